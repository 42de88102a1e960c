// All kinds of solids bounce on all kinds of obstacles, at rest and moving: every contact is told and left, none is
// passed by, and the energy of what bounces without loss is kept.

#include <gtest/gtest.h>

#include "solid_kinds.hpp"
#include "trajet/sim/run_observer.hpp"

namespace trajet::test {
namespace {

constexpr double kGravity = 9.8, kMass = 2.5;

/// Sees to it that nothing overlaps at any sample.
class Guard : public RunObserver {
 public:
  explicit Guard(const Drive& drive) : oracle_(drive) {}
  RunWishes wishes() const override { return {.motion = false, .samples = true}; }
  void begin(const World& world) override { oracle_.begin(world); }
  void sample(const Sample& sample) override {
    if (sample.phase != SamplePhase::none) return;  // at an impact they touch
    ++looks;
    overlaps += oracle_.overlaps(sample.bodies.front(), sample.time);
  }

  long looks = 0;
  long overlaps = 0;

 private:
  OverlapOracle oracle_;
};

double energy_of(const BodyState& state, const Matrix3& inertia) {
  const Matrix3& R = state.rotation_matrix;
  return 0.5 * kMass * state.velocity.squaredNorm() + kMass * kGravity * state.position.z() +
         0.5 * state.angular_velocity.dot(R * inertia * R.transpose() * state.angular_velocity);
}

class SolidMatrix : public testing::TestWithParam<std::size_t> {};

TEST_P(SolidMatrix, WhatBouncesIsNeverInside) {
  const Kind& other = obstacles()[GetParam()];
  int impacts = 0;
  for (std::size_t b = 0; b < bodies().size(); ++b)
    for (int k = 0; k < 4; ++k) {
      const bool is_driven = k % 2 == 1;
      const double restitution = k < 2 ? 1.0 : 0.7;
      const Kind& body = bodies()[b];
      SCOPED_TRACE(body.name + " on " + other.name + " " + std::to_string(k));
      const Throw thrown = random_throw(
          body, other, is_driven, "on_hit = \"bounce\"\nrestitution = " + number(restitution) + "\n", kMass,
          static_cast<unsigned>(7919 * GetParam() + 104729 * b + 1009 * static_cast<std::size_t>(k) + 17));
      Guard guard(thrown.drive);
      const RunResult result = run(thrown.scene, &guard);
      impacts += static_cast<int>(result.impacts.size());
      EXPECT_GT(guard.looks, 0);
      EXPECT_EQ(guard.overlaps, 0);
      const bool has_come_to_rest = result.failure.find("comes to rest on") != std::string::npos;
      EXPECT_TRUE(result.status == RunStatus::finished || (restitution < 1.0 && has_come_to_rest)) << result.failure;
      if (restitution < 1.0 || is_driven || result.status != RunStatus::finished) continue;
      const World world = make_world(thrown.scene);
      BodyState before;
      before.position = thrown.position;
      before.velocity = thrown.velocity;
      before.angular_velocity = thrown.w;
      before.rotation_matrix = rotation_matrix(world.bodies.front().q_WB);
      const double energy = energy_of(before, *world.bodies.front().inertia);
      // an impulse keeps the energy whatever its place and direction; steps do to 1e-12 of some 100 J each
      EXPECT_NEAR(energy_of(final_of(result, "b"), *world.bodies.front().inertia), energy, 1e-9);
    }
  EXPECT_GT(impacts, 60);
}

INSTANTIATE_TEST_SUITE_P(Solids, SolidMatrix, testing::Range<std::size_t>(0, obstacles().size()),
                         [](const testing::TestParamInfo<std::size_t>& kind) { return obstacles()[kind.param].name; });

}  // namespace
}  // namespace trajet::test
