#pragma once

#include <string>
#include <vector>

#include "scene_run.hpp"

namespace trajet::test {

/// The plane z = 0, off which everything bounces; a scene may go on with its `restitution`.
inline const std::string kBouncingGround = R"(
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "bounce"
)";

/// A method of long steps, one of controlled steps, one of short ones.
inline std::vector<Way> long_controlled_and_short_steps() {
  return {{"taylor", "name = \"taylor\"\n"}, {"dopri5", "name = \"dopri5\"\n"}, fixed("rk4", 0.05)};
}

}  // namespace trajet::test
