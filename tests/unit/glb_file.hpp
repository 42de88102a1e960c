#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "scene_run.hpp"
#include "trajet/io/gltf.hpp"

namespace trajet::test {

/// A glb file read by its specification: a header of 12 bytes, then chunks of length, type, content.
class Glb {
 public:
  explicit Glb(const std::string& bytes) {
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(number(bytes, 8), bytes.size());
    const std::size_t json_size = number(bytes, 12);
    json = nlohmann::json::parse(bytes.substr(20, json_size));
    buffer_ = bytes.substr(20 + json_size + 8);
  }

  const nlohmann::json& node(const std::string& name) const {
    for (const nlohmann::json& each : json["nodes"])
      if (each["name"] == name) return each;
    throw std::out_of_range("no node '" + name + "'");
  }

  const nlohmann::json& primitives(const std::string& name) const {
    return json["meshes"][node(name)["mesh"].get<std::size_t>()]["primitives"];
  }

  /// The floats of an accessor, one row per item.
  std::vector<std::vector<float>> floats(const nlohmann::json& index, std::size_t columns) const {
    const nlohmann::json& accessor = json["accessors"][index.get<std::size_t>()];
    const nlohmann::json& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
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
    const nlohmann::json& animation = json["animations"][0];
    for (const nlohmann::json& channel : animation["channels"]) {
      const auto target = channel["target"]["node"].get<std::size_t>();
      if (json["nodes"][target]["name"] != body || channel["target"]["path"] != path) continue;
      const nlohmann::json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
      EXPECT_EQ(sampler.value("interpolation", "LINEAR"), "LINEAR");
      Keys keys{{}, floats(sampler["output"], path == "rotation" ? 4 : 3)};
      for (const auto& row : floats(sampler["input"], 1)) keys.times.push_back(row[0]);
      return keys;
    }
    throw std::out_of_range("no " + path + " of '" + body + "'");
  }

  nlohmann::json json;

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

inline Animation animate(const std::string& scene, double fps) {
  MotionRecord motion;
  RunResult result = run_text(scene, &motion);
  Glb glb(gltf_binary(motion, result, fps));
  return {std::move(result), std::move(glb)};
}

inline constexpr const char* kBouncingBall = R"(
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

}  // namespace trajet::test
