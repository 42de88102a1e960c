#include "trajet/geom/box_tree.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>

namespace trajet {

namespace {

/// Leaves of so many boxes are searched one after the other.
constexpr std::uint32_t kLeafSize = 4;

}  // namespace

/// Orders the boxes by halving.
class BoxTree::Builder {
 public:
  Builder(BoxTree& tree, std::span<const Aabb> boxes) : tree_(tree), boxes_(boxes) {
    centers_.reserve(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      centers_.push_back((boxes[i].lower + boxes[i].upper).cast<float>());
      if (is_bounded(boxes[i])) {
        keys_.push_back(i);
      } else {
        tree.unbounded_.push_back({boxes[i], i});
      }
    }
    if (keys_.empty()) return;
    tree.items_.reserve(keys_.size());
    // Every leaf but a lone one holds at least two boxes, so that leaves and inner nodes are no more than the boxes.
    tree.nodes_.reserve(keys_.size());
    build(0, static_cast<std::uint32_t>(keys_.size()));
    tree.nodes_.shrink_to_fit();
  }

 private:
  /// Appends the nodes and the items of some keys; returns the box around them.
  Aabb build(std::uint32_t first, std::uint32_t count) {
    const std::size_t own = tree_.nodes_.size();
    tree_.nodes_.push_back({{}, first, count});
    Aabb box;
    if (count <= kLeafSize) {
      for (std::uint32_t i = first; i < first + count; ++i) {
        tree_.items_.push_back({boxes_[index(keys_[i])], index(keys_[i])});
        box = united(box, tree_.items_.back().box);
      }
    } else {
      const std::uint32_t half = count / 2;
      halve(first, count, half);
      box = build(first, half);
      tree_.nodes_[own].first = static_cast<std::uint32_t>(tree_.nodes_.size());
      tree_.nodes_[own].count = 0;
      box = united(box, build(first + half, count - half));
    }
    tree_.nodes_[own].box = box;
    return box;
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
  std::span<const Aabb> boxes_;
  std::vector<Eigen::Vector3f> centers_;  // doubled
  std::vector<std::uint64_t> keys_;       // a centre's coordinate in the upper half, the index of the box in the lower
};

BoxTree::BoxTree(std::span<const Aabb> boxes) {
  assert(boxes.size() <= std::numeric_limits<std::int32_t>::max());
  Builder(*this, boxes);
}

}  // namespace trajet
