// The glTF animation of a run: what other programs read must be the motion.

#include "trajet/io/gltf.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "scene_run.hpp"

namespace trajet {
namespace {

using Json = nlohmann::json;

/// A glb file read by its specification: a header of 12 bytes, then chunks of length, type, content.
class Glb {
 public:
  explicit Glb(const std::string& bytes) {
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(number(bytes, 8), bytes.size());
    const std::size_t json_size = number(bytes, 12);
    json = Json::parse(bytes.substr(20, json_size));
    buffer_ = bytes.substr(20 + json_size + 8);
  }

  const Json& node(const std::string& name) const {
    for (const Json& each : json["nodes"])
      if (each["name"] == name) return each;
    throw std::out_of_range("no node '" + name + "'");
  }

  const Json& primitives(const std::string& name) const {
    return json["meshes"][node(name)["mesh"].get<std::size_t>()]["primitives"];
  }

  /// The floats of an accessor, one row per item.
  std::vector<std::vector<float>> floats(const Json& index, std::size_t columns) const {
    const Json& accessor = json["accessors"][index.get<std::size_t>()];
    const Json& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    std::vector<std::vector<float>> rows(accessor["count"].get<std::size_t>(), std::vector<float>(columns));
    const char* from = buffer_.data() + view.value("byteOffset", 0);
    for (auto& row : rows) {
      std::memcpy(row.data(), from, row.size() * sizeof(float));
      from += row.size() * sizeof(float);
    }
    return rows;
  }

  /// Key times and translations of a body, or rotations.
  struct Keys {
    std::vector<float> times;
    std::vector<std::vector<float>> positions;
  };
  Keys keys(const std::string& body, const std::string& path = "translation") const {
    const Json& animation = json["animations"][0];
    for (const Json& channel : animation["channels"]) {
      const auto target = channel["target"]["node"].get<std::size_t>();
      if (json["nodes"][target]["name"] != body || channel["target"]["path"] != path) continue;
      const Json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
      EXPECT_EQ(sampler.value("interpolation", "LINEAR"), "LINEAR");
      Keys keys{{}, floats(sampler["output"], path == "rotation" ? 4 : 3)};
      for (const auto& row : floats(sampler["input"], 1)) keys.times.push_back(row[0]);
      return keys;
    }
    throw std::out_of_range("no " + path + " of '" + body + "'");
  }

  Json json;

 private:
  static std::uint32_t number(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  }

  std::string buffer_;
};

struct Animation {
  RunResult result;
  Glb glb;
};

Animation animate(const std::string& scene, double fps) {
  MotionRecord motion;
  RunResult result = test::run_text(scene, &motion);
  Glb glb(gltf_binary(motion, result, fps));
  return {std::move(result), std::move(glb)};
}

const char* const kBouncingBall = R"(
[time]
start = 2
end = 5
[[body]]
name = "ball"
shape = "sphere"
radius = 0.1
position = [0, 0, 1.1]
velocity = [3, 0, 0]
acceleration = [0, 0, -10]
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "bounce"
restitution = 0.5
)";

// z(t) = 1.1 - 5 t^2 until the impact at sqrt(0.2), all from the start.
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

TEST(Gltf, KeysAreTheMotion) {
  const auto [result, glb] = animate(kBouncingBall, 60.0);
  const Glb::Keys keys = glb.keys("ball");
  EXPECT_EQ(keys.times.front(), 0.0f);
  EXPECT_EQ(keys.times.back(), 3.0f);
  std::size_t checked = 0;
  for (std::size_t i = 0; i < keys.times.size(); ++i) {
    const double t = keys.times[i];
    // single precision: 6e-8 of 9 m in position, and of the time at a speed below 5.4 m/s
    if (i > 0) {
      EXPECT_LT(keys.times[i - 1], keys.times[i]);
    }
    EXPECT_NEAR(keys.positions[i][0], 3.0 * t, 2e-6);
    if (t > std::sqrt(0.2)) continue;
    EXPECT_NEAR(keys.positions[i][2], 1.1 - 5.0 * t * t, 1e-6);
    ++checked;
  }
  EXPECT_EQ(checked, 28u);  // frames 0 to 26, and the first of the pair at the impact
}

TEST(Gltf, TwoKeysAtEachImpactGiveItsPosition) {
  const auto [result, glb] = animate(kBouncingBall, 25.0);
  const Glb::Keys keys = glb.keys("ball");
  int impacts = 0;
  for (const Impact& impact : result.impacts) {
    const float time = static_cast<float>(impact.time - result.start_time);
    const auto key = std::ranges::find(keys.times, time);
    ASSERT_NE(key, keys.times.end()) << impact.time;
    const auto index = static_cast<std::size_t>(key - keys.times.begin());
    ASSERT_LT(index + 1, keys.times.size());
    if (impact.kind == ImpactKind::rest) continue;  // its position is that of the last bounce, a little before
    // impacts of the ball's last jumps come closer than single precision can tell
    EXPECT_EQ(keys.times[index + 1], std::nextafter(time, 10.0f));
    for (const std::size_t each : {index, index + 1})
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(keys.positions[each][axis], impact.position[static_cast<int>(axis)], 1e-6);
    ++impacts;
  }
  EXPECT_GT(impacts, 10);
  EXPECT_EQ(glb.node("world")["extras"]["impacts"].size(), result.impacts.size());
  EXPECT_EQ(glb.node("world")["extras"]["impacts"][0]["time"], result.impacts[0].time);
}

// -90 degrees about x carries z up into y up.
TEST(Gltf, OneNodeTurnsTheSceneToYUp) {
  const auto [result, glb] = animate(kBouncingBall, 60.0);
  const auto q = glb.node("world")["rotation"].get<std::vector<double>>();
  const Vector3 up = Quaternion(q[3], q[0], q[1], q[2]) * Vector3(0, 0, 1);
  EXPECT_NEAR((up - Vector3(0, 1, 0)).norm(), 0.0, 1e-15);
  for (const Json& node : glb.json["nodes"]) EXPECT_EQ(node.contains("rotation"), node["name"] == "world");
}

// q(t) = (cos t, 0, 0, sin t) for w = 2 rad/s about z, over more than a turn: quaternions of either sign are the same
// rotation, but a change of sign between keys would make the linear interpolation run the wrong way round.
TEST(Gltf, RotationKeysAreTheRotationAndDoNotChangeSign) {
  const auto [result, glb] = animate(R"(
[time]
end = 5
[[body]]
name = "top"
shape = "sphere"
radius = 0.1
angular_velocity = [0, 0, 2]
)",
                                     30.0);
  const Glb::Keys keys = glb.keys("top", "rotation");
  ASSERT_EQ(keys.times.size(), 151u);
  for (std::size_t i = 0; i < keys.times.size(); ++i) {
    const double t = keys.times[i];
    const double sign = keys.positions[0][3] > 0.0f ? 1.0 : -1.0;
    // single precision of the quaternion, and of the time: 5 * 6e-8
    EXPECT_NEAR(keys.positions[i][2], sign * std::sin(t), 5e-7) << t;
    EXPECT_NEAR(keys.positions[i][3], sign * std::cos(t), 5e-7) << t;
  }
}

/// Of a body, by which it turns from each key to the next, degrees.
std::vector<double> turns(const Glb::Keys& keys) {
  std::vector<double> result;
  const auto q = [&](std::size_t i) {
    const auto& row = keys.positions[i];
    return Quaternion(row[3], row[0], row[1], row[2]);
  };
  for (std::size_t i = 1; i < keys.positions.size(); ++i)
    result.push_back(q(i - 1).angularDistance(q(i)) * 180.0 / 3.14159265358979);
  return result;
}

// 0.8 turns of 1 s in each direction: keys 1 s apart, or 1/3 s, would turn it backward or not at all.
TEST(Gltf, KeysAreAtMostAQuarterOfATurnApart) {
  for (const double fps : {0.01, 1.0, 3.0, 1000.0}) {
    const auto [result, glb] = animate(R"(
[time]
start = 1
end = 6
[[body]]
name = "top"
shape = "sphere"
radius = 0.1
angular_velocity = [0, 0, "1.6*pi"]
angular_acceleration = [0, 0, "4*pi"]
)",
                                       fps);
    const Glb::Keys keys = glb.keys("top", "rotation");
    double before = 0.0;
    for (std::size_t i = 0; i < keys.times.size(); ++i) {
      const double t = keys.times[i], angle = 3.14159265358979 * (1.6 * t + 2.0 * t * t);
      const Quaternion q(keys.positions[i][3], keys.positions[i][0], keys.positions[i][1], keys.positions[i][2]);
      const Quaternion expected(std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle));
      // single precision of the time, at 22 pi rad/s
      EXPECT_LT(q.angularDistance(expected), 1e-4) << fps << " " << t;
      EXPECT_LE((angle - before) * 180.0 / 3.14159265358979, 90.0 + 1e-3) << fps << " " << t;
      before = angle;
    }
    // 58 pi of angle: 116 quarters; none is needed at 1000 keys a second
    EXPECT_LT(keys.times.size(), fps == 1000.0 ? 5002u : 2u * 116u + 16u) << fps;
  }
}

TEST(Gltf, KeysAreClosestWhereTheBodyTurnsFastest) {
  const auto [result, glb] = animate(R"(
[time]
end = 10
[[body]]
name = "top"
shape = "sphere"
radius = 0.1
angular_velocity = [0, 0, 1]
[[event]]
name = "hit"
when = "t - 9"
action = { set = { top.w = "[0, 0, 100]" } }
)",
                                     10.0);
  const Glb::Keys keys = glb.keys("top", "rotation");
  std::size_t before = 0;
  for (const float time : keys.times) before += time < 9.0f ? 1 : 0;
  EXPECT_EQ(before, 90u);
  EXPECT_GT(keys.times.size(), 90u + 64u) << "100 rad";
  for (const double turn : turns(keys)) EXPECT_LE(turn, 90.0);
}

TEST(Gltf, SaysThatABodyTurnsTooFast) {
  const auto refusal = [](const std::string& time, const std::string& spin) -> std::string {
    try {
      animate(time + "[method]\nname = \"euler\"\nstep = 0.1\norientation = \"exact\"\n[[body]]\nname = \"top\"\n" +
                  "shape = \"sphere\"\nradius = 0.1\nangular_velocity = [0, 0, " + spin + "]\n",
              1.0);
    } catch (const FileError& error) {
      return error.what();
    }
    return "none";
  };
  const std::string many = refusal("[time]\nend = 1\n", "1e7");
  EXPECT_NE(many.find("body 'top' turns too fast"), std::string::npos) << many;
  EXPECT_NE(many.find("more than a million"), std::string::npos) << many;
  EXPECT_EQ(refusal("[time]\nend = 1\n", "1e5"), "none");
}

// 2000 s after the start single precision tells 0.12 ms apart, and a quarter of a turn takes 0.016 ms
TEST(Gltf, SaysThatSinglePrecisionCannotTellKeysApart) {
  try {
    animate(R"(
[time]
end = 2000
[[body]]
name = "top"
shape = "sphere"
radius = 0.1
angular_velocity = [0, 0, 0]
[[event]]
name = "hit"
when = "t - 1999.999"
action = { set = { top.w = "[0, 0, 1e5]" } }
)",
            1.0);
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("closer than single precision can tell"), std::string::npos);
  }
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
