// A scene's `up = "y"` in figures: the axis that points up has its name upward.

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <string>

#include "program.hpp"

namespace trajet {
namespace {

/// Where the names of the axes of the path stand in a figure, by name: from the left and from above.
std::map<std::string, std::pair<double, double>> axis_names(const std::string& scene) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("s.toml")) << scene;
  const ProgramResult result = run_trajet({"run", folder.file("s.toml"), "--quiet", "--plot", folder.file("f.svg")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string svg = read_text(folder.file("f.svg"));
  static const std::regex kName(R"(translate\(([0-9.]+),([0-9.]+)\)[^>]*>\s*<text>([xyz]) \[m\]</text>)");
  std::map<std::string, std::pair<double, double>> names;
  for (auto match = std::sregex_iterator(svg.begin(), svg.end(), kName); match != std::sregex_iterator(); ++match)
    names[(*match)[3]] = {std::stod((*match)[1]), std::stod((*match)[2])};
  return names;
}

std::string shot(const std::string& up, const std::string& velocity, const std::string& acceleration) {
  return up + "[time]\nend = 1\n[[body]]\nname = \"p\"\nvelocity = " + velocity + "\nacceleration = " + acceleration +
         "\n";
}

TEST(UpAxis, HasItsNameUpwardInFigures) {
  // in space the upward axis is at the left
  const auto z = axis_names(shot("", "[1, 2, 5]", "[0, 0, -9.81]"));
  const auto y = axis_names(shot("up = \"y\"\n", "[1, 5, -2]", "[0, -9.81, 0]"));
  ASSERT_EQ(z.size(), 3u);
  ASSERT_EQ(y.size(), 3u);
  for (const char* level : {"x", "y"}) EXPECT_LT(z.at("z").first, z.at(level).first) << level;
  for (const char* level : {"x", "z"}) EXPECT_LT(y.at("y").first, y.at(level).first) << level;
  // in a plane it is beside the picture, the other beneath
  const auto plane = axis_names(shot("up = \"y\"\n", "[0, 5, 2]", "[0, -9.81, 0]"));
  ASSERT_EQ(plane.size(), 2u);
  EXPECT_LT(plane.at("y").first, plane.at("z").first);
  EXPECT_LT(plane.at("y").second, plane.at("z").second);
}

}  // namespace
}  // namespace trajet
