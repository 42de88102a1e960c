// Laws that are another in a layer of space, however thin: each method does what the law says.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "event_traps/tolerated_methods.hpp"
#include "scene_run.hpp"
#include "trajet/law/lookup_table.hpp"

namespace trajet {
namespace {

using test::number;
using test::run_text;
using test::ToleratedWay;
using Real = long double;

/// The motion x'' = c - k x from a state, in closed form.
struct Piece {
  Real k, c, x0, v0;

  Real omega() const { return std::sqrt(k); }
  /// Without differences of what is large where the time is short.
  Real moved(Real t) const {
    if (k == 0) return v0 * t + c / 2 * t * t;
    const Real w = omega(), half = std::sin(w * t / 2);
    return 2 * (c / k - x0) * half * half + v0 / w * std::sin(w * t);
  }
  Real x(Real t) const { return x0 + moved(t); }
  Real v(Real t) const {
    if (k == 0) return v0 + c * t;
    const Real w = omega();
    return v0 * std::cos(w * t) + (c / k - x0) * w * std::sin(w * t);
  }
  /// The first time behind `after` at which x is `level`; infinite if there is none.
  Real reaches(Real level, Real after) const {
    const Real d = x0 - level;
    Real first = std::numeric_limits<Real>::infinity();
    const auto take = [&](Real t) {
      for (int i = 0; i < 4 && std::isfinite(t); ++i) t -= (d + moved(t)) / v(t);
      // not every start leads to a root
      if (t > after && std::abs(d + moved(t)) < 1e-15L) first = std::min(first, t);
    };
    // as if the acceleration were constant
    const Real pull = c - k * x0, discriminant = v0 * v0 - 2 * pull * d;
    if (pull == 0) {
      take(-d / v0);
    } else if (discriminant >= 0) {
      const Real q = -(v0 + std::copysign(std::sqrt(discriminant), v0));
      take(q / pull);
      take(2 * d / q);
    }
    if (k == 0) return first;
    const Real w = omega(), a = x0 - c / k, b = v0 / w, height = (level - c / k) / std::hypot(a, b);
    if (std::abs(height) > 1) return first;
    const Real period = 2 * std::numbers::pi_v<Real>;
    for (const Real sign : {Real(-1), Real(1)})
      for (Real angle = std::atan2(b, a) + sign * std::acos(height) - 2 * period; angle < 3 * period; angle += period)
        take(angle / w);
    return first;
  }
};

/// x'' = c - k x, and in the layer from a to b an acceleration more.
struct Layered {
  Real k, c, inside, a, b;
};

struct State {
  Real x, v;
  Real slowest = std::numeric_limits<Real>::infinity();  // speed at a border
  int crossings = 0;
};

/// The layers below, in and above are left by crossing a border, on which the side is that to which it moves.
State exact_motion(const Layered& law, Real x, Real v, Real end) {
  State state{x, v};
  int layer = x < law.a ? 0 : x < law.b ? 1 : 2;
  for (Real t = 0;;) {
    const Piece piece{law.k, law.c + (layer == 1 ? law.inside : 0), state.x, state.v};
    // the border on which it stands is left at 0: the root there is no other
    const auto next = [&](Real border) {
      const bool stands_there = std::abs(state.x - border) <= 1e-17L * std::abs(border);
      return piece.reaches(border, stands_there ? 1e-9L / (1 + std::abs(state.v)) * (law.b - law.a) : 0);
    };
    const Real to_a = layer == 2 ? std::numeric_limits<Real>::infinity() : next(law.a);
    const Real to_b = layer == 0 ? std::numeric_limits<Real>::infinity() : next(law.b);
    const Real step = std::min(to_a, to_b);
    if (t + step >= end) {
      const Real rest = end - t;
      const Real x_end = piece.x(rest), v_end = piece.v(rest);
      state.x = x_end;
      state.v = v_end;
      return state;
    }
    t += step;
    state.v = piece.v(step);
    state.x = to_a < to_b ? law.a : law.b;
    layer = to_a < to_b ? (state.v > 0 ? 1 : 0) : (state.v > 0 ? 2 : 1);
    state.slowest = std::min(state.slowest, std::abs(state.v));
    ++state.crossings;
  }
}

std::vector<ToleratedWay> methods_for(double end) {
  std::vector<ToleratedWay> all = test::controlled_ways();
  const auto add = [&](const std::string& name, double tolerance) {
    all.push_back({test::fixed(name, end / 200.0), tolerance});
  };
  add("rk4", 1e-5);
  add("rk4-3/8", 1e-5);
  add("gauss6", 1e-7);
  add("series", 1e-5);
  add("midpoint", 1e-3);
  add("heun", 1e-3);
  add("velocity-verlet", 1e-3);
  add("rk4-doubling", 1e-5);
  // it takes the speed in a thin layer for constant
  all.push_back({test::fixed("euler", end / 20000.0), 5e-3, true});
  return all;
}

/// Ways to write that x lies in the layer.
std::string inside(int way, const std::string& a, const std::string& b) {
  switch (way) {
    case 0:
      return "where(x > " + a + " and x < " + b + ", 1, 0)";
    case 1:
      return "(x >= " + a + ")*(x <= " + b + ")";
    case 2:
      return "0.5*(sign(x - " + a + ") - sign(x - " + b + "))";
    case 3:
      return "where((x - " + a + ")*(x - " + b + ") < 0, 1, 0)";
    default:
      return "where(abs(2*x - " + a + " - " + b + ") < " + b + " - " + a + ", 1, 0)";
  }
}

TEST(Layers, RandomThinLayersAreFelt) {
  std::mt19937 random(18);
  std::uniform_real_distribution<> uniform(0.0, 1.0);
  int felt = 0, turned = 0;
  for (int i = 0; felt < 1500; ++i) {
    const double end = std::pow(10.0, 2.0 * uniform(random) - 1.0);
    const std::vector<ToleratedWay> methods = methods_for(end);
    const ToleratedWay& method = methods[static_cast<std::size_t>(felt) % methods.size()];
    // about so fast that it goes some metres
    const double v0 = (1.0 + uniform(random)) / end;
    const double a = 0.2 + 0.6 * uniform(random);
    const double width = std::pow(10.0, -4.0 * uniform(random) - 2.0);
    const double kick = (method.is_coarse ? 0.02 : 1.5) * (2.0 * uniform(random) - 1.0);  // of the energy
    const bool swings = i % 2 == 1 && !method.is_coarse;
    const double k = swings ? std::pow(3.0 * uniform(random) / end, 2) : 0.0;
    const double c = method.is_coarse ? 0.0 : (uniform(random) - 0.5) * v0 / end;
    const Layered law{k, c, 0.5 * kick * v0 * v0 / width, a, a + width};
    const State exact = exact_motion(law, 0.0, v0, end);
    // where it all but stops at a border, what comes is not decided by digits that doubles have
    if (exact.crossings == 0 || exact.slowest < 0.1 * v0) continue;
    ++felt;
    turned += exact.v < 0 && !swings;
    const std::string acceleration = number(c) + " - " + number(k) + "*x + " + number(static_cast<double>(law.inside)) +
                                     "*" + inside(i % 5, number(a), number(a + width));
    const std::string text = "[time]\nend = " + number(end) + "\n[method]\n" + method.way.lines +
                             "[[body]]\nname = \"p\"\nvelocity = [" + number(v0) + ", 0, 0]\nacceleration = [\"" +
                             acceleration + "\", 0, 0]\n";
    SCOPED_TRACE(text);
    const RunResult result = run_text(text);
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    const BodyState& final = test::final_of(result, "p");
    ASSERT_NEAR(final.position.x(), static_cast<double>(exact.x), method.tolerance * 10.0);
    ASSERT_NEAR(final.velocity.x(), static_cast<double>(exact.v), method.tolerance * 10.0 * v0);
  }
  EXPECT_GT(turned, 50);
}

TEST(Layers, BackwardInTimeToo) {
  for (const ToleratedWay& method : methods_for(2.0)) {
    if (method.is_coarse) continue;
    const RunResult result = run_text("[time]\nstart = 2\nend = 0\n[method]\n" + method.way.lines +
                                      "[[body]]\nname = \"p\"\nposition = [2, 0, 0]\nvelocity = [1, 0, 0]\n"
                                      "acceleration = [\"where(x > 1 and x < 1.0001, 1000, 0)\", 0, 0]\n");
    // v^2 was less by 2 * 1000 * 1e-4 before the layer
    EXPECT_NEAR(test::final_of(result, "p").velocity.x(), std::sqrt(0.8), 10.0 * method.tolerance)
        << method.way.name << result.failure;
  }
}

/// The work of a force that a table gives over all of its points, by the cubics of its cells.
double integral(const LookupTable& table) {
  double sum = 0.0;
  for (int i = 0; i < table.cell_count(); ++i) {
    const auto& cell = table.cell(i);
    const double u = table.cell_end(i) - cell.begin;
    sum += u * (cell.c0 + u * (cell.c1 / 2 + u * (cell.c2 / 3 + u * cell.c3 / 4)));
  }
  return sum;
}

// A step of a set length makes one step of each of the peak's three slopes.
TEST(Layers, AThinPeakOfATableIsFelt) {
  const std::vector<double> x{-10, 1, 1.0001, 1.0002, 1.0003, 10}, force{0, 0, 800, 3000, 0, 0};
  const auto peak = std::make_shared<const LookupTable>(x, force);
  for (const ToleratedWay& method : methods_for(4.0)) {
    if (method.is_coarse) continue;
    Scene scene = parse_scene("[time]\nend = 4\n[method]\n" + method.way.lines +
                                  "[[body]]\nname = \"p\"\nvelocity = [1, 0, 0]\nacceleration = [0, 0, 0]\n",
                              "test.toml");
    scene.tables["peak"] = peak;
    scene.bodies[0].acceleration = Expression::parse("[table(\"peak\", x), 0, 0]");
    const RunResult result = run(scene);
    EXPECT_NEAR(test::final_of(result, "p").velocity.x(), std::sqrt(1.0 + 2.0 * integral(*peak)),
                method.way.lines.find("step") != std::string::npos ? 0.05 : 100.0 * method.tolerance)
        << method.way.name << result.failure;
  }
}

/// A ball rolls down a stair of potentials: each floor(x) pulls harder.
TEST(Layers, EachStepOfAFloorIsFelt) {
  double x = 0.0, v = 0.5, t = 0.0;
  for (int step = 0; step < 20; ++step) {
    const double pull = 0.1 * step;
    const double speed = std::sqrt(v * v + 2.0 * pull);
    t += 2.0 / (v + speed);
    v = speed;
    x += 1.0;
  }
  for (const ToleratedWay& method : methods_for(t)) {
    if (method.is_coarse) continue;
    const RunResult result = run_text("[time]\nend = " + number(t) + "\n[method]\n" + method.way.lines +
                                      "[[body]]\nname = \"p\"\nvelocity = [0.5, 0, 0]\n"
                                      "acceleration = [\"0.1*floor(x)\", 0, 0]\n");
    EXPECT_NEAR(test::final_of(result, "p").position.x(), x, 100.0 * method.tolerance)
        << method.way.name << result.failure;
  }
}

/// Beyond the border the law is not finite: no method looks there for long.
TEST(Layers, ALawThatIsGuardedFromWhatItCannotBe) {
  for (const ToleratedWay& method : methods_for(3.0)) {
    if (method.is_coarse) continue;
    const RunResult result = run_text("[time]\nend = 3\n[method]\n" + method.way.lines +
                                      "[[body]]\nname = \"p\"\nvelocity = [1, 0, 0]\n"
                                      "acceleration = [\"where(x < 1, sqrt(1 - x), 0)\", 0, 0]\n");
    // v^2 = 1 + 2 (2/3) (1 - (1 - x)^(3/2))
    EXPECT_NEAR(test::final_of(result, "p").velocity.x(), std::sqrt(7.0 / 3.0), 1e-2)
        << method.way.name << result.failure;
  }
}

}  // namespace
}  // namespace trajet
