#pragma once

#include <numeric>
#include <vector>

namespace trajet {

/// Disjoint sets of 0..n-1 that can be joined: which motions depend on each other.
class Partition {
 public:
  explicit Partition(int size) : parent_(static_cast<std::size_t>(size)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  /// The smallest member of the set that holds `i`.
  int find(int i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }

  void join(int i, int j) {
    const int a = find(i), b = find(j);
    parent(a < b ? b : a) = a < b ? a : b;
  }

 private:
  int& parent(int i) { return parent_[static_cast<std::size_t>(i)]; }
  std::vector<int> parent_;
};

}  // namespace trajet
