#include "trajet/geom/moving_boxes.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <map>
#include <utility>

namespace trajet {
namespace {

using Corner = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
using Box = boost::geometry::model::box<Corner>;
using Item = std::pair<Box, int>;

Box box_of(const Aabb& box) {
  return {{box.lower.x(), box.lower.y(), box.lower.z()}, {box.upper.x(), box.upper.y(), box.upper.z()}};
}

}  // namespace

class MovingBoxes::Tree {
 public:
  static constexpr int kMostInNode = 8;
  boost::geometry::index::rtree<Item, boost::geometry::index::rstar<kMostInNode>> bounded;
  std::map<int, Aabb> unbounded;
};

MovingBoxes::MovingBoxes() : tree_(std::make_unique<Tree>()) {}
MovingBoxes::~MovingBoxes() = default;

void MovingBoxes::insert(int index, const Aabb& box) {
  if (is_bounded(box)) {
    tree_->bounded.insert({box_of(box), index});
  } else {
    tree_->unbounded.emplace(index, box);
  }
}

void MovingBoxes::remove(int index, const Aabb& box) {
  if (is_bounded(box)) {
    tree_->bounded.remove({box_of(box), index});
  } else {
    tree_->unbounded.erase(index);
  }
}

void MovingBoxes::visit_overlapping(const Aabb& query, const std::function<bool(int)>& visit) const {
  for (const auto& [index, box] : tree_->unbounded)
    if (overlaps(box, query) && !visit(index)) return;
  if (!is_bounded(query)) {
    for (const Item& item : tree_->bounded)
      if (!visit(item.second)) return;
    return;
  }
  const auto end = tree_->bounded.qend();
  for (auto item = tree_->bounded.qbegin(boost::geometry::index::intersects(box_of(query))); item != end; ++item)
    if (!visit(item->second)) return;
}

}  // namespace trajet
