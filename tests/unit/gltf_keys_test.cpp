// The keys of a glTF animation are the motion of the run.

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

// z(t) = 1.1 - 5 t^2 until the impact at sqrt(0.2), all from the start.
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
  const std::string many = refusal("[time]\nend = 1\n", "2e6");
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

}  // namespace
}  // namespace trajet
