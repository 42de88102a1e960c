#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trajet {

/// An option that names a file to write.
struct NamedOutput {
  std::string_view option;
  std::string path;                       ///< `-` for standard output, empty for none
  std::vector<std::string_view> endings;  ///< ".json", one of which the name shall have; empty: whoever draws it looks
};

/// Throws InputError where an output would overwrite the scene or another output, under whatever name, or where its
/// name does not end as those of its kind do: so no forgotten file name costs a file of another kind. Devices and pipes
/// have any name, and are written side by side. Touches nothing.
void check_outputs(const std::string& scene, const std::vector<NamedOutput>& outputs);

}  // namespace trajet
