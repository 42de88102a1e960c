// Events and impacts that happen at one instant, and those that a jump of the state makes happen: through whole runs.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::number;
using test::run_text;
using test::Way;

std::string event(const std::string& name, const std::string& when, const std::string& direction,
                  const std::string& action) {
  return "[[event]]\nname = \"" + name + "\"\nwhen = \"" + when + "\"\ndirection = \"" + direction + "\"\n" + action +
         "\n";
}

std::string counter(const std::string& name) { return "[[state]]\nname = \"" + name + "\"\nvalue = 0\nrate = 0\n"; }

int count(const RunResult& result, const std::string& name) {
  int n = 0;
  for (const EventRecord& happened : result.events) n += happened.event == name;
  return n;
}

/// What turns a point back, or takes it to the other side, at 0 and 1 of an axis.
enum class Walls { periodic, mirrors, obstacles };

/// A point in a box of edge 1, along each axis with walls of its own, and how often it has met them.
///
/// Unfolded it moves straight: u = u0 + v t. It meets a wall wherever u is whole.
struct Box {
  std::array<int, 3> start;     // in 60ths
  std::array<int, 3> velocity;  // in 60ths per second
  std::array<Walls, 3> walls;

  std::string text() const {
    const auto vector = [](const std::array<int, 3>& a) {
      return "[" + number(a[0] / 60.0) + ", " + number(a[1] / 60.0) + ", " + number(a[2] / 60.0) + "]";
    };
    std::string scene =
        "[[body]]\nname = \"p\"\nposition = " + vector(start) + "\nvelocity = " + vector(velocity) + "\n";
    for (int i = 0; i < 3; ++i) {
      const std::string axis(1, "xyz"[i]), n = "n" + axis, x = "p." + axis, v = "p.v" + axis;
      const auto is = [&](Walls kind) { return walls[static_cast<std::size_t>(i)] == kind; };
      if (is(Walls::obstacles)) {
        for (const int side : {0, 1}) {
          std::array<int, 3> point{}, normal{};
          point[static_cast<std::size_t>(i)] = 60 * side;
          normal[static_cast<std::size_t>(i)] = side == 0 ? 60 : -60;
          scene += "[[obstacle]]\nname = \"" + axis + std::to_string(side) +
                   "\"\nshape = \"plane\"\npoint = " + vector(point) + "\nnormal = " + vector(normal) +
                   "\non_hit = \"bounce\"\n";
        }
        continue;
      }
      scene += counter(n);
      const std::string count = n + " = \"" + n + " + 1\"";
      const auto set = [&](const std::string& sign) {
        return "set = { " + count + ", " +
               (is(Walls::periodic) ? x + " = \"" + x + sign + "1\"" : v + " = \"-" + v + "\"") + " }";
      };
      scene += event(axis + "0", x, "falling", set(" + ")) + event(axis + "1", x + " - 1", "rising", set(" - "));
    }
    return scene;
  }

  int meetings(int i, double t) const {
    const auto k = static_cast<std::size_t>(i);
    const double u0 = start[k] / 60.0, u = u0 + velocity[k] / 60.0 * t;
    return static_cast<int>(std::abs(std::floor(u)));  // a start is inside
  }

  double position(int i, double t) const {
    const auto k = static_cast<std::size_t>(i);
    const double u = start[k] / 60.0 + velocity[k] / 60.0 * t;
    if (walls[k] == Walls::periodic) return u - std::floor(u);
    const double folded = u - 2.0 * std::floor(u / 2.0);
    return folded <= 1.0 ? folded : 2.0 - folded;
  }
};

Box random_box(std::mt19937& random) {
  const auto draw = [&](int from, int to) { return std::uniform_int_distribution(from, to)(random); };
  Box box;
  const int start = draw(1, 59), velocity = draw(20, 120) * (2 * draw(0, 1) - 1);
  for (std::size_t i = 0; i < 3; ++i) {
    // diagonals, and those of other axes' multiples: corners and edges
    const bool is_diagonal = draw(0, 3) > 0;
    box.start[i] = is_diagonal ? start : draw(1, 59);
    box.velocity[i] = is_diagonal ? velocity : draw(-90, 90);
    if (is_diagonal && draw(0, 3) == 0) {
      box.start[i] = 60 - start;
      box.velocity[i] = -velocity;
    }
    box.walls[i] = static_cast<Walls>(draw(0, 2));
  }
  return box;
}

std::vector<Way> ways() {
  return {{"taylor", "name = \"taylor\"\n"}, {"dopri5", "name = \"dopri5\"\n"}, test::fixed("rk4", 0.37)};
}

TEST(Coincidence, RandomBoxesAreLeftAtNoEdgeAndNoCorner) {
  std::mt19937 random(18);
  for (int i = 0; i < 1200; ++i) {
    const Box box = random_box(random);
    const Way way = ways()[static_cast<std::size_t>(i) % ways().size()];
    const double end = 9.0 + 1.0 / 7.0 + i * 1e-4;  // not where it meets a wall
    const std::string text = "[time]\nend = " + number(end) + "\n[method]\n" + way.lines + box.text();
    SCOPED_TRACE(text);
    const RunResult result = run_text(text);
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    for (int axis = 0; axis < 3; ++axis) {
      // some 20 meetings, each with the roundings of a position near 1 and of its time up to 10
      ASSERT_NEAR(test::final_of(result, "p").position[axis], box.position(axis, end), 1e-13) << axis;
      const std::string name(1, "xyz"[axis]);
      if (box.walls[static_cast<std::size_t>(axis)] == Walls::obstacles) continue;
      ASSERT_EQ(count(result, name + "0") + count(result, name + "1"), box.meetings(axis, end)) << axis;
      ASSERT_EQ(test::state_of(result, "n" + name), box.meetings(axis, end)) << axis;
    }
  }
}

TEST(Coincidence, APointOnTheDiagonalOfAPeriodicBoxStaysInIt) {
  for (const Way& way : ways()) {
    const RunResult result = run_text("[time]\nend = 10\n[method]\n" + way.lines +
                                      "[[body]]\nname = \"p\"\nposition = [0.25, 0.25, 0]\nvelocity = [1.0, 1.0, 0]\n" +
                                      event("right", "p.x - 1", "rising", "set = { p.x = \"p.x - 1\" }") +
                                      event("top", "p.y - 1", "rising", "set = { p.y = \"p.y - 1\" }"));
    EXPECT_NEAR((test::final_of(result, "p").position - Vector3(0.25, 0.25, 0)).norm(), 0.0, 1e-13) << way.name;
    EXPECT_EQ(result.events.size(), 20u) << way.name;
  }
}

TEST(Coincidence, ACounterThatReachesItsLimitStopsTheRun) {
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    Box box = random_box(random);
    box.walls[0] = i % 2 == 0 ? Walls::periodic : Walls::mirrors;
    if (box.velocity[0] == 0) box.velocity[0] = 60;
    const Way way = ways()[static_cast<std::size_t>(i) % ways().size()];
    const int limit = 1 + i % 5;
    const std::string when = i % 3 == 0 ? "nx - " + number(limit) : "nx - " + number(limit - 0.5);
    const std::string text = "[time]\nend = 100\n[method]\n" + way.lines + box.text() +
                             event("full", when, i % 2 == 0 ? "rising" : "any", "action = \"stop\"");
    SCOPED_TRACE(text);
    const RunResult result = run_text(text);
    ASSERT_EQ(result.status, RunStatus::stopped) << result.failure;
    const double u0 = box.start[0] / 60.0, v = box.velocity[0] / 60.0;
    const double expected = v > 0.0 ? (limit - u0) / v : (limit - 1 + u0) / -v;
    ASSERT_NEAR(result.end_time, expected, 1e-13);
    ASSERT_EQ(test::state_of(result, "nx"), limit);
    ASSERT_EQ(count(result, "full"), 1);
    // all that happens at this instant is done: whoever has come to a wall has met it
    for (int axis = 1; axis < 3; ++axis) {
      if (box.walls[static_cast<std::size_t>(axis)] == Walls::obstacles) continue;
      ASSERT_EQ(test::state_of(result, std::string("n") + "xyz"[axis]), box.meetings(axis, expected + 1e-12));
    }
  }
}

TEST(Coincidence, EventsOfOneInstantComeInTheOrderOfTheScene) {
  // (a + 1) 2 or a 2 + 1
  const std::string state =
      "[[state]]\nname = \"x\"\nvalue = -0.1\nrate = 0.3\n[[state]]\nname = \"a\"\nvalue = 1\nrate = 0\n";
  const std::string sum = event("sum", "x", "rising", "set = { a = \"a + 1\" }");
  const std::string product = event("product", "3*x", "rising", "set = { a = \"2*a\" }");
  for (const Way& way : ways()) {
    const std::string begin = "[time]\nend = 1\n[method]\n" + way.lines + state;
    EXPECT_EQ(test::state_of(run_text(begin + sum + product), "a"), 4.0);
    EXPECT_EQ(test::state_of(run_text(begin + product + sum), "a"), 3.0);
  }
}

TEST(Coincidence, AnImpactThatTurnsAWhenCountsAsItsCrossing) {
  for (const Way& way : ways()) {
    const RunResult result = run_text("[time]\nend = 3\n[method]\n" + way.lines + R"([[body]]
name = "ball"
position = [0, 0, 1]
velocity = [0, 0, -2]
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "bounce"
)" + event("turn", "ball.vz", "rising", "action = \"record\""));
    ASSERT_EQ(result.events.size(), 1u) << way.name;
    EXPECT_NEAR(result.events[0].time, 0.5, 1e-15);
  }
}

TEST(Coincidence, SetsThatCallEachOtherEndInASentence) {
  const RunResult result = run_text(
      "[time]\nend = 2\n[[state]]\nname = \"x\"\nvalue = -1\nrate = 1\n[[state]]\nname = \"s\"\nvalue = 0\nrate = 0\n" +
      event("start", "x", "rising", "set = { s = 1 }") + event("up", "s - 1/2", "rising", "set = { s = -1 }") +
      event("down", "s + 1/2", "falling", "set = { s = 1 }"));
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_NE(result.failure.find("again and again at one instant"), std::string::npos) << result.failure;
}

}  // namespace
}  // namespace trajet
