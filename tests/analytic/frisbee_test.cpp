// examples/frisbee.toml: the flight of the published model, and what must hold of it without air, torque or handedness.

#include <gtest/gtest.h>

#include <cmath>

#include "scene_run.hpp"
#include "trajet/io/scene_overrides.hpp"

namespace trajet {
namespace {

RunResult fly(const std::vector<std::string>& parameters, const std::optional<std::string>& end = {}) {
  Scene scene = read_scene(TRAJET_SOURCE_DIR "/examples/frisbee.toml");
  apply({.parameters = parameters, .end = end}, scene);
  return run(scene);
}

const BodyState& disc(const RunResult& result) { return test::final_of(result, "disc"); }
Vector3 axis(const RunResult& result) { return disc(result).rotation_matrix.col(2); }

/// The release, and the equations of motion, of [HubbardHummel2000] and [Hummel2003]: theirs are for the angles and
/// their rates of a frame that does not spin with the disc, x forward, y right, z down. Integrated by rk4 with steps of
/// 0.5 ms, which agree with steps of 1 ms to 6e-10 in what is compared here.
TEST(Frisbee, FliesAsItsPublishedEquationsSay) {
  const RunResult second = fly({}, "1 s");
  const Vector3 r(10.214006224119819, -1.0326228326653808, 2.4676034833910143);
  const Vector3 v(7.516906830283838, -2.4319456863839584, 0.031172542572701488);
  EXPECT_LT((disc(second).position - r).norm(), 1e-10);
  EXPECT_LT((disc(second).velocity - v).norm(), 1e-9);
  // roll and pitch of that frame at 1 s
  const double roll = 0.5403148617883927, pitch = 0.30089424888278493;
  const Vector3 down(std::sin(pitch), -std::cos(pitch) * std::sin(roll), std::cos(pitch) * std::cos(roll));  // z down
  EXPECT_LT((axis(second) - Vector3(-down.x(), down.y(), down.z())).norm(), 1e-8);

  const RunResult whole = fly({});
  EXPECT_EQ(whole.status, RunStatus::stopped);
  EXPECT_NEAR(whole.end_time, 2.200277, 1e-6) << "between two of its steps";
  EXPECT_NEAR(disc(whole).position.x(), 16.6066, 1e-4);
  EXPECT_NEAR(disc(whole).position.y(), -6.0690, 1e-4) << "to the right";
}

TEST(Frisbee, ThrownWithTheOtherHandIsItsMirrorImage) {
  const RunResult right = fly({}, "2 s"), left = fly({"spin=-50"}, "2 s");
  const Vector3 mirror(1, -1, 1);
  EXPECT_LT((disc(left).position - mirror.cwiseProduct(disc(right).position)).norm(), 1e-10);
  EXPECT_LT((axis(left) - mirror.cwiseProduct(axis(right))).norm(), 1e-9);
}

TEST(Frisbee, KeepsItsAxisWithoutTorque) {
  const RunResult start = fly({}, "0 s");
  const RunResult end = fly({"CRr=0", "CRp=0", "CM0=0", "CMa=0", "CMq=0", "CNr=0"}, "2 s");
  EXPECT_LT((axis(end) - axis(start)).norm(), 1e-12);
  EXPECT_LT((disc(end).angular_velocity - disc(start).angular_velocity).norm(), 1e-11);
  EXPECT_LT((disc(end).velocity - disc(start).velocity).dot(disc(start).velocity), -10.0) << "the air slows it down";
}

TEST(Frisbee, WithoutAirFallsAndSpinsDownAlone) {
  const double t = 0.5, g = 9.7935;
  const RunResult start = fly({}, "0 s"), end = fly({"rho=0"}, "0.5 s");
  const Vector3 r = disc(start).position + t * disc(start).velocity - Vector3(0, 0, 0.5 * g * t * t);
  EXPECT_LT((disc(end).position - r).norm(), 1e-12);
  // dw/dt = CNr/Ia w about the axis
  EXPECT_NEAR(disc(end).angular_velocity.norm(), 50.0 * std::exp(-7.1e-6 / 0.002352 * t), 1e-10);
  EXPECT_LT((axis(end) - axis(start)).norm(), 1e-12);
}

}  // namespace
}  // namespace trajet
