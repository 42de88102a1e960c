#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "golden/program.hpp"

namespace trajet {
namespace {

/// A cannon without drag, with a target at that distance.
std::string write_cannon(const TemporaryFolder& folder, double x) {
  std::string path = folder.file("cannon.toml");
  std::ofstream(path) << R"(
[parameters]
theta = "40 deg"
[time]
end = "20 s"
[[body]]
name = "shell"
velocity = "50*[cos(theta), 0, sin(theta)]"
acceleration = [0, 0, -9.81]
[[obstacle]]
name = "target"
shape = "sphere"
radius = 1
center = [)" << x << ", 0, 10]\n";
  return path;
}

TEST(AimCommand, TellsTheSolutionsInDegreesTooAndAsJson) {
  const TemporaryFolder folder;
  const std::string scene = write_cannon(folder, 200), json = folder.file("aim.json");
  const ProgramResult result =
      run_trajet({"aim", scene, "--vary", "theta=1deg:89deg", "--hit", "target", "--json", json});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("found: 2 solutions"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("29.67459274"), std::string::npos) << result.out;  // deg, of the closed form
  const std::string text = read_text(json);
  for (const char* part : {"\"status\": \"found\"", "\"theta\": 0.51791934749", "\"theta\": 1.10283537502",
                           "\"bounces\": 0", "\"closest\"", "\"miss\"", "\"point\""})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
}

TEST(AimCommand, SaysHowFarATargetIsOutOfReach) {
  const TemporaryFolder folder;
  const std::string scene = write_cannon(folder, 260);
  const ProgramResult result =
      run_trajet({"aim", scene, "--vary", "theta=1deg:89deg", "--hit", "target", "--json", "-"});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("out of reach by 10.7264 m"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("\"status\": \"unreachable\""), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("\"solutions\": []"), std::string::npos) << result.out;
}

TEST(AimCommand, RefusesWhatIsNoTaskAndNoRange) {
  const TemporaryFolder folder;
  const std::string scene = write_cannon(folder, 200);
  EXPECT_EQ(run_trajet({"aim", scene, "--vary", "theta=1deg:89deg"}).exit_code, 2);
  EXPECT_NE(
      run_trajet({"aim", scene, "--vary", "theta=1deg:89deg", "--hit", "tagret"}).err.find("did you mean 'target'"),
      std::string::npos);
  const ProgramResult range = run_trajet({"run", scene, "--set", "theta=0:10:0.5"});
  EXPECT_NE(range.exit_code, 0);
  EXPECT_NE(range.err.find("trajet sweep --vary theta=LOW:HIGH:COUNT"), std::string::npos) << range.err;
}

}  // namespace
}  // namespace trajet
