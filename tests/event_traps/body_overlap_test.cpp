// Bodies that pass through each other: each run says so once, with the pair and the time.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::number;
using test::run_text;

std::string vector(const Vector3& v) { return "[" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + "]"; }

std::string body(const std::string& name, const std::string& shape, const Vector3& position, const Vector3& velocity) {
  return "[[body]]\nname = \"" + name + "\"\n" + shape + "position = " + vector(position) +
         "\nvelocity = " + vector(velocity) + "\n";
}

std::string ball(double radius) {
  return radius > 0.0 ? "shape = \"sphere\"\nradius = " + number(radius) + "\n" : std::string();
}

std::vector<std::string> overlaps(const RunResult& result) {
  std::vector<std::string> found;
  for (const std::string& warning : result.warnings)
    if (warning.find(" overlap from t = ") != std::string::npos) found.push_back(warning);
  return found;
}

double time_in(const std::string& warning) { return std::strtod(warning.c_str() + warning.find("t = ") + 4, nullptr); }

TEST(BodyOverlap, BallsAndPointsAreSeenFromTheirFirstTouchOn) {
  // |d + w t| = R has its first root where the balls touch
  std::mt19937 random(3);
  std::uniform_real_distribution<> uniform(-1.0, 1.0);
  const auto draw = [&] { return Vector3(uniform(random), uniform(random), uniform(random)); };
  int seen = 0;
  for (int i = 0; i < 1000; ++i) {
    const double a = i % 3 == 0 ? 0.0 : 0.3 + 0.2 * uniform(random), b = 0.4 + 0.2 * uniform(random), reach = a + b;
    const Vector3 at_a = draw(), at_b = at_a + 3.0 * draw(), v_a = draw(),
                  v_b = v_a - 0.7 * (at_b - at_a) + 0.3 * draw();
    const Vector3 d = at_b - at_a, w = v_b - v_a;
    const double along = d.dot(w), rest = along * along - w.squaredNorm() * (d.squaredNorm() - reach * reach);
    const double enters = (-along - std::sqrt(rest)) / w.squaredNorm(),
                 leaves = (-along + std::sqrt(rest)) / w.squaredNorm();
    // a meeting of less than the shortest pieces into which 10 s are cut, 10 / 2^16, may be missed
    if (std::abs(rest) < 1e-6 || (leaves > 0.0 && leaves - enters < 1e-3) || std::abs(enters) < 1e-3) continue;
    const std::string text =
        "[time]\nend = 10\n" + body("first", ball(a), at_a, v_a) + body("second", ball(b), at_b, v_b);
    SCOPED_TRACE(text);
    const std::vector<std::string> found = overlaps(run_text(text));
    const bool meet = rest > 0.0 && leaves > 0.0 && enters < 10.0;
    ASSERT_EQ(found.size(), meet ? 1u : 0u);
    if (!meet) continue;
    ++seen;
    ASSERT_NE(found[0].find("'first' and 'second'"), std::string::npos);
    // a depth of 1e-12 of the lengths is not seen, up to 1e-11 m; at the speed with which they approach
    ASSERT_NEAR(time_in(found[0]), std::max(0.0, enters), 1e-11 * reach * w.norm() / std::sqrt(rest) + 1e-13);
  }
  EXPECT_GT(seen, 100);
}

TEST(BodyOverlap, TheFirstOfManyPairsIsNamedOnce) {
  std::string text = "[time]\nend = 10\n";
  // ball k meets the wall of balls at t = 9 - k
  for (int k = 0; k < 9; ++k) {
    text += body("a" + std::to_string(k), ball(0.1), {0, double(k), 0}, {1, 0, 0});
    text += body("b" + std::to_string(k), ball(0.1), {9.2 - k, double(k), 0}, {0, 0, 0});
  }
  const std::vector<std::string> found = overlaps(run_text(text));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("'a8' and 'b8'"), std::string::npos) << found[0];
  EXPECT_NEAR(time_in(found[0]), 1.0, 1e-10);
}

TEST(BodyOverlap, BoxesOverlapByTheirShapesNotByTheBallsAroundThem) {
  const std::string cube = "shape = \"box\"\nsize = [0.4, 0.4, 0.4]\n";
  const auto run_past = [&](double beside) {
    return overlaps(run_text("[time]\nend = 4\n" + body("cube", cube, {0, 0, 0}, {0, 0, 0}) +
                             body("other", cube, {-2, beside, 0}, {1, 0, 0})));
  };
  ASSERT_EQ(run_past(0.39).size(), 1u);
  EXPECT_NEAR(time_in(run_past(0.39)[0]), 1.6, 1e-10);
  EXPECT_TRUE(run_past(0.41).empty());
}

TEST(BodyOverlap, ABounceBeforeTheMeetingPreventsIt) {
  const std::string wall =
      "[[obstacle]]\nname = \"wall\"\nshape = \"disk\"\ncenter = [1, 0, 0]\nnormal = [-1, 0, 0]\nradius = 1\non_hit = "
      "\"bounce\"\n";
  const std::string bodies =
      body("one", ball(0.1), {0, 0, 0}, {1, 0, 0}) + body("two", ball(0.1), {2, 0, 0}, {0, 0, 0});
  EXPECT_TRUE(overlaps(run_text("[time]\nend = 5\n" + bodies + wall)).empty());
  EXPECT_EQ(overlaps(run_text("[time]\nend = 5\n" + bodies)).size(), 1u);
}

TEST(BodyOverlap, PointsAlwaysMissEachOther) {
  EXPECT_TRUE(overlaps(run_text("[time]\nend = 5\n" + body("one", "", {0, 0, 0}, {1, 0, 0}) +
                                body("two", "", {2, 0, 0}, {0, 0, 0})))
                  .empty());
}

}  // namespace
}  // namespace trajet
