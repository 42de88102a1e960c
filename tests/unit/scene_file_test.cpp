#include "trajet/io/scene_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <variant>

namespace trajet {
namespace {

const std::string kTime = "[time]\nend = 1\n";
const std::string kBall = "[[body]]\nname = \"ball\"\n";

double number(const Expression& expression) { return std::stod(expression.text()); }

TEST(SceneFile, TheAxisThatPointsUpIsYOrZ) {
  EXPECT_EQ(parse_scene(kTime + kBall, "s.toml").up, UpAxis::z);
  try {
    parse_scene("up = \"w\"\n" + kTime + kBall, "s.toml");
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("s.toml:1:6: error: unknown up 'w', expected one of: y, z"), 0u)
        << error.what();
  }
}

TEST(SceneFile, FillsEveryPartOfAScene) {
  const Scene scene = parse_scene(R"(
title = "everything"
up = "y"
[parameters]
v0 = "36 km/h"
a-b = 2
[time]
start = "-1 min"
end = 5
sample = "10 ms"
[method]
name = "rk4"
steps = ["10 ms", 0.02, "v0/100"]
max_steps = 50
orientation = "quaternion"
locate = "subdivision"
[[body]]
name = "big-ball"
shape = "sphere"
radius = "20 cm"
position = [1, "2 m", "a-b"]
velocity = "v0*[1, 0, 0]"
force = [0, 0, "-9.8*mass"]
mass = "mass"
position_rate = "v + [1, 0, 0]"
[[obstacle]]
name = "crate"
shape = "box"
center = [5, 0, 0]
size = [1, 1, 1]
orientation = {axis = [0, 0, 1], angle = "180 deg"}
on_hit = "bounce"
restitution = 0.5
[[obstacle]]
name = "window"
shape = "rectangle"
center = [9, 0, 0]
normal = [1, 0, 0]
up = [0, 0, 1]
size = [2, "3 m"]
on_hit = "pass"
[[state]]
name = "mass"
value = 10
rate = "-big-ball.vx"
[[event]]
name = "refuel"
when = "mass - 1"
direction = "falling"
set = { mass = "mass + 5", big-ball.v = "-big-ball.v" }
[exact]
big-ball.r = "[t, t, t]"
mass = "10 - t"
)",
                                  "all.toml");
  EXPECT_EQ(scene.title, "everything");
  EXPECT_EQ(scene.up, UpAxis::y);
  EXPECT_EQ(scene.file, "all.toml");
  ASSERT_EQ(scene.parameters.size(), 2u);
  EXPECT_EQ(scene.parameters[0].name, "v0");  // in the order of the file
  EXPECT_EQ(number(scene.parameters[0].value), 10.0);
  EXPECT_EQ(number(scene.time.start), -60.0);
  EXPECT_EQ(number(*scene.time.sample), 0.01);
  EXPECT_EQ(scene.method.name, "rk4");
  ASSERT_EQ(scene.method.steps.size(), 3u);
  EXPECT_EQ(scene.method.steps[2].text(), "v0/100");
  EXPECT_EQ(scene.method.max_steps, 50);
  EXPECT_EQ(scene.method.locate, Locator::subdivision);
  const BodyDefinition& body = scene.bodies.at(0);
  EXPECT_EQ(body.name, "big-ball");
  EXPECT_EQ(number(std::get<BallShape>(body.shape).radius), 0.2);
  EXPECT_EQ(body.position.names(), std::vector<std::string>{"a-b"});
  EXPECT_TRUE(body.force && body.mass && body.position_rate && !body.acceleration);
  const ObstacleDefinition& crate = scene.obstacles.at(0);
  EXPECT_EQ(crate.on_hit, OnHit::bounce);
  EXPECT_EQ(number(*crate.orientation->angle_rad), 3.141592653589793);
  EXPECT_EQ(number(std::get<RectangleShape>(scene.obstacles.at(1).shape).height), 3.0);
  EXPECT_EQ(scene.states.at(0).rate.names(), std::vector<std::string>{"big-ball.vx"});
  const EventDefinition& event = scene.events.at(0);
  EXPECT_EQ(event.action, EventAction::set);
  EXPECT_EQ(event.direction, CrossingDirection::falling);
  ASSERT_EQ(event.set.size(), 2u);
  EXPECT_EQ(event.set[1].name, "big-ball.v");
  ASSERT_EQ(scene.exact.size(), 2u);
  EXPECT_EQ(scene.exact[0].name, "big-ball.r");
}

TEST(SceneFile, DefaultsAreThoseOfTheFormat) {
  const Scene scene = parse_scene(kTime + kBall, "s");
  EXPECT_EQ(scene.method.name, "taylor");
  EXPECT_EQ(scene.method.locate, Locator::polynomial);
  EXPECT_FALSE(scene.method.rtol || scene.method.step || scene.time.sample);
  EXPECT_TRUE(std::holds_alternative<PointShape>(scene.bodies[0].shape));
  EXPECT_FALSE(scene.bodies[0].acceleration || scene.bodies[0].force);
}

TEST(SceneFile, TheOtherSpellingsAreRead) {
  const std::string obstacle =
      "[[obstacle]]\nname = \"o\"\nshape = \"triangle\"\npoints = [[0,0,0],[1,0,0],\"[0,1,0]\"]\n";
  const ObstacleDefinition triangle = parse_scene(kTime + kBall + obstacle, "s").obstacles.at(0);
  EXPECT_EQ(triangle.on_hit, OnHit::stop);
  const auto& corners = std::get<TriangleShape>(triangle.shape);
  EXPECT_NE(corners.a.text(), corners.b.text());
  EXPECT_EQ(corners.c.text(), "[0,1,0]");
  // An angle is a number: 50 % of a radian.
  const std::string box =
      "[[obstacle]]\nname = \"o\"\nshape = \"box\"\ncenter = [0,0,0]\nsize = [1,1,1]\n"
      "orientation = {axis = [0,0,1], angle = \"50 %\"}\n";
  const ObstacleDefinition turned = parse_scene(kTime + kBall + box, "s").obstacles.at(0);
  EXPECT_EQ(number(*turned.orientation->angle_rad), 0.5);
  EXPECT_EQ(parse_scene(kTime + kBall + "[exact]\n\"ball.r\" = \"[t, 0, 0]\"\n", "s").exact.at(0).name, "ball.r");
  const std::string event = "[[event]]\nname = \"e\"\nwhen = \"ball.x\"\n";
  EXPECT_EQ(parse_scene(kTime + kBall + event + "action = {set = {ball.vx = 0}}", "s").events.at(0).set.at(0).name,
            "ball.vx");
  EXPECT_EQ(parse_scene(kTime + kBall + event + "action = \"stop\"", "s").events.at(0).action, EventAction::stop);
  // Names of a body's parts are free where there is no body: the Lorenz system.
  EXPECT_EQ(parse_scene(kTime + "[[state]]\nname = \"x\"\nvalue = 1\nrate = \"10*(x)\"\n", "s").states.at(0).name, "x");
  EXPECT_EQ(parse_scene("\xef\xbb\xbf" + kTime + kBall, "s").bodies.size(), 1u);
}

TEST(SceneFile, ReadsEveryExample) {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(TRAJET_SOURCE_DIR "/examples")) {
    if (entry.path().extension() != ".toml") continue;
    EXPECT_FALSE(read_scene(entry.path().string()).title.empty()) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 8);
}

TEST(SceneFile, WhatCannotBeReadIsAFileError) {
  EXPECT_THROW(read_scene("/nonexistent/scene.toml"), FileError);
  EXPECT_THROW(read_scene("/"), FileError);
}

TEST(SceneFile, AChargeAndARadiusMayBeCalledSo) {
  // q and R alone mean nothing in laws: only their parts qw, Rxx, ... do
  const Scene scene = parse_scene(
      "[time]\nend = 1\n[parameters]\nR = 2\n[[state]]\nname = \"q\"\nvalue = 1\nrate = 0\n"
      "[[body]]\nname = \"b\"\nacceleration = \"q*cross(v, [0, 0, R]) + [Rxx, qw, 0]\"\n",
      "s.toml");
  EXPECT_EQ(scene.parameters[0].name, "R");
  EXPECT_EQ(scene.states[0].name, "q");
}

}  // namespace
}  // namespace trajet
