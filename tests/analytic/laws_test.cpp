// Laws of the scene language through whole runs, each against its closed form.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::run_text;
using test::Way;

/// Ways with the error that each may make on the smooth problems below, relative to numbers of order one.
struct ErrorOf : Way {
  double error;
};

std::vector<ErrorOf> ways() {
  return {{{"taylor", "name = \"taylor\"\n"}, 1e-11},
          {test::controlled("dopri5", 1e-12), 1e-10},
          {test::fixed("rk4", 1.0 / 256.0), 1e-7}};
}

TEST(Laws, ExtraStatesAlone) {
  // A general system: rotation and decay. x = cos 2t e^-t, y = sin 2t e^-t
  for (const ErrorOf& way : ways()) {
    const RunResult result = run_text("[time]\nend = 3\n[method]\n" + way.lines + R"(
[[state]]
name = "x"
value = 1
rate = "-x - 2*y"
[[state]]
name = "y"
value = 0
rate = "2*x - y"
)");
    EXPECT_NEAR(test::state_of(result, "x"), std::cos(6.0) * std::exp(-3.0), way.error) << way.name;
    EXPECT_NEAR(test::state_of(result, "y"), std::sin(6.0) * std::exp(-3.0), way.error) << way.name;
  }
}

TEST(Laws, TheRocketEquation) {
  // F = u dm/dt: v = u ln(m0/m) - g t, h by its integral
  for (const ErrorOf& way : ways()) {
    const RunResult result = run_text("[time]\nend = 4\n[method]\n" + way.lines + R"(
[parameters]
u = 50
burn = 2
[[body]]
name = "rocket"
force = "[0, 0, u*burn - 9.8*fuel]"
mass = "fuel"
[[state]]
name = "fuel"
value = 10
rate = "-burn"
)");
    const double speed = 50.0 * std::log(10.0 / 2.0) - 9.8 * 4.0;
    // integral of ln(m0/(m0 - b t)) dt = t - (m/b) ln(m0/m)
    const double height = 50.0 * (4.0 - 1.0 * std::log(5.0)) - 0.5 * 9.8 * 16.0;
    EXPECT_NEAR(test::final_of(result, "rocket").velocity.z(), speed, 1e2 * way.error) << way.name;
    EXPECT_NEAR(test::final_of(result, "rocket").position.z(), height, 1e2 * way.error) << way.name;
    EXPECT_NEAR(test::final_of(result, "rocket").acceleration.z(), 100.0 / 2.0 - 9.8, 1e2 * way.error) << way.name;
  }
}

TEST(Laws, PositionRateWithWind) {
  for (const ErrorOf& way : ways()) {
    const RunResult result = run_text("[time]\nend = 3\n[method]\n" + way.lines + R"(
[[body]]
name = "leaf"
velocity = [0, 2, 0]
acceleration = "-v"
position_rate = "v + [cos(t), 0, 0]"
)");
    EXPECT_NEAR(test::final_of(result, "leaf").position.x(), std::sin(3.0), way.error) << way.name;
    EXPECT_NEAR(test::final_of(result, "leaf").position.y(), 2.0 * (1.0 - std::exp(-3.0)), way.error) << way.name;
    EXPECT_NEAR(test::final_of(result, "leaf").velocity.y(), 2.0 * std::exp(-3.0), way.error) << way.name;
  }
}

TEST(Laws, WindCarriesIntoAWall) {
  // The velocity that meets the wall is dr/dt = v + wind, and what bounces is dr/dt.
  const RunResult result = run_text(R"(
[time]
end = 3
[[body]]
name = "leaf"
velocity = [1, 0, 0]
position_rate = "v + [1, 0, 0]"
[[obstacle]]
name = "wall"
shape = "plane"
point = [2, 0, 0]
normal = [-1, 0, 0]
on_hit = "bounce"
)");
  ASSERT_EQ(result.impacts.size(), 1u) << result.failure;
  EXPECT_EQ(result.impacts[0].time, 1.0);
  EXPECT_EQ(test::final_of(result, "leaf").velocity.x(), -3.0);
  EXPECT_EQ(test::final_of(result, "leaf").position.x(), -2.0);
}

TEST(Laws, ThrustThatEnds) {
  // a = 3 until t = 1: v = 3, x = 1.5 + 3 (t - 1). A branch in the law, which steps must not smear.
  for (const char* condition : {"where(t < 1, 3, 0)", "where(t <= 1, 3, 0)", "3*where(1 > t, 1, 0)"}) {
    const RunResult result = run_text(std::string("[time]\nend = 2\n[[body]]\nname = \"rocket\"\nacceleration = [\"") +
                                      condition + "\", 0, 0]\n");
    EXPECT_NEAR(test::final_of(result, "rocket").velocity.x(), 3.0, 1e-11) << condition;
    EXPECT_NEAR(test::final_of(result, "rocket").position.x(), 4.5, 1e-11) << condition;
  }
}

TEST(Laws, AForceThatDependsOnTheSide) {
  // A ball rolls onto a spring at x = 1: half an oscillation, and back.
  const RunResult result = run_text(R"(
[time]
end = 5
[[body]]
name = "ball"
velocity = [1, 0, 0]
acceleration = ['where(x > 1, -4*(x - 1), 0)', 0, 0]
)");
  // In the spring from t = 1 for pi/2 s, out with v = -1.
  EXPECT_NEAR(test::final_of(result, "ball").velocity.x(), -1.0, 1e-11);
  EXPECT_NEAR(test::final_of(result, "ball").position.x(), 1.0 - (4.0 - M_PI / 2.0), 1e-11);
}

TEST(Laws, QuadraticDragFromRestAndThroughTheApex) {
  // |v| v has a corner in its second derivative at v = 0, where a fall begins and a vertical throw turns.
  const double g = 9.8;
  const double k = 0.05;
  const double terminal = std::sqrt(g / k);
  for (const ErrorOf& way : ways()) {
    const std::string head = "[time]\nend = 3\n[method]\n" + way.lines + R"(
[[body]]
name = "ball"
acceleration = "[0, 0, -9.8] - 0.05*norm(v)*v"
)";
    const RunResult fall = run_text(head);
    const double tolerance = 20.0 * way.error;  // numbers of order ten
    EXPECT_NEAR(test::final_of(fall, "ball").velocity.z(), -terminal * std::tanh(g * 3.0 / terminal), tolerance)
        << way.name;
    EXPECT_NEAR(test::final_of(fall, "ball").position.z(), -std::log(std::cosh(g * 3.0 / terminal)) / k, tolerance)
        << way.name;

    const RunResult throw_up = run_text(head + "velocity = [0, 0, 12]\n");
    // up: v = V tan(phi0 - g t/V), apex where phi = 0; then down from rest
    const double phi0 = std::atan(12.0 / terminal);
    const double apex = phi0 * terminal / g;
    const double height = -std::log(std::cos(phi0)) / k;
    const double down = g * (3.0 - apex) / terminal;
    ASSERT_LT(apex, 3.0);
    // rk4 steps over the corner at the apex: (step)^3 there
    EXPECT_NEAR(test::final_of(throw_up, "ball").velocity.z(), -terminal * std::tanh(down), tolerance) << way.name;
    EXPECT_NEAR(test::final_of(throw_up, "ball").position.z(), height - std::log(std::cosh(down)) / k, tolerance)
        << way.name;
  }
}

TEST(Laws, ATable) {
  // a = t/2 from a table of two columns on a straight line: any sensible interpolation gives the line.
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "trajet_laws_test_table.csv";
  std::ofstream(path) << "0,0\n1,0.5\n2,1\n4,2\n";
  for (const ErrorOf& way : ways()) {
    const RunResult result =
        run_text("[time]\nend = 3\n[method]\n" + way.lines + "[[body]]\nname = \"cart\"\nacceleration = ['table(\"" +
                 path.string() + "\", t)', 0, 0]\n");
    EXPECT_NEAR(test::final_of(result, "cart").velocity.x(), 9.0 / 4.0, way.error) << way.name;
    EXPECT_NEAR(test::final_of(result, "cart").position.x(), 27.0 / 12.0, way.error) << way.name;
  }
  std::filesystem::remove(path);
}

TEST(Laws, BackwardInTime) {
  // From the end of a damped oscillation back to its start.
  for (const ErrorOf& way : ways()) {
    const std::string body = "[[body]]\nname = \"bob\"\nacceleration = \"-4*r - 0.2*v\"\n";
    const RunResult forward =
        run_text("[time]\nend = 3\n[method]\n" + way.lines + body + "position = [1, 0, 0]\nvelocity = [0, 1, 0]\n");
    Scene scene = parse_scene("[time]\nstart = 3\nend = 0\n[method]\n" + way.lines + body, "test.toml");
    scene.bodies[0].position = forward.final.bodies[0].position;
    scene.bodies[0].velocity = forward.final.bodies[0].velocity;
    const RunResult back = run(scene);
    EXPECT_EQ(back.status, RunStatus::finished) << back.failure;
    EXPECT_EQ(back.end_time, 0.0);
    // the damping, backward, lets errors grow by e^0.3
    EXPECT_LT((back.final.bodies[0].position - Vector3(1, 0, 0)).norm(), 3.0 * way.error) << way.name;
    EXPECT_LT((back.final.bodies[0].velocity - Vector3(0, 1, 0)).norm(), 3.0 * way.error) << way.name;
  }
}

TEST(Laws, TheErrorBoundOfAnImpactHoldsAllSteps) {
  // v' = -g - k v from rest at h: z = h - g t/k + g/k^2 (1 - exp(-k t))
  const double g = 9.8, k = 0.5, h = 2.0;
  double t = std::sqrt(2.0 * h / g);
  for (int i = 0; i < 10; ++i)
    t -= (h - g * t / k - g / (k * k) * std::expm1(-k * t)) / (-g / k + g / k * std::exp(-k * t));
  // and no bound is larger than a method of that order and step gives reason for
  const ErrorOf ways[] = {{test::fixed("euler", 0.05), 0.1},        {test::fixed("midpoint", 0.05), 1e-3},
                          {test::fixed("heun", 0.05), 1e-3},        {test::fixed("rk4", 0.05), 1e-6},
                          {test::controlled("bs32", 1e-6), 1e-4},   {test::controlled("dopri5", 1e-6), 1e-5},
                          {test::controlled("taylor", 1e-6), 1e-6}, {test::controlled("taylor", 1e-13), 1e-13}};
  for (const ErrorOf& way : ways) {
    SCOPED_TRACE(way.name);
    const RunResult result = run_text("[time]\nend = 2\n[method]\n" + way.lines + R"(
[[body]]
name = "ball"
position = [0, 0, 2]
acceleration = "[0, 0, -9.8] - 0.5*v"
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
)");
    ASSERT_EQ(result.impacts.size(), 1u);
    const double error = std::abs(result.impacts[0].time - t);
    EXPECT_LE(error, result.impacts[0].time_error_bound);
    EXPECT_LE(result.impacts[0].time_error_bound, way.error);
  }
}

}  // namespace
}  // namespace trajet
