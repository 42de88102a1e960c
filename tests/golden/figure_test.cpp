#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <sstream>

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

/// The SVG that `--plot` makes; `warning`: part of what is said on standard error, or nothing is.
std::string figure(std::vector<std::string> arguments, const std::string& warning = "") {
  const TemporaryFolder folder;
  arguments.insert(arguments.end(), {"--quiet", "--plot", folder.file("f.svg")});
  const ProgramResult result = run_trajet(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err.empty(), warning.empty()) << result.err;
  EXPECT_NE(result.err.find(warning), std::string::npos) << result.err;
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

/// How many corners the line of a colour has that has the most.
std::size_t most_corners(const std::string& svg, const std::string& color) {
  std::size_t most = 0;
  const std::string begin = "<path stroke='" + color + "'";
  for (std::size_t at = svg.find(begin); at != std::string::npos; at = svg.find(begin, at + 1)) {
    const std::string path = svg.substr(at, svg.find("/>", at) - at);
    most = std::max(most, static_cast<std::size_t>(std::ranges::count(path, ',')));
  }
  return most;
}

constexpr const char* kBlue = "rgb(  0,  80, 200)";

TEST(Figure, HasSmoothCurvesInTheScaleOfEachAxis) {
  // 180 m far, 0.5 m down: a parabola of the width of the panel is more than five straight lines
  EXPECT_GT(most_corners(figure({"run", kExamples + "notes/rifle_shot.toml"}), kBlue), 15U);
  EXPECT_GT(most_corners(figure({"run", kExamples + "notes/cube.toml"}), kBlue), 15U);
}

TEST(Figure, HasNamesForPeople) {
  const TemporaryFolder folder;
  const std::string scene =
      folder.write("s.toml", "title = \"a < b & c\"\n[time]\nend = 1\n[[body]]\nname = \"b\"\nvelocity = [1, 2, 3]\n");
  const std::string svg = figure({"run", scene});
  EXPECT_NE(svg.find("<title>a &lt; b &amp; c</title>"), std::string::npos);
  EXPECT_NE(svg.find("<title>x</title>"), std::string::npos);
  EXPECT_NE(svg.find("<title>b</title>"), std::string::npos) << "the path";
  EXPECT_EQ(svg.find("<title>Gnuplot"), std::string::npos);
  EXPECT_EQ(svg.find("<title>gnuplot_plot"), std::string::npos);
}

TEST(Figure, OfOneCoordinateIsASolidLineWithTypographicMinus) {
  const TemporaryFolder folder;
  const std::string scene = folder.write(
      "s.toml", "[time]\nend = 1\n[[body]]\nname = \"b\"\nposition = [0, 0, 5]\nacceleration = [0, 0, -10]\n");
  const std::string svg = figure({"run", scene});
  EXPECT_EQ(svg.find("stroke-dasharray"), std::string::npos);
  const std::string text = words(svg);
  EXPECT_NE(text.find("\u22125"), std::string::npos) << text;
  EXPECT_EQ(text.find("-5"), std::string::npos);
}

TEST(Figure, TellsWhatIsConstantInsteadOfDrawingIt) {
  const std::string text = words(figure({"run", kExamples + "notes/rotated_vector.toml"}));
  EXPECT_NE(text.find("ω, world = (0, 0, 1.571) rad/s, constant"), std::string::npos) << text;
  EXPECT_EQ(text.find("time [s]"), std::string::npos);
  // a constant beside what changes has its panel
  EXPECT_NE(words(figure({"run", kExamples + "notes/free_fall.toml"})).find("acceleration"), std::string::npos);
}

TEST(Figure, HasNoPanelForRounding) {
  const TemporaryFolder folder;
  const std::string scene = folder.write(
      "s.toml",
      "[time]\nend = 1\n[[body]]\nname = \"b\"\nvelocity = [1, 0, 0]\nacceleration = [0, \"1e-15*sin(9*t)\", 0]\n");
  const std::string svg = figure({"run", scene}), text = words(svg);
  EXPECT_NE(text.find("velocity [m/s]"), std::string::npos);
  EXPECT_EQ(text.find("acceleration"), std::string::npos);
  EXPECT_EQ(svg.find("<title>y</title>"), std::string::npos);
  EXPECT_EQ(words(figure({"compare", kExamples + "t_handle.toml", "--methods", "taylor"})).find("|det R"),
            std::string::npos);
}

TEST(Figure, HasTheColoursOfTheScene) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.toml", R"([time]
end = 1
[[body]]
name = "a"
shape = "sphere"
radius = 0.3
velocity = [1, 2, 3]
color = "#ff4000"
[[body]]
name = "white"
position = [0, 0, 1]
velocity = [3, 2, 1]
color = "white"
[[obstacle]]
name = "o"
shape = "box"
center = [3, 0, 0]
size = [1, 1, 1]
color = "navy"
)");
  const std::string svg = figure({"run", scene});
  EXPECT_GE(count(svg, "stroke='rgb(255,  64,   0)'"), 1) << "the path";
  EXPECT_GE(count(svg, "stroke='rgb(  0,   0, 102)'"), 1) << "the edges of the box, a fifth darker";
  EXPECT_GE(count(svg, "stroke='rgb(179, 179, 179)'"), 1) << "white on white paper";
}

/// Each `<polygon fill = 'COLOR' … points = 'x,y …'/>` of an SVG.
struct Polygon {
  std::string fill;
  double left = 1e9, right = -1e9, bottom = -1e9;  // pixels
};
std::vector<Polygon> polygons(const std::string& svg) {
  std::vector<Polygon> found;
  for (std::size_t at = svg.find("<polygon"); at != std::string::npos; at = svg.find("<polygon", at + 1)) {
    const auto value = [&](const std::string& name) {
      const std::size_t begin = svg.find('\'', svg.find(name, at)) + 1;
      return svg.substr(begin, svg.find('\'', begin) - begin);
    };
    Polygon polygon{value("fill")};
    std::istringstream points(value("points"));
    for (double x = 0, y = 0, comma = 0; points >> x && points.get() == ',' && points >> y; comma = y) {
      polygon.left = std::min(polygon.left, x);
      polygon.right = std::max(polygon.right, x);
      polygon.bottom = std::max(polygon.bottom, comma);
    }
    found.push_back(polygon);
  }
  return found;
}

/// How wide the solids of the strip of poses are, from the first to the last.
std::vector<double> widths_of_strip(const std::string& svg, std::size_t count) {
  const std::vector<Polygon> all = polygons(svg);
  double bottom = 0.0, width = 0.0;
  for (const Polygon& polygon : all) {
    bottom = std::max(bottom, polygon.bottom);
    width = std::max(width, polygon.right);
  }
  std::vector<double> left(count, 1e9), right(count, -1e9);
  for (const Polygon& polygon : all) {
    if (polygon.bottom < bottom - 110.0) continue;  // that of the paths
    const double middle = 0.5 * (polygon.left + polygon.right);
    const auto cell =
        std::min(static_cast<std::size_t>((middle - 24.0) / (1120.0 - 48.0) * static_cast<double>(count)), count - 1);
    left[cell] = std::min(left[cell], polygon.left);
    right[cell] = std::max(right[cell], polygon.right);
  }
  for (std::size_t i = 0; i < count; ++i) right[i] -= left[i];
  return right;
}

TEST(Figure, ShowsHowSolidsStandAndThatEulersBallGrows) {
  const std::string scene = kExamples + "notes/soccer_ball.toml";
  const std::string text = words(figure({"run", scene}));
  for (const char* label : {"ball, seen from its centre", "0 s", "5 s", "10 s"})
    EXPECT_NE(text.find(label), std::string::npos) << label;
  // |q|^2 = 1.2832^2 times as large after 10 s (F99); the outline of the turning polyhedron is a circle to 8 %
  const std::vector<double> grown = widths_of_strip(figure({"run", scene}), 11);
  EXPECT_NEAR(grown.back() / grown.front(), 1.2832 * 1.2832, 0.15);
  const std::vector<double> kept =
      widths_of_strip(figure({"run", scene, "--orientation", "quaternion-normalized"}), 11);
  EXPECT_NEAR(kept.back() / kept.front(), 1.0, 0.09);
}

TEST(Figure, ShowsWhatIsHit) {
  constexpr const char* kObstacle = "rgb(138, 138, 128)";
  EXPECT_GE(count(figure({"run", kExamples + "notes/rifle_shot.toml"}), kObstacle), 2) << "target and ground, edge on";
  const auto obstacles = [](const std::string& svg) {  // in space they are transparent
    return count(svg, "fill-opacity = '0.500000'");
  };
  EXPECT_EQ(obstacles(figure({"run", kExamples + "notes/cube.toml"})), 6 + 1) << "the cube's faces, the ground";
  EXPECT_EQ(obstacles(figure({"run", kExamples + "free_kick.toml"})), 4 * 6 + 1 + 1)
      << "the players, the goal, the ground";
}

TEST(Figure, OfAVectorThatTurnsHasItInBlueThenInRed) {
  const TemporaryFolder folder;
  const std::string scene = folder.write(
      "v.toml",
      "[time]\nend = 1\n[[body]]\nname = \"b\"\nangular_velocity = [0, 0, \"pi/2\"]\npoints = { v = [1, 1, 1] }\n");
  const std::string svg = figure({"run", scene});
  EXPECT_GE(count(svg, "stroke='rgb(  0,  80, 200)'"), 1);
  EXPECT_GE(count(svg, "stroke='rgb(208,  16,  16)'"), 1);
  EXPECT_NE(words(svg).find("axis of rotation"), std::string::npos);
  // before it turns
  EXPECT_EQ(count(figure({"run", scene, "--end", "0 s"}), "stroke='rgb(208,  16,  16)'"), 0);
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
  figure({"compare", drag}, "warning: quadrature, ");  // all methods
}

/// All numbers among the words of an SVG.
std::vector<double> numbers(const std::string& svg) {
  std::string text = words(svg);
  for (std::size_t at = 0; (at = text.find("\u2212", at)) != std::string::npos;) text.replace(at, 3, "-");
  std::istringstream lines(text);
  std::vector<double> found;
  for (std::string word; lines >> word;) {
    std::size_t used = 0;
    try {
      const double value = std::stod(word, &used);
      if (used == word.size()) found.push_back(value);
    } catch (const std::exception&) {
    }
  }
  return found;
}

TEST(Figure, OfAComparisonIsNotSpoiltByAMethodThatRunsAway) {
  const TemporaryFolder folder;
  // Euler's method multiplies the amplitude by sqrt(1 + 10^2) a step
  const std::string scene = folder.write("s.toml", R"([time]
end = 10
[[body]]
name = "b"
position = [1, 0, 0]
acceleration = "-100*r"
)");
  const std::string svg = figure({"compare", scene, "--methods", "taylor,euler", "--steps", "10", "--rtols", "1e-6"});
  const std::string text = words(svg);
  EXPECT_NE(text.find("euler, 10 steps (leaves the picture)"), std::string::npos) << text;
  EXPECT_NE(text.find("euler, 10 steps: an error of"), std::string::npos) << text;
  EXPECT_NE(text.find("beyond the diagrams"), std::string::npos);
  // ticks of the reference; words join 10 and its exponent
  for (const double number : numbers(svg)) EXPECT_LT(std::abs(number), 1000.0);
}

TEST(Figure, ShowsWhereWhatIsDrivenComes) {
  const TemporaryFolder folder;
  const auto lines = [&](const std::string& motion, const std::string& body) {
    return count(figure({"run", folder.write("s.toml", "[time]\nend = 2\n[[body]]\nname = \"p\"\nvelocity = " + body +
                                                           "\n[[obstacle]]\nname = \"lift\"\nshape = \"box\"\n"
                                                           "center = [0, 0, 5]\nsize = [1, 1, 1]\n" +
                                                           motion)}),
                 "stroke='rgb(168, 168, 168)'");
  };
  constexpr int kTimes = 4, kSides = 6;
  for (const std::string body : {"[1, 0, 2]", "[1, 1, 2]"}) {  // in a plane, and in space
    EXPECT_EQ(lines("velocity = [2, 0, 0]\n", body), kTimes * kSides);
    EXPECT_EQ(lines("velocity = [3, 0, 0]\n", body), (kTimes - 1) * kSides);  // the last is farther off than 4 m
    EXPECT_EQ(lines("", body), 0);
  }
}

TEST(Figure, OfAComparisonNamesWhatHasNoResult) {
  const std::string text =
      words(figure({"compare", kExamples + "heavy_top.toml", "--methods", "taylor,rk4"}, "no result: "));
  EXPECT_NE(text.find("rk4: no result"), std::string::npos) << text;
  EXPECT_NE(text.find("rk4: no result: whether event"), std::string::npos) << "the reason, at the foot";
  // a law of many numbers: its reason fits into the picture
  const std::string wordy = figure({"compare", kExamples + "frisbee.toml", "--methods", "taylor,rk4"}, "no result: ");
  for (std::size_t at = wordy.find("<text"); at != std::string::npos; at = wordy.find("<text", at + 1)) {
    const std::string line = words(wordy.substr(at, wordy.find("</text>", at) - at));
    EXPECT_LT(line.size(), 140u) << line;  // what fits into the picture
  }
  EXPECT_NE(words(wordy).find(" …"), std::string::npos);
}

TEST(Figure, OfAComparisonEndsWhereTheReferenceMeetsTheGround) {
  // Euler's bullet flies on to 600 m, where the closed form is 5 m under the ground
  const std::string svg =
      figure({"compare", kExamples + "notes/rifle_shot.toml", "--methods", "euler", "--steps", "5"});
  for (const double number : numbers(svg)) EXPECT_GE(number, 0.0);
  EXPECT_NE(words(svg).find("error [m, m/s]"), std::string::npos);
  const std::string one =
      words(figure({"compare", kExamples + "notes/rifle_shot.toml", "--methods", "euler", "--steps", "1"}));
  EXPECT_NE(one.find("euler, 1 step"), std::string::npos);
  EXPECT_EQ(one.find("1 steps"), std::string::npos);
}

TEST(Figure, OfAComparisonShowsSolidsBelowOneAnother) {
  const std::string svg = figure({"compare", kExamples + "notes/soccer_ball.toml", "--methods", "euler", "--steps",
                                  "100", "--orientations", "exact,quaternion,quaternion-normalized"});
  const std::string text = words(svg);
  for (const char* label :
       {"exact, 100 steps", "quaternion, 100 steps", "quaternion-normalized, 100 steps", "2 s", "10 s"})
    EXPECT_NE(text.find(label), std::string::npos) << label;
  for (const char* label : {"|det R − 1|", "angle from the reference [rad]"})
    EXPECT_NE(text.find(label), std::string::npos) << label;
  EXPECT_EQ(text.find("relative drift"), std::string::npos);  // of energy: the ball has no inertia
  // F101: 16 of the 32 faces of each of the three balls at six times, and the small ones on the way
  EXPECT_GE(polygons(svg).size(), 3U * 6U * 14U);
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
