#include "program.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

namespace trajet {
namespace {

using Json = nlohmann::ordered_json;

const std::string kNotes = TRAJET_SOURCE_DIR "/examples/notes/";
const std::string kRifleShot = kNotes + "rifle_shot.toml";
const char* const kCsvHeader = "t,body,x,y,z,vx,vy,vz,ax,ay,az,qw,qx,qy,qz,wx,wy,wz";

std::vector<std::string> keys(const Json& json) {
  std::vector<std::string> names;
  for (const auto& [key, value] : json.items()) names.push_back(key);
  return names;
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) all.push_back(line);
  return all;
}

std::vector<std::string> cells(const std::string& row) {
  std::vector<std::string> all(1);
  for (const char c : row) {
    if (c == ',')
      all.emplace_back();
    else
      all.back() += c;
  }
  return all;
}

TEST(Run, WritesSummaryReportAndSamples) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_trajet({"run", kRifleShot, "--json", folder.file("r.json"), "--csv", folder.file("r.csv")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("A shot at a thin target 180 m away\nstopped at t = 0.3600001371 s (method taylor)\n"),
            std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("bullet  target  hit"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find('\033'), std::string::npos);  // no colours into a file

  const Json report = Json::parse(read_text(folder.file("r.json")));
  EXPECT_EQ(keys(report), (std::vector<std::string>{"trajet", "scene", "title", "method", "status", "start_time",
                                                    "end_time", "parameters", "impacts", "events", "contacts",
                                                    "verdict", "final", "states", "warnings", "statistics"}));
  EXPECT_EQ(report["status"], "stopped");
  EXPECT_EQ(keys(report["parameters"]), (std::vector<std::string>{"theta", "v0", "g"}));
  ASSERT_EQ(report["impacts"].size(), 1u);
  const Json& impact = report["impacts"][0];
  EXPECT_EQ(keys(impact),
            (std::vector<std::string>{"time", "body", "with", "kind", "point", "normal", "position", "velocity_before",
                                      "velocity_after", "angular_velocity_before", "angular_velocity_after", "impulse",
                                      "time_error_bound", "features", "points"}));
  // t = 180/(v0 cos theta), to the rounding of both computations
  const double theta = report["parameters"]["theta"];
  EXPECT_DOUBLE_EQ(theta, 0.05 * M_PI / 180);
  EXPECT_NEAR(impact["time"], 180 / (500 * std::cos(theta)), 1e-15);
  EXPECT_EQ(report["end_time"], impact["time"]);
  const Json& final = report["final"][0];
  EXPECT_EQ(keys(final),
            (std::vector<std::string>{"body", "position", "velocity", "acceleration", "orientation", "rotation_matrix",
                                      "angular_velocity", "points", "position_error_bound", "velocity_error_bound"}));
  EXPECT_EQ(final["acceleration"], Json({0.0, 0.0, -9.8}));
  EXPECT_EQ(keys(report["statistics"]), (std::vector<std::string>{"steps", "rejected_steps", "law_evaluations",
                                                                  "contact_searches", "wall_seconds"}));

  const std::vector<std::string> rows = lines(read_text(folder.file("r.csv")));
  // start, 0.01 … 0.36, before and after the impact
  ASSERT_EQ(rows.size(), 1u + 1u + 36u + 2u);
  EXPECT_EQ(rows[0], std::string(kCsvHeader) + ",phase");
  EXPECT_EQ(cells(rows[0]).size(), 19u);
  // what stops the run leaves no row behind it
  EXPECT_TRUE(rows[1].ends_with(","));
  EXPECT_TRUE(rows[rows.size() - 2].ends_with(",before"));
  EXPECT_EQ(std::stod(cells(rows.back())[0]), impact["time"]);
  EXPECT_EQ(std::stod(cells(rows.back())[2]), final["position"][0]);
}

TEST(Run, StandardOutputHoldsTheDataAlone) {
  EXPECT_TRUE(Json::accept(run_trajet({"run", kRifleShot, "--json", "-"}).out));
  EXPECT_TRUE(run_trajet({"run", kRifleShot, "--csv", "-"}).out.starts_with(kCsvHeader));
  EXPECT_EQ(run_trajet({"run", kRifleShot, "--quiet"}).out, "");
}

TEST(Run, IsTheSameEveryTimeButForTheClock) {
  const std::regex clock("\"wall_seconds\": [^\n]*");
  const auto report = [&] { return std::regex_replace(run_trajet({"run", kRifleShot, "--json", "-"}).out, clock, ""); };
  EXPECT_EQ(report(), report());
}

TEST(Run, OptionsReplaceWhatTheSceneSays) {
  const auto report = [](std::vector<std::string> options) {
    options.insert(options.begin(), {"run", kRifleShot, "--json", "-"});
    return Json::parse(run_trajet(options).out);
  };
  const Json over = report({"--set", "theta=0.2 deg", "--method", "rk4", "--step", "300 ms"});
  EXPECT_EQ(over["method"], "rk4");
  EXPECT_EQ(over["impacts"][0]["with"], "ground");  // erratum A16: above 0.1066 degrees it flies over
  EXPECT_EQ(report({"--end", "100 ms"})["status"], "finished");
  EXPECT_EQ(report({"--end", "100 ms"})["end_time"], 0.1);
  EXPECT_GT(report({"--method", "dopri5", "--rtol", "1e-12", "--atol", "1e-12"})["statistics"]["steps"], 0);
}

TEST(Run, ExtraStatesAloneGiveRowsWithoutBody) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("decay.toml",
                                         "[time]\nend = 1\nsample = 0.5\n"
                                         "[[state]]\nname = \"x\"\nvalue = 1\nrate = \"-x\"\n"
                                         "[[state]]\nname = \"y\"\nvalue = 2\nrate = 0\n");
  const std::vector<std::string> rows = lines(run_trajet({"run", scene, "--csv", "-"}).out);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0], std::string(kCsvHeader) + ",x,y,phase");
  EXPECT_EQ(rows[1], "0,,,,,,,,,,,,,,,,,,1,2,");
  EXPECT_NEAR(std::stod(cells(rows[3])[18]), std::exp(-1.0), 1e-12);
  const Json report = Json::parse(run_trajet({"run", scene, "--json", "-"}).out);
  EXPECT_EQ(report["final"], Json::array());
  EXPECT_EQ(report["states"]["y"], 2.0);
}

TEST(Run, NumericalFailureIsReportedAndWritten) {
  const TemporaryFolder folder;
  // y' = y^2 from 1 is infinite at t = 1
  const std::string scene =
      folder.write("blow_up.toml", "[time]\nend = 2\n[[state]]\nname = \"y\"\nvalue = 1\nrate = \"y^2\"\n");
  const ProgramResult result =
      run_trajet({"run", scene, "--json", folder.file("r.json"), "--csv", folder.file("r.csv")});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("error: "), std::string::npos);
  const Json report = Json::parse(read_text(folder.file("r.json")));
  EXPECT_EQ(report["status"], "failed");
  EXPECT_FALSE(report["failure"].get<std::string>().empty());
  EXPECT_NEAR(report["end_time"], 1.0, 1e-3);
  EXPECT_GT(lines(read_text(folder.file("r.csv"))).size(), 50u);
}

TEST(Run, InterruptWritesWhatWasComputed) {
  const TemporaryFolder folder;
  // Far longer than any test waits: 1e12 steps.
  const std::string scene = folder.write("long.toml",
                                         "[time]\nend = 1e9\nsample = 1\n[method]\nname = \"rk4\"\nstep = 1e-3\n"
                                         "max_steps = 1000000000000\n"
                                         "[[state]]\nname = \"x\"\nvalue = 1\nrate = \"sin(t)\"\n");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    SCOPED_TRACE(signal);
    const std::string csv = folder.file(std::to_string(signal) + ".csv");
    const std::string json = folder.file(std::to_string(signal) + ".json");
    const ProgramResult result = run_trajet({"run", scene, "--csv", csv, "--json", json}, csv, signal);
    ASSERT_EQ(result.exit_code, 130);
    const Json report = Json::parse(read_text(json));
    EXPECT_EQ(report["status"], "interrupted");
    EXPECT_GT(report["end_time"], 1.0);
    EXPECT_EQ(read_text(csv).back(), '\n');
  }
}

TEST(Run, WhatIsNoNumberIsNanInTheCsv) {
  const TemporaryFolder folder;
  const std::string scene = folder.write(
      "s.toml", "[time]\nend = 2\n[[body]]\nname = \"b\"\nacceleration = \"[sqrt(-1 - t), -sqrt(-1 - t), 0]\"\n");
  const ProgramResult result = run_trajet({"run", scene, "--csv", "-"});
  EXPECT_EQ(result.exit_code, 4);
  const std::vector<std::string> last = cells(lines(result.out).back());
  EXPECT_EQ(last[8], "nan") << result.out;
  EXPECT_EQ(last[9], "nan");
}

TEST(ExitCodes, TellWhatWasWrong) {
  const TemporaryFolder folder;
  const std::string wrong = folder.write("wrong.toml", "[time]\nend = \"5 m\"\n[[body]]\nname = \"b\"\n");
  const std::string no_table = folder.write(
      "no_table.toml", "[time]\nend = 1\n[[body]]\nname = \"b\"\nacceleration = \"[table('none.csv', t), 0, 0]\"\n");
  struct Case {
    std::vector<std::string> arguments;
    int exit_code;
    std::string message;
  };
  const Case cases[] = {
      {{}, 2, "subcommand"},
      {{"rnu", kRifleShot}, 2, "unknown command 'rnu'"},
      {{"viewed", kRifleShot}, 2, "unknown command 'viewed', see 'trajet --help'; did you mean 'view'?"},
      {{"run"}, 2, "SCENE"},
      {{"run", kRifleShot, "--jsn", "x"}, 2, "--jsn"},
      {{"run", kRifleShot, "--json", "-", "--csv", "-"}, 2, "standard output"},
      {{"run", kRifleShot, "--set", "thata=1"}, 2, "did you mean 'theta'?"},
      {{"run", kRifleShot, "--set", "theta=1+"}, 2, "--set theta"},
      {{"run", kRifleShot, "--set", "theta=t"}, 2, "--set theta"},
      {{"run", kRifleShot, "--end", "5 m"}, 2, "time [s] expected, got length [m]"},
      {{"run", kRifleShot, "--method", "rk44"}, 2, "did you mean"},
      {{"run", wrong}, 3, wrong + ":2:10: error: time [s] expected, got length [m]"},
      {{"check", wrong}, 3, ":2:10: error:"},
      {{"run", kRifleShot, "--order", "99"}, 2, "--order: error: method 'taylor' takes an order of at most"},
      {{"run", no_table}, 5, no_table + ":5:18: error: cannot read the table"},
      {{"run", kRifleShot, "--fps", "0"}, 2, "a positive number expected, got '0'"},
      {{"run", folder.file("none.toml")}, 5, "none.toml"},
      {{"run", kRifleShot, "--json", folder.file("no/folder.json")}, 5, "cannot write"},
      {{"run", kRifleShot, "--csv", "/dev/full"}, 5, "cannot write"},
      {{"run", kRifleShot, "--json", "/dev/full"}, 5, "cannot write"},
      {{"examples", "rifle-shot"}, 2, "did you mean 'rifle_shot'?"},
      {{"check", kRifleShot}, 0, ""},
      {{"--version"}, 0, ""},
      {{"run", "--help"}, 0, ""},
  };
  for (const Case& c : cases) {
    const ProgramResult result = run_trajet(c.arguments);
    EXPECT_EQ(result.exit_code, c.exit_code) << ::testing::PrintToString(c.arguments) << result.err;
    EXPECT_NE(result.err.find(c.message), std::string::npos) << ::testing::PrintToString(c.arguments) << result.err;
    EXPECT_EQ(result.err.empty(), c.exit_code == 0);
  }
}

TEST(ExitCodes, AreThoseOfTheContractWhereNoMessageCanBeWritten) {
  const TemporaryFolder folder;
  const std::string wrong = folder.write("wrong.toml", "[time]\nend = \"1 kg\"\n");
  const std::string failing =
      folder.write("failing.toml", "[time]\nend = 2\n[[state]]\nname = \"y\"\nvalue = 1\nrate = \"y^2\"\n");
  const std::string json = folder.file("r.json");
  for (const std::string closed : {" 2>&-", " 2>/dev/full"}) {
    const auto exit_code = [&](const std::string& arguments) {
      const int status = std::system((TRAJET_PROGRAM " " + arguments + " >/dev/null" + closed).c_str());
      return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    };
    EXPECT_EQ(exit_code("run " + folder.file("nosuch.toml")), 5) << closed;
    EXPECT_EQ(exit_code("run " + wrong), 3) << closed;
    EXPECT_EQ(exit_code("nosuch"), 2) << closed;
    EXPECT_EQ(exit_code("run " + failing + " --json " + json), 4) << closed;
    EXPECT_EQ(Json::parse(read_text(json))["status"], "failed") << closed;
  }
}

TEST(ExitCodes, OfATextThatCannotBeWrittenIsThatOfAFile) {
  for (const std::string arguments : {"--help", "run --help", "--version", "methods", "examples", "completion bash"}) {
    const int status = std::system((TRAJET_PROGRAM " " + arguments + " >/dev/full 2>/dev/null").c_str());
    EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 5) << arguments;
  }
}

/// What the program says where it may have so many KiB of memory.
ProgramResult run_within(int memory, const std::string& arguments) {
  const TemporaryFolder folder;
  const std::string err = folder.file("err");
  const std::string limit = "ulimit -c 0; ulimit -v " + std::to_string(memory) + "; exec ";
  const int status = std::system((limit + TRAJET_PROGRAM " " + arguments + " 2>" + err).c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), "", read_text(err)};
}

TEST(ExitCodes, WhereMemoryEndsWhatWasComputedIsWritten) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer needs memory of its own";
#endif
  const TemporaryFolder folder;
  const std::string scene = folder.write(
      "s.toml",
      "[time]\nend = 1e7\nsample = 1\n[method]\nmax_steps = 1000000000\n[[body]]\nname = \"ball\"\n"
      "position = [0, 0, 1]\nacceleration = [0, 0, -98.18]\n[[obstacle]]\nname = \"ground\"\nshape = \"plane\"\n"
      "point = [0, 0, 0]\nnormal = [0, 0, 1]\non_hit = \"bounce\"\n");
  const std::string json = folder.file("r.json"), csv = folder.file("r.csv"), glb = folder.file("r.glb");
  for (const std::string& more : {std::string(), " --glb " + glb + " --fps 0.1"}) {
    // what a figure shows is in memory, all of it
    const ProgramResult result = run_within(60'000, "run " + scene + " --quiet --json " + json + " --csv " + csv +
                                                        " --plot " + folder.file("r.svg") + more);
    EXPECT_EQ(result.exit_code, 4) << result.err;
    EXPECT_NE(result.err.find("error: memory has run out; what was computed until then is kept"), std::string::npos)
        << result.err;
    const Json report = Json::parse(read_text(json));
    EXPECT_EQ(report["status"], "failed");
    EXPECT_NE(report["failure"].get<std::string>().find("memory has run out"), std::string::npos);
    EXPECT_GT(report["impacts"].size(), 100u);
    const std::vector<std::string> rows = lines(read_text(csv));
    EXPECT_GT(rows.size(), 2 * report["impacts"].size());
    EXPECT_EQ(std::stod(cells(rows.back())[0]), report["end_time"].get<double>());
  }
}

TEST(ExitCodes, MemoryThatEndsEarlyIsNoFaultOfTheScene) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer needs memory of its own";
#endif
  const TemporaryFolder folder;
  // beside this text there is no room for what is read from it
  std::string text = "[time]\nend = 1\n";
  for (int i = 0; i < 60'000; ++i)
    text += "[[body]]\nname = \"b" + std::to_string(i) + "\"\nposition = [98.18, 0, 0]\n";
  const ProgramResult result = run_within(60'000, "run " + folder.write("s.toml", text));
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_EQ(result.err, "error: memory has run out\n");
}

TEST(ExitCodes, AWrongSceneLeavesEarlierFilesAlone) {
  const TemporaryFolder folder;
  const std::string wrong =
      folder.write("wrong.toml", "[time]\nend = 1\n[[body]]\nname = \"b\"\nvelocity = \"[g,0,0]\"\n");
  const std::string earlier = folder.write("r.json", "{}");
  EXPECT_EQ(run_trajet({"run", wrong, "--json", earlier}).exit_code, 3);
  EXPECT_EQ(read_text(earlier), "{}");
}

TEST(ExitCodes, AnAnimationOfTooManyKeysIsRefusedBeforeAnythingIsWritten) {
  const TemporaryFolder folder;
  const std::string scene =
      folder.write("s.toml", "[time]\nend = 30000\n[[body]]\nname = \"b\"\nvelocity = [1, 0, 0]\n");
  const std::string earlier = folder.write("r.glb", "earlier");
  const ProgramResult result = run_trajet({"run", scene, "--glb", earlier, "--csv", folder.file("r.csv")});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err,
            "--fps: error: 60 keys a second for 30000 s are more keys than the 1e+06 that an animation may have: "
            "--fps 33.3 or less, or an earlier --end expected\n");
  EXPECT_EQ(read_text(earlier), "earlier");
  EXPECT_FALSE(std::filesystem::exists(folder.file("r.csv")));
  EXPECT_EQ(run_trajet({"run", scene, "--glb", earlier, "--fps", "33.3"}).exit_code, 0);
}

TEST(Check, FindsWhatOnlyTheMeaningOfAnExpressionTells) {
  struct Case {
    const char* text;
    const char* message;
  };
  const Case cases[] = {
      {"velocity = \"[1, 0, gg]\"", ":7:20: error:"}, {"velocity = \"g\"", ":7:"},
      {"position = \"[t, 0, 0]\"", ":7:14: error:"},  {"acceleration = \"[0, 0, bal.x]\"", "did you mean 'ball.x'?"},
      {"acceleration = [0, 0, \"g + r\"]", ":7:"},    {"position = [0, 0, \"1/0\"]", ":7:"},
  };
  const TemporaryFolder folder;
  for (const Case& c : cases) {
    const std::string scene = folder.write("s.toml", std::string("[parameters]\ng = 9.8\n[time]\nend = 1\n[[body]]\n") +
                                                         "name = \"ball\"\n" + c.text + "\n");
    const ProgramResult result = run_trajet({"check", scene});
    EXPECT_EQ(result.exit_code, 3) << c.text;
    EXPECT_NE(result.err.find(c.message), std::string::npos) << c.text << "\n" << result.err;
  }
}

TEST(Examples, AreListedPrintedAndRun) {
  const std::vector<std::string> listed = lines(run_trajet({"examples"}).out);
  EXPECT_GE(listed.size(), 8u);
  for (const std::string& line : listed) {
    const std::string name = line.substr(0, line.find(' '));
    const std::string notes = kNotes + name + ".toml", other = TRAJET_SOURCE_DIR "/examples/" + name + ".toml";
    const std::string path = std::filesystem::exists(notes) ? notes : other;
    EXPECT_EQ(run_trajet({"examples", name}).out, read_text(path)) << name;
    const ProgramResult result = run_trajet({"run", path});
    EXPECT_EQ(result.exit_code, 0) << name << result.err;
    EXPECT_EQ(result.err, "") << name;
  }
}

TEST(Examples, TheFreeKickScores) {
  const Json report = Json::parse(run_trajet({"run", TRAJET_SOURCE_DIR "/examples/free_kick.toml", "--json", "-"}).out);
  ASSERT_EQ(report["impacts"].size(), 1u) << "neither the wall nor the ground before the goal";
  EXPECT_EQ(report["impacts"][0]["with"], "goal");
  EXPECT_EQ(report["events"][0]["event"], "apex");
  // Without spin it misses: the goal is missed or the wall is hit.
  const Json straight = Json::parse(run_trajet({"run", TRAJET_SOURCE_DIR "/examples/free_kick.toml", "--json", "-",
                                                "--set", "lift=0", "--end", "1.2 s"})
                                        .out);
  EXPECT_TRUE(straight["impacts"].empty() || straight["impacts"][0]["with"] != "goal");
}

TEST(Examples, TheSummaryTellsHowSolidsHaveTurned) {
  const std::string out = run_trajet({"run", kNotes + "soccer_ball.toml", "--orientation", "exact"}).out;
  // 10 sqrt(2) rad about (0, 1, 1): cos(5 sqrt(2)), sin(5 sqrt(2)) / sqrt(2)
  EXPECT_NE(out.find("(0.705348, 0, 0.501241, 0.501241)"), std::string::npos) << out;
  EXPECT_NE(out.find("(0, 1, 1)"), std::string::npos) << out;
  EXPECT_EQ(run_trajet({"run", kNotes + "drag_3d.toml"}).out.find("orientation"), std::string::npos);
}

TEST(Methods, AreListed) {
  const std::string out = run_trajet({"methods"}).out;
  for (const char* name : {"euler", "midpoint", "rk4", "dopri5", "ode45", "taylor"})
    EXPECT_NE(out.find(name), std::string::npos) << name;
  // what others call them: by name
  for (const char* known_as : {"notes: Runge-Kutta 4", "MATLAB: ode45", "notes: Euler normalised"})
    EXPECT_NE(out.find(known_as), std::string::npos) << known_as;
  EXPECT_EQ(out.find("(F"), std::string::npos) << out;
}

}  // namespace
}  // namespace trajet
