#include <fmt/format.h>

#include <vector>

#include "commands.hpp"
#include "example_scenes.hpp"
#include "terminal.hpp"
#include "text_table.hpp"
#include "trajet/io/output_file.hpp"
#include "trajet/io/scene_file.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet {

int examples_command(const std::string& name) {
  constexpr std::size_t kTitleColumn = 25;
  std::string text;
  std::vector<std::string_view> names;
  for (const ExampleScene& example : example_scenes()) {
    names.push_back(example.name);
    if (name.empty())
      text += wrap(fmt::format("{:<24} {}", example.name,
                               parse_scene(std::string(example.text), std::string(example.name)).title),
                   kTitleColumn, text_width(stdout));
    else if (example.name == name)
      text = example.text;
  }
  if (text.empty() && !name.empty())
    throw InputError({"trajet"},
                     "there is no built-in scene '" + name + "', see 'trajet examples'" + did_you_mean(name, names));
  OutputFile out("-");
  out.write(text);
  out.finish();
  return kDone;
}

}  // namespace trajet
