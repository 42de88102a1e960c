#pragma once

#include <functional>
#include <memory>

#include "trajet/geom/aabb.hpp"

namespace trajet {

/// Boxes that come and go, each known by an index: finds those that overlap a box in a time that grows like the
/// logarithm of their number. An R*-tree; boxes without bounds are tried by every query.
class MovingBoxes {
 public:
  MovingBoxes();
  ~MovingBoxes();

  /// The index must not be in use.
  void insert(int index, const Aabb& box);
  /// The box must be the one that was inserted.
  void remove(int index, const Aabb& box);
  /// Calls `visit(index)` for each box that overlaps `query`; where it returns false the query stops.
  void visit_overlapping(const Aabb& query, const std::function<bool(int)>& visit) const;

 private:
  class Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace trajet
