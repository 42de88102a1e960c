#include <gtest/gtest.h>
#include <stdlib.h>

#include "program.hpp"

namespace trajet {
namespace {

const std::string kExamples = TRAJET_SOURCE_DIR "/examples/";

/// The text of an SVG, without its tags.
std::string words(const std::string& svg) {
  std::string text;
  bool in_tag = false;
  for (const char c : svg) {
    if (c == '<') in_tag = true;
    if (!in_tag) text += c;
    if (c == '>') in_tag = false;
  }
  return text;
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

std::string figure(std::vector<std::string> arguments) {
  const TemporaryFolder folder;
  arguments.insert(arguments.end(), {"--quiet", "--plot", folder.file("f.svg")});
  const ProgramResult result = run_trajet(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const std::string svg = read_text(folder.file("f.svg"));
  EXPECT_TRUE(svg.starts_with("<?xml") && svg.find("</svg>") != std::string::npos);
  return svg;
}

TEST(Figure, OfARunHasThreeQuantitiesAndThePath) {
  const std::string svg = figure({"run", kExamples + "free_kick.toml"});
  const std::string text = words(svg);
  for (const char* label : {"A free kick over the wall", "method taylor; impacts: 1", "position [m]", "velocity [m/s]",
                            "acceleration [m/s²]", "time [s]", "x [m]", "y [m]", "z [m]", "ball", "impact"})
    EXPECT_NE(text.find(label), std::string::npos) << label;
  // the course's colours, one for each quantity (F19): three components each, and their keys
  for (const char* color : {"rgb(  0,  80, 200)", "rgb(  0, 138,  32)", "rgb(208,  16,  16)"})
    EXPECT_GE(count(svg, color), 3) << color;
}

TEST(Figure, LeavesOutWhatDoesNotMove) {
  // F27: on a line, no path is worth a panel
  const std::string line = words(figure({"run", kExamples + "notes/velocity_dependent.toml"}));
  EXPECT_NE(line.find("velocity [m/s]"), std::string::npos);
  EXPECT_EQ(line.find("y [m]"), std::string::npos);
  const std::string plane = words(figure({"run", kExamples + "notes/rifle_shot.toml"}));
  EXPECT_NE(plane.find("z [m]"), std::string::npos);
  EXPECT_EQ(plane.find("y [m]"), std::string::npos);
}

TEST(Figure, OfStatesAndManyBodies) {
  const TemporaryFolder folder;
  std::string scene =
      "title = \"it's a_b\"\n[time]\nend = 2\n[[state]]\nname = \"heat_1\"\nvalue = 1\nrate = \"-heat_1\"\n";
  const std::string states = folder.write("states.toml", scene);
  const std::string text = words(figure({"run", states}));
  EXPECT_NE(text.find("heat_1"), std::string::npos);
  EXPECT_TRUE(text.find("it's a_b") != std::string::npos || text.find("it&apos;s a_b") != std::string::npos ||
              text.find("it&#39;s a_b") != std::string::npos)
      << text.substr(0, 400);
  for (int i = 0; i < 5; ++i)
    scene += "[[body]]\nname = \"b" + std::to_string(i) + "\"\nvelocity = [1, " + std::to_string(i) + ", 0]\n";
  const std::string many = words(figure({"run", folder.write("many.toml", scene)}));
  EXPECT_NE(many.find("the first 3 of 5 bodies"), std::string::npos);
  EXPECT_NE(many.find("b4"), std::string::npos) << "all paths are drawn";
  // a run that ends where it begins
  figure({"run", states, "--end", "0 s"});
}

TEST(Figure, OfAComparisonHasTheCoursesColours) {
  const std::string drag = kExamples + "notes/drag_3d.toml";
  const std::string svg = figure({"compare", drag, "--methods", "euler,rk4", "--steps", "10,40"});
  const std::string text = words(svg);
  for (const char* label : {"exact", "euler, 10 steps", "euler, 40 steps", "rk4, 10 steps", "law evaluations",
                            "time [ms]", "error", "reference (red): the closed form"})
    EXPECT_NE(text.find(label), std::string::npos) << label;
  for (const char* color : {"rgb(208,  16,  16)", "rgb(  0,  80, 200)", "rgb(  0,   0,   0)"})  // F48
    EXPECT_GE(count(svg, color), 1) << color;
  const std::string shown = words(figure({"compare", drag, "--methods", "rk4", "--show", "particle.z"}));
  EXPECT_NE(shown.find("particle.z [m]"), std::string::npos);
  EXPECT_EQ(shown.find("y [m]"), std::string::npos);
  figure({"compare", drag});  // all methods
}

TEST(Figure, ComesInThreeFormats) {
  const TemporaryFolder folder;
  const std::string scene = kExamples + "notes/constant_acceleration.toml";
  EXPECT_EQ(run_trajet({"run", scene, "--quiet", "--plot", folder.file("f.png")}).exit_code, 0);
  EXPECT_TRUE(read_text(folder.file("f.png")).starts_with("\x89PNG\r\n"));
  EXPECT_EQ(run_trajet({"run", scene, "--quiet", "--plot", folder.file("f.pdf")}).exit_code, 0);
  EXPECT_TRUE(read_text(folder.file("f.pdf")).starts_with("%PDF-"));
  for (const char* name : {"f.gif", "f", "svg", "-"}) {
    const ProgramResult other = run_trajet({"run", scene, "--plot", name});
    EXPECT_EQ(other.exit_code, 2) << name;
    EXPECT_NE(other.err.find(".svg, .png or .pdf"), std::string::npos) << other.err;
  }
  const ProgramResult nowhere = run_trajet({"run", scene, "--plot", folder.file("no/f.svg")});
  EXPECT_EQ(nowhere.exit_code, 5);
  const ProgramResult unknown = run_trajet({"compare", scene, "--plot", folder.file("c.svg"), "--show", "particle.w"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("--show: error: there is no component 'particle.w'"), std::string::npos) << unknown.err;
}

TEST(Figure, NeedsGnuplot) {
  const TemporaryFolder folder;
  const std::string path = getenv("PATH");
  setenv("PATH", folder.file("").c_str(), 1);
  const ProgramResult result = run_trajet({"run", kExamples + "notes/rifle_shot.toml", "--plot", folder.file("f.svg")});
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_NE(result.err.find("gnuplot-nox"), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "") << "nothing is computed in vain";
}

}  // namespace
}  // namespace trajet
