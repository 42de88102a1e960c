#include <fmt/format.h>

#include "completion.hpp"

namespace trajet {
namespace {

/// A text within a part of a specification of `_arguments`, within single quotes.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return result;
}

/// `:KIND:ACTION`, what is proposed for a value. A blank before an action keeps `_arguments` from adding words to it.
std::string action(const CompletedValue& value) {
  const std::string words = fmt::format("{}", fmt::join(value.words, " "));
  std::string text = ":" + escaped(value.kind) + ":";
  if (value.is_list) return text + (words.empty() ? " " : " _values -s , " + value.kind + " " + words);
  if (!value.is_file) return text + (words.empty() ? " " : "(" + words + ")");
  const std::string files = value.ending.empty() ? "_files" : "_files -g \"*" + value.ending + "\"";
  if (words.empty()) return text + files;
  return fmt::format("{} _alternative \"words:{}:({})\" \"files:file:{}\"", text, value.kind, words,
                     value.ending.empty() ? "_files" : "_files -g \\*" + value.ending);
}

std::string specification(const CompletedOption& option, const std::string& name) {
  std::string text = option.is_repeatable ? "*" : "";
  text += name;
  const bool is_long = name.starts_with("--");
  if (!option.is_flag) text += is_long ? "=" : "+";
  text += "[" + escaped(option.description) + "]";
  if (!option.is_flag) text += action(option.value);
  return text;
}

std::string case_of(const CompletedCommand& command) {
  std::string text = fmt::format("    {})\n      _arguments", command.name);
  for (const CompletedOption& option : command.options)
    for (const std::string& name : option.names) text += fmt::format(" \\\n        '{}'", specification(option, name));
  int position = 0;
  for (const CompletedValue& argument : command.arguments)
    text += fmt::format(" \\\n        '{}{}'", ++position, action(argument));
  return text + " ;;\n";
}

}  // namespace

std::string zsh_completion(const std::vector<CompletedCommand>& commands) {
  std::string text = "#compdef trajet\n# As `trajet completion zsh` prints it.\n_trajet() {\n";
  text += "  if (( CURRENT == 2 )); then\n    local -a commands=(\n";
  for (std::size_t i = 1; i < commands.size(); ++i)
    text += fmt::format("      '{}:{}'\n", commands[i].name, escaped(commands[i].description));
  text += "    )\n    _describe command commands\n    _arguments";
  for (const CompletedOption& option : commands.front().options)
    for (const std::string& name : option.names) text += fmt::format(" '{}'", specification(option, name));
  text += "\n    return\n  fi\n  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $command in\n";
  for (std::size_t i = 1; i < commands.size(); ++i) text += case_of(commands[i]);
  // bound to the name where it is loaded by `source`, called where it is loaded by its first use
  return text +
         "  esac\n}\nif [[ $funcstack[1] == _trajet ]]; then\n  _trajet \"$@\"\nelse\n  compdef _trajet trajet\nfi\n";
}

}  // namespace trajet
