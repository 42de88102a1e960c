#include "trajet/geom/box_tree.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

namespace trajet {

namespace {

/// Leaves of so many boxes are searched one after the other.
constexpr std::uint32_t kLeafSize = 4;

/// Of a tree of so many boxes.
std::size_t node_count(std::uint32_t boxes) {
  if (boxes <= kLeafSize) return 1;
  const std::uint32_t half = boxes / 2;
  const std::size_t lesser = node_count(half);
  return 1 + lesser + (2 * half == boxes ? lesser : node_count(boxes - half));
}

}  // namespace

/// Orders the boxes by halving.
class BoxTree::Builder {
 public:
  Builder(BoxTree& tree, int count, const std::function<Aabb(int)>& box) : tree_(tree), box_(box) {
    centers_.reserve(static_cast<std::size_t>(count));
    keys_.reserve(static_cast<std::size_t>(count));
    Aabb around;
    for (int i = 0; i < count; ++i) {
      const Aabb each = box(i);
      centers_.push_back((each.lower + each.upper).cast<float>());
      if (is_bounded(each)) {
        keys_.push_back(static_cast<std::uint32_t>(i));
        around = united(around, each);
      } else {
        tree.unbounded_.push_back({each, static_cast<std::uint32_t>(i)});
      }
    }
    if (keys_.empty()) return;
    tree.origin_ = 0.5 * around.lower + 0.5 * around.upper;
    tree.items_.reserve(keys_.size());
    tree.nodes_.reserve(node_count(static_cast<std::uint32_t>(keys_.size())));
    build(0, static_cast<std::uint32_t>(keys_.size()));
  }

 private:
  /// Appends the nodes and the items of some keys; returns the box around them.
  Box build(std::uint32_t first, std::uint32_t count) {
    const std::size_t own = tree_.nodes_.size();
    tree_.nodes_.push_back({{}, first, count});
    Box box;
    box.lower.fill(std::numeric_limits<float>::infinity());
    box.upper.fill(-std::numeric_limits<float>::infinity());
    if (count <= kLeafSize) {
      for (std::uint32_t i = first; i < first + count; ++i) {
        tree_.items_.push_back({tree_.box_around(box_(static_cast<int>(index(keys_[i])))), index(keys_[i])});
        unite(box, tree_.items_.back().box);
      }
    } else {
      const std::uint32_t half = count / 2;
      halve(first, count, half);
      unite(box, build(first, half));
      tree_.nodes_[own].first = static_cast<std::uint32_t>(tree_.nodes_.size());
      tree_.nodes_[own].count = 0;
      unite(box, build(first + half, count - half));
    }
    tree_.nodes_[own].box = box;
    return box;
  }

  static void unite(Box& box, const Box& other) {
    for (std::size_t i = 0; i < 3; ++i) {
      box.lower[i] = std::min(box.lower[i], other.lower[i]);
      box.upper[i] = std::max(box.upper[i], other.upper[i]);
    }
  }

  /// At the median of the centres along the axis on which they spread most. Equal centres keep the order of their
  /// indices, so that the tree does not depend on how the library selects.
  void halve(std::uint32_t first, std::uint32_t count, std::uint32_t half) {
    const std::span<std::uint64_t> keys(keys_.data() + first, count);
    Eigen::Vector3f lower = centers_[index(keys[0])], upper = lower;
    for (const std::uint64_t key : keys) {
      lower = lower.cwiseMin(centers_[index(key)]);
      upper = upper.cwiseMax(centers_[index(key)]);
    }
    Eigen::Index axis = 0;
    (upper - lower).maxCoeff(&axis);
    for (std::uint64_t& key : keys) key = std::uint64_t{ordered(centers_[index(key)][axis])} << 32 | index(key);
    std::nth_element(keys.begin(), keys.begin() + half, keys.end());
  }

  static std::uint32_t index(std::uint64_t key) { return static_cast<std::uint32_t>(key); }

  /// An integer that grows with x.
  static std::uint32_t ordered(float x) {
    std::uint32_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    constexpr std::uint32_t kSign = 0x80000000U;
    return (bits & kSign) != 0U ? ~bits : bits | kSign;
  }

  BoxTree& tree_;
  const std::function<Aabb(int)>& box_;
  std::vector<Eigen::Vector3f> centers_;  // doubled
  std::vector<std::uint64_t> keys_;       // a centre's coordinate in the upper half, the index of the box in the lower
};

BoxTree::BoxTree(std::span<const Aabb> boxes)
    : BoxTree(static_cast<int>(boxes.size()), [boxes](int i) { return boxes[static_cast<std::size_t>(i)]; }) {
  assert(boxes.size() <= std::numeric_limits<std::int32_t>::max());
}

BoxTree::BoxTree(int count, const std::function<Aabb(int)>& box) { Builder(*this, count, box); }

BoxTree::Box BoxTree::box_around(const Aabb& box) const {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Box result;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    // the next number out is beyond the rounding of the difference and of the conversion
    result.lower[i] = std::nextafter(static_cast<float>(box.lower[axis] - origin_[axis]), -kInfinity);
    result.upper[i] = std::nextafter(static_cast<float>(box.upper[axis] - origin_[axis]), kInfinity);
  }
  return result;
}

}  // namespace trajet
