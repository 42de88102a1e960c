// Nobody leaves a closed room, whatever its walls are made of, and nobody gains energy in it: flying, bouncing,
// resting, sliding along walls, edges and into corners.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "scene_run.hpp"
#include "trajet/math/quaternion.hpp"

namespace trajet::test {
namespace {

std::string vector_text(const Vector3& v) {
  return "[" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + "]";
}

/// A cube of edge 2, turned anyhow.
class Room {
 public:
  Room(unsigned seed, bool has_ball) : random_(seed), radius_(has_ball ? 0.1 : 0.0) {
    if (seed % 2 == 0)
      R_WB_ = Quaternion(uniform(0.1, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0))
                  .normalized()
                  .toRotationMatrix();
    restitution_ = std::vector<double>{0.0, 0.3, 0.5, 0.9, 1.0}[random_() % 5];
    force_ = seed % 3 == 0 ? Vector3(uniform(-10, 10), uniform(-10, 10), uniform(-10, 10)) : Vector3(0, 0, -9.81);
  }

  std::string text(const std::string& walls) {
    const Vector3 position = R_WB_ * Vector3(uniform(-0.7, 0.7), uniform(-0.7, 0.7), uniform(-0.7, 0.7));
    std::string scene = "[time]\nend = 5\nsample = 0.01\n[[body]]\nname = \"b\"\nposition = " + vector_text(position) +
                        "\nvelocity = " + vector_text({uniform(-4, 4), uniform(-4, 4), uniform(-4, 4)}) +
                        "\nacceleration = " + vector_text(force_) + "\n";
    if (radius_ > 0.0) scene += "shape = \"sphere\"\nradius = " + number(radius_) + "\n";
    for (int side = 0; side < 6; ++side) add_wall(scene, walls, side);
    return scene;
  }

  /// How far the body's surface is beyond the walls, m.
  double outside(const Vector3& position) const {
    return (R_WB_.transpose() * position).lpNorm<Eigen::Infinity>() - (1.0 - radius_);
  }
  double energy(const BodyState& state) const {
    return 0.5 * state.velocity.squaredNorm() - force_.dot(state.position);
  }

 private:
  double uniform(double a, double b) { return a + (b - a) * (static_cast<double>(random_()) / 4294967296.0); }

  void add_wall(std::string& scene, const std::string& walls, int side) const {
    const double sign = side % 2 == 0 ? 1.0 : -1.0;
    const int axis = side / 2;
    const Vector3 center = sign * R_WB_.col(axis);
    const Vector3 up = R_WB_.col((axis + 1) % 3);
    const auto add = [&](const std::string& lines, const std::string& half = {}) {
      scene += "[[obstacle]]\nname = \"w" + std::to_string(side) + half +
               "\"\non_hit = \"bounce\"\nrestitution = " + number(restitution_) + "\nshape = \"" + lines;
    };
    if (walls == "plane") add("plane\"\npoint = " + vector_text(center) + "\nnormal = " + vector_text(-center) + "\n");
    if (walls == "rectangle")
      add("rectangle\"\ncenter = " + vector_text(center) + "\nnormal = " + vector_text(-center) +
          "\nup = " + vector_text(up) + "\nsize = [2, 2]\n");
    if (walls == "box") {
      const auto row = [&](int i) { return vector_text(R_WB_.row(i).transpose()); };
      add("box\"\ncenter = " + vector_text(1.25 * center) +
          "\nsize = " + vector_text(Vector3::Constant(3.0) - 2.5 * Vector3::Unit(axis)) +
          "\norientation = {matrix = [" + row(0) + ", " + row(1) + ", " + row(2) + "]}\n");
    }
    if (walls == "triangle") {
      const Vector3 side_way = up.cross(center);
      const std::vector<Vector3> corners{center + up + side_way, center + up - side_way, center - up - side_way,
                                         center - up + side_way};
      for (const std::size_t first : {std::size_t{0}, std::size_t{2}})
        add("triangle\"\npoints = [" + vector_text(corners[first]) + ", " + vector_text(corners[first + 1]) + ", " +
                vector_text(corners[(first + 2) % 4]) + "]\n",
            first == 0 ? "a" : "b");
    }
  }

  std::mt19937 random_;
  double radius_;
  double restitution_ = 1.0;
  Vector3 force_ = Vector3::Zero();
  Matrix3 R_WB_ = Matrix3::Identity();
};

class Watcher : public RunObserver {
 public:
  explicit Watcher(const Room& room) : room_(room) {}
  RunWishes wishes() const override { return {.samples = true}; }
  void sample(const Sample& sample) override {
    const BodyState& body = sample.bodies.front();
    farthest = std::max(farthest, room_.outside(body.position));
    const double energy = room_.energy(body);
    if (has_energy_) gain = std::max(gain, energy - energy_);
    energy_ = energy;
    has_energy_ = true;
  }

  double farthest = -1e9;  // m
  double gain = 0.0;       // m^2/s^2, from sample to sample

 private:
  const Room& room_;
  bool has_energy_ = false;
  double energy_ = 0.0;
};

void check_room(const std::string& walls, bool has_ball, unsigned seed) {
  Room room(seed, has_ball);
  Watcher watcher(room);
  const RunResult result = run_text(room.text(walls), &watcher);
  ASSERT_EQ(result.status, RunStatus::finished) << walls << " " << seed << ": " << result.failure;
  EXPECT_LE(watcher.farthest, 1e-9) << walls << " " << seed;  // a thousand times what rounding makes here
  EXPECT_LE(watcher.gain, 1e-9) << walls << " " << seed;
}

void check_rooms(const std::string& walls, bool has_ball) {
  for (unsigned seed = 1; seed <= 400 && !testing::Test::HasFatalFailure(); ++seed) check_room(walls, has_ball, seed);
}

TEST(ClosedRooms, KeepAPointBetweenPlanes) { check_rooms("plane", false); }
TEST(ClosedRooms, KeepAPointBetweenRectangles) { check_rooms("rectangle", false); }
TEST(ClosedRooms, KeepAPointBetweenTriangles) { check_rooms("triangle", false); }
TEST(ClosedRooms, KeepABallBetweenPlanes) { check_rooms("plane", true); }
TEST(ClosedRooms, KeepABallBetweenRectangles) { check_rooms("rectangle", true); }
TEST(ClosedRooms, KeepABallBetweenTriangles) { check_rooms("triangle", true); }
TEST(ClosedRooms, KeepAPointBetweenBoxes) { check_rooms("box", false); }
TEST(ClosedRooms, KeepABallBetweenBoxes) { check_rooms("box", true); }

// Three walls at one instant stop it in their corner.
TEST(ClosedRooms, KeepAPointInACorner) { check_room("triangle", false, 1514); }

}  // namespace
}  // namespace trajet::test
