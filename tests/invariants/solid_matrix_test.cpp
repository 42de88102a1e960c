// All kinds of solids bounce on all kinds of obstacles, at rest and moving: every contact is told and left, none is
// passed by, and the energy of what bounces without loss is kept.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "scene_run.hpp"
#include "trajet/geom/solid_overlap.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/sim/run_observer.hpp"

namespace trajet::test {
namespace {

constexpr double kGravity = 9.8, kMass = 2.5;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  Vector3 vector(double half) {
    const double x = between(-half, half), y = between(-half, half), z = between(-half, half);
    return {x, y, z};
  }

 private:
  std::mt19937 engine_;
};

std::string array(const Vector3& v) { return "[" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + "]"; }

/// A shape as the lines of its table; of a mesh those of another shape, which it then replaces.
struct Kind {
  std::string name;
  std::string lines;
};

const std::vector<Kind>& bodies() {
  static const std::vector<Kind> all{
      {"box", "shape = \"box\"\nsize = [1, 0.6, 0.4]\n"},
      {"rounded_box", "shape = \"box\"\nsize = [1, 0.6, 0.4]\nrounding = 0.05\n"},
      {"cylinder", "shape = \"cylinder\"\nradius = 0.3\nheight = 0.8\n"},
      {"rounded_cylinder", "shape = \"cylinder\"\nradius = 0.3\nheight = 0.8\nrounding = 0.05\n"},
      {"capsule", "shape = \"capsule\"\nradius = 0.2\nheight = 0.6\n"},
      {"cone", "shape = \"cone\"\nradius = 0.4\nheight = 0.7\n"},
      {"ellipsoid", "shape = \"ellipsoid\"\nradii = [0.5, 0.3, 0.4]\n"},
      {"hull", "shape = \"hull\"\npoints = [[0, 0, 0], [1, 0, 0], [0, 0.8, 0], [0, 0, 0.7], [0.5, 0.5, 0.4]]\n"},
      {"hammer",
       "shape = \"compound\"\nparts = [{shape = \"box\", size = [0.8, 0.2, 0.2]}, {shape = \"ellipsoid\", radii = "
       "[0.2, 0.25, 0.3], position = [0.4, 0.1, 0]}]\n"},
      {"dumbbell",
       "shape = \"compound\"\nparts = [{shape = \"cylinder\", radius = 0.1, height = 0.8}, {shape = \"sphere\", radius "
       "= 0.2, position = [0, 0, 0.4]}, {shape = \"cone\", radius = 0.2, height = 0.3, position = [0, 0, -0.4]}]\n"},
      {"mesh", "shape = \"box\"\nsize = [1, 1, 1]\n"}};
  return all;
}

const std::vector<Kind>& obstacles() {
  static const std::string tilted = "orientation = {axis = [1, 0.2, 0], angle = 1.4}\n";
  static const std::vector<Kind> all{
      {"plane", "shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0.1, 0.2, 1]\n"},
      {"disk", "shape = \"disk\"\ncenter = [0, 0, 0]\nnormal = [0.1, 0.2, 1]\nradius = 1.5\n"},
      {"rectangle",
       "shape = \"rectangle\"\ncenter = [0, 0, 0]\nnormal = [0.1, 0.2, 1]\nup = [1, 0, -0.1]\nsize = [2.5, 2]\n"},
      {"triangle", "shape = \"triangle\"\npoints = [[-1.5, -1, 0], [1.5, -1.2, 0.1], [0.1, 1.6, -0.1]]\n"},
      {"sphere", "shape = \"sphere\"\ncenter = [0, 0, -0.5]\nradius = 1\n"},
      {"box", "shape = \"box\"\ncenter = [0, 0, -0.5]\nsize = [2, 1.5, 1]\n" + tilted},
      {"rounded_box", "shape = \"box\"\ncenter = [0, 0, -0.5]\nsize = [2, 1.5, 1]\nrounding = 0.1\n" + tilted},
      {"cylinder", "shape = \"cylinder\"\ncenter = [0, 0, -0.5]\nradius = 0.7\nheight = 2\n" + tilted},
      {"capsule", "shape = \"capsule\"\ncenter = [0, 0, -0.5]\nradius = 0.7\nheight = 1\n" + tilted},
      {"cone", "shape = \"cone\"\ncenter = [0, 0, -0.5]\nradius = 1.2\nheight = 1.5\n"},
      {"ellipsoid", "shape = \"ellipsoid\"\ncenter = [0, 0, -0.5]\nradii = [1.2, 0.8, 0.6]\n" + tilted},
      {"hull",
       "shape = \"hull\"\ncenter = [0, 0, -0.7]\npoints = [[-1, -1, 0], [1, -1, 0], [0, 1, 0], [0, 0, 1], [0.7, 0.6, "
       "0.4]]\n"},
      {"mesh", "shape = \"box\"\ncenter = [0, 0, 0]\nsize = [1, 1, 1]\n"},
      {"compound",
       "shape = \"compound\"\ncenter = [0, 0, -0.5]\nparts = [{shape = \"box\", size = [2, 0.6, 0.6]}, {shape = "
       "\"ellipsoid\", radii = [0.5, 0.7, 0.6], position = [0.6, 0.1, 0]}, {shape = \"cone\", radius = 0.5, height = "
       "1, position = [-0.6, 0, 0.3]}]\n"},
      {"room", "shape = \"box\"\ncenter = [0, 0, 0.8]\nsize = [4, 4, 5]\ninside = true\n"}};
  return all;
}

/// A prism over an L, closed and not convex.
TriangleMesh corner_block() {
  TriangleMesh mesh;
  for (const double z : {0.0, 0.4})
    for (const auto& [x, y] :
         std::vector<std::pair<double, double>>{{0.0, 0.0}, {0.8, 0.0}, {0.8, 0.3}, {0.3, 0.3}, {0.3, 0.7}, {0.0, 0.7}})
      mesh.vertices.push_back({x, y, z});
  for (int i = 1; i < 5; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({6, i + 6, i + 7});
  }
  for (int i = 0; i < 6; ++i) {
    const int j = (i + 1) % 6;
    mesh.triangles.push_back({i, j, j + 6});
    mesh.triangles.push_back({i, j + 6, i + 6});
  }
  return mesh;
}

TriangleMesh hills() {
  constexpr int kSide = 5;
  TriangleMesh mesh;
  for (int i = 0; i <= kSide; ++i)
    for (int j = 0; j <= kSide; ++j)
      mesh.vertices.push_back({-1.5 + 3.0 * i / kSide, -1.5 + 3.0 * j / kSide, 0.1 * ((7 * i + 5 * j) % 3)});
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const int a = i * (kSide + 1) + j, b = a + kSide + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

/// What bounded convex solids, or compounds of them, a thing is made of; of a half space what is near.
std::vector<Solid> parts_of(const Solid& solid) {
  const auto* mesh = std::get_if<Mesh>(&solid);
  if (mesh == nullptr) return {solid};
  const TriangleMesh& surface = mesh->polyhedron->surface;
  std::vector<Solid> parts;
  for (const auto& corners : surface.triangles) {
    const auto at = [&](std::size_t i) { return surface.vertices[static_cast<std::size_t>(corners[i])]; };
    parts.emplace_back(TriangularPlate{{at(0), at(1), at(2)}});
  }
  return parts;
}

/// How an obstacle moves: about its centre.
struct Drive {
  Vector3 pivot = Vector3::Zero(), velocity = Vector3::Zero(), w = Vector3::Zero();
};

/// Sees to it that nothing overlaps at any sample: by an algorithm and by support functions that the search does not
/// know.
class Guard : public RunObserver {
 public:
  explicit Guard(const Drive& drive) : drive_(drive) {}
  RunWishes wishes() const override { return {.motion = false, .samples = true}; }
  void begin(const World& world) override {
    world_ = &world;
    body_ = parts_of(world.bodies.front().solid);
    for (const World::Obstacle& obstacle : world.obstacles) obstacles_.push_back(parts_of(obstacle.solid));
  }
  void sample(const Sample& sample) override {
    if (sample.phase != SamplePhase::none) return;  // at an impact they touch
    const BodyState& state = sample.bodies.front();
    const double t = sample.time, angle = drive_.w.norm() * t;
    const Matrix3 turn =
        angle > 0.0 ? rotation_matrix(from_axis_angle<double>(drive_.w.normalized(), angle)) : Matrix3::Identity();
    for (std::size_t i = 0; i < obstacles_.size(); ++i) {
      const World::Obstacle& obstacle = world_->obstacles[i];
      const Matrix3 R = turn * rotation_matrix(obstacle.q_WB);
      const Vector3 p = drive_.pivot + drive_.velocity * t + turn * (obstacle.p_WB - drive_.pivot);
      for (const Solid& part : obstacles_[i])
        for (const Solid& piece : body_) {
          ++looks;
          overlaps += overlap({piece, state.position, state.rotation_matrix}, near_part(part, p, R, state.position));
        }
    }
  }

  long looks = 0;
  long overlaps = 0;

 private:
  PlacedSolid near_part(const Solid& part, const Vector3& p, const Matrix3& R, const Vector3& body) {
    if (!std::holds_alternative<HalfSpace>(part)) return {part, p, R};
    constexpr double kThick = 4.0;
    static const Solid block = Cuboid{{kThick, kThick, kThick}};
    const Vector3 n = R.col(2), above = body - n * n.dot(body - p);
    return {block, above - kThick * n, R};
  }

  Drive drive_;
  const World* world_ = nullptr;
  std::vector<Solid> body_;
  std::vector<std::vector<Solid>> obstacles_;
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
      const bool is_driven = k % 2 == 1, is_room = other.name == "room";
      const double restitution = k < 2 ? 1.0 : 0.7;
      const Kind& body = bodies()[b];
      SCOPED_TRACE(body.name + " on " + other.name + " " + std::to_string(k));
      Random random(static_cast<unsigned>(7919 * GetParam() + 104729 * b + 1009 * static_cast<std::size_t>(k) + 17));
      const double height = is_room ? random.between(0.0, 1.5) : random.between(1.2, 2.0);
      const Vector3 start(random.between(-0.6, 0.6), random.between(-0.6, 0.6), height),
          v = random.vector(1.0), w = random.vector(8.0), axis = random.vector(1.0);
      Drive drive;
      if (other.lines.find("center = [0, 0, ") != std::string::npos)
        drive.pivot.z() = std::stod(other.lines.substr(other.lines.find("center = ") + 16));
      if (is_driven) {
        drive.w = is_room ? Vector3(0.3, 0.2, 0.4) : Vector3(0.5, 0.3, 1.0);
        if (!is_room) drive.velocity = {0.1, 0.0, 0.3};
      }
      std::string text = "[time]\nend = 1.5\nsample = 0.01\n[[body]]\nname = \"b\"\nmass = " + number(kMass) + "\n" +
                         body.lines + "position = " + array(start) + "\nvelocity = " + array(v) +
                         "\nangular_velocity = " + array(w) + "\norientation = {axis = " + array(axis) +
                         ", angle = " + number(random.between(0.0, 6.0)) +
                         "}\nforce = [0, 0, \"-9.8*2.5\"]\n[[obstacle]]\nname = \"o\"\n" + other.lines +
                         "on_hit = \"bounce\"\nrestitution = " + number(restitution) + "\n";
      if (is_driven) text += "velocity = " + array(drive.velocity) + "\nangular_velocity = " + array(drive.w) + "\n";
      Scene scene = parse_scene(text, "test.toml");
      if (body.name == "mesh") scene.bodies.front().shape = MeshShape{corner_block()};
      if (other.name == "mesh") scene.obstacles.front().shape = MeshShape{hills()};

      Guard guard(drive);
      const RunResult result = run(scene, &guard);
      impacts += static_cast<int>(result.impacts.size());
      EXPECT_GT(guard.looks, 0);
      EXPECT_EQ(guard.overlaps, 0);
      const bool has_come_to_rest = result.failure.find("comes to rest on") != std::string::npos;
      EXPECT_TRUE(result.status == RunStatus::finished || (restitution < 1.0 && has_come_to_rest)) << result.failure;
      if (restitution < 1.0 || is_driven || result.status != RunStatus::finished) continue;
      const World world = make_world(scene);
      BodyState before;
      before.position = start;
      before.velocity = v;
      before.angular_velocity = w;
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
