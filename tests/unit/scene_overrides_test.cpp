// What the command line says instead of the scene: it reaches every table, and errors name the option.

#include "trajet/io/scene_overrides.hpp"

#include <gtest/gtest.h>

#include <string>

#include "trajet/io/scene_file.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/sim/run.hpp"

namespace trajet {
namespace {

Scene overridden(const SceneOverrides& overrides) {
  Scene scene = parse_scene(
      "[parameters]\ntheta = 1\nv-0 = 2\n[time]\nend = 1\n[method]\nsteps = [1]\n[[body]]\nname = \"b\"", "s");
  apply(overrides, scene);
  return scene;
}

std::string override_message(const SceneOverrides& overrides) {
  try {
    overridden(overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string message_of_setting(const std::string& assignment) {
  SceneOverrides overrides;
  overrides.parameters = {assignment};
  return override_message(overrides);
}

TEST(SceneOverrides, ReplaceWhatTheyName) {
  const Scene scene = overridden({.parameters = {"theta=2*v-0", "v-0=36 km/h"},
                                  .method = "rk4",
                                  .step = "10 ms",
                                  .order = {},
                                  .rtol = "1e-3",
                                  .atol = "1e-4",
                                  .end = "2 min"});
  EXPECT_EQ(scene.parameters[0].value.names(), std::vector<std::string>{"v-0"});
  EXPECT_EQ(scene.parameters[1].value.text(), Expression(10.0).text());
  EXPECT_EQ(scene.method.name, "rk4");
  EXPECT_EQ(scene.method.step->text(), Expression(0.01).text());
  EXPECT_TRUE(scene.method.steps.empty());
  EXPECT_EQ(scene.method.rtol->text(), "1e-3");
  EXPECT_EQ(scene.method.atol->text(), "1e-4");
  EXPECT_EQ(scene.time.end->text(), Expression(120.0).text());
}

TEST(SceneOverrides, ReachTheKeysOfEveryTable) {
  Scene scene = parse_scene(R"(
[time]
end = 1
[method]
steps = [1]
[[body]]
name = "ball"
shape = "sphere"
radius = 1
[[obstacle]]
name = "wall"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
[[state]]
name = "heat"
value = 1
rate = 0
[[event]]
name = "noon"
when = "t"
)",
                            "s");
  apply(
      {.parameters = {"ball.radius = 20 cm", "ball.velocity = [\"36 km/h\", 0, 1 ft/s]", "wall.point = [1 m, 2, 3]",
                      "wall.normal = [1, 0, 0]", "wall.on_hit = bounce", "heat.rate = -heat", "noon.when = heat - 0.5",
                      "time.end = 2 min", "time.sample = 1 s", "method.step = 10 ms", "method.max_seconds = 60"}},
      scene);
  EXPECT_EQ(std::get<BallShape>(scene.bodies[0].shape).radius.text(), Expression(0.2).text());
  EXPECT_EQ(scene.bodies[0].velocity.text(),
            Expression::vector(Expression(10.0), Expression(0.0), Expression(0.3048)).text());
  EXPECT_EQ(scene.obstacles[0].center->text(),
            Expression::vector(Expression(1.0), Expression(2.0), Expression(3.0)).text());
  EXPECT_EQ(std::get<PlaneShape>(scene.obstacles[0].shape).normal.text(), "[1, 0, 0]");
  EXPECT_EQ(scene.obstacles[0].on_hit, OnHit::bounce);
  EXPECT_EQ(scene.states[0].rate.text(), "-heat");
  EXPECT_EQ(scene.events[0].when.text(), "heat - 0.5");
  EXPECT_EQ(scene.time.end->text(), Expression(120.0).text());
  EXPECT_TRUE(scene.time.sample && scene.method.step && scene.method.max_seconds);
  EXPECT_TRUE(scene.method.steps.empty());
  const auto fault_of = [&](const std::string& assignment) -> std::string {
    try {
      apply({.parameters = {assignment}}, scene);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(fault_of("wall.on_hit = bonce"),
            "--set wall.on_hit: error: stop, bounce or pass expected, got 'bonce'; did you mean 'bounce'?");
  EXPECT_EQ(fault_of("time.ende = 1"),
            "--set time.ende: error: the scene has no key 'time.ende' that can be replaced; did you mean 'time.end'?");
  EXPECT_NE(fault_of("ball.radius = 2 kg"), "none");
}

TEST(SceneOverrides, ErrorsNameTheOption) {
  EXPECT_EQ(message_of_setting("thata=1"),
            "--set thata: error: the scene has no parameter 'thata'; did you mean 'theta'?");
  EXPECT_EQ(message_of_setting("theta"), "--set: error: NAME=VALUE expected, got 'theta'");
  EXPECT_TRUE(message_of_setting("theta=1 +").starts_with("--set theta:1:4: error:"));
  EXPECT_TRUE(message_of_setting("theta=").starts_with("--set theta"));
  SceneOverrides wrong_end;
  wrong_end.end = "5 m";
  EXPECT_EQ(override_message(wrong_end), "--end: error: time [s] expected, got length [m]");
}

}  // namespace
}  // namespace trajet
