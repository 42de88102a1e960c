// What is thinner than the rounding of the places where it is met: a path through it is a hit, not a graze, and is
// never lost without a word.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::number;
using test::run_text;
using test::Way;

enum class Kind { box, cylinder, cone, ellipsoid, disk, triangle, compound, capsule, rod, sphere };

/// An obstacle across the x axis at `x`, `thickness` thick along it; the last three are so thin across it too.
std::string obstacle(Kind kind, double x, double thickness) {
  const std::string h = number(thickness), half = number(0.5 * thickness);
  const std::string center = "center = [" + number(x) + ", 0, 0]\n";
  const std::string along_x = "orientation = {axis = [0, 1, 0], angle = \"90 deg\"}\n";
  switch (kind) {
    case Kind::box:
      return center + "shape = \"box\"\nsize = [" + h + ", 1, 1]\n";
    case Kind::cylinder:
      return center + along_x + "shape = \"cylinder\"\nradius = 0.5\nheight = " + h + "\n";
    case Kind::cone:
      return center + along_x + "shape = \"cone\"\nradius = 0.5\nheight = " + h + "\n";
    case Kind::ellipsoid:
      return center + "shape = \"ellipsoid\"\nradii = [" + half + ", 0.5, 0.5]\n";
    case Kind::disk:
      return center + "shape = \"disk\"\nnormal = [1, 0, 0]\nradius = 0.5\n";
    case Kind::triangle:
      return "shape = \"triangle\"\npoints = [[" + number(x) + ", -1, -1], [" + number(x) + ", 1, -1], [" + number(x) +
             ", 0, 1]]\n";
    case Kind::compound:
      return center + "shape = \"compound\"\nparts = [{shape = \"box\", size = [" + h + ", 1, 1]}]\n";
    case Kind::capsule:
      return center + "shape = \"capsule\"\nheight = 1\nradius = " + half + "\n";
    case Kind::rod:
      return center + "shape = \"cylinder\"\nheight = 1\nradius = " + half + "\n";
    case Kind::sphere:
      return center + "shape = \"sphere\"\nradius = " + half + "\n";
  }
  return {};
}

TEST(ThinObstacles, APathThroughThemIsAHit) {
  std::mt19937 random(3);
  std::uniform_real_distribution<> uniform(0.0, 1.0);
  constexpr double kSlopes[] = {0.0, 0.1, 0.3, 1.0}, kPlaces[] = {0.0, 0.0, 12.5, 1e3},
                   kSpeeds[] = {1e-3, 1.0, 340, 1e5};
  int undecided = 0;
  for (std::size_t i = 0; i < 1200; ++i) {
    const auto kind = static_cast<Kind>(i % 10);
    const bool is_narrow = kind >= Kind::capsule;
    const double distance = std::pow(10.0, 6.0 * uniform(random));
    const double x = kPlaces[random() % 4], v = kSpeeds[random() % 4], slope = is_narrow ? 0.0 : kSlopes[random() % 4];
    // a ball no larger than the rounding of its own place may be missed by a straight line that is as exact as can be
    const double least = kind == Kind::sphere || i % 3 == 0 ? 1e-14 * (distance + x) : 1e-16;
    const double thickness = std::max(least, std::pow(10.0, -16.0 + 10.0 * uniform(random)));
    const double radius = i % 3 == 0 ? thickness / 3.0 : 0.0, meets = distance / v;
    const Way ways[] = {{"taylor", "name = \"taylor\"\n"},
                        {"dopri5", "name = \"dopri5\"\n"},
                        test::fixed("rk4", meets / 7.3),
                        test::fixed("rk4", meets / 4.0)};  // a step ends there
    const std::string text = "[time]\nend = " + number(2.0 * meets) + "\n[method]\n" + ways[random() % 4].lines +
                             "[[body]]\nname = \"p\"\n" +
                             (radius > 0.0 ? "shape = \"sphere\"\nradius = " + number(radius) + "\n" : "") +
                             "position = [" + number(x - distance) + ", " + number(-slope * distance) +
                             ", 0]\nvelocity = [" + number(v) + ", " + number(slope * v) +
                             ", 0]\n[[obstacle]]\nname = \"a\"\non_hit = \"bounce\"\n" + obstacle(kind, x, thickness);
    SCOPED_TRACE(text);
    const RunResult result = run_text(text);
    if (result.status == RunStatus::failed) {
      ASSERT_FALSE(result.failure.empty());  // said, not silent
      ++undecided;
      continue;
    }
    ASSERT_EQ(result.impacts.size(), 1u);
    const Impact& hit = result.impacts.front();
    ASSERT_EQ(hit.kind, ImpactKind::hit);
    ASSERT_NEAR(hit.time, meets, 1e-9 * meets + 2.0 * thickness / v);
    ASSERT_NEAR(hit.normal.norm(), 1.0, 1e-14);
    ASSERT_LT(hit.normal.x(), -0.5);
    ASSERT_LT(hit.velocity_after.x(), 0.0);
    ASSERT_NEAR(hit.velocity_after.norm(), hit.velocity_before.norm(), 1e-12 * v);
  }
  EXPECT_LE(undecided, 12);
}

TEST(ThinObstacles, ThroughOneThatLetsPassItGoesInAndOut) {
  const RunResult result = run_text(
      "[time]\nend = 2\n[[body]]\nname = \"p\"\nposition = [-1e5, 0, 0]\nvelocity = [1e5, 0, 0]\n[[obstacle]]\nname = "
      "\"a\"\nshape = \"box\"\ncenter = [0, 0, 0]\nsize = [1e-12, 1, 1]\non_hit = \"pass\"\n");
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  ASSERT_EQ(result.impacts.size(), 2u);
  for (const Impact& impact : result.impacts) {
    EXPECT_EQ(impact.kind, ImpactKind::hit);
    EXPECT_NEAR(impact.time, 1.0, 1e-14);
  }
  EXPECT_EQ(test::final_of(result, "p").position.x(), 1e5);
}

TEST(ThinObstacles, WhatPassesBesideThemMeetsNothingAndATouchOfThickOnesIsAGraze) {
  const auto beside = [](const std::string& y, const std::string& size) {
    return run_text(
        "[time]\nend = 2\n[[body]]\nname = \"p\"\nposition = [-1e3, " + y +
        ", 0]\nvelocity = [1e3, 0, 0]\n[[obstacle]]\nname = \"a\"\nshape = \"box\"\ncenter = [0, 0, 0]\nsize = " +
        size + "\non_hit = \"bounce\"\n");
  };
  EXPECT_TRUE(beside("0.50001", "[1e-15, 1, 1]").impacts.empty());
  const RunResult touched = beside("0.5", "[1, 1, 1]");
  for (const Impact& impact : touched.impacts) EXPECT_EQ(impact.kind, ImpactKind::graze);
  // the edge of a wedge, clipped
  const RunResult wedge = run_text(
      "[time]\nend = 2\n[[body]]\nname = \"p\"\nposition = [-1, 1, 0]\nvelocity = [1, 0, 0]\n[[obstacle]]\nname = "
      "\"a\"\nshape = \"cone\"\nradius = 0.25\nheight = 1\ncenter = [0, 0.25, 0]\norientation = {axis = [1, 0, 0], "
      "angle = "
      "\"-90 deg\"}\non_hit = \"bounce\"\n");
  for (const Impact& impact : wedge.impacts) EXPECT_EQ(impact.kind, ImpactKind::graze);
}

}  // namespace
}  // namespace trajet
