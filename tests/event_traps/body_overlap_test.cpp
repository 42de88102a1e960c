// Bodies that pass through each other: each run says so once, with the pair and the time.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <optional>
#include <random>

#include "scene_run.hpp"
#include "src/sim/body_overlaps.hpp"

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

/// Looks for overlaps as a run does, and counts.
class Looker : public RunObserver {
 public:
  RunWishes wishes() const override { return {.motion = true}; }
  void begin(const World& world) override { overlaps_.emplace(world_.emplace(world)); }
  void motion(const MotionPiece& piece) override {
    ++pieces;
    overlaps_->add(piece);
  }
  long trees(double end_time) {
    EXPECT_FALSE(overlaps_->finish(end_time));
    return overlaps_->trees();
  }

  long pieces = 0;

 private:
  std::optional<World> world_;  // it is asked when the run is over
  std::optional<BodyOverlaps> overlaps_;
};

TEST(BodyOverlap, APieceOfMotionCostsNoMoreThanItsShareOfATree) {
  constexpr int kBodies = 40;
  std::string bodies;
  for (int i = 0; i < kBodies; ++i)
    bodies += body("b" + std::to_string(i), ball(0.1), Vector3(i, 0.0, 1.0 + 0.01 * i), Vector3::Zero()) +
              "acceleration = [0, 0, -9.81]\n";
  const std::string ground =
      "[[obstacle]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\non_hit = "
      "\"bounce\"\n";
  Looker flying, bouncing;
  run_text("[time]\nend = 8\n" + bodies, &flying);
  // one Segment for each: windows double from an eighth of a second on
  EXPECT_EQ(flying.pieces, kBodies);
  EXPECT_LE(flying.trees(8.0), 7);
  run_text("[time]\nend = 8\n" + bodies + ground, &bouncing);
  EXPECT_GT(bouncing.pieces, 8 * kBodies);
  EXPECT_LE(bouncing.trees(8.0), 7 + bouncing.pieces / kBodies);
}

}  // namespace
}  // namespace trajet
