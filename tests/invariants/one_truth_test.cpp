// What is reported of a motion is read from its Segments: samples, the final state, impacts and pictures agree.

#include <gtest/gtest.h>

#include "scene_run.hpp"
#include "trajet/rigid/free_rotation.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/sim/motion_record.hpp"
#include "trajet/sim/observer_list.hpp"
#include "trajet/sim/run.hpp"
#include "trajet/sim/state_at.hpp"

namespace trajet::test {
namespace {

std::string free_top(const std::string& method, const std::string& orientation) {
  return "[time]\nend = 5\nsample = 0.37\n[method]\n" + method + "\norientation = \"" + orientation + R"("
[[body]]
name = "top"
inertia = [1, 2, 3]
angular_velocity_body = [0.4, 1.0, 0.3]
)";
}

class Samples : public RunObserver {
 public:
  RunWishes wishes() const override { return {.samples = true}; }
  void sample(const Sample& sample) override { samples.push_back(sample); }
  std::vector<Sample> samples;
};

/// The angle between two rotations, rad.
double angle(const Quaternion& a, const Quaternion& b) {
  return to_rotation_vector(Quaternion(a * b.conjugate())).norm();
}

const char* const kMethods[] = {"name = \"euler\"\nstep = 1.0", "name = \"rk4\"\nstep = 0.5", "name = \"dopri5\"",
                                "name = \"adams\"", "name = \"taylor\""};

TEST(OneTruth, SamplesAreReadFromTheSegments) {
  for (const char* method : kMethods)
    for (const OrientationInfo& way : orientation_ways()) {
      SCOPED_TRACE(std::string(method) + ", " + std::string(way.name));
      const World world = make_world(parse_scene(free_top(method, std::string(way.name)), "test.toml"));
      MotionRecord record;
      Samples samples;
      ObserverList observers({&record, &samples});
      ASSERT_EQ(run(world, &observers).status, RunStatus::finished);
      const World::Body& top = world.bodies.front();
      for (const Sample& sample : samples.samples) {
        const auto& pieces = record.pieces(0);
        const auto piece = std::ranges::find_if(pieces, [&](const auto& each) { return each.to >= sample.time; });
        ASSERT_NE(piece, pieces.end());
        const Eigen::VectorXd q = state_at(world, 0, piece->segment, sample.time);
        const Matrix3 R = top.rotation->layout.matrix(top.slice().orientation(q));
        // polynomials of t - t0 against the stepper's own sum, at the end of a step: some roundings
        EXPECT_LT((R - sample.bodies[0].rotation_matrix).cwiseAbs().maxCoeff(), 1e-13) << sample.time;
      }
    }
}

TEST(OneTruth, TheClosedFormIsInTheSegments) {
  const Vector3 w(0.4, 1.0, 0.3);
  const FreeRotation exact(Quaternion::Identity(), w, Vector3(1, 2, 3).asDiagonal());
  for (const char* method : kMethods) {
    const World world = make_world(parse_scene(free_top(method, "exact"), "test.toml"));
    MotionRecord record;
    ASSERT_EQ(run(world, &record).status, RunStatus::finished) << method;
    const World::Body& top = world.bodies.front();
    for (const auto& piece : record.pieces(0))
      for (const double part : {0.0, 0.3, 0.5, 0.9, 1.0}) {
        const double t = piece.from + part * (piece.to - piece.from);
        const Eigen::VectorXd q = state_at(world, 0, piece.segment, t);
        EXPECT_LT(angle(top.rotation->layout.quaternion(top.slice().orientation(q)), exact.q_WB(t)), 1e-13)
            << method << ' ' << t;
        EXPECT_LT((top.slice().angular_velocity(q) - exact.w_WB_B(t)).norm(), 1e-13) << method << ' ' << t;
      }
  }
}

TEST(OneTruth, SegmentsJoinWhereOrientationsWerePutRight) {
  for (const char* method : kMethods)
    for (const OrientationInfo& way : orientation_ways()) {
      SCOPED_TRACE(std::string(method) + ", " + std::string(way.name));
      const World world = make_world(parse_scene(free_top(method, std::string(way.name)), "test.toml"));
      MotionRecord record;
      ASSERT_EQ(run(world, &record).status, RunStatus::finished);
      const auto& pieces = record.pieces(0);
      const World::Body& top = world.bodies.front();
      for (std::size_t i = 1; i < pieces.size(); ++i) {
        const double t = pieces[i].from;
        const Eigen::VectorXd before = state_at(world, 0, pieces[i - 1].segment, t);
        const Eigen::VectorXd behind = state_at(world, 0, pieces[i].segment, t);
        const auto rotation = [&](const Eigen::VectorXd& q) {
          return top.rotation->layout.matrix(top.slice().orientation(q));
        };
        EXPECT_LT((rotation(before) - rotation(behind)).cwiseAbs().maxCoeff(), 1e-13) << t;
        EXPECT_LT((top.slice().angular_velocity(before) - top.slice().angular_velocity(behind)).norm(), 1e-13) << t;
      }
    }
}

}  // namespace
}  // namespace trajet::test
