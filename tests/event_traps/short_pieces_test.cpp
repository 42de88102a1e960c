// Laws that switch at certain times, for however short a while: each method does what the law says.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::number;
using test::run_text;
using test::Way;

/// Ways, and what of a pulse's effect they may be off by.
struct Method {
  Way way;
  double tolerance;
};

std::vector<Method> suitable_methods(double end) {
  const auto loose = [](const std::string& name) {
    return Method{{name, "name = \"" + name + "\"\nrtol = 1e-6\natol = 1e-8\n"}, 1e-3};
  };
  const auto tight = [](const std::string& name) {
    return Method{{name, "name = \"" + name + "\"\nrtol = 1e-10\natol = 1e-12\n"}, 1e-7};
  };
  // of the error that a method of order 4 makes in exp(-t) with 400 steps
  const auto fixed = [&](const std::string& name) { return Method{test::fixed(name, end / 400.0), 1e-3}; };
  return {tight("taylor"),       tight("taylor-extended"), tight("dopri5"),  tight("dop853"),
          tight("rodas5p"),      tight("adams"),           loose("bdf"),     loose("bs32"),
          loose("rosenbrock23"), loose("trapezoid"),       loose("tr-bdf2"), fixed("rk4"),
          fixed("gauss6"),       fixed("series"),          fixed("rk4-3/8")};
}

struct Pulse {
  double from;    // s
  double to;      // s
  double height;  // 1/s

  /// Ways to write it.
  std::string text(int way) const {
    const std::string a = number(from), b = number(to), h = number(height), half = number(height / 2.0);
    switch (way) {
      case 0:
        return "where(t > " + a + " and t < " + b + ", " + h + ", 0)";
      case 1:
        return h + "*(t >= " + a + ")*(t <= " + b + ")";
      case 2:
        return half + "*(sign(t - " + a + ") - sign(t - " + b + "))";
      case 3:
        return "where((t - " + a + ")*(t - " + b + ") < 0, " + h + ", 0)";
      default:
        return "where(floor((t - " + a + ")/(" + b + " - " + a + ")) == 0, " + h + ", 0)";
    }
  }

  /// What it leaves of u' = -k u + pulse at the end.
  double effect(double k, double end) const {
    return height / k * (std::exp(-k * (end - to)) - std::exp(-k * (end - from)));
  }
};

TEST(ShortPieces, RandomPulsesAreFelt) {
  std::mt19937 random(18);
  std::uniform_real_distribution<> uniform(0.0, 1.0);
  for (int i = 0; i < 1500; ++i) {
    const double end = std::pow(10.0, 2.0 * uniform(random));
    const std::vector<Method> methods = suitable_methods(end);
    const Method& method = methods[static_cast<std::size_t>(i) % methods.size()];
    const double k = 3.0 * uniform(random) / end;
    std::string rate = number(-k) + "*u";
    double expected = std::exp(-k * end);
    double scale = 1.0;
    for (int n = 0; n < 1 + i % 3; ++n) {
      const double width = std::pow(10.0, -6.0 * uniform(random)) * 0.2 * end;
      const double from = (end - width) * uniform(random), area = 1.0 + uniform(random);
      const Pulse pulse{from, from + width, area / width};
      // floor switches as often as the time is long
      rate += " + " + pulse.text(width > 1e-3 * end ? (i + n) % 5 : (i + n) % 4);
      expected += pulse.effect(k, end);
      scale += area;
    }
    const std::string text = "[time]\nend = " + number(end) + "\n[method]\n" + method.way.lines +
                             "[[state]]\nname = \"u\"\nvalue = 1\nrate = \"" + rate + "\"\n";
    SCOPED_TRACE(text);
    const RunResult result = run_text(text);
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    ASSERT_NEAR(test::state_of(result, "u"), expected, method.tolerance * scale);
  }
}

TEST(ShortPieces, APulseOfAThousandthOfASecondInAThousandSeconds) {
  const Pulse pulse{612.0, 612.001, 1000.0};
  for (const Method& method : suitable_methods(1000.0)) {
    const RunResult result = run_text("[time]\nend = 1000\n[method]\n" + method.way.lines +
                                      "[[state]]\nname = \"u\"\nvalue = 0\nrate = \"" + pulse.text(0) + "\"\n");
    EXPECT_NEAR(test::state_of(result, "u"), 1.0, 1e-8) << method.way.name << result.failure;
  }
}

TEST(ShortPieces, AStepThatIsSetEndsWhereALawSwitches) {
  // the steps of 0.4 s would pass 1 and 1.0001
  for (const Method& method : suitable_methods(2.0)) {
    const RunResult result =
        run_text("[time]\nend = 2\n[method]\n" + method.way.lines +
                 "[[state]]\nname = \"u\"\nvalue = 1\nrate = \"-u + where(t > 1 and t < 1 + 1e-4, 1e4, 0)\"\n");
    EXPECT_NEAR(test::state_of(result, "u"), 0.5032331190, 3.0 * method.tolerance) << method.way.name << result.failure;
  }
}

TEST(ShortPieces, BackwardInTimeToo) {
  const Pulse pulse{3.0, 3.001, 1000.0};
  for (const Method& method : suitable_methods(10.0)) {
    const RunResult result = run_text("[time]\nstart = 10\nend = 0\n[method]\n" + method.way.lines +
                                      "[[state]]\nname = \"u\"\nvalue = 1\nrate = \"" + pulse.text(0) + "\"\n");
    EXPECT_NEAR(test::state_of(result, "u"), 0.0, 1e-8) << method.way.name << result.failure;
  }
}

TEST(ShortPieces, AStartAtASwitchIsBehindIt) {
  for (const Method& method : suitable_methods(2.0)) {
    const RunResult result =
        run_text("[time]\nend = 2\n[method]\n" + method.way.lines +
                 "[[state]]\nname = \"u\"\nvalue = 0\nrate = \"where(t > 0, 1, 5) + where(t < 2, 0, 7)\"\n");
    EXPECT_NEAR(test::state_of(result, "u"), 2.0, 1e-8) << method.way.name << result.failure;
  }
}

TEST(ShortPieces, AnImpactAndAnEventBetweenSwitchesKeepThem) {
  // a gust of 1 ms after the ball has bounced at 1 s; the event at 1.5 s starts the method anew
  for (const Way& way : {Way{"taylor", "name = \"taylor\"\n"}, Way{"dopri5", "name = \"dopri5\"\n"},
                         Way{"dop853", "name = \"dop853\"\n"}, test::fixed("rk4", 0.3)}) {
    const RunResult result = run_text("[time]\nend = 3\n[method]\n" + way.lines + R"([[body]]
name = "ball"
position = [0, 0, 1]
velocity = [0, 0, -1]
acceleration = "[where(t > 2 and t < 2.001, 1000, 0), 0, 0]"
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "bounce"
[[event]]
name = "kick"
when = "t - 1.5"
set = { ball.vy = 1 }
)");
    EXPECT_NEAR((test::final_of(result, "ball").position - Vector3(1.0 - 0.0005, 1.5, 2)).norm(), 0.0, 1e-9)
        << way.name;
  }
}

}  // namespace
}  // namespace trajet
