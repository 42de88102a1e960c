#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "trajet/io/sweep_csv.hpp"

namespace trajet {
namespace {

using Json = nlohmann::ordered_json;

const std::string kRifleShot = TRAJET_SOURCE_DIR "/examples/notes/rifle_shot.toml";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) all.push_back(line);
  return all;
}

TEST(SweepProgram, WritesGridInTheOrderOfThePlan) {
  const ProgramResult result =
      run_trajet({"sweep", kRifleShot, "--vary", "theta=-0.02deg:0.1deg:3", "--vary", "v0=480 m/s:500m/s:2", "--report",
                  "hit,impact(1).z,norm([x, z, 0])", "--out", "-"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  const std::vector<std::string> lines = lines_of(result.out);
  ASSERT_EQ(lines.size(), 7U);
  EXPECT_EQ(lines[0], "index,theta,v0,hit,impact(1).z,\"norm([x, z, 0])\"");
  for (std::size_t i = 0; i < 6; ++i) {
    const SweepRow row = read_csv_row(lines[i + 1], 2);
    EXPECT_EQ(row.index, i);
    const double theta = row.values[0], v0 = row.values[1];
    EXPECT_EQ(v0, i % 2 == 0 ? 480.0 : 500.0);
    // closed form: the height at 180 m, where it is within 20 cm of the centre at 1 m
    const double t = 180.0 / (v0 * std::cos(theta)), z = 1.5 + v0 * std::sin(theta) * t - 4.9 * t * t;
    const bool is_target = std::abs(z - 1.0) < 0.2;
    EXPECT_EQ(std::get<std::string>(row.cells[0]), is_target ? "target" : "ground");
    EXPECT_NEAR(std::get<double>(row.cells[1]), is_target ? z : 0.0, 1e-13);
  }
}

TEST(SweepProgram, SumsUp) {
  const TemporaryFolder folder;
  const std::string json = folder.file("s.json");
  const ProgramResult result = run_trajet({"sweep", kRifleShot, "--sample", "theta=normal(0.04deg,0.05deg)", "--count",
                                           "3000", "--seed", "3", "--report", "t,hit,impact(1).z", "--summary", json,
                                           "--out", folder.file("t.csv"), "--plot", folder.file("f.svg")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.out.find("3000 motions"), std::string::npos) << result.out;
  const Json summary = Json::parse(read_text(json));
  EXPECT_EQ(summary["count"], 3000);
  EXPECT_EQ(summary["seed"], 3);
  EXPECT_EQ(summary["failed"], 0);
  // theta hits between -0.0207 and 0.1066 degrees: the share of the normal distribution there
  const auto below = [](double degrees) { return 0.5 * std::erfc(-(degrees - 0.04) / 0.05 / std::sqrt(2.0)); };
  const double share = below(0.1066) - below(-0.0207);
  const Json& target = summary["hits"]["target"];
  EXPECT_NEAR(target["share"], share, 4.0 * std::sqrt(share * (1.0 - share) / 3000.0));
  EXPECT_LT(target["ci95"][0], target["share"]);
  EXPECT_GT(target["ci95"][1], target["share"]);
  EXPECT_EQ(target["count"].get<int>() + summary["hits"]["ground"]["count"].get<int>(), 3000);
  const Json& t = summary["columns"]["t"];
  EXPECT_EQ(t["count"], 3000);
  EXPECT_LE(t["min"], t["quantiles"]["0.05"]);
  EXPECT_LE(t["quantiles"]["0.05"], t["quantiles"]["0.5"]);
  EXPECT_FALSE(summary["columns"].contains("hit"));
  // the same numbers from the table
  double sum = 0.0;
  const std::vector<std::string> rows = lines_of(read_text(folder.file("t.csv")));
  for (std::size_t i = 1; i < rows.size(); ++i) sum += std::get<double>(read_csv_row(rows[i], 1).cells[0]);
  EXPECT_NEAR(t["mean"], sum / 3000.0, 1e-12);
  EXPECT_NE(read_text(folder.file("f.svg")).find("</svg>"), std::string::npos);
}

/// What a sweep has left when `kill -9` came some time after its first rows.
class KilledSweep : public testing::TestWithParam<std::string> {};

TEST_P(KilledSweep, GoesOnToTheSameBits) {
  const TemporaryFolder folder;
  const auto command = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> words{
        "sweep", kRifleShot, "--sample", "theta=normal(0.05deg,0.03deg)", "--count", "4000",      "--seed", "8",
        "--out", out,        "--report", "t,hit,max(z),impact(1).z",      "--quiet", "--threads", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const std::string whole = folder.file("whole" + GetParam()), killed = folder.file("killed" + GetParam());
  const std::string whole_json = folder.file("whole.json"), killed_json = folder.file("killed.json");
  ASSERT_EQ(run_trajet(command(whole, {"--summary", whole_json})).exit_code, 0);
  const std::string table = GetParam() == ".csv" ? killed : killed + ".csv";
  int kills = 0;
  for (int attempt = 0; attempt < 40; ++attempt) {
    const ProgramResult result =
        run_trajet(command(killed, {"--resume", "--summary", killed_json}), table + ".journal", SIGKILL);
    if (result.exit_code == 0) break;
    EXPECT_EQ(result.exit_code, 128 + SIGKILL);
    ++kills;
  }
  EXPECT_GT(kills, 0);
  EXPECT_EQ(run_trajet(command(killed, {"--resume"})).exit_code, 0);
  EXPECT_TRUE(read_text(killed) == read_text(whole)) << kills << " kills";
  EXPECT_FALSE(std::filesystem::exists(table + ".journal"));
  ASSERT_EQ(run_trajet(command(killed, {"--resume"})).exit_code, 0) << "nothing is left to do";
  EXPECT_TRUE(read_text(killed) == read_text(whole));
}
INSTANTIATE_TEST_SUITE_P(Formats, KilledSweep, testing::Values(".csv", ".h5"),
                         [](const auto& format) { return format.param.substr(1); });

TEST(SweepProgram, IsInterruptedBetweenBlocks) {
  const TemporaryFolder folder;
  const std::string out = folder.file("t.csv");
  const std::vector<std::string> command{"sweep",   kRifleShot, "--sample", "theta=normal(0.05deg,0.03deg)",
                                         "--count", "200000",   "--out",    out};
  const ProgramResult result = run_trajet(command, out, SIGINT);
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_NE(result.err.find("--resume goes on"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find(" motions"), std::string::npos) << "what was computed is summed up";
  const ProgramResult again = run_trajet(command);
  EXPECT_EQ(again.exit_code, 5);
  EXPECT_NE(again.err.find("--resume goes on with it"), std::string::npos) << again.err;
}

TEST(SweepProgram, ShardsJoinToTheWhole) {
  const TemporaryFolder folder;
  const auto sweep = [&](const std::string& out, const std::string& shard) {
    std::vector<std::string> words{"sweep", kRifleShot,  "--vary",  "theta=-1deg:1deg:101",
                                   "--out", out,         "--quiet", "--report",
                                   "t,hit", "--threads", "1"};
    if (!shard.empty()) words.insert(words.end(), {"--shard", shard});
    return run_trajet(words).exit_code;
  };
  const std::string whole = folder.file("whole.csv"), merged = folder.file("merged.csv");
  ASSERT_EQ(sweep(whole, ""), 0);
  std::vector<std::string> shards;
  for (const char* part : {"3/3", "1/3", "2/3"}) {
    shards.push_back(folder.file(std::string(part, 1) + ".csv"));
    ASSERT_EQ(sweep(shards.back(), part), 0);
  }
  EXPECT_EQ(run_trajet({"merge", shards[0], shards[1], shards[2], "--out", merged}).exit_code, 0);
  EXPECT_EQ(read_text(merged), read_text(whole));
  const ProgramResult gap = run_trajet({"merge", shards[0], shards[1], "--out", merged});
  EXPECT_NE(gap.err.find("missing in 1 place"), std::string::npos) << gap.err;
  EXPECT_EQ(run_trajet({"merge", shards[0], shards[0], "--out", merged}).exit_code, 5);
}

/// As `mpirun` starts a process.
struct RankEnvironment {
  RankEnvironment(int rank, const std::string& job) {
    setenv("OMPI_COMM_WORLD_RANK", std::to_string(rank).c_str(), 1);
    setenv("OMPI_COMM_WORLD_SIZE", "2", 1);
    setenv("PMIX_NAMESPACE", job.c_str(), 1);
  }
  ~RankEnvironment() {
    for (const char* name : {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "PMIX_NAMESPACE"}) unsetenv(name);
  }
};

TEST(SweepProgram, IsComputedBySeveralProcesses) {
  const TemporaryFolder folder;
  const auto command = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> words{"sweep", kRifleShot, "--vary",   "theta=-1deg:1deg:4001", "--quiet",
                                   "--out", out,        "--report", "t,hit,max(z)"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const std::string whole = folder.file("whole.csv"), out = folder.file("t.csv");
  const std::string whole_json = folder.file("whole.json"), json = folder.file("t.json");
  ASSERT_EQ(run_trajet(command(whole, {"--summary", whole_json})).exit_code, 0);
  const std::string journal = out + ".parts/0003.csv.journal";
  {
    const RankEnvironment environment(1, "first/1");
    EXPECT_EQ(run_trajet(command(out, {}), journal, SIGKILL).exit_code, 128 + SIGKILL);
  }
  {
    const RankEnvironment environment(1, "second/2");
    EXPECT_EQ(run_trajet(command(out, {})).exit_code, 5) << "what is there is not overwritten";
    EXPECT_EQ(run_trajet(command(out, {"--resume"})).exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(out)) << "the process of number 0 joins the parts";
  }
  {
    const RankEnvironment environment(0, "second/2");
    EXPECT_EQ(run_trajet(command(out, {"--resume", "--summary", json})).exit_code, 0);
  }
  EXPECT_EQ(read_text(out), read_text(whole));
  EXPECT_EQ(read_text(json), read_text(whole_json));
  EXPECT_FALSE(std::filesystem::exists(out + ".parts"));
  for (const int rank : {0, 1}) {
    const RankEnvironment environment(rank, "third/3");
    EXPECT_EQ(run_trajet(command(out, {"--resume"})).exit_code, 0) << "nothing is left to do";
    EXPECT_FALSE(std::filesystem::exists(out + ".parts"));
  }
  const RankEnvironment environment(1, "fourth/4");
  EXPECT_EQ(run_trajet(command("-", {})).exit_code, 2);
}

TEST(SweepProgram, ReplaysOneMotion) {
  const TemporaryFolder folder;
  const std::vector<std::string> sample{"--sample", "theta=normal(0.05deg,0.03deg)", "--seed", "4"};
  std::vector<std::string> all{"sweep", kRifleShot, "--count", "20", "--out", "-", "--report", "t,hit,z"};
  std::vector<std::string> one{"sweep", kRifleShot, "--only", "13", "--json", folder.file("r.json"), "--quiet"};
  all.insert(all.end(), sample.begin(), sample.end());
  one.insert(one.end(), sample.begin(), sample.end());
  const SweepRow row = read_csv_row(lines_of(run_trajet(all).out)[14], 1);
  EXPECT_EQ(run_trajet(one).exit_code, 0);
  const Json report = Json::parse(read_text(folder.file("r.json")));
  EXPECT_EQ(report["parameters"]["theta"], row.values[0]);
  EXPECT_EQ(report["end_time"], std::get<double>(row.cells[0]));
  EXPECT_EQ(report["impacts"][0]["with"], std::get<std::string>(row.cells[1]));
  EXPECT_EQ(report["final"][0]["position"][2], std::get<double>(row.cells[2]));
}

TEST(SweepProgram, EndsWhenItKnowsEnough) {
  const ProgramResult result = run_trajet({"sweep", kRifleShot, "--sample", "theta=normal(0.05deg,0.03deg)", "--until",
                                           "ci(hit == 'target') < 2%", "--report", "hit", "--out", "-"});
  EXPECT_EQ(result.exit_code, 0);
  const std::size_t rows = lines_of(result.out).size() - 1;
  // the share is 0.96: a plain interval is that narrow after 4 · 0.96 · 0.04 / 0.02² = 380 motions
  EXPECT_GT(rows, 380U);
  EXPECT_LT(rows, 4000U);
  EXPECT_EQ(lines_of(result.out)[0], "index,theta,hit");
}

TEST(SweepProgram, SaysWhatIsWrong) {
  struct Case {
    std::vector<std::string> words;
    int exit_code;
    std::string message;
  };
  const std::vector<Case> cases{
      {{}, 2, "nothing varies"},
      {{"--vary", "thet=0:1:3"}, 2, "did you mean 'theta'"},
      {{"--vary", "theta=0:1"}, 2, "a number of values is missing"},
      {{"--vary", "theta=0 m:1 m:3"}, 2, "--vary theta"},
      {{"--vary", "theta=0 deg:1 deg:2.5"}, 2, "a whole number of values"},
      {{"--vary", "theta=0 deg:1 deg:3", "--vary", "theta=0 deg:1 deg:3"}, 2, "varies twice"},
      {{"--vary", "target.on_hit=0:1:3"}, 2, "is a word"},
      {{"--vary", "bullet.position=0:1:3"}, 2, "--vary bullet.position: error: a vector is expected"},
      {{"--vary", "target.radius=-2:-1:3"}, 2, "must be positive"},
      {{"--sample", "theta=uniform(0 deg,1 deg)", "--seed", "-1"}, 2, "--seed"},
      {{"--vary", "theta=0 deg:1 deg:3", "--count", "5"}, 2, "goes with --sample"},
      {{"--sample", "theta=norml(0,1)"}, 2, "did you mean 'normal'"},
      {{"--sample", "theta=normal(0 deg)"}, 2, "takes 2 numbers"},
      {{"--sample", "theta=normal(0 deg,-1 deg)"}, 2, "must be positive"},
      {{"--sample", "theta=uniform(1 deg,0 deg)"}, 2, "below the high one"},
      {{"--sample", "theta=uniform(0 deg,1 deg)", "--design", "lhc"}, 2, "did you mean 'lhs'"},
      {{"--sample", "theta=uniform(0 deg,1 deg)", "--correlate", "theta,v0=0.5"}, 2, "'v0' is not sampled"},
      {{"--sample", "theta=uniform(0 deg,1 deg)", "--until", "t < 1"}, 2, "ci(CONDITION)"},
      {{"--sample", "theta=uniform(0 deg,1 deg)", "--until", "ci(t) < 1"}, 2, "is no condition"},
      {{"--sample", "theta=uniform(0 deg,1 deg)", "--shard", "0/3"}, 2, "I/N with I from 1 to N"},
      {{"--sample", "theta=uniform(0 deg,1 deg)", "--resume"}, 2, "--out FILE.csv"},
      {{"--sample", "theta=uniform(0 deg,1 deg)", "--json", "-"}, 2, "goes with --only"},
      {{"--sample", "theta=uniform(0 deg,1 deg)", "--only", "1000"}, 2, "0 to 999"},
      {{"--sample", "theta=uniform(0 deg,1 deg)", "--report", "t,bulet.x"}, 2, "did you mean"},
      {{"--sample", "theta=uniform(0 deg,1 deg)", "--out", "t.txt"}, 2, ".csv or .h5"},
  };
  for (const Case& each : cases) {
    std::vector<std::string> words{"sweep", kRifleShot};
    words.insert(words.end(), each.words.begin(), each.words.end());
    const ProgramResult result = run_trajet(words);
    EXPECT_EQ(result.exit_code, each.exit_code) << result.err;
    EXPECT_NE(result.err.find(each.message), std::string::npos) << each.message << " in:\n" << result.err;
  }
}

TEST(SweepProgram, CountsMotionsThatFail) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.toml", R"([parameters]
a = 1
[time]
end = 1
[[body]]
name = "ball"
shape = "sphere"
radius = "a"
)");
  const ProgramResult result =
      run_trajet({"sweep", scene, "--vary", "a=-1:1:4", "--report", "t,status", "--out", folder.file("t.csv")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(read_text(folder.file("t.csv")),
            "index,a,t,status\n0,-1,,failed\n1,-0.33333333333333337,,failed\n2,0.33333333333333326,1,finished\n"
            "3,1,1,finished\n");
  EXPECT_NE(result.out.find("4 motions, 2 failed"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("2 of 4 motions failed, the first of them: motion 0: "), std::string::npos) << result.err;
}

}  // namespace
}  // namespace trajet
