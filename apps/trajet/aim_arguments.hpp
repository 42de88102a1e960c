#pragma once

#include <string>
#include <vector>

#include "trajet/io/scene_overrides.hpp"

namespace trajet {

/// What `trajet aim` takes from the command line.
struct AimArguments {
  std::string scene{};
  SceneOverrides overrides{};
  std::vector<std::string> vary{};  ///< NAME=LOW:HIGH each
  std::string hit{};                ///< name of an obstacle; or:
  std::string at{};                 ///< X,Y,Z
  std::string body{};               ///< empty: the only one
  std::vector<std::string> with{};  ///< conditions
  std::string minimise{};           ///< empty: all solutions
  std::string json{};               ///< file name, `-` for standard output, empty for none
  bool quiet = false;
};

}  // namespace trajet
