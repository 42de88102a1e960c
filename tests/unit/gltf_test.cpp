// What a glTF file holds beside the motion: nodes, shapes, colours, and what happened.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "unit/glb_file.hpp"

namespace trajet {
namespace {

using Json = nlohmann::json;
using test::animate;
using test::Animation;
using test::Glb;
using test::kBouncingBall;

// The root turns a scene of z up to glTF's y up, and no other.
TEST(Gltf, ASceneOfYUpIsNotTurned) {
  for (const std::string up : {"", "up = \"z\"\n", "up = \"y\"\n"}) {
    const Scene scene =
        parse_scene(up + "[time]\nend = 1\n[[body]]\nname = \"p\"\nvelocity = [0, 1, 0]\n", "test.toml");
    MotionRecord motion;
    const RunResult result = run(scene, &motion);
    const Glb glb(gltf_binary(motion, result, 10.0));
    EXPECT_EQ(glb.node("world").contains("rotation"), up.find('y') == std::string::npos) << up;
    EXPECT_EQ(glb.keys("p").positions.back()[1], 1.0f);
  }
}

// -90 degrees about x carries z up into y up.
TEST(Gltf, OneNodeTurnsTheSceneToYUp) {
  const auto [result, glb] = animate(kBouncingBall, 60.0);
  const auto q = glb.node("world")["rotation"].get<std::vector<double>>();
  const Vector3 up = Quaternion(q[3], q[0], q[1], q[2]) * Vector3(0, 0, 1);
  EXPECT_NEAR((up - Vector3(0, 1, 0)).norm(), 0.0, 1e-15);
  for (const Json& node : glb.json["nodes"]) EXPECT_EQ(node.contains("rotation"), node["name"] == "world");
}

TEST(Gltf, TellsImpactsAndEvents) {
  const auto [quiet_result, quiet] = animate("[time]\nend = 1\n[[body]]\nname = \"b\"\n", 10.0);
  EXPECT_EQ(quiet.node("world")["extras"]["impacts"], Json::array());
  EXPECT_EQ(quiet.node("world")["extras"]["events"], Json::array());

  // the title reads like what stands for the records while the file is written
  const auto [result, glb] = animate(R"(title = '"records":""'
)" + std::string(kBouncingBall) + R"([[event]]
name = "apex"
when = "ball.vz"
direction = "falling"
)",
                                     10.0);
  const Json& extras = glb.node("world")["extras"];
  EXPECT_EQ(glb.json["scenes"][0]["name"], "\"records\":\"\"");
  EXPECT_EQ(extras["start_time"], 2.0);
  ASSERT_EQ(extras["impacts"].size(), result.impacts.size());
  const Json& impact = extras["impacts"][1];
  EXPECT_EQ(impact["time"], result.impacts[1].time);
  EXPECT_EQ(impact["with"], "ground");
  EXPECT_EQ(impact["velocity_after"][2], result.impacts[1].velocity_after.z());
  ASSERT_EQ(extras["events"].size(), result.events.size());
  ASSERT_GE(result.events.size(), 2u);
  EXPECT_EQ(extras["events"][1], Json({{"time", result.events[1].time}, {"event", "apex"}, {"direction", "falling"}}));
}

/// The corners of an obstacle's mesh in the world, and in its own frame.
struct Corners {
  std::vector<Vector3> world, own;
};
Corners corners(const Glb& glb, const std::string& name) {
  Corners result;
  const Json& node = glb.node(name);
  const auto t = node["translation"].get<std::vector<double>>();
  Quaternion q = Quaternion::Identity();
  if (node.contains("rotation")) q.coeffs() = Eigen::Vector4d(node["rotation"].get<std::vector<double>>().data());
  for (const auto& row : glb.floats(glb.primitives(name)[0]["attributes"]["POSITION"], 3)) {
    result.own.emplace_back(row[0], row[1], row[2]);
    result.world.push_back(q * result.own.back() + Vector3(t[0], t[1], t[2]));
  }
  return result;
}

bool holds(const std::vector<Vector3>& points, const Vector3& wanted) {
  return std::ranges::any_of(points, [&](const Vector3& each) { return (each - wanted).norm() < 1e-6; });
}

TEST(Gltf, ObstaclesStandWithTheirOriginsAtTheirCentres) {
  const auto [result, glb] = animate(R"(
[time]
end = 1
[[body]]
name = "b"
position = [0, 0, 5]
[[obstacle]]
name = "ground"
shape = "plane"
point = [3, 0, -1]
normal = [0, 0, 1]
[[obstacle]]
name = "ball"
shape = "sphere"
center = [1, 2, 3]
radius = 0.5
[[obstacle]]
name = "box"
shape = "box"
center = [4, 0, 0]
size = [2, 4, 6]
orientation = {axis = [1, 0, 0], angle = "90 deg"}
[[obstacle]]
name = "gate"
shape = "rectangle"
center = [-4, 1, 0]
normal = [1, 0, 0]
up = [0, 0, 1]
size = [2, 1]
[[obstacle]]
name = "disk"
shape = "disk"
center = [0, -4, 1]
normal = [0, 2, 0]
radius = 0.3
[[obstacle]]
name = "sail"
shape = "triangle"
points = [[5, 5, 0], [8, 5, 0], [5, 5, 3]]
)",
                                     10.0);
  const std::map<std::string, Vector3> centers{
      {"ball", {1, 2, 3}}, {"box", {4, 0, 0}}, {"gate", {-4, 1, 0}}, {"disk", {0, -4, 1}}, {"sail", {6, 5, 1}}};
  for (const auto& [name, center] : centers) {
    const auto t = glb.node(name)["translation"].get<std::vector<double>>();
    EXPECT_NEAR((Vector3(t[0], t[1], t[2]) - center).norm(), 0.0, 1e-12) << name;
  }
  EXPECT_EQ(glb.node("ground")["translation"][2], -1.0);
  for (const Vector3& corner : corners(glb, "ground").world) EXPECT_NEAR(corner.z(), -1.0, 1e-6);
  EXPECT_TRUE(holds(corners(glb, "box").own, {1, 2, 3}));
  EXPECT_TRUE(holds(corners(glb, "box").world, {5, -3, 2})) << "(1, 2, 3) turned about x, and moved";
  EXPECT_TRUE(holds(corners(glb, "gate").own, {1, 0.5, 0}));
  EXPECT_TRUE(holds(corners(glb, "gate").world, {-4, 2, 0.5}));
  EXPECT_TRUE(holds(corners(glb, "gate").world, {-4, 0, -0.5}));
  for (const Vector3& corner : corners(glb, "disk").world) EXPECT_NEAR(corner.y(), -4.0, 1e-6);
  for (const Vector3& corner : corners(glb, "disk").own) EXPECT_NEAR(corner.norm(), 0.3, 1e-6);
  for (const Vector3& corner : {Vector3(5, 5, 0), Vector3(8, 5, 0), Vector3(5, 5, 3)})
    EXPECT_TRUE(holds(corners(glb, "sail").world, corner)) << corner.transpose();
}

TEST(Gltf, HasTheColoursOfTheScene) {
  const auto [result, glb] = animate(R"(
[time]
end = 1
[[body]]
name = "ball"
shape = "sphere"
radius = 0.1
color = "#ff8000"
[[obstacle]]
name = "wall"
shape = "box"
center = [4, 0, 0]
size = [1, 1, 1]
color = "Navy"
)",
                                     10.0);
  const auto color = [&](const std::string& name) {
    const Json& material = glb.json["materials"][glb.primitives(name)[0]["material"].get<std::size_t>()];
    return material["pbrMetallicRoughness"]["baseColorFactor"].get<std::vector<double>>();
  };
  // 128 / 255 in sRGB is this much light: ((0.50196 + 0.055) / 1.055)^2.4
  const std::vector<double> orange = color("ball"), navy = color("wall");
  EXPECT_NEAR(orange[0], 1.0, 1e-12);
  EXPECT_NEAR(orange[1], 0.215861, 1e-6);
  EXPECT_NEAR(orange[2], 0.0, 1e-12);
  EXPECT_NEAR(navy[0], 0.0, 1e-12);
  EXPECT_NEAR(navy[2], 0.215861, 1e-6);
}

TEST(Gltf, NamedPointsAreNodesOfTheirBody) {
  const auto [result, glb] = animate(R"(
[time]
end = 1
[[body]]
name = "stick"
inertia = [1, 1, 1]
points = { left = [-0.3, 0, 0], right = [0.2, 0, 0.1] }
)",
                                     10.0);
  const Json& body = glb.node("stick");
  ASSERT_EQ(body["children"].size(), 2u);
  EXPECT_EQ(glb.json["nodes"][body["children"][0].get<std::size_t>()], glb.node("stick.left"));
  EXPECT_EQ(glb.node("stick.left")["translation"], Json({-0.3, 0.0, 0.0}));
  EXPECT_EQ(glb.node("stick.right")["translation"], Json({0.2, 0.0, 0.1}));
  // rods lead to the points, which stand out: the mesh of a point reaches farther across than a rod
  const Json& rods = glb.json["accessors"][glb.primitives("stick")[0]["attributes"]["POSITION"].get<std::size_t>()];
  const Json& point =
      glb.json["accessors"][glb.primitives("stick.left")[0]["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_NEAR(rods["min"][0], -0.3, 1e-7);
  EXPECT_NEAR(rods["max"][0], 0.2, 0.01);
  EXPECT_GT(point["max"][1], rods["max"][1]);
  EXPECT_LT(point["max"][1], 0.05);
}

// The path is 100 m long: 1 % of it would hide what is hit.
TEST(Gltf, APointIsSmallBesideWhatItMeets) {
  const auto [result, glb] = animate(R"(
[time]
end = 1
[[body]]
name = "bullet"
velocity = [100, 0, 0]
[[obstacle]]
name = "target"
shape = "disk"
center = [90, 0, 0]
normal = [-1, 0, 0]
radius = 0.2
)",
                                     10.0);
  const Json& ball = glb.json["accessors"][glb.primitives("bullet")[0]["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_NEAR(ball["max"][2], 0.1, 1e-7);
}

TEST(Gltf, ASoccerBallHasTwelveDarkPentagons) {
  const auto [result, glb] = animate(R"(
[time]
end = 1
[[body]]
name = "ball"
shape = "soccer-ball"
radius = 0.11
)",
                                     10.0);
  std::map<double, std::size_t> triangles_by_lightness;
  for (const Json& primitive : glb.primitives("ball")) {
    const Json& material = glb.json["materials"][primitive["material"].get<std::size_t>()];
    triangles_by_lightness[material["pbrMetallicRoughness"]["baseColorFactor"][0]] +=
        glb.json["accessors"][primitive["indices"].get<std::size_t>()]["count"].get<std::size_t>() / 3;
  }
  ASSERT_EQ(triangles_by_lightness.size(), 2u);
  EXPECT_EQ(triangles_by_lightness.begin()->second, 12u * 3u);
  EXPECT_EQ(triangles_by_lightness.rbegin()->second, 20u * 4u);
}

TEST(Gltf, TellsWhatAnEventHasSet) {
  const auto [result, glb] = animate(R"(
[time]
end = 2
[[body]]
name = "traveller"
velocity = [1, 0, 0]
[[event]]
name = "jump"
when = "t - 0.7"
action = { set = { traveller.r = "[10, 0, 0]" } }
)",
                                     10.0);
  const Glb::Keys keys = glb.keys("traveller");
  const auto index = static_cast<std::size_t>(std::ranges::find(keys.times, 0.7f) - keys.times.begin());
  ASSERT_LT(index + 1, keys.times.size());
  EXPECT_NEAR(keys.positions[index][0], 0.7, 1e-6);
  EXPECT_NEAR(keys.positions[index + 1][0], 10.0, 1e-6);
}

}  // namespace
}  // namespace trajet
