#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trajet/geom/aabb.hpp"

namespace trajet {

/// A balanced tree over boxes: finds those that overlap a box in a time that grows like the logarithm of their number.
///
/// Boxes that are not bounded, those of planes, stay outside the tree and are tried by every query. The same boxes give
/// the same tree, and a query visits in the same order.
class BoxTree {
 public:
  BoxTree() = default;
  /// At most 2^31 - 1 boxes.
  explicit BoxTree(std::span<const Aabb> boxes);

  int size() const { return static_cast<int>(items_.size() + unbounded_.size()); }

  /// Calls `visit(index)` for each box that overlaps `query`: first the unbounded ones, then the others in the order of
  /// the tree. Where `visit` returns false the query stops and returns false, else true.
  template <class Visit>
  bool visit_overlapping(const Aabb& query, Visit&& visit) const {
    for (const Item& item : unbounded_)
      if (overlaps(item.box, query) && !visit(static_cast<int>(item.index))) return false;
    if (nodes_.empty()) return true;
    std::array<std::uint32_t, kMaxDepth> open;
    std::size_t open_count = 0;
    std::uint32_t at = 0;
    while (true) {
      const Node& node = nodes_[at];
      if (overlaps(node.box, query)) {
        if (node.count == 0) {
          open[open_count++] = node.first;  // its second child; the first one is its neighbour
          ++at;
          continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
          if (overlaps(items_[i].box, query) && !visit(static_cast<int>(items_[i].index))) return false;
      }
      if (open_count == 0) return true;
      at = open[--open_count];
    }
  }

 private:
  static constexpr std::size_t kMaxDepth = 32;  // halving 2^31 items

  struct Item {
    Aabb box;
    std::uint32_t index;
  };
  /// In depth-first order.
  struct Node {
    Aabb box;
    std::uint32_t first;  ///< of its items; of an inner node, the index of its second child
    std::uint32_t count;  ///< of its items; 0: an inner node
  };

  class Builder;

  std::vector<Node> nodes_;
  std::vector<Item> items_;      // in the order of the leaves
  std::vector<Item> unbounded_;  // in the order of the boxes given
};

}  // namespace trajet
