// Solids that turn and bounce off obstacles without friction: what every such impact keeps.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "scene_run.hpp"
#include "trajet/scene/world.hpp"

namespace trajet::test {
namespace {

constexpr double kGravity = 9.8;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  Vector3 vector(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }

 private:
  std::mt19937 engine_;
};

std::string array(const Vector3& v) { return "[" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + "]"; }

/// Solids of about a metre, each as the lines of its shape.
const std::vector<std::string>& shapes() {
  static const std::vector<std::string> all{
      "shape = \"box\"\nsize = [1, 0.6, 0.4]\n",
      "shape = \"box\"\nsize = [1, 0.6, 0.4]\nrounding = 0.05\n",
      "shape = \"cylinder\"\nradius = 0.3\nheight = 0.8\n",
      "shape = \"capsule\"\nradius = 0.2\nheight = 0.6\n",
      "shape = \"cone\"\nradius = 0.4\nheight = 0.7\n",
      "shape = \"ellipsoid\"\nradii = [0.5, 0.3, 0.4]\n",
      "shape = \"hull\"\npoints = [[0, 0, 0], [1, 0, 0], [0, 0.8, 0], [0, 0, 0.7], [0.5, 0.5, 0.4]]\n",
      "shape = \"soccer-ball\"\nradius = 0.4\n",
      "shape = \"compound\"\nparts = [{shape = \"box\", size = [0.8, 0.1, 0.1]}, {shape = \"sphere\", radius = 0.2, "
      "position = [0.4, 0.1, 0]}]\n"};
  return all;
}

struct Start {
  Vector3 position, velocity, w, axis;
  double angle;
};

std::string solid(const std::string& shape, const Start& start, const Vector3& train = Vector3::Zero()) {
  return "[[body]]\nname = \"b\"\nmass = 2.5\n" + shape + "position = " + array(start.position) +
         "\nvelocity = " + array(start.velocity + train) + "\nangular_velocity = " + array(start.w) +
         "\norientation = {axis = " + array(start.axis) + ", angle = " + number(start.angle) +
         "}\nforce = [0, 0, \"-9.8*2.5\"]\n";
}

std::string floor_of(double restitution) {
  return "[[obstacle]]\nname = \"floor\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\non_hit = "
         "\"bounce\"\nrestitution = " +
         number(restitution) + "\n";
}

Matrix3 inertia_of(const std::string& scene) {
  const World world = make_world(parse_scene(scene, "test.toml"));
  return *world.bodies.front().inertia;
}

/// J; and the angular momentum about the vertical through the centre of mass, kg m^2/s.
struct Kept {
  double energy;
  double spin;
};
Kept kept(const BodyState& state, const Matrix3& inertia) {
  const Matrix3& R = state.rotation_matrix;
  const Vector3 momentum = R * inertia * R.transpose() * state.angular_velocity;
  return {0.5 * 2.5 * state.velocity.squaredNorm() + 2.5 * kGravity * state.position.z() +
              0.5 * state.angular_velocity.dot(momentum),
          momentum.z()};
}

BodyState at_start(const std::string& scene) { return final_of(run_text("[time]\nend = 0\n" + scene), "b"); }

TEST(SolidImpacts, KeepEnergyAndWhatTheNormalDoesNotTouch) {
  Random random(11);
  int hits = 0;
  for (const std::string& shape : shapes())
    for (int i = 0; i < 12; ++i) {
      const Start start{{0, 0, random.between(1.5, 3.0)},
                        random.vector(1.0),
                        random.vector(8.0),
                        random.vector(1.0),
                        random.between(0.0, 6.0)};
      const std::string scene = solid(shape, start) + floor_of(1.0);
      const RunResult result = run_text("[time]\nend = 2.5\n" + scene);
      ASSERT_EQ(result.status, RunStatus::finished) << shape << i << ": " << result.failure;
      hits += static_cast<int>(result.impacts.size());
      const Matrix3 inertia = inertia_of("[time]\nend = 0\n" + scene);
      const Kept before = kept(at_start(scene), inertia), after = kept(final_of(result, "b"), inertia);
      // tolerances of 1e-12 along some dozens of steps, of energies of about 70 J
      EXPECT_NEAR(after.energy, before.energy, 1e-9) << shape << i;
      EXPECT_NEAR(after.spin, before.spin, 1e-9) << shape << i;
      EXPECT_NEAR(final_of(result, "b").velocity.x(), start.velocity.x(), 1e-12);
      EXPECT_NEAR(final_of(result, "b").velocity.y(), start.velocity.y(), 1e-12);
      for (const Impact& impact : result.impacts) {
        EXPECT_NEAR(impact.point.z(), 0.0, 1e-12) << shape << i << " touches the floor";
        ASSERT_TRUE(impact.touched.has_value());
        EXPECT_EQ(impact.touched->of_obstacle, Feature::face);
      }
    }
  EXPECT_GT(hits, 150);
}

TEST(SolidImpacts, NeverGainEnergy) {
  Random random(12);
  for (const std::string& shape : shapes())
    for (int i = 0; i < 6; ++i) {
      const double restitution = random.between(0.3, 0.95);
      const Start start{{0, 0, random.between(1.5, 3.0)},
                        random.vector(1.0),
                        random.vector(8.0),
                        random.vector(1.0),
                        random.between(0.0, 6.0)};
      const std::string scene = solid(shape, start) + floor_of(restitution);
      const RunResult result = run_text("[time]\nend = 1\n" + scene);
      const Matrix3 inertia = inertia_of("[time]\nend = 0\n" + scene);
      const double before = kept(at_start(scene), inertia).energy;
      EXPECT_LT(kept(final_of(result, "b"), inertia).energy, before + 1e-9) << shape << i;
    }
}

TEST(SolidImpacts, WhatFallsFlatComesBackFlat) {
  const std::string scene =
      "[time]\nend = 2\n[[body]]\nname = \"b\"\nmass = 1\nshape = \"box\"\nsize = [1, 0.6, 0.4]\nposition = [0, 0, "
      "1.2]\n"
      "force = [0, 0, -9.8]\n" +
      floor_of(1.0);
  const RunResult result = run_text(scene);
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  ASSERT_GE(result.impacts.size(), 2u);
  for (const Impact& impact : result.impacts) {
    EXPECT_EQ(impact.touched->of_body, Feature::face);
    EXPECT_EQ(impact.touched->points.size(), 4u);
    EXPECT_LT(impact.angular_velocity_after.norm(), 1e-13);
  }
  // z = 0.2 at sqrt(2 h / g), h = 1 m
  const double fall = std::sqrt(2.0 / 9.8);
  EXPECT_NEAR(result.impacts[0].time, fall, 1e-15);
  EXPECT_NEAR(result.impacts[1].time, 3.0 * fall, 1e-13);
}

TEST(SolidImpacts, WhatDoesNotTurnIsMadeTurn) {
  // A rod falls on its lower end, with its middle beside it: m u = P, I w = P d and u + w d = v (1 + e) say by how
  // much.
  const RunResult result = run_text(
      "[time]\nend = 1\n[[body]]\nname = \"b\"\nmass = 1\nshape = \"box\"\nsize = [2, 0.01, 0.01]\nposition = [0, 0, "
      "1]\nvelocity = [0, 0, -1]\norientation = {axis = [0, 1, 0], angle = 0.3}\ninertia = [0.1, 0.3, 0.3]\n" +
      floor_of(1.0));
  ASSERT_GE(result.impacts.size(), 1u) << result.failure;
  const Impact& hit = result.impacts[0];
  EXPECT_EQ(hit.angular_velocity_before, Vector3(0, 0, 0));
  const double arm = hit.point.x() - hit.position.x();
  const double impulse = 2.0 / (1.0 + arm * arm / 0.3);
  EXPECT_NEAR(hit.impulse.z(), impulse, 1e-12);
  EXPECT_NEAR(hit.velocity_after.z(), -1.0 + impulse, 1e-12);
  EXPECT_NEAR(hit.angular_velocity_after.y(), -arm * impulse / 0.3, 1e-12);
}

TEST(SolidImpacts, WhoMovesDoesNotMatter) {
  // as seen from a train: of an obstacle that moves and a solid against it
  Random random(13);
  int hits = 0;
  for (int i = 0; i < 60; ++i) {
    const std::string& shape = shapes()[static_cast<std::size_t>(i) % shapes().size()];
    const Vector3 train = random.vector(10.0);
    const Start start{{0, 0, 2}, random.vector(0.5), random.vector(6.0), random.vector(1.0), random.between(0.0, 6.0)};
    const std::string block =
        "[[obstacle]]\nname = \"block\"\nshape = \"box\"\ncenter = [0.1, 0, 0]\nsize = [2, 1.5, "
        "0.6]\norientation = {axis = [1, 0.2, 0], angle = 0.4}\non_hit = \"bounce\"\n";
    const RunResult still = run_text("[time]\nend = 0.9\n" + solid(shape, start) + block);
    const RunResult seen =
        run_text("[time]\nend = 0.9\n" + solid(shape, start, train) + block + "velocity = " + array(train) + "\n");
    ASSERT_EQ(still.status, seen.status) << shape << i << still.failure << seen.failure;
    ASSERT_EQ(still.impacts.size(), seen.impacts.size()) << shape << i;
    for (std::size_t k = 0; k < still.impacts.size(); ++k) {
      const Impact &a = still.impacts[k], &b = seen.impacts[k];
      ++hits;
      // measured: the contact points of round solids are right to 2e-7 m, which the next impact tells in its time
      const double tolerance = 4.0 * (a.time_error_bound + b.time_error_bound) + (k == 0 ? 1e-12 : 1e-7);
      EXPECT_NEAR(a.time, b.time, tolerance) << shape << i;
      EXPECT_LT((b.velocity_after - train - a.velocity_after).norm(), 2e-6 + 100.0 * tolerance) << shape << i;
      EXPECT_LT((b.angular_velocity_after - a.angular_velocity_after).norm(), 2e-6 + 100.0 * tolerance) << shape << i;
    }
  }
  EXPECT_GT(hits, 40);
}

TEST(SolidImpacts, AllWaysOfTurningAndMethodsAgree) {
  const Start start{{0, 0, 2}, {0.3, 0.1, 0}, {1, 2, 3}, {1, 2, 3}, 0.5};
  const std::string scene = solid(shapes()[0], start) + floor_of(0.9);
  const RunResult reference = run_text("[time]\nend = 0.9\n" + scene);
  ASSERT_GE(reference.impacts.size(), 1u);
  for (const std::string lines :
       {"orientation = \"matrix\"\n", "orientation = \"rotation-vector\"\n", "orientation = \"exact\"\n",
        "orientation = \"quaternion\"\n", "name = \"dopri5\"\n", "name = \"dop853\"\n",
        "name = \"gauss6\"\nstep = 1e-3\n", "name = \"rk4\"\nstep = 2e-4\n"}) {
    const RunResult result = run_text("[time]\nend = 0.9\n[method]\n" + lines + scene);
    ASSERT_EQ(result.impacts.size(), reference.impacts.size()) << lines << result.failure;
    for (std::size_t k = 0; k < reference.impacts.size(); ++k) {
      // measured: the errors of rk4 at that step, 2e-12
      EXPECT_NEAR(result.impacts[k].time, reference.impacts[k].time, 1e-10) << lines;
      EXPECT_LT((result.impacts[k].velocity_after - reference.impacts[k].velocity_after).norm(), 1e-8) << lines;
    }
  }
}

TEST(SolidImpacts, ARoomKeepsWhatTumblesInIt) {
  // at rest, and turning; the walls of one that turns give energy, but |v|^2/2 + w_b I w_b/2 m - W L_z / m stays
  const Start start{{0.1, 0.05, 0}, {0.7, 0.4, 0.3}, {3, 2, 5}, {1, 2, 3}, 0.5};
  const std::string body = "[[body]]\nname = \"b\"\nmass = 2.5\n" + shapes()[0] +
                           "position = " + array(start.position) + "\nvelocity = " + array(start.velocity) +
                           "\nangular_velocity = " + array(start.w) +
                           "\norientation = {axis = [1, 2, 3], angle = 0.5}\n";
  for (const double turn : {0.0, 0.8}) {
    const std::string scene = body +
                              "[[obstacle]]\nname = \"room\"\nshape = \"box\"\ncenter = [0, 0, 0]\nsize = [4, 3, "
                              "3]\ninside = true\non_hit = \"bounce\"\nangular_velocity = [0, 0, " +
                              number(turn) + "]\n";
    const RunResult result = run_text("[time]\nend = 20\n" + scene);
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    EXPECT_GT(result.impacts.size(), 10u);
    const Matrix3 inertia = inertia_of("[time]\nend = 0\n" + scene);
    const auto integral = [&](const BodyState& state) {
      const Kept all = kept(state, inertia);
      const double orbit = 2.5 * (state.position.x() * state.velocity.y() - state.position.y() * state.velocity.x());
      return all.energy - 2.5 * kGravity * state.position.z() - turn * (all.spin + orbit);
    };
    const BodyState& end = final_of(result, "b");
    EXPECT_NEAR(integral(end), integral(at_start(scene)), 1e-9) << turn;
    EXPECT_LT(end.position.norm(), 3.0) << "it is in the room still";
  }
}

TEST(SolidImpacts, AMeshIsMetAsItsTrianglesAre) {
  // the same hills once as one mesh, whose triangles stand under a tree of its own, once as 288 obstacles
  constexpr int kSide = 12;
  TriangleMesh hills;
  for (int i = 0; i <= kSide; ++i)
    for (int j = 0; j <= kSide; ++j)
      hills.vertices.push_back({-1.5 + 3.0 * i / kSide, -1.5 + 3.0 * j / kSide, 0.05 * ((7 * i + 5 * j) % 3)});
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const int a = i * (kSide + 1) + j, b = a + kSide + 1;
      hills.triangles.push_back({a, b, b + 1});
      hills.triangles.push_back({a, b + 1, a + 1});
    }
  Random random(14);
  for (int i = 0; i < 12; ++i) {
    const Start start{{random.between(-0.3, 0.3), random.between(-0.3, 0.3), 1.2},
                      random.vector(0.5),
                      random.vector(8.0),
                      random.vector(1.0),
                      random.between(0.0, 6.0)};
    Scene one =
        parse_scene("[time]\nend = 1\n" + solid("shape = \"box\"\nsize = [0.5, 0.3, 0.2]\n", start), "test.toml");
    Scene many = one;
    one.obstacles.push_back({.name = "hills", .shape = MeshShape{hills}});
    for (std::size_t k = 0; k < hills.triangles.size(); ++k) {
      const auto corner = [&](std::size_t c) {
        return Expression(hills.vertices[static_cast<std::size_t>(hills.triangles[k][c])]);
      };
      many.obstacles.push_back(
          {.name = "t" + std::to_string(k), .shape = TriangleShape{corner(0), corner(1), corner(2)}});
    }
    const RunResult mesh = run(one), triangles = run(many);
    ASSERT_EQ(mesh.impacts.size(), 1u) << i << mesh.failure;
    ASSERT_EQ(triangles.impacts.size(), 1u) << i << triangles.failure;
    EXPECT_NEAR(mesh.impacts[0].time, triangles.impacts[0].time, 1e-13) << i;
    EXPECT_LT((mesh.impacts[0].point - triangles.impacts[0].point).norm(), 1e-11) << i;
  }
}

TEST(SolidImpacts, WhatCannotAnswerSaysSo) {
  const RunResult kinematic = run_text(
      "[time]\nend = 2\n[[body]]\nname = \"b\"\nshape = \"box\"\nsize = [1, 1, 1]\nposition = [0, 0, 2]\nvelocity = "
      "[0, 0, "
      "-1]\nangular_velocity = [1, 0, 0]\n" +
      floor_of(1.0));
  EXPECT_EQ(kinematic.status, RunStatus::failed);
  EXPECT_NE(kinematic.failure.find("mass"), std::string::npos);
  ASSERT_EQ(kinematic.impacts.size(), 1u) << "the contact is reported all the same";
}

}  // namespace
}  // namespace trajet::test
