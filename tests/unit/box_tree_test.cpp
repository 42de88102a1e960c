#include "trajet/geom/box_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace trajet {
namespace {

Aabb random_box(std::mt19937& random, double extent, double largest) {
  std::uniform_real_distribution<double> place(-extent, extent), size(0.0, largest);
  const Vector3 lower(place(random), place(random), place(random));
  return {lower, lower + Vector3(size(random), size(random), size(random))};
}

std::vector<int> found_by_tree(const BoxTree& tree, const Aabb& query) {
  std::vector<int> found;
  EXPECT_TRUE(tree.visit_overlapping(query, [&](int index) {
    found.push_back(index);
    return true;
  }));
  return found;
}

std::vector<int> found_one_by_one(const std::vector<Aabb>& boxes, const Aabb& query) {
  std::vector<int> found;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (overlaps(boxes[i], query)) found.push_back(static_cast<int>(i));
  return found;
}

std::vector<int> sorted(std::vector<int> indices) {
  std::ranges::sort(indices);
  return indices;
}

TEST(Aabb, ClosedBoxesOverlapWhereTheyTouch) {
  const Aabb unit{Vector3(0, 0, 0), Vector3(1, 1, 1)};
  EXPECT_TRUE(overlaps(unit, {Vector3(1, 1, 1), Vector3(2, 2, 2)}));
  EXPECT_FALSE(overlaps(unit, {Vector3(1.5, 0, 0), Vector3(2, 1, 1)}));
  EXPECT_FALSE(overlaps(unit, {Vector3(0, 0, -2), Vector3(1, 1, -1)}));
  EXPECT_TRUE(overlaps(grown(unit, 0.5), {Vector3(1.5, 0, 0), Vector3(2, 1, 1)}));
  EXPECT_TRUE(overlaps(unit, unbounded_box()));
  EXPECT_FALSE(overlaps(unit, Aabb()));
  EXPECT_TRUE(overlaps(unit, {Vector3::Constant(std::nan("")), Vector3(5, 5, 5)}));
  EXPECT_EQ(united(Aabb(), unit).upper, unit.upper);
  EXPECT_EQ(united(unit, Vector3(0.5, -3, 2)).lower, Vector3(0, -3, 0));
}

TEST(BoxTree, FindsWhatASearchOneByOneFinds) {
  std::mt19937 random(1);
  for (const int count : {0, 1, 2, 3, 4, 5, 8, 9, 17, 100, 1000}) {
    std::vector<Aabb> boxes;
    for (int i = 0; i < count; ++i) boxes.push_back(random_box(random, 10.0, i % 7 == 0 ? 8.0 : 1.0));
    const BoxTree tree(boxes);
    EXPECT_EQ(tree.size(), count);
    for (int i = 0; i < 200; ++i) {
      const Aabb query = random_box(random, 12.0, i % 5 == 0 ? 10.0 : 1.0);
      EXPECT_EQ(sorted(found_by_tree(tree, query)), found_one_by_one(boxes, query));
    }
    EXPECT_EQ(found_by_tree(tree, unbounded_box()).size(), static_cast<std::size_t>(count));
    EXPECT_TRUE(found_by_tree(tree, Aabb()).empty());
  }
}

TEST(BoxTree, EqualCentresAndFlatBoxes) {
  const std::vector<Aabb> boxes(50, {Vector3(1, 2, 3), Vector3(1, 3, 3)});
  const BoxTree tree(boxes);
  const std::vector<int> found = found_by_tree(tree, {Vector3(1, 3, 3), Vector3(4, 4, 4)});
  EXPECT_EQ(sorted(found), found_one_by_one(boxes, unbounded_box()));
}

TEST(BoxTree, UnboundedBoxesComeFirstAndOnlyWhereTheyReach) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<Aabb> boxes;
  for (int i = 0; i < 20; ++i) boxes.push_back({Vector3(i, 0, 0), Vector3(i + 0.5, 1, 1)});
  const Aabb below{Vector3::Constant(-kInfinity), Vector3(kInfinity, kInfinity, 0.0)};
  boxes.insert(boxes.begin() + 10, below);
  boxes.push_back(Aabb());
  const BoxTree tree(boxes);
  EXPECT_EQ(found_by_tree(tree, {Vector3(3.1, 0, 0), Vector3(3.2, 1, 1)}), (std::vector<int>{10, 3}));
  EXPECT_EQ(found_by_tree(tree, {Vector3(3.1, 0, 0.5), Vector3(3.2, 1, 1)}), (std::vector<int>{3}));
}

TEST(BoxTree, StopsWhereTheVisitorHasEnough) {
  const std::vector<Aabb> boxes(100, {Vector3(0, 0, 0), Vector3(1, 1, 1)});
  const BoxTree tree(boxes);
  int visits = 0;
  EXPECT_FALSE(tree.visit_overlapping(boxes[0], [&](int) { return ++visits < 7; }));
  EXPECT_EQ(visits, 7);
}

TEST(BoxTree, TheSameBoxesGiveTheSameOrder) {
  std::mt19937 random(2);
  std::vector<Aabb> boxes;
  for (int i = 0; i < 500; ++i) boxes.push_back(random_box(random, 5.0, 1.0));
  const BoxTree a(boxes), b(boxes);
  EXPECT_EQ(found_by_tree(a, unbounded_box()), found_by_tree(b, unbounded_box()));
}

}  // namespace
}  // namespace trajet
