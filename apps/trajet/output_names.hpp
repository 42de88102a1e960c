#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trajet {

/// An option that names a file to write.
struct NamedOutput {
  std::string_view option;
  std::string path;  ///< `-` for standard output, empty for none
};

/// Throws InputError where an output would overwrite the scene or another output, under whatever name. Devices are
/// written side by side. Touches nothing.
void check_outputs(const std::string& scene, const std::vector<NamedOutput>& outputs);

}  // namespace trajet
