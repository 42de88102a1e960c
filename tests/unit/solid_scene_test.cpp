#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "scene_run.hpp"
#include "trajet/study/compare.hpp"

namespace trajet {
namespace {

using test::error_of;
using test::final_of;
using test::run_text;

std::string scene(const std::string& body, const std::string& rest = "") {
  return "[time]\nend = 1\n[[body]]\nname = \"b\"\n" + body + "\n" + rest;
}

TEST(SolidScene, MistakesAreErrorsAtTheirPlace) {
  struct {
    const char* body;
    const char* place;
    const char* words;
  } const cases[] = {
      {"torque = [0, 0, 1]", "s:5:11", "a torque but no inertia"},
      {"shape = \"sphere\"\nradius = 1\ntorque = [0, 0, 1]", "s:7:11", "a torque but no inertia"},
      {"inertia = [1, 2, 4]\ntorque = [0, 0, 1]", "s:5:12", "belongs to no body"},
      {"inertia = [1, 0, 1]\ntorque = [0, 0, 1]", "s:5:12", "belongs to no body"},
      {"inertia = [[1, 1, 0], [0, 1, 0], [0, 0, 1]]\ntorque = [0, 0, 1]", "s:5:13", "not symmetric"},
      {"angular_velocity = [0, 0, 1]\nangular_velocity_body = [0, 0, 1]", "s:6:26", "both"},
      {"angular_acceleration = [0, 0, 1]\ntorque = [0, 0, 1]\ninertia = [1, 1, 1]", "s:6:11", "both"},
      {"density = 3", "s:5:11", "is a point and has no volume"},
      {"shape = \"sphere\"\nradius = 1\ndensity = 3\nmass = 2", "s:7:11", "both"},
      {"shape = \"box\"\nsize = [1, 0, 1]", "s:6:9", "must be positive"},
      {"shape = \"hull\"\npoints = [[0,0,0], [1,0,0], [0,1,0], [1,1,0]]", "s:4:8", "do not lie in a plane"},
      {"shape = \"hull\"\npoints = [[0,0,0], [1,0,0]]", "s:4:8", "at least four points"},
      {"orientation = {quaternion = [0, 0, 0, 0]}", "s:5:30", "is zero"},
      {"orientation = {axis = [0, 0, 0], angle = 1}", "s:5:24", "no direction"},
      {"orientation = {matrix = [[1, 0, 0], [0, 1, 0], [0, 0, -1]]}", "s:5:27", "no rotation matrix"},
      {"orientation = {matrix = [[1, 0, 0], [0, 1, 0], [0, 0.1, 1]]}", "s:5:27", "no rotation matrix"},
      {"force_point = [0, 0, 1]", "s:5:16", "no `force`"},
      {"angular_velocity = \"[0, 0, t]\"", "s:5:28", "only laws"},
      {"angular_acceleration = \"[0, 0, wq]\"", "s:5:32", "unknown name"},
  };
  for (const auto& c : cases) {
    const std::string message = error_of(scene(c.body));
    EXPECT_TRUE(message.starts_with(c.place)) << message << "\n  for:\n" << c.body;
    EXPECT_NE(message.find(c.words), std::string::npos) << message << "\n  for:\n" << c.body;
  }
}

TEST(SolidScene, WaysThatDoNotSuitTheLawAreErrors) {
  const std::string exact = "[method]\norientation = \"exact\"\n";
  EXPECT_NE(error_of(scene("inertia = [1, 2, 3]\ntorque = [0, 0, 1]", exact)).find("s:6:11"), std::string::npos);
  EXPECT_NE(error_of(scene("angular_acceleration = [0, 0, 1]", exact)).find("closed forms only"), std::string::npos);
  const std::string matrix = "[method]\norientation = \"matrix\"\n";
  EXPECT_NE(error_of(scene("inertia = [1, 2, 3]\ntorque = \"[0, 0, qw]\"", matrix)).find("carries no quaternion"),
            std::string::npos);
  const std::string set = "[[event]]\nname = \"e\"\nwhen = \"t - 0.5\"\nset = {b.w = [0, 0, 1]}\n";
  EXPECT_NE(error_of(scene("", set)).find("does not turn"), std::string::npos);
  EXPECT_EQ(error_of(scene("angular_velocity = [0, 0, 0]", set)), "no error");
}

TEST(SolidScene, OrientationsInAllForms) {
  const char* const forms[] = {"{axis = [0, 0, 2], angle = \"90 deg\"}", "{quaternion = [2, 0, 0, 2]}",
                               "{matrix = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]}", "{yaw = \"90 deg\"}"};
  for (const char* form : forms)
    for (const char* spin :
         {"", "\nangular_velocity_body = [0, 0, 0]", "\ninertia = [1, 2, 2.5]\nangular_velocity = [0, 0, 0]"}) {
      const BodyState b = final_of(run_text(scene("orientation = " + std::string(form) + spin)), "b");
      EXPECT_LE((b.rotation_matrix * Vector3(1, 0, 0) - Vector3(0, 1, 0)).norm(), 1e-15) << form << spin;
      EXPECT_LE(std::abs(b.orientation.w() - std::sqrt(0.5)), 1e-15);
    }
}

TEST(SolidScene, RollPitchAndYawTurnAboutXThenYThenZOfTheWorld) {
  // x goes down by the pitch, then round by the yaw; y is rolled up to z, pitched to x, yawed to y
  const BodyState b =
      final_of(run_text(scene("orientation = {roll = \"90 deg\", pitch = \"90 deg\", yaw = \"90 deg\"}")), "b");
  EXPECT_LE((b.rotation_matrix.col(0) - Vector3(0, 0, -1)).norm(), 1e-15);
  EXPECT_LE((b.rotation_matrix.col(1) - Vector3(0, 1, 0)).norm(), 1e-15);
  const double roll = 0.3, pitch = -0.4, yaw = 2.5;
  const BodyState c = final_of(run_text(scene("orientation = {roll = 0.3, pitch = -0.4, yaw = 2.5}")), "b");
  const Matrix3 expected = (Eigen::AngleAxisd(yaw, Vector3::UnitZ()) * Eigen::AngleAxisd(pitch, Vector3::UnitY()) *
                            Eigen::AngleAxisd(roll, Vector3::UnitX()))
                               .toRotationMatrix();
  EXPECT_LE((c.rotation_matrix - expected).norm(), 1e-15);
}

TEST(SolidScene, LawsReadTheRotation) {
  // thrust along the body's x axis, which turns once around z in 1 s: v = (sin, 1 - cos) / (2 pi)
  const std::string thrust = "angular_velocity = [0, 0, \"2*pi\"]\nacceleration = \"[Rxx, Ryx, Rzx]\"\n";
  const std::string same =
      "angular_velocity = [0, 0, \"2*pi\"]\nacceleration = \"[qw^2 + qx^2 - qy^2 - qz^2, 2*qw*qz, 0]\"\n";
  for (const std::string& body : {thrust, same}) {
    const BodyState b = final_of(run_text(scene(body, "[method]\nrtol = 1e-14\natol = 1e-14\n")), "b");
    EXPECT_LE(b.velocity.norm(), 1e-13);
    EXPECT_LE((b.position - Vector3(0, 1 / (2 * std::numbers::pi), 0)).norm(), 1e-13);
  }
  // another body follows its angular velocity, in the world and from an event
  const std::string others =
      "[[body]]\nname = \"c\"\nvelocity = [0, 0, 0]\nposition_rate = \"b.w + [b.wx, b.wy, b.wz] + b.w_body\"\n"
      "[[event]]\nname = \"quarter\"\nwhen = \"b.Rxx\"\n";
  const RunResult result = run_text(scene("angular_velocity = [0, 0, \"2*pi\"]", others));
  EXPECT_NEAR(final_of(result, "c").position.z(), 6 * std::numbers::pi, 1e-12);
  ASSERT_EQ(result.events.size(), 2u);
  EXPECT_NEAR(result.events[0].time, 0.25, 1e-12);
}

TEST(SolidScene, EventsSetTheAngularVelocity) {
  const std::string event = "[[event]]\nname = \"e\"\nwhen = \"t - 0.5\"\nset = {b.w = \"-b.w\"}\n";
  for (const char* body : {"angular_velocity = [1, 2, 3]", "inertia = [1, 1.5, 2]\nangular_velocity = [1, 2, 3]"})
    for (const char* way : {"quaternion-normalized", "matrix", "rotation-vector", "exact"}) {
      const RunResult result = run_text(scene(body, event + "[method]\norientation = \"" + way + "\"\n"));
      // the motion runs backward to where it began
      EXPECT_LE((final_of(result, "b").angular_velocity + Vector3(1, 2, 3)).norm(), 1e-10) << body << way;
      EXPECT_NEAR(std::abs(final_of(result, "b").orientation.w()), 1.0, 1e-10) << body << way;
    }
}

TEST(SolidScene, InertiaOfAShapeIsThatOfItsMassOrDensity) {
  const std::string spin = "\nangular_velocity_body = [1, 0.1, 2]\n";
  const auto run_shape = [&](const std::string& body) { return final_of(run_text(scene(body + spin)), "b"); };
  const BodyState given = run_shape("inertia = [\"13/12*6\", \"10/12*6\", \"5/12*6\"]");
  for (const char* shape :
       {"shape = \"box\"\nsize = [1, 2, 3]\nmass = 6", "shape = \"box\"\nsize = [1, 2, 3]\ndensity = 1",
        "shape = \"hull\"\ndensity = 1\npoints = [[0,0,0], [1,0,0], [0,2,0], [0,0,3], [1,2,0], [1,0,3], [0,2,3], "
        "[1,2,3]]"})
    EXPECT_LE((run_shape(shape).angular_velocity - given.angular_velocity).norm(), 1e-10) << shape;
}

TEST(SolidScene, MeshesAreReadFromFiles) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "trajet_mesh_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "box.obj") << "v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3\n"
                                       "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  std::ofstream(folder / "open.obj") << "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n";
  const auto run_mesh = [&](const std::string& body) {
    return run(parse_scene(scene(body + "\nangular_velocity_body = [1, 0.1, 2]\n"), (folder / "scene.toml").string()));
  };
  const BodyState mesh = final_of(run_mesh("shape = \"mesh\"\nfile = \"box.obj\"\nscale = 0.5\nmass = 6"), "b");
  const BodyState box = final_of(run_mesh("shape = \"box\"\nsize = [0.5, 1, 1.5]\nmass = 6"), "b");
  EXPECT_LE((mesh.angular_velocity - box.angular_velocity).norm(), 1e-10);
  EXPECT_THROW(run_mesh("shape = \"mesh\"\nfile = \"open.obj\""), InputError);
  EXPECT_THROW(run_mesh("shape = \"mesh\"\nfile = \"none.obj\""), FileError);
  std::filesystem::remove_all(folder);
}

TEST(SolidScene, ABallThatTurnsBouncesAndTurnsOn) {
  const std::string ground =
      "[[obstacle]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0,0,0]\nnormal = [0,0,1]\non_hit = \"bounce\"\n";
  const RunResult result =
      run_text(scene("shape = \"sphere\"\nradius = 0.1\nmass = 1\nposition = [0,0,1]\nacceleration = [0,0,-9.8]\n"
                     "angular_velocity = [1, 2, 3]",
                     ground));
  ASSERT_GE(result.impacts.size(), 1u);
  EXPECT_NEAR(result.impacts[0].time, std::sqrt(2 * 0.9 / 9.8), 1e-12);
  EXPECT_EQ(result.impacts[0].angular_velocity_before, Vector3(1, 2, 3));
  EXPECT_EQ(result.impacts[0].angular_velocity_after, Vector3(1, 2, 3));
  EXPECT_LE((to_rotation_vector(final_of(result, "b").orientation) -
             std::remainder(std::sqrt(14.0), 2 * std::numbers::pi) * Vector3(1, 2, 3).normalized())
                .norm(),
            1e-11);
}

TEST(SolidScene, OrientationsAreComparedAsReported) {
  // both ways are exact at a constant angular velocity, whatever numbers a step leaves
  for (const char* way : {"rotation-vector", "exact"}) {
    ComparePlan plan;
    plan.methods = {"euler"};
    plan.step_counts = {100};
    const std::string method = "[method]\norientation = \"" + std::string(way) + "\"\n";
    const Comparison comparison = compare(parse_scene(scene("angular_velocity = [0, 4, 4]", method), "s"), plan);
    ASSERT_EQ(comparison.rows.size(), 1u);
    EXPECT_LE(comparison.rows[0].at_samples.state.value_or(1.0), 1e-10) << way;  // of the reference
  }
}

ComparePlan euler_with(long steps) {
  ComparePlan plan;
  plan.methods = {"euler"};
  plan.step_counts = {steps};
  return plan;
}

// w = (0, 0, 2): each step of Euler's method multiplies q by (1, w h/2), which is longer and turns by 2 atan(h w/2).
TEST(SolidScene, OrientationsAreComparedWithClosedForms) {
  const char* const forms[] = {
      "b.orientation = {axis = [0, 0, 3], angle = \"2*t\"}\n",
      "b.orientation = {quaternion = [\"-cos(t)\", 0, 0, \"-sin(t)\"]}\n",  // the other one of the two
      "b.orientation = {matrix = [[\"cos(2*t)\", \"-sin(2*t)\", 0], [\"sin(2*t)\", \"cos(2*t)\", 0], [0, 0, 1]]}\n",
      "b.qw = \"cos(t)\"\nb.qx = 0\nb.qy = 0\nb.qz = \"sin(t)\"\n",
      "b.orientation = {yaw = \"2*t\"}\n",
      "b.orientation = {roll = \"180 deg\", pitch = \"180 deg\", yaw = \"2*t - 180*pi/180\"}\n"};
  const double h = 0.1, lag = 10 * std::atan(h) - 1.0;  // of half the angle, after 10 steps
  const double length = std::pow(1 + h * h, 5.0), stretch = std::pow(1 + 4 * h * h, 5.0);
  const auto row = [&](const std::string& way, const std::string& exact) {
    const std::string text = "[method]\norientation = \"" + way + "\"\n[exact]\n" + exact;
    return compare(parse_scene(scene("angular_velocity = [0, 0, 2]", text), "s"), euler_with(10)).rows.at(0);
  };
  for (const char* form : forms) {
    const auto largest = [](double a, double b) { return std::max(std::abs(a), std::abs(b)); };
    EXPECT_NEAR(*row("quaternion-normalized", form).at_end.state,
                largest(std::cos(1 + lag) - std::cos(1.0), std::sin(1 + lag) - std::sin(1.0)), 1e-13)
        << form;
    EXPECT_NEAR(*row("quaternion", form).at_end.state,
                largest(length * std::cos(1 + lag) - std::cos(1.0), length * std::sin(1 + lag) - std::sin(1.0)), 1e-13)
        << form;
    // R is multiplied by 1 + h w~, which turns by atan(h w)
    const double angle = 10 * std::atan(2 * h);
    EXPECT_NEAR(*row("matrix", form).at_end.state,
                largest(stretch * std::cos(angle) - std::cos(2.0), stretch * std::sin(angle) - std::sin(2.0)), 1e-13)
        << form;
    EXPECT_LE(*row("rotation-vector", form).at_samples.state, 1e-14) << form;
  }
}

// The same motion again: R is multiplied by 1 + h w~, of determinant 1 + (h w)^2; q by a number of length
// sqrt(1 + (h w/2)^2), and R = q (.) q* grows by the sixth power of it.
TEST(SolidScene, AClosedFormByRollPitchAndYawIsTheStartsOwn) {
  // about the world's z: only the yaw changes
  const std::string start = "orientation = {roll = 0.3, pitch = -0.4, yaw = 2.5}\nangular_velocity = [0, 0, 2]";
  const auto error = [&](const std::string& yaw) {
    const std::string exact = "[exact]\nb.orientation = {roll = 0.3, pitch = -0.4, yaw = \"" + yaw + "\"}\n";
    return *compare(parse_scene(scene(start, "[method]\norientation = \"rotation-vector\"\n" + exact), "s"),
                    euler_with(10))
                .rows.at(0)
                .at_samples.state;
  };
  EXPECT_LE(error("2.5 + 2*t"), 1e-14);
  EXPECT_GE(error("2.5 + 2.01*t"), 1e-3);
}

TEST(SolidScene, ComparisonsTellWhatBecomesOfRotations) {
  const std::string exact = "[exact]\nb.orientation = {axis = [0, 0, 1], angle = \"2*t\"}\n";
  ComparePlan plan = euler_with(10);
  plan.orientations = {OrientationWay::matrix, OrientationWay::quaternion, OrientationWay::quaternion_normalized};
  const Comparison comparison = compare(parse_scene(scene("angular_velocity = [0, 0, 2]", exact), "s"), plan);
  EXPECT_TRUE(comparison.turns);
  ASSERT_EQ(comparison.rows.size(), 3u);
  const double h = 0.1, length = std::pow(1 + h * h, 5.0), by_quaternion = std::abs(20 * std::atan(h) - 2);
  const struct {
    double determinant;
    std::optional<double> norm;
    double angle;
  } expected[] = {{std::pow(1 + 4 * h * h, 10.0), std::nullopt, std::abs(10 * std::atan(2 * h) - 2)},
                  {std::pow(length, 6.0), length, by_quaternion},
                  {1.0, 1.0, by_quaternion}};
  for (std::size_t i = 0; i < 3; ++i) {
    const RotationDeviation& end = comparison.rows[i].rotation_at_end;
    EXPECT_NEAR(*end.determinant, expected[i].determinant, 1e-13) << i;
    ASSERT_EQ(end.norm.has_value(), expected[i].norm.has_value()) << i;
    EXPECT_NEAR(end.norm.value_or(0.0), expected[i].norm.value_or(0.0), 1e-13) << i;
    EXPECT_NEAR(*end.angle_rad, expected[i].angle, 1e-13) << i;
    EXPECT_NEAR(*comparison.rows[i].rotation_at_samples.angle_rad, expected[i].angle, 1e-13) << i;
    EXPECT_FALSE(end.energy || end.momentum) << i;  // without an inertia
    const std::vector<RotationSample>& history = comparison.rows[i].rotation_history;
    ASSERT_EQ(history.size(), 201u) << i;
    EXPECT_EQ(history[0].time, 0.0);
    EXPECT_NEAR(history[200].time, 1.0, 1e-12);
    EXPECT_NEAR(*history[200].deviation.angle_rad, expected[i].angle, 1e-13) << i;
  }
  const Scene still = parse_scene("[time]\nend = 1\n[[state]]\nname = \"y\"\nvalue = 1\nrate = \"-y\"\n", "s");
  EXPECT_FALSE(compare(still, euler_with(2)).turns);
}

// One step of Euler's method from q = 1: w becomes w + h dw/dt, q becomes (1, h w/2).
TEST(SolidScene, ComparisonsTellTheDriftOfEnergyAndMomentum) {
  const Vector3 I(1, 2, 2.5), w(1, -2, 0.5);
  const double h = 0.125;
  const std::string top = "inertia = [1, 2, 2.5]\nangular_velocity = [1, -2, 0.5]";
  Scene scene_of_top = parse_scene(scene(top), "s");
  scene_of_top.time.end = Expression::number(h, {});
  ComparePlan plan = euler_with(1);
  plan.orientations = {OrientationWay::quaternion, OrientationWay::quaternion_normalized};
  const Comparison comparison = compare(scene_of_top, plan);
  const Vector3 L = I.cwiseProduct(w), w1 = w - h * I.cwiseInverse().cwiseProduct(w.cross(L)), L1 = I.cwiseProduct(w1);
  const Quaternion q1 = Quaternion(1.0, h / 2 * w.x(), h / 2 * w.y(), h / 2 * w.z()).normalized();
  const RotationDeviation& end = comparison.rows.at(0).rotation_at_end;
  EXPECT_NEAR(*end.energy, std::abs(w1.dot(L1) / w.dot(L) - 1), 1e-14);
  EXPECT_NEAR(*end.momentum, (rotate<double>(q1, L1) - L).norm() / L.norm(), 1e-14);
  EXPECT_LE(*comparison.rows.at(1).rotation_at_end.energy, 1e-14);  // put back
  EXPECT_LE(*comparison.rows.at(1).rotation_at_end.momentum, 1e-14);
}

// The reference carries its orientation in the scene's way, each row in its own: the numbers are made the row's.
TEST(SolidScene, WaysAreComparedWithOneReference) {
  const std::string tops =
      "inertia = [1, 2, 2.5]\nangular_velocity = [1, -2, 0.5]\ntorque = \"c.w - w\"\n[[body]]\nname = \"c\"\n"
      "inertia = [1, 2, 2.5]\nangular_velocity = [0, 1, 0.5]\ntorque = \"0.1*b.w\"\n";
  for (const char* way : {"quaternion", "matrix", "rotation-vector"}) {
    ComparePlan plan;
    plan.methods = {"rk4"};
    plan.step_counts = {50};
    plan.orientations = {OrientationWay::matrix, OrientationWay::quaternion, OrientationWay::rotation_vector,
                         OrientationWay::quaternion_normalized};
    const std::string method = "[method]\norientation = \"" + std::string(way) + "\"\n";
    const Comparison comparison = compare(parse_scene(scene(tops, method), "s"), plan);
    ASSERT_EQ(comparison.rows.size(), 4u);
    for (const ComparisonRow& row : comparison.rows) {
      EXPECT_LE(*row.at_samples.state, 1e-6) << way << " " << row.orientation;
      EXPECT_GT(*row.at_samples.state, 1e-10) << way << " " << row.orientation;
    }
  }
}

TEST(SolidScene, AngularVelocitiesAreComparedInEitherFrame) {
  // a symmetric top: w_B turns about its axis at (I_3 - I_1)/I_1 w_3 = 3, and about L in the world
  const std::string top = "inertia = [1, 1, 2]\nangular_velocity_body = [1, 0, 3]";
  const auto error = [&](const std::string& exact) {
    ComparePlan plan;
    plan.methods = {"taylor"};
    plan.rtols = {1e-12};
    return *compare(parse_scene(scene(top, "[exact]\n" + exact), "s"), plan).rows.at(0).at_samples.state;
  };
  const std::string w_B = "b.w_body = [\"cos(3*t)\", \"sin(3*t)\", 3]\n";
  EXPECT_LE(error(w_B), 1e-11);
  EXPECT_GT(error("b.w_body = [\"cos(3*t)\", \"-sin(3*t)\", 3]\n"), 0.1);
  EXPECT_NE(error_of(scene(top, "[exact]\nb.w = [0, 0, 3]\n")).find("s:8:3"), std::string::npos);
  EXPECT_NE(error_of(scene(top, "[exact]\nb.w = [0, 0, 3]\n")).find("give `w_body`"), std::string::npos);
  EXPECT_NE(error_of(scene("", "[exact]\nb.w = [0, 0, 3]\n")).find("does not turn"), std::string::npos);
  // the axis that moves in the world, and its orientation, of which the state holds w_B
  const std::string driven =
      "angular_velocity_body = [1, 0, 0]\nangular_acceleration_body = [0, 0, 0]\norientation = {axis = [0, 0, 1], "
      "angle = \"pi/2\"}";
  EXPECT_NE(error_of(scene(driven, "[exact]\nb.w = [0, 1, 0]\n")).find("give `w_body`"), std::string::npos);
  ComparePlan plan;
  plan.methods = {"taylor"};
  plan.rtols = {1e-12};
  const std::string exact =
      "[exact]\nb.w = [0, 1, 0]\nb.qw = \"cos(t/2)/sqrt(2)\"\nb.qx = \"sin(t/2)/sqrt(2)\"\nb.qy = "
      "\"sin(t/2)/sqrt(2)\"\n"
      "b.qz = \"cos(t/2)/sqrt(2)\"\n";
  const Comparison comparison = compare(parse_scene(scene(driven, exact), "s"), plan);
  EXPECT_LE(*comparison.rows.at(0).at_samples.state, 1e-12);
  EXPECT_EQ(comparison.components, (std::vector<std::string>{"b.orientation", "b.w"}));
  EXPECT_TRUE(comparison.warnings.empty());
}

TEST(SolidScene, ClosedFormsOfOrientationsSayWhatIsWrongAndWhere) {
  const auto message = [&](const std::string& exact) -> std::string {
    try {
      const Comparison c =
          compare(parse_scene(scene("angular_velocity = [0, 0, 2]", "[exact]\n" + exact), "s"), euler_with(4));
      return c.warnings.empty() ? "" : c.warnings[0];
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(message("b.orientation = {axis = [0, 0, 1], angle = \"2*t\"}\n"), "");
  EXPECT_NE(message("b.orientation = {axis = [0, 0, 1], angle = \"2*t + 1\"}\n").find("'b.orientation' does not begin"),
            std::string::npos);
  EXPECT_TRUE(message("b.orientation = {axis = [0, 0, \"t\"], angle = 0}\n")
                  .starts_with("s:7:3: error: the closed form of "
                               "'b.orientation' is not finite"));
  EXPECT_TRUE(
      message("b.orientation = {axis = [0, 0, 1], angle = \"2*s\"}\n").starts_with("s:7:47: error: unknown name"));
}

TEST(SolidScene, OtherSolidsMeetObstaclesWithTheirSurface) {
  const std::string ground = "[[obstacle]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0,0,0]\nnormal = [0,0,1]\n";
  const std::string box = "shape = \"box\"\nsize = [1, 2, 2]\nangular_velocity = [1, 2, 3]\nvelocity = [0, 0, -1]\n";
  // its corners are 1.5 away from the centre
  const RunResult far = run_text(scene(box + "position = [0, 0, 2.6]", ground));
  EXPECT_EQ(far.status, RunStatus::finished);
  const RunResult near = run_text(scene(box + "position = [0, 0, 2]", ground));
  EXPECT_EQ(near.status, RunStatus::stopped) << near.failure;
  EXPECT_GT(near.end_time, 0.5);  // before, its farthest corner does not reach so far
  const BodyState& touching = near.final.bodies.front();
  const Vector3 half(0.5, 1.0, 1.0);
  const double lowest = touching.position.z() - touching.rotation_matrix.row(2).cwiseAbs() * half;
  EXPECT_NEAR(lowest, 0.0, 1e-12);
}

}  // namespace
}  // namespace trajet
