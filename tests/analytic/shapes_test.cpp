// Motions among curved, hollow, rounded and composed shapes of which the closed forms are known.

#include <gtest/gtest.h>

#include <cmath>

#include "scene_run.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {
namespace {

using test::final_of;
using test::impacts_of;
using test::run_text;

constexpr double kG = 9.81;

/// A ball or a point that falls or flies, and obstacles.
std::string scene(const std::string& end, const std::string& body, const std::string& obstacles) {
  return "[time]\nend = " + end + "\n[[body]]\nname = \"ball\"\n" + body + "\n" + obstacles;
}
const std::string kFalls = "acceleration = [0, 0, -9.81]\n";
const std::string kBall = "shape = \"sphere\"\nradius = 0.1\n";

std::string obstacle(const std::string& keys, const std::string& on_hit = "bounce") {
  return "[[obstacle]]\nname = \"o\"\n" + keys + "\non_hit = \"" + on_hit + "\"\n";
}

TEST(Shapes, ABallFallsOnTheTipOfACone) {
  const RunResult result = run_text(scene("1.0", kBall + kFalls + "position = [0, 0, 5]",
                                          obstacle("shape = \"cone\"\ncenter = [0,0,0]\nradius = 1\nheight = 2")));
  ASSERT_EQ(result.impacts.size(), 1u);
  // the tip is at 1.5, the ball's centre 0.1 above it
  const double t = std::sqrt(2.0 * 3.4 / kG);
  EXPECT_NEAR(result.impacts[0].time, t, 1e-14);
  EXPECT_LE((result.impacts[0].point - Vector3(0, 0, 1.5)).norm(), 1e-14);
  EXPECT_LE((result.impacts[0].normal - Vector3(0, 0, 1)).norm(), 1e-12);
  EXPECT_NEAR(final_of(result, "ball").position.z(), 1.6 + kG * t * (1.0 - t) - 0.5 * kG * (1.0 - t) * (1.0 - t),
              1e-12);
}

TEST(Shapes, ABallMeetsTheRimOfACylinder) {
  const RunResult result =
      run_text(scene("2.0", "shape = \"sphere\"\nradius = 0.5\n" + kFalls + "position = [1.3, 0, 3]",
                     obstacle("shape = \"cylinder\"\ncenter = [0,0,0]\nradius = 1\nheight = 2", "stop")));
  ASSERT_EQ(result.impacts.size(), 1u);
  // 0.3 beside the rim at the height 1, and so 0.4 above it
  EXPECT_NEAR(result.impacts[0].time, std::sqrt(2.0 * 1.6 / kG), 1e-14);
  EXPECT_LE((result.impacts[0].point - Vector3(1, 0, 1)).norm(), 1e-14);
  EXPECT_LE((result.impacts[0].normal - Vector3(0.6, 0, 0.8)).norm(), 1e-14);
}

TEST(Shapes, APointGrazesAnEllipsoidAtItsTop) {
  const std::string ellipsoid = "shape = \"ellipsoid\"\ncenter = [0,0,0]\nradii = [3, 2, 1]";
  const std::string flight = "velocity = [1, 0, 0]\nposition = [-2, 0, 1]";
  const RunResult touches = run_text(scene("4.0", flight, obstacle(ellipsoid)));
  ASSERT_EQ(touches.impacts.size(), 1u);
  EXPECT_EQ(touches.impacts[0].kind, ImpactKind::graze);
  EXPECT_NEAR(touches.impacts[0].time, 2.0, touches.impacts[0].time_error_bound);
  EXPECT_TRUE(run_text(scene("4.0", "velocity = [1, 0, 0]\nposition = [-2, 0, 1.000000000001]", obstacle(ellipsoid)))
                  .impacts.empty());
  // (x / 3)^2 + z^2 = 1
  const RunResult cuts =
      run_text(scene("4.0", "velocity = [1, 0, 0]\nposition = [-2, 0, 0.99999999]", obstacle(ellipsoid, "pass")));
  ASSERT_EQ(cuts.impacts.size(), 2u);
  const double half = 3.0 * std::sqrt(1.0 - 0.99999999 * 0.99999999);
  EXPECT_NEAR(cuts.impacts[0].time, 2.0 - half, 1e-11);
  EXPECT_NEAR(cuts.impacts[1].time, 2.0 + half, 1e-11);
}

TEST(Shapes, ABallInAHollowSphereComesBackOnItsDiameter) {
  const RunResult result = run_text(scene("20.0", kBall + "velocity = [0.6, 0, 0.8]",
                                          obstacle("shape = \"sphere\"\ncenter = [0,0,0]\nradius = 1\ninside = true")));
  ASSERT_EQ(result.impacts.size(), 11u);
  for (std::size_t i = 0; i < result.impacts.size(); ++i)
    EXPECT_NEAR(result.impacts[i].time, 0.9 + 1.8 * static_cast<double>(i), 1e-12);

  const RunResult falls = run_text(
      scene("5.0", kBall + kFalls, obstacle("shape = \"sphere\"\ncenter = [0,0,0]\nradius = 1\ninside = true")));
  const double down = std::sqrt(2.0 * 0.9 / kG);
  ASSERT_EQ(falls.impacts.size(), 6u);
  for (std::size_t i = 0; i < falls.impacts.size(); ++i)
    EXPECT_NEAR(falls.impacts[i].time, down * (1.0 + 2.0 * static_cast<double>(i)), 1e-12);
}

// In an ellipse the product of the angular momenta about both foci is kept by every reflection.
TEST(Shapes, AnEllipticBilliardKeepsTheProductOfAngularMomenta) {
  const RunResult result =
      run_text(scene("400.0", "position = [0.3, 0.2, 0]\nvelocity = [0.7, 0.9, 0]",
                     obstacle("shape = \"ellipsoid\"\ncenter = [0,0,0]\nradii = [2, 1, 1.5]\ninside = true")));
  EXPECT_EQ(result.status, RunStatus::finished);
  EXPECT_GT(result.impacts.size(), 150u);
  const double focus = std::sqrt(3.0);
  const auto product = [&](const Vector3& r, const Vector3& v) {
    return ((r.x() - focus) * v.y() - r.y() * v.x()) * ((r.x() + focus) * v.y() - r.y() * v.x());
  };
  const double start = product({0.3, 0.2, 0}, {0.7, 0.9, 0});
  for (const Impact& impact : result.impacts) {
    EXPECT_NEAR(impact.position.x() * impact.position.x() / 4.0 + impact.position.y() * impact.position.y(), 1.0,
                1e-12);
    EXPECT_NEAR(product(impact.position, impact.velocity_after), start, 1e-10);
  }
}

TEST(Shapes, AHollowBoxIsARoomOfSixPlanes) {
  const std::string room = obstacle("shape = \"box\"\ncenter = [0,0,0]\nsize = [2, 3, 4]\ninside = true");
  std::string planes;
  for (const char* wall : {"[-1,0,0]", "[1,0,0]", "[0,-1.5,0]", "[0,1.5,0]", "[0,0,-2]", "[0,0,2]"})
    planes += "[[obstacle]]\nname = \"w" + std::to_string(planes.size()) + "\"\nshape = \"plane\"\npoint = " + wall +
              "\nnormal = \"-1*" + wall + "\"\non_hit = \"bounce\"\n";
  const std::string flight = kBall + kFalls + "velocity = [1.1, 2.3, 0.7]\nposition = [0.1, 0.2, 0.3]";
  const RunResult in_room = run_text(scene("20.0", flight, room)),
                  among_planes = run_text(scene("20.0", flight, planes));
  ASSERT_EQ(in_room.impacts.size(), among_planes.impacts.size());
  EXPECT_GT(in_room.impacts.size(), 40u);
  for (std::size_t i = 0; i < in_room.impacts.size(); ++i) {
    EXPECT_EQ(in_room.impacts[i].with, "o");
    EXPECT_EQ(in_room.impacts[i].time, among_planes.impacts[i].time);
  }
}

TEST(Shapes, ARoomsCornerSendsABallBack) {
  const RunResult result =
      run_text(scene("3.0", kBall + "velocity = [1, 1, 1]",
                     obstacle("shape = \"box\"\ncenter = [0,0,0]\nsize = [2, 2, 2]\ninside = true")));
  EXPECT_EQ(result.status, RunStatus::finished) << result.failure;
  // to 0.9 and back to the opposite corner, and on the way from there
  EXPECT_LE((final_of(result, "ball").position - Vector3(-0.6, -0.6, -0.6)).norm(), 1e-12);
}

TEST(Shapes, RoomsKeepWhatRestsOnTheirFloors) {
  for (const char* keys : {"shape = \"box\"\ncenter = [0,0,0]\nsize = [2, 2, 2]\ninside = true",
                           "shape = \"cylinder\"\ncenter = [0,0,0]\nradius = 1\nheight = 2\ninside = true"}) {
    const RunResult result =
        run_text(scene("20.0", kBall + kFalls + "velocity = [0.1, 0, 0]", obstacle(keys) + "restitution = 0.5\n"));
    EXPECT_EQ(result.status, RunStatus::finished) << result.failure;
    EXPECT_EQ(impacts_of(result, ImpactKind::rest).size(), 1u);
    EXPECT_NEAR(final_of(result, "ball").position.z(), -0.9, 1e-12);
    EXPECT_LE(std::abs(final_of(result, "ball").position.x()), 0.9 + 1e-12);
  }
  const RunResult bowl = run_text(
      scene("60.0", kBall + kFalls,
            obstacle("shape = \"sphere\"\ncenter = [0,0,0]\nradius = 1\ninside = true") + "restitution = 0.5\n"));
  EXPECT_EQ(bowl.status, RunStatus::finished) << bowl.failure;
  EXPECT_EQ(impacts_of(bowl, ImpactKind::rest).size(), 1u);
  EXPECT_NEAR((final_of(bowl, "ball").position - Vector3(0, 0, -0.9)).norm(), 0.0, 1e-15);
}

TEST(Shapes, ABodyRestsOnTheFlatEndOfACylinder) {
  const RunResult result = run_text(
      scene("10.0", kBall + kFalls + "position = [0, 0, 2]\nvelocity = [0.1, 0, 0]",
            obstacle("shape = \"cylinder\"\ncenter = [0,0,0]\nradius = 0.5\nheight = 2") + "restitution = 0\n"));
  const auto leaves = impacts_of(result, ImpactKind::leave);
  // it slides off the end, round the rim, and leaves that
  EXPECT_EQ(result.status, RunStatus::finished) << result.failure;
  EXPECT_GE(impacts_of(result, ImpactKind::rest).size(), 1u);
  EXPECT_EQ(leaves.size(), 1u);
}

// Rays parallel to the axis of a paraboloid z = (x^2 + y^2) / (4 f) meet in its focus.
TEST(Shapes, AParabolicTerrainHasAFocus) {
  const RunResult result = run_text(scene("10.0", "position = [1.2, 0.5, 4]\nvelocity = [0, 0, -1]",
                                          obstacle("shape = \"terrain\"\nheight = \"(x^2 + y^2)/8\"")));
  ASSERT_GE(result.impacts.size(), 1u);
  const Impact& impact = result.impacts[0];
  EXPECT_NEAR(impact.time, 4.0 - (1.44 + 0.25) / 8.0, 1e-14);
  const Vector3 to_focus = Vector3(0, 0, 2) - impact.position;
  EXPECT_LE(to_focus.normalized().cross(impact.velocity_after.normalized()).norm(), 1e-14);
  EXPECT_NEAR(impact.velocity_after.norm(), 1.0, 1e-14);
}

TEST(Shapes, AHullIsTheBoxThatItsCornersAre) {
  const std::string corners =
      "points = [[-1,-1,-1],[1,-1,-1],[-1,1,-1],[1,1,-1],[-1,-1,1],[1,-1,1],[-1,1,1],[1,1,1],[0,0,0]]\n";
  for (const std::string& body : {kBall, std::string()}) {
    const std::string flight = body + kFalls + "position = [0.3, 0.4, 3]\nvelocity = [0.1, -0.05, 0]";
    const RunResult hull = run_text(scene("1.5", flight, obstacle("shape = \"hull\"\ncenter = [0,0,0.5]\n" + corners)));
    const RunResult box =
        run_text(scene("1.5", flight, obstacle("shape = \"box\"\ncenter = [0,0,0.5]\nsize = [2,2,2]\n")));
    ASSERT_EQ(hull.impacts.size(), box.impacts.size());
    ASSERT_GE(hull.impacts.size(), 1u);
    for (std::size_t i = 0; i < hull.impacts.size(); ++i) EXPECT_NEAR(hull.impacts[i].time, box.impacts[i].time, 1e-14);
  }
}

TEST(Shapes, ARoundedBoxHasItsFacesAndLosesItsCorners) {
  const std::string box = "shape = \"box\"\ncenter = [0,0,0]\nsize = [2, 2, 2]\nrounding = 0.25";
  const RunResult on_face = run_text(scene("2.0", kFalls + "position = [0.1, 0, 2]", obstacle(box, "stop")));
  ASSERT_EQ(on_face.impacts.size(), 1u);
  EXPECT_NEAR(on_face.impacts[0].time, std::sqrt(2.0 / kG), 1e-14);
  const RunResult to_corner =
      run_text(scene("4.0", kBall + "position = [3, 3, 3]\nvelocity = [-1, -1, -1]", obstacle(box, "stop")));
  ASSERT_EQ(to_corner.impacts.size(), 1u);
  // the corner of the core is at 0.75
  EXPECT_NEAR(to_corner.impacts[0].time, 3.0 - (0.75 + 0.35 / std::sqrt(3.0)), 1e-14);
}

TEST(Shapes, ACompoundIsMetAtItsParts) {
  const std::string parts =
      "shape = \"compound\"\ncenter = [0,0,1]\nparts = [{shape = \"box\", size = [1,1,1], position = [-2,0,0]}, "
      "{shape = \"sphere\", radius = 0.5, position = [2,0,0]}]\norientation = {axis = [0,1,0], angle = \"90 deg\"}\n";
  // turned about y, x becomes -z: the sphere is below, the box above
  const RunResult result = run_text(scene("3.0", kFalls + "position = [0, 0, 10]", obstacle(parts, "pass")));
  ASSERT_EQ(result.impacts.size(), 4u);
  const double heights[] = {3.5, 2.5, -0.5, -1.5};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(result.impacts[i].time, std::sqrt(2.0 * (10.0 - heights[i]) / kG), 1e-13);
}

TEST(Shapes, ACompoundBodyHasTheMassOfItsParts) {
  const World world =
      make_world(parse_scene(scene("1.0",
                                   "shape = \"compound\"\nangular_velocity = [0,0,1]\nforce = [0,0,1]\n"
                                   "parts = [{shape = \"sphere\", radius = 0.1, mass = 2, position = [0.5,0,0]}, "
                                   "{shape = \"sphere\", radius = 0.1, mass = 1, position = [-1,0,0]}]\n",
                                   ""),
                             "s"));
  ASSERT_TRUE(world.bodies[0].rotation && world.bodies[0].rotation->inertia);
  // about the common centre at the origin: 2/5 m r^2 for each, and m x^2
  const double own = 0.4 * 3.0 * 0.01, apart = 2.0 * 0.25 + 1.0;
  EXPECT_LE((*world.bodies[0].rotation->inertia - Matrix3(Vector3(own, own + apart, own + apart).asDiagonal())).norm(),
            1e-14);
  EXPECT_NEAR(bounding_radius(world.bodies[0].solid), 1.1, 1e-14);
}

}  // namespace
}  // namespace trajet
