#include "scene_source.hpp"

#include <filesystem>
#include <iostream>
#include <iterator>
#include <string_view>
#include <vector>

#include "example_scenes.hpp"
#include "trajet/error.hpp"
#include "trajet/io/scene_file.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet {

Scene read_named_scene(const std::string& name) {
  if (name == "-") {
    std::string text{std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>()};
    if (std::cin.bad()) throw FileError("cannot read standard input");
    return parse_scene(std::move(text), "standard input");
  }
  std::error_code unknown;
  if (std::filesystem::exists(name, unknown)) return read_scene(name);
  std::vector<std::string_view> names;
  for (const ExampleScene& example : example_scenes()) {
    if (example.name == name) return parse_scene(std::string(example.text), name);
    names.push_back(example.name);
  }
  throw FileError("cannot open '" + name + "': there is no such file, nor a built-in scene of that name" +
                  did_you_mean(name, names));
}

}  // namespace trajet
