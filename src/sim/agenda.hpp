#pragma once

#include <functional>
#include <queue>
#include <vector>

namespace trajet {

/// Which course of a run has something to handle next, in the order of time; at one time the course of lower index.
class Agenda {
 public:
  /// `ahead`: the time from the run's start on, in its direction, s.
  void add(double ahead, int course) { entries_.push({ahead, course}); }
  bool empty() const { return entries_.empty(); }
  int next() const { return entries_.top().course; }
  void pop() { entries_.pop(); }

 private:
  struct Entry {
    double ahead;
    int course;
    bool operator>(const Entry& other) const {
      return ahead != other.ahead ? ahead > other.ahead : course > other.course;
    }
  };
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> entries_;
};

}  // namespace trajet
