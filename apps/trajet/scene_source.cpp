#include "scene_source.hpp"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string_view>
#include <vector>

#include "example_scenes.hpp"
#include "trajet/error.hpp"
#include "trajet/io/scene_file.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet {
namespace {

constexpr std::string_view kStandardInput = "standard input";

/// What was read of it, which gives its text once.
std::string& standard_input() {
  static std::string text;
  return text;
}

}  // namespace

Scene read_named_scene(const std::string& name) {
  if (name == "-") {
    standard_input() = {std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>()};
    if (std::cin.bad()) throw FileError("cannot read standard input");
    return parse_scene(standard_input(), std::string(kStandardInput));
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

std::string text_of(const std::string& name) {
  if (name == "-" || name == kStandardInput) return standard_input();
  std::error_code missing;
  if (std::filesystem::is_regular_file(name, missing)) {  // a pipe gives its text once
    std::ifstream file(name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  for (const ExampleScene& example : example_scenes())
    if (example.name == name) return std::string(example.text);
  return {};
}

}  // namespace trajet
