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
  EXPECT_EQ(
      fault_of("wall.on_hit = bonce"),
      "--set wall.on_hit: error: unknown on_hit 'bonce', expected one of: stop, bounce, pass, stick; did you mean "
      "'bounce'?");
  EXPECT_EQ(fault_of("time.ende = 1"),
            "--set time.ende: error: the scene has no key 'time.ende' that can be replaced; did you mean 'time.end'?");
  EXPECT_NE(fault_of("ball.radius = 2 kg"), "none");
}

constexpr const char* kWorkshop = R"(
[time]
end = 1
[[body]]
name = "ball"
shape = "sphere"
radius = 1
mass = 1
orientation = {axis = [0, 0, 1], angle = "10 deg"}
points = {tip = [0, 0, 1]}
[[body]]
name = "hammer"
shape = "compound"
parts = [{shape = "box", size = [1, 1, 1], mass = 1}, {shape = "sphere", radius = 1, position = [0, 0, 2], mass = 3}]
[[obstacle]]
name = "wall"
shape = "rectangle"
center = [9, 0, 0]
normal = [1, 0, 0]
up = [0, 0, 1]
size = [1, 2]
on_hit = "bounce"
[[obstacle]]
name = "ramp"
shape = "triangle"
points = [[9, 0, 0], [9, 1, 0], [9, 0, 1]]
[[pair]]
of = ["ball", "wall"]
restitution = 0.5
[[state]]
name = "heat"
value = 1
rate = 0
[[event]]
name = "noon"
when = "t - 0.5"
set = {heat = 2}
[exact]
heat = "1"
)";

// Not only formulas: words, tables, arrays, and what lies within them.
TEST(SceneOverrides, ReachWordsTablesAndParts) {
  Scene scene = parse_scene(kWorkshop, "s");
  apply({.parameters = {"ball.color=red",
                        "wall.color = \"#00ff80\"",
                        "ball.orientation.angle=30 deg",
                        "hammer.orientation={axis = [0, 0, 1], angle = '90 deg'}",
                        "hammer.parts[1].mass=2 kg",
                        "hammer.parts[0].size=[2, 2, 2]",
                        "hammer.parts[1].orientation={yaw = 1}",
                        "ball.inertia=[1, 2, 3]",
                        "ball.points.tip=[0, 2 m, 0]",
                        "ball.collides_with=none",
                        "hammer.collides_with=['wall']",
                        "wall.size=[3, 4]",
                        "wall.impact=newton",
                        "wall.on_hit=pass",
                        "ramp.points=[[8, 0, 0], [8, 1, 0], [8, 0, 1]]",
                        "pair[0].friction=0.3",
                        "pair[0].on_hit=stop",
                        "noon.direction=rising",
                        "noon.set.heat=heat + 1",
                        "method.name=rk4",
                        "method.max_steps=50",
                        "method.locate=subdivision",
                        "method.steps=[0.5, 0.5]",
                        "exact.heat=2"}},
        scene);
  const BodyDefinition &ball = scene.bodies[0], &hammer = scene.bodies[1];
  EXPECT_EQ(ball.color, find_color("red"));
  EXPECT_EQ(scene.obstacles[0].color, find_color("#00ff80"));
  EXPECT_TRUE(hammer.orientation.axis && hammer.orientation.angle_rad);
  const auto& parts = std::get<CompoundShape>(hammer.shape).parts;
  EXPECT_EQ(parts[1].mass->text(), Expression(2.0).text());
  EXPECT_EQ(std::get<CuboidShape>(parts[0].shape).size.text(), "[2, 2, 2]");
  EXPECT_EQ(parts[1].orientation.roll_pitch_yaw.size(), 3u);
  EXPECT_TRUE(ball.principal_inertia);
  EXPECT_EQ(ball.points[0].value.text(), Expression::vector(Expression(0.0), Expression(2.0), Expression(0.0)).text());
  EXPECT_EQ(ball.collides_with.kind, CollidesWith::Kind::none);
  EXPECT_EQ(hammer.collides_with.names, std::vector<std::string>{"wall"});
  EXPECT_EQ(std::get<RectangleShape>(scene.obstacles[0].shape).height.text(), Expression(4.0).text());
  EXPECT_EQ(scene.obstacles[0].friction->impact, ImpactLaw::newton);
  EXPECT_EQ(scene.obstacles[0].on_hit, OnHit::pass);
  EXPECT_TRUE(scene.pairs[0].friction->friction);
  EXPECT_EQ(scene.pairs[0].on_hit, OnHit::stop);
  EXPECT_EQ(scene.events[0].direction, CrossingDirection::rising);
  EXPECT_EQ(scene.events[0].set[0].value.text(), "heat + 1");
  EXPECT_EQ(scene.method.name, "rk4");
  EXPECT_EQ(scene.method.max_steps, 50);
  EXPECT_EQ(scene.method.locate, Locator::subdivision);
  EXPECT_EQ(scene.method.steps.size(), 2u);
  EXPECT_EQ(scene.exact[0].value.text(), "2");
  const RunResult result = run(scene);
  EXPECT_EQ(result.status, RunStatus::finished) << result.failure;
  EXPECT_NEAR(result.final.bodies[0].rotation_matrix(1, 0), 0.5, 1e-15);  // sin 30 degrees
}

TEST(SceneOverrides, WhatIsWrongInAWordOrATableNamesTheOption) {
  const auto fault_of = [](const std::string& assignment) -> std::string {
    Scene scene = parse_scene(kWorkshop, "s");
    try {
      apply({.parameters = {assignment}}, scene);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_TRUE(fault_of("ball.color=rad").starts_with("--set ball.color: error: ")) << fault_of("ball.color=rad");
  EXPECT_NE(fault_of("ball.color=rad").find("red"), std::string::npos);
  EXPECT_TRUE(fault_of("ball.orientation={axis = [0, 0, 1]}").starts_with("--set ball.orientation: error: "));
  EXPECT_TRUE(fault_of("ball.orientation={axis = ").starts_with("--set ball.orientation"));
  EXPECT_EQ(
      fault_of("hammer.parts[2].mass=1"),
      "--set hammer.parts[2].mass: error: the scene has no key 'hammer.parts[2].mass' that can be replaced; did you "
      "mean 'hammer.parts[0].mass'?");
  EXPECT_NE(fault_of("hammer.parts[0].mass=1 s").find("mass"), std::string::npos);
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
