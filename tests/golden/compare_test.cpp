#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace trajet {
namespace {

using Json = nlohmann::ordered_json;

const std::string kDrag = TRAJET_SOURCE_DIR "/examples/notes/drag_3d.toml";

TEST(CompareCommand, ReproducesTheCoursesNumbers) {
  const TemporaryFolder folder;
  const ProgramResult result = run_trajet({"compare", kDrag, "--methods", "euler,rk4", "--steps", "10,40", "--json",
                                           folder.file("c.json"), "--csv", folder.file("c.csv")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("reference: exact"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("1.3979"), std::string::npos) << result.out;

  const Json report = Json::parse(read_text(folder.file("c.json")));
  EXPECT_EQ(report["reference"]["name"], "exact");
  EXPECT_EQ(report["components"], Json({"particle.r", "particle.v"}));
  ASSERT_EQ(report["rows"].size(), 4u);
  const double published[] = {1.39789527279837, 0.0702641221366347, 0.0542477931734899, 7.53983131197348e-5};
  for (std::size_t i = 0; i < 4; ++i) {
    const Json& row = report["rows"][i];
    EXPECT_NEAR(row["max_error_at_nodes"], published[i], 5e-15);
    EXPECT_EQ(row["status"], "finished");
    EXPECT_EQ(row["failure"], nullptr);
    EXPECT_EQ(row["rtol"], nullptr);
    EXPECT_EQ(row["steps"], i % 2 == 0 ? 10 : 40);
    EXPECT_GT(row["law_evaluations"], 0);
  }

  std::istringstream csv(read_text(folder.file("c.csv")));
  std::vector<std::string> lines;
  for (std::string line; std::getline(csv, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_TRUE(lines[0].starts_with("method,step,rtol,atol,status,failure,end_time,compared_until,error_at_end,"));
  EXPECT_TRUE(lines[1].starts_with("euler,1.0,,,finished,,10.0,10.0,1.397895272798"));
}

TEST(CompareCommand, ComparesAllMethodsUnlessToldWhich) {
  const Json report = Json::parse(run_trajet({"compare", kDrag, "--json", "-"}).out);
  const std::string methods = run_trajet({"methods"}).out;
  for (const Json& row : report["rows"])
    EXPECT_NE(methods.find(row["method"].get<std::string>()), std::string::npos) << row;
  EXPECT_GE(report["rows"].size(), 15u);
  // a tighter tolerance and a shorter step each make a smaller error, down to rounding; with both, either may rule
  const Json* previous = nullptr;
  for (const Json& row : report["rows"]) {
    if (row["status"] != "finished" || (!row["step"].is_null() && !row["rtol"].is_null())) continue;
    if (previous != nullptr && (*previous)["method"] == row["method"] && (*previous)["max_error"] > 1e-12) {
      EXPECT_LT(row["max_error"], (*previous)["max_error"]) << row;
    }
    previous = &row;
  }
}

TEST(CompareCommand, ComparesWaysOfCarryingOrientations) {
  const std::string box = TRAJET_SOURCE_DIR "/examples/notes/parallelepiped.toml";
  const ProgramResult result = run_trajet({"compare", box, "--methods", "euler,rk4", "--steps", "20", "--orientations",
                                           "matrix,lie,matrix", "--json", "-"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const Json report = Json::parse(result.out);
  std::vector<std::string> rows;
  for (const Json& row : report["rows"])
    rows.push_back(row["method"].get<std::string>() + " " + row["orientation"].get<std::string>());
  EXPECT_EQ(rows,
            (std::vector<std::string>{"euler matrix", "euler rotation-vector", "rk4 matrix", "rk4 rotation-vector"}));
  // the ball's |q| = 1.2832 by Euler's method, or normalised an angle 0.0235 rad short; a closed form has neither
  const Json ball =
      Json::parse(run_trajet({"compare", TRAJET_SOURCE_DIR "/examples/notes/soccer_ball.toml", "--methods", "euler",
                              "--steps", "100", "--orientations", "quaternion,quaternion-normalized,exact",
                              "--reference", "taylor", "--json", "-"})
                      .out);
  EXPECT_GT(ball["rows"][0]["max_error"], 0.2);
  EXPECT_NEAR(ball["rows"][1]["max_error"], 0.0235 / 2.0 / std::sqrt(2.0), 1e-4) << "of q's largest component";
  EXPECT_LT(ball["rows"][2]["max_error"], 1e-12);
  // nothing turns there
  const Json drag = Json::parse(run_trajet({"compare", kDrag, "--methods", "rk4", "--json", "-"}).out);
  EXPECT_EQ(drag["rows"][0]["orientation"], nullptr);
}

TEST(CompareCommand, TellsOfSolidsWhatBecomesOfThem) {
  const TemporaryFolder folder;
  const std::string ball = TRAJET_SOURCE_DIR "/examples/notes/soccer_ball.toml";
  const ProgramResult result = run_trajet({"compare", ball, "--methods", "euler", "--steps", "100", "--json",
                                           folder.file("c.json"), "--csv", folder.file("c.csv")});
  EXPECT_NE(result.out.find("|q|"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("1.28323"), std::string::npos) << result.out;
  const Json report = Json::parse(read_text(folder.file("c.json")));
  EXPECT_EQ(report["components"], Json({"ball.r", "ball.v", "ball.orientation", "ball.w"}));
  const Json& row = report["rows"][0];
  EXPECT_NEAR(row["quaternion_norm_at_end"], 1.28322581493537, 5e-15);  // F104
  EXPECT_NEAR(row["angle_error_at_end"], 0.0234997669214770, 1e-14);    // F105
  EXPECT_EQ(row["max_energy_drift"], nullptr);
  EXPECT_NE(read_text(folder.file("c.csv")).find(",determinant_at_end,quaternion_norm_at_end,angle_error_at_end,"),
            std::string::npos);
  // nothing of it where nothing turns
  const ProgramResult particle = run_trajet({"compare", kDrag, "--methods", "euler", "--csv", folder.file("d.csv")});
  EXPECT_EQ(particle.out.find("|q|"), std::string::npos) << particle.out;
  EXPECT_EQ(read_text(folder.file("d.csv")).find("determinant"), std::string::npos);
}

TEST(CompareCommand, TellsWhatIsWrong) {
  struct Case {
    std::vector<std::string> options;
    int exit_code;
    std::string message;
  };
  const Case cases[] = {
      {{"--methods", "rk44"}, 2, "--methods: error: unknown method 'rk44'; did you mean 'rk4'?"},
      {{"--orientations", "matrix"}, 2, "--orientations: error: no body of the scene turns"},
      {{"--orientations", "matrx"}, 2, "--orientations: error: unknown way of carrying orientations 'matrx'"},
      {{"--steps", "0"}, 2, "--steps"},
      {{"--steps", "ten"}, 2, "--steps"},
      {{"--rtols", "-1"}, 2, "--rtols"},
      {{"--reference", "exactly"}, 2, "--reference: error: unknown method 'exactly'"},
      {{"--json", "-", "--csv", "-"}, 2, "standard output"},
      {{"--json", "/nonexistent/folder/c.json", "--methods", "rk4"}, 5, "cannot write"},
  };
  for (const Case& c : cases) {
    std::vector<std::string> arguments = {"compare", kDrag};
    arguments.insert(arguments.end(), c.options.begin(), c.options.end());
    const ProgramResult result = run_trajet(arguments);
    EXPECT_EQ(result.exit_code, c.exit_code) << c.message;
    EXPECT_NE(result.err.find(c.message), std::string::npos) << result.err;
  }
}

TEST(CompareCommand, FailsOnlyIfNothingSucceeds) {
  const TemporaryFolder folder;
  // y' = y^2 from 1 is infinite at t = 1: who controls the error notices, who does not goes past
  const std::string scene =
      folder.write("blow_up.toml",
                   "[time]\nend = 0.5\n[[state]]\nname = \"y\"\nvalue = 1\nrate = \"y^2\"\n[method]\nmax_steps = 4\n");
  const ProgramResult some = run_trajet({"compare", scene, "--methods", "rk4", "--steps", "3,30"});
  EXPECT_EQ(some.exit_code, 0) << some.err;
  EXPECT_NE(some.out.find("without result:\n  rk4, step 0.0166667 s: more than max_steps = 4"), std::string::npos)
      << some.out;
  EXPECT_EQ(run_trajet({"compare", scene, "--methods", "rk4", "--steps", "30"}).exit_code, 4);
}

}  // namespace
}  // namespace trajet
