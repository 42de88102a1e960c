#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace trajet {

/// What may stand as the value of an option, or as an argument.
struct CompletedValue {
  std::string kind{};                ///< as help names it: METHOD, FILE
  std::vector<std::string> words{};  ///< that a shell proposes
  bool is_list = false;              ///< several of them, with commas between
  bool is_file = false;              ///< names of files are proposed too
  std::string ending{};              ///< of those files; empty: any
};

struct CompletedOption {
  std::vector<std::string> names{};  ///< with their dashes
  std::string description{};
  bool is_flag = false;
  bool is_repeatable = false;
  CompletedValue value{};  ///< unless it is a flag
};

struct CompletedCommand {
  std::string name{};
  std::string description{};
  std::vector<CompletedOption> options{};
  std::vector<CompletedValue> arguments{};
};

/// The commands of a program as shells complete them, read off the options that it parses. The first has no name: the
/// options of the program itself.
std::vector<CompletedCommand> completed_commands(const CLI::App& app);

// What each shell has to be told.
std::string bash_completion(const std::vector<CompletedCommand>& commands);
std::string zsh_completion(const std::vector<CompletedCommand>& commands);
std::string fish_completion(const std::vector<CompletedCommand>& commands);

}  // namespace trajet
