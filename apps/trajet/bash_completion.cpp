#include <fmt/format.h>

#include "completion.hpp"

namespace trajet {
namespace {

constexpr const char* kHead =
    R"(# Completes the commands and options of trajet in bash, as `trajet completion bash` prints it.
_trajet() {
  local current="${COMP_WORDS[COMP_CWORD]}" before="${COMP_WORDS[COMP_CWORD - 1]}" IFS=$' \t\n'
  # bash takes --option=value for three words
  if [[ $current == = ]]; then
    current=
  elif [[ $before == = ]]; then
    before="${COMP_WORDS[COMP_CWORD - 2]}"
  fi
  local words= is_list= files=
  case "$COMP_CWORD:${COMP_WORDS[1]}" in
)";

constexpr const char* kTail = R"(  esac
  local listed=
  if [[ $is_list ]]; then
    [[ $current == *,* ]] && listed="${current%,*},"
    current="${current##*,}"
    compopt -o nospace 2>/dev/null
  fi
  COMPREPLY=($(compgen -P "$listed" -W "$words" -- "$current"))
  if [[ $files ]]; then
    compopt -o filenames 2>/dev/null
    IFS=$'\n'
    COMPREPLY+=($(compgen -d -- "$current") $(compgen -f -X "!$files" -- "$current"))
  fi
}
complete -F _trajet trajet
)";

/// What the script proposes for a value, as assignments to its variables.
std::string assignments(const CompletedValue& value) {
  std::string text = fmt::format("words='{}'", fmt::join(value.words, " "));
  if (value.is_list) text += " is_list=1";
  if (value.is_file) text += fmt::format(" files='*{}'", value.ending);
  return text;
}

std::string option_words(const CompletedCommand& command) {
  std::string text;
  for (const CompletedOption& option : command.options)
    text += fmt::format("{}{}", text.empty() ? "" : " ", fmt::join(option.names, " "));
  return text;
}

std::string case_of(const CompletedCommand& command) {
  std::string text = fmt::format("    *:{})\n      case $before in\n", command.name);
  for (const CompletedOption& option : command.options)
    if (!option.is_flag)
      text += fmt::format("        {}) {} ;;\n", fmt::join(option.names, "|"), assignments(option.value));
  const std::string options = fmt::format("words='{}'", option_words(command));
  if (command.arguments.empty())
    text += fmt::format("        *) {} ;;\n", options);
  else
    text += fmt::format("        *) if [[ $current == -* ]]; then {}; else {}; fi ;;\n", options,
                        assignments(command.arguments.front()));
  return text + "      esac ;;\n";
}

}  // namespace

std::string bash_completion(const std::vector<CompletedCommand>& commands) {
  std::string names, cases;
  for (std::size_t i = 1; i < commands.size(); ++i) {
    names += commands[i].name + " ";
    cases += case_of(commands[i]);
  }
  return kHead + fmt::format("    1:*) words='{}' ;;\n", names + option_words(commands.front())) + cases + kTail;
}

}  // namespace trajet
