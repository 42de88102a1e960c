// What people type: names of scenes and methods as they know them, keys, mistakes.

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "program.hpp"

namespace trajet {
namespace {

TEST(CommandLine, ABuiltInSceneRunsByItsName) {
  const ProgramResult named = run_trajet({"run", "rifle_shot", "--json", "-"});
  EXPECT_EQ(named.exit_code, 0) << named.err;
  EXPECT_EQ(nlohmann::json::parse(named.out)["status"], "stopped");
  const ProgramResult mistyped = run_trajet({"run", "rifle_sht"});
  EXPECT_EQ(mistyped.exit_code, 5);
  EXPECT_NE(mistyped.err.find("did you mean 'rifle_shot'?"), std::string::npos) << mistyped.err;
}

TEST(CommandLine, ASceneMayComeFromStandardInput) {
  const TemporaryFolder folder;
  const std::string report = folder.file("r.json");
  const std::string command =
      std::string("'") + TRAJET_PROGRAM + "' run - --quiet --json '" + report + "' < '" +
      folder.write("s.toml", "[time]\nend = 2\n[[state]]\nname = \"x\"\nvalue = 1\nrate = 3\n") + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(nlohmann::json::parse(read_text(report))["end_time"], 2.0);
}

TEST(CommandLine, HelpIsThereUnderTheNamesThatPeopleTry) {
  const ProgramResult help = run_trajet({"help", "run"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.out, run_trajet({"run", "--help"}).out);
  EXPECT_EQ(run_trajet({"help"}).out, run_trajet({"--help"}).out);
  EXPECT_EQ(run_trajet({"-V"}).out, run_trajet({"--version"}).out);
}

TEST(CommandLine, AnUnknownOptionIsNamedWithTheNearest) {
  const ProgramResult result = run_trajet({"run", "rifle_shot", "--methd", "taylor"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("unknown option '--methd'"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("did you mean '--method'?"), std::string::npos) << result.err;
  const ProgramResult more = run_trajet({"run", "rifle_shot", "twice"});
  EXPECT_EQ(more.exit_code, 2);
  EXPECT_NE(more.err.find("'twice'"), std::string::npos) << more.err;
}

TEST(CommandLine, WhatIsMissingOrTooMuchIsSaidInSentences) {
  const struct {
    std::vector<std::string> words;
    const char* message;
  } cases[] = {
      {{}, "trajet: error: A subcommand is missing, see 'trajet --help'\n"},
      {{"run"}, "trajet: error: SCENE is missing, see 'trajet run --help'\n"},
      {{"run", "x", "--step"}, "--step: error: its value is missing, see 'trajet run --help'\n"},
      {{"run", "x", "--fps", "-1"}, "--fps: error: a positive number expected, got '-1'\n"},
      {{"run", "x", "--order", "2.5"}, "--order: error: a whole number, or of a switch no value expected, got '2.5'\n"},
      {{"run", "x", "--order", "2", "--order", "3"},
       "--order: error: once expected, given more often, see 'trajet run --help'\n"},
  };
  for (const auto& c : cases) {
    const ProgramResult result = run_trajet(c.words);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.err, c.message);
  }
}

TEST(CommandLine, BlanksAroundNamesInListsDoNotCount) {
  const ProgramResult result = run_trajet(
      {"compare", "rifle_shot", "--methods", "rk4, dopri5 ", "--steps", "10, 20", "--rtols", " 1e-6", "--csv", "-"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("dopri5"), std::string::npos) << result.out;
  EXPECT_EQ(run_trajet({"run", "rifle_shot", "--method", " rk4", "--step", "1 ms ", "--set", " theta = 0.1 deg "}).err,
            "");
}

TEST(CommandLine, MethodsGoByOtherProgramsNamesAndInAnyCase) {
  const auto method_of = [](const std::string& name) {
    const ProgramResult result = run_trajet({"run", "rifle_shot", "--method", name, "--json", "-"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(result.out)["method"].get<std::string>();
  };
  EXPECT_EQ(method_of("RK45"), "dopri5");
  EXPECT_EQ(method_of("rk23"), "bs32");
  EXPECT_EQ(method_of("DOP853"), "dop853");
  EXPECT_EQ(method_of("Taylor"), "taylor");
  const ProgramResult radau = run_trajet({"run", "rifle_shot", "--method", "Radau", "--quiet"});
  EXPECT_EQ(radau.exit_code, 0);
  EXPECT_NE(radau.err.find("'rodas5p' is the nearest"), std::string::npos) << radau.err;
}

TEST(CommandLine, SetReachesKeysOfBodiesAndObstacles) {
  const TemporaryFolder folder;
  const std::string scene =
      folder.write("s.toml",
                   "[time]\nend = 1\n[[body]]\nname = \"b\"\nposition = [0, 0, 1]\n"
                   "acceleration = [0, 0, -9.81]\n[[obstacle]]\nname = \"floor\"\nshape = \"plane\"\n"
                   "point = [0, 0, 0]\nnormal = [0, 0, 1]\non_hit = \"bounce\"\n");
  const ProgramResult result =
      run_trajet({"run", scene, "--set", "b.velocity=[3, 0, 0]", "--set", " floor.restitution = 0.5", "--json", "-"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json impact = nlohmann::json::parse(result.out)["impacts"][0];
  EXPECT_EQ(impact["velocity_before"][0], 3.0);
  EXPECT_NEAR(impact["velocity_after"][2].get<double>(), -0.5 * impact["velocity_before"][2].get<double>(), 1e-12);
  const ProgramResult wrong = run_trajet({"run", scene, "--set", "b.velocty=[1, 0, 0]"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("did you mean 'b.velocity'?"), std::string::npos) << wrong.err;
  const ProgramResult unit = run_trajet({"run", scene, "--set", "floor.restitution=2 m"});
  EXPECT_EQ(unit.exit_code, 2);
}

/// A scene with something to warn of before its first step, of every kind that there is.
const std::string kDoubtful =
    "[parameters]\nv0 = \"3 m/s\"\n[time]\nstart = 1e9\nend = 1000000001\n[method]\nname = \"Radau\"\n"
    "[[body]]\nname = \"b\"\nposition = [0, 0, 1]\nvelocity = [\"v0\", 0, 0]\n"
    "[[obstacle]]\nname = \"wall\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nrestitution = 0.5\n"
    "[[event]]\nname = \"never\"\nwhen = \"1\"\n";

TEST(CommandLine, CheckWarnsOfWhatRunWarnsOfBeforeItSteps) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.toml", kDoubtful);
  const ProgramResult checked = run_trajet({"check", scene, "--set", "v0=2"});
  const ProgramResult run = run_trajet({"run", scene, "--set", "v0=2", "--json", "-"});
  EXPECT_EQ(checked.exit_code, 0);
  EXPECT_EQ(checked.err, run.err);
  for (const char* text : {"--set v0=2 has no unit", "times near 1000000001 s", "'rodas5p' is the nearest",
                           "obstacle 'wall' has a restitution", "event 'never' can never happen"})
    EXPECT_NE(checked.err.find(text), std::string::npos) << text << "\n" << checked.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["warnings"].size(), 5u);
}

}  // namespace
}  // namespace trajet
