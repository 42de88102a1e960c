#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "commands.hpp"

namespace trajet {

/// What the program understands: its commands, their options, and what these set. Help, completions of shells and the
/// manual page are made from it.
class CommandLine {
 public:
  CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Runs what the words behind the program's name ask for; the exit code. Throws InputError at words that are wrong.
  int run(std::vector<std::string> words);

 private:
  struct Command {
    CLI::App* app;
    std::function<int()> run;
  };

  CLI::App& add_command(const char* name, const char* description, std::function<int()> run);
  void add_run();
  void add_view();
  void add_compare();
  void add_sweep();
  void add_aim();
  void add_lists();
  /// Throws InputError with the nearest command.
  void check_name(const std::string& word) const;
  /// An option that there is not gets a better answer than CLI11's too: with the nearest one.
  std::string unknown_option() const;

  CLI::App app_;
  std::vector<Command> commands_;
  RunArguments run_;
  RunArguments check_;
  ViewArguments view_;
  CompareArguments compare_;
  SweepArguments sweep_;
  MergeArguments merge_;
  AimArguments aim_;
  std::string example_;
  std::string shell_;
};

}  // namespace trajet
