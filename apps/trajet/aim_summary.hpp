#pragma once

#include <string>
#include <vector>

#include "trajet/ensemble/aim.hpp"

namespace trajet {

/// How an unknown is shown beside its SI value.
struct ShownUnknown {
  std::string name{};
  bool is_in_degrees = false;  ///< the scene, or its range, has it in degrees
};

/// "theta = 0.785398 (45 deg)", one after the other.
std::string describe_values(const std::vector<ShownUnknown>& unknowns, const std::vector<double>& values);

/// What has come of aiming, for people.
std::string aim_text(const std::string& title, const std::vector<ShownUnknown>& unknowns, const AimResult& result,
                     bool color, int width);

/// In one sentence why there is no solution.
std::string aim_failure(const std::vector<ShownUnknown>& unknowns, const AimResult& result);

}  // namespace trajet
