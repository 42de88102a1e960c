#pragma once

#include <string>
#include <vector>

#include "scene_run.hpp"
#include "trajet/ensemble/aim.hpp"
#include "trajet/io/variation_text.hpp"

namespace trajet::test {

/// Aiming at something in a scene that is written out in a test; ranges as of a command line.
inline AimTask aim_task(const std::string& text, const std::vector<std::string>& ranges, AimTarget target) {
  AimTask task;
  task.scene = parse_scene(text, "test.toml");
  for (const std::string& range : ranges) {
    GridAxis axis = read_range(range, "--vary", task.scene);
    task.unknowns.push_back({axis.quantity, axis.low, axis.high});
  }
  task.target = std::move(target);
  return task;
}

constexpr double kDegree = 0.017453292519943295;

/// A point shot from the origin at `v0` (m/s) under gravity of 9.81 m/s^2, without drag or with one of that many 1/m.
inline std::string cannon(double v0, double drag = 0.0) {
  return "[parameters]\nv0 = " + number(v0) + "\ntheta = 0.5\nphi = 0.0\ndrag = " + number(drag) + R"(
[time]
end = 40
[[body]]
name = "shell"
velocity = "v0*[cos(theta)*cos(phi), cos(theta)*sin(phi), sin(theta)]"
acceleration = "[0, 0, -9.81])" +
         std::string(drag == 0.0 ? "" : " - drag*norm(v)*v") + "\"\n";
}

}  // namespace trajet::test
