#include "completion.hpp"

#include <algorithm>
#include <array>

#include "commands.hpp"
#include "example_scenes.hpp"
#include "trajet/error.hpp"
#include "trajet/io/output_file.hpp"
#include "trajet/ode/registry.hpp"
#include "trajet/portable.hpp"
#include "trajet/rigid/orientation.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet {
namespace {

using Words = std::vector<std::string>;

struct Shell {
  std::string_view name;
  std::string (*script)(const std::vector<CompletedCommand>& commands);
};
constexpr std::array kShells{Shell{"bash", bash_completion}, Shell{"zsh", zsh_completion},
                             Shell{"fish", fish_completion}};

template <class Entries>
void add_names(const Entries& entries, Words& words) {
  for (const auto& entry : entries) {
    words.emplace_back(entry.name);
    words.insert(words.end(), entry.aliases.begin(), entry.aliases.end());
  }
}

Words scene_names() {
  Words words;
  for (const ExampleScene& scene : example_scenes()) words.emplace_back(scene.name);
  return words;
}

/// What stands for a word of that kind.
CompletedValue value_of(std::string kind) {
  CompletedValue value;
  const std::size_t comma = kind.find(",...");
  value.is_list = comma != std::string::npos;
  value.kind = kind.substr(0, comma);
  if (value.kind == "REFERENCE") value.words.emplace_back("exact");
  if (value.kind == "METHOD" || value.kind == "REFERENCE") add_names(methods(), value.words);
  if (value.kind == "WAY") add_names(orientation_ways(), value.words);
  if (value.kind == "SCENE" || value.kind == "EXAMPLE") value.words = scene_names();
  if (value.kind == "SHELL")
    for (const Shell& shell : kShells) value.words.emplace_back(shell.name);
  value.is_file = value.kind == "FILE" || value.kind == "SCENE";
  if (value.kind == "SCENE") value.ending = ".toml";
  return value;
}

CompletedOption option_of(const CLI::Option& option) {
  CompletedOption completed;
  for (const std::string& name : option.get_lnames()) completed.names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) completed.names.push_back("-" + name);
  completed.description = option.get_description();
  completed.is_flag = option.get_items_expected_max() == 0;
  if (completed.is_flag) return completed;
  completed.value = value_of(option.get_type_name());
  completed.is_repeatable = !completed.value.is_list && option.get_items_expected_max() > 1;
  return completed;
}

CompletedCommand command_of(const CLI::App& app, std::string name) {
  CompletedCommand command{std::move(name), app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional())
      command.arguments.push_back(value_of(option->get_single_name()));
    else
      command.options.push_back(option_of(*option));
  }
  return command;
}

}  // namespace

std::vector<CompletedCommand> completed_commands(const CLI::App& app) {
  std::vector<CompletedCommand> commands{command_of(app, "")};
  CompletedCommand help{"help", "tell of a command and its options", {}, {{"COMMAND"}}};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back(command_of(*command, command->get_name()));
    help.arguments.front().words.push_back(command->get_name());
  }
  commands.push_back(std::move(help));
  return commands;
}

int completion_command(const std::string& shell, const CLI::App& app) {
  const auto* found = ranges::find(kShells, shell, &Shell::name);
  if (found == kShells.end()) {
    std::vector<std::string_view> names;
    for (const Shell& each : kShells) names.push_back(each.name);
    throw InputError({"trajet"}, "there are completions for bash, zsh and fish, not for '" + shell + "'" +
                                     did_you_mean(shell, names));
  }
  OutputFile out("-");
  out.write(found->script(completed_commands(app)));
  out.finish();
  return kDone;
}

}  // namespace trajet
