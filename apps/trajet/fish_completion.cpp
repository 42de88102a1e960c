#include <fmt/format.h>

#include "completion.hpp"

namespace trajet {
namespace {

/// Within single quotes.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string proposals(const CompletedValue& value) {
  const std::string words = fmt::format("{}", fmt::join(value.words, " "));
  if (words.empty()) return "";
  return value.is_list ? fmt::format(" -a '(__fish_append , {})'", words) : fmt::format(" -a '{}'", words);
}

std::string files(const CompletedValue& value) {
  if (!value.is_file) return "";
  return value.ending.empty() ? " -F" : fmt::format(" -a '(__fish_complete_suffix {})'", value.ending);
}

std::string line_of(const CompletedOption& option, const std::string& condition) {
  std::string text = "complete -c trajet -n '" + condition + "'";
  for (const std::string& name : option.names)
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  text += " -d '" + escaped(option.description) + "'";
  if (!option.is_flag)
    text += " -r" + std::string(option.value.is_file ? "" : " -f") + proposals(option.value) + files(option.value);
  return text + "\n";
}

}  // namespace

std::string fish_completion(const std::vector<CompletedCommand>& commands) {
  std::string text = "# Completes trajet in fish, as `trajet completion fish` prints it.\ncomplete -c trajet -f\n";
  for (const CompletedOption& option : commands.front().options) text += line_of(option, "__fish_use_subcommand");
  for (std::size_t i = 1; i < commands.size(); ++i)
    text += fmt::format("complete -c trajet -n __fish_use_subcommand -a {} -d '{}'\n", commands[i].name,
                        escaped(commands[i].description));
  for (std::size_t i = 1; i < commands.size(); ++i) {
    const std::string condition = "__fish_seen_subcommand_from " + commands[i].name;
    for (const CompletedOption& option : commands[i].options) text += line_of(option, condition);
    for (const CompletedValue& argument : commands[i].arguments) {
      const std::string begin = "complete -c trajet -n '" + condition + "'";
      if (!argument.words.empty()) text += begin + proposals(argument) + " -d '" + argument.kind + "'\n";
      if (argument.is_file) text += begin + files(argument) + "\n";
    }
  }
  return text;
}

}  // namespace trajet
