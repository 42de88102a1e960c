#pragma once

#include <span>
#include <string_view>

namespace trajet {

/// A scene of the folder examples/, embedded in the program when it is built.
struct ExampleScene {
  std::string_view name;  ///< file name without `.toml`
  std::string_view text;  ///< the whole file
};

/// All of them: the course's (examples/notes/) first, then the others, each group by name.
std::span<const ExampleScene> example_scenes();

}  // namespace trajet
