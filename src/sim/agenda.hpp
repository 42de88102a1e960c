#pragma once

#include <set>
#include <utility>
#include <vector>

namespace trajet {

/// Which course of a run has something to handle next, in the order of time; at one time the course of lower index.
class Agenda {
 public:
  explicit Agenda(std::size_t course_count) : ahead_(course_count, 0.0) {}

  /// Enters a course, or moves its entry. `ahead`: the time from the run's start on, in its direction, s.
  void set(double ahead, int course) {
    double& known = ahead_[static_cast<std::size_t>(course)];
    entries_.erase({known, course});
    known = ahead;
    entries_.insert({ahead, course});
  }
  bool empty() const { return entries_.empty(); }
  int next() const { return entries_.begin()->second; }
  void pop() { entries_.erase(entries_.begin()); }
  void clear() { entries_.clear(); }

 private:
  std::set<std::pair<double, int>> entries_;
  std::vector<double> ahead_;  // of the entry of each course, if it has one
};

}  // namespace trajet
