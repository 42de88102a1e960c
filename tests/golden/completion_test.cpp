// What shells propose after `trajet completion`: run by the shells that there are.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "program.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

using Lines = std::vector<std::string>;

bool contains(const Lines& lines, const std::string& line) { return ranges::find(lines, line) != lines.end(); }

/// What a shell command prints.
Lines output_of(const std::string& command) {
  const TemporaryFolder folder;
  const std::string out = folder.file("out");
  EXPECT_EQ(std::system((command + " >" + out + " 2>&1").c_str()), 0) << command << "\n" << read_text(out);
  Lines lines;
  std::istringstream text(read_text(out));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// What bash proposes for the last of the words behind `trajet`, in a folder.
Lines proposed(const std::string& words, const std::string& folder = ".") {
  return output_of("cd " + folder +
                   " && bash --norc -c 'source <(" TRAJET_PROGRAM " completion bash) && complete -p trajet " +
                   ">/dev/null && COMP_WORDS=(trajet " + words + ") && COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) && " +
                   "{ _trajet; printf \"%s\\n\" \"${COMPREPLY[@]}\"; }'");
}

TEST(Completion, BashProposesCommands) {
  EXPECT_EQ(proposed("co"), (Lines{"compare", "completion"}));
  EXPECT_TRUE(contains(proposed("\"\""), "run"));
  EXPECT_EQ(proposed("help vi"), Lines{"view"});
}

TEST(Completion, BashProposesTheOptionsOfTheCommand) {
  EXPECT_EQ(proposed("run --gl"), Lines{"--glb"});
  EXPECT_EQ(proposed("compare s.toml --rt"), (Lines{"--rtol", "--rtols"}));
  EXPECT_EQ(proposed("check --gl"), Lines{""});
}

TEST(Completion, BashKnowsEveryOptionThatHelpTells) {
  for (const std::string command : {"run", "view", "check", "compare"}) {
    const Lines options = proposed(command + " --");
    std::istringstream help(run_trajet({command, "--help"}).out);
    for (std::string word; help >> word;) {
      if (!word.starts_with("--")) continue;
      EXPECT_TRUE(contains(options, word.substr(0, word.find_first_of(",;")))) << command << " " << word;
    }
  }
}

TEST(Completion, BashProposesValues) {
  EXPECT_TRUE(contains(proposed("run s.toml --method ta"), "taylor-extended"));
  EXPECT_TRUE(contains(proposed("run s.toml --method = do"), "dopri5"));  // as bash splits --method=do
  EXPECT_TRUE(contains(proposed("compare s.toml --methods rk4,do"), "rk4,dopri5"));
  EXPECT_EQ(proposed("run s.toml --orientation quaternion-n"), Lines{"quaternion-normalized"});
  EXPECT_EQ(proposed("examples rifle"), Lines{"rifle_shot"});
  EXPECT_EQ(proposed("compare s.toml --reference ex"), Lines{"exact"});
}

TEST(Completion, BashProposesScenesAndFiles) {
  const TemporaryFolder folder;
  folder.write("my kick.toml", "");
  folder.write("my notes.txt", "");
  EXPECT_EQ(proposed("run my", folder.file("")), Lines{"my kick.toml"});
  EXPECT_EQ(proposed("run s.toml --json my", folder.file("")).size(), 2u);
  EXPECT_TRUE(contains(proposed("run free_k", folder.file("")), "free_kick"));
}

TEST(Completion, OtherShellsTakeTheirScripts) {
  const auto is_there = [](const std::string& shell) {
    return std::system(("command -v " + shell + " >/dev/null").c_str()) == 0;
  };
  const TemporaryFolder folder;
  for (const std::string shell : {"zsh", "fish"}) {
    const ProgramResult script = run_trajet({"completion", shell});
    EXPECT_EQ(script.exit_code, 0);
    EXPECT_NE(script.out.find("rotation"), std::string::npos) << shell;
    if (is_there(shell)) {
      EXPECT_TRUE(output_of(shell + " -n " + folder.write("script", script.out)).empty()) << shell;
    }
  }
  if (is_there("fish")) {
    EXPECT_TRUE(
        contains(output_of("fish -c '" TRAJET_PROGRAM " completion fish | source; complete -C \"trajet run --quie\"'"),
                 "--quiet\tno summary"));
  }
}

TEST(Completion, AnUnknownShellIsNamed) {
  const ProgramResult result = run_trajet({"completion", "bsh"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("not for 'bsh'; did you mean 'bash'?"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace trajet
