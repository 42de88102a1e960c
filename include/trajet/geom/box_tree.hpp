#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "trajet/geom/aabb.hpp"

namespace trajet {

/// A balanced tree over boxes: finds those that overlap a box in a time that grows like the logarithm of their number.
///
/// Boxes that are not bounded, those of planes, stay outside the tree and are tried by every query. The same boxes give
/// the same tree, and a query visits in the same order.
///
/// It keeps boxes in single precision, relative to the middle of all, and wider by their rounding: a query may also
/// visit boxes that it misses by so little.
class BoxTree {
 public:
  BoxTree() = default;
  /// At most 2^31 - 1 boxes.
  explicit BoxTree(std::span<const Aabb> boxes);
  /// Over `count` boxes, which are asked for when they are needed, more than once.
  BoxTree(int count, const std::function<Aabb(int)>& box);

  int size() const { return static_cast<int>(items_.size() + unbounded_.size()); }

  /// Calls `visit(index)` for each box that overlaps `query`: first the unbounded ones, then the others in the order of
  /// the tree. Where `visit` returns false the query stops and returns false, else true.
  template <class Visit>
  bool visit_overlapping(const Aabb& query, Visit&& visit) const {
    for (const Unbounded& each : unbounded_)
      if (overlaps(each.box, query) && !visit(static_cast<int>(each.index))) return false;
    if (nodes_.empty()) return true;
    const Box near = box_around(query);
    std::array<std::uint32_t, kMaxDepth> open;
    std::size_t open_count = 0;
    std::uint32_t at = 0;
    while (true) {
      const Node& node = nodes_[at];
      if (overlap(node.box, near)) {
        if (node.count == 0) {
          open[open_count++] = node.first;  // its second child; the first one is its neighbour
          ++at;
          continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
          if (overlap(items_[i].box, near) && !visit(static_cast<int>(items_[i].index))) return false;
      }
      if (open_count == 0) return true;
      at = open[--open_count];
    }
  }

 private:
  static constexpr std::size_t kMaxDepth = 32;  // halving 2^31 items

  struct Unbounded {
    Aabb box;
    std::uint32_t index;
  };
  /// Relative to the origin.
  struct Box {
    std::array<float, 3> lower, upper;
  };
  struct Item {
    Box box;
    std::uint32_t index;
  };
  /// In depth-first order.
  struct Node {
    Box box;
    std::uint32_t first;  ///< of its items; of an inner node, the index of its second child
    std::uint32_t count;  ///< of its items; 0: an inner node
  };

  class Builder;

  Box box_around(const Aabb& box) const;
  static bool overlap(const Box& a, const Box& b) {
    for (std::size_t i = 0; i < 3; ++i)
      if (a.lower[i] > b.upper[i] || a.upper[i] < b.lower[i]) return false;
    return true;
  }

  Vector3 origin_ = Vector3::Zero();  // the middle of all bounded boxes
  std::vector<Node> nodes_;
  std::vector<Item> items_;           // in the order of the leaves
  std::vector<Unbounded> unbounded_;  // in the order of the boxes given
};

}  // namespace trajet
