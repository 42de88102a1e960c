// Laws without their choices, and along the borders of these.

#include "trajet/law/pinned_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "trajet/law/evaluate.hpp"
#include "trajet/law/program_builder.hpp"
#include "trajet/law/program_jacobian.hpp"
#include "trajet/law/sliding_law.hpp"

namespace trajet {
namespace {

constexpr int kInputs = 4;  // t, x, y, z

Program compile(std::initializer_list<std::string> formulas) {
  Symbols symbols;
  symbols.set_input("t", 0);
  symbols.set_input("x", 1);
  symbols.set_input("y", 2);
  symbols.set_input("z", 3);
  symbols.set_table("bumps", std::make_shared<const LookupTable>(std::vector{-9.0, -1.0, 0.0, 0.5, 2.0, 9.0},
                                                                 std::vector{0.0, 1.0, -1.0, 3.0, 0.0, 1.0}));
  std::vector<double> places, heights;
  for (int i = 0; i <= 300; ++i) places.push_back(i), heights.push_back(i % 7);
  symbols.set_table("many", std::make_shared<const LookupTable>(places, heights));
  ProgramBuilder builder(kInputs);
  for (const std::string& formula : formulas)
    builder.add_output(builder.compile_scalar(Expression::parse(formula), symbols));
  return builder.build();
}

std::vector<double> values(const Program& program, double t, const std::vector<double>& q) {
  std::vector<double> result(program.outputs.size());
  Evaluator<double> evaluate(program);
  evaluate(t, q.data(), result.data());
  return result;
}

void set_pins(const PinnedLaw& pinned, const std::vector<BorderSide>& sides, Program& program) {
  for (std::size_t b = 0; b < pinned.borders.size(); ++b)
    for (const PinnedLaw::Pin& pin : pinned.borders[b].pins) {
      const std::vector<double> constants = pinned_values(pinned.borders[b], pin, sides[b]);
      for (std::size_t k = 0; k < constants.size(); ++k)
        for (Program::Constant& constant : program.constants)
          if (constant.slot == pin.slots[k]) constant.value = constants[k];
    }
}

/// The sides on which a state is. A function may be made of choices before it.
std::vector<BorderSide> sides_at(const PinnedLaw& pinned, double t, const std::vector<double>& q) {
  std::vector<BorderSide> sides(pinned.borders.size());
  for (std::size_t b = 0; b < sides.size(); ++b) {
    Program functions = pinned.functions;
    set_pins(pinned, sides, functions);
    sides[b] =
        side_of(pinned.borders[b], values(functions, t, q)[static_cast<std::size_t>(pinned.borders[b].function)], 1.0);
  }
  return sides;
}

const char* const kChoices[] = {"abs(x)",
                                "sign(y - 0.3)*x",
                                "floor(3*x) + z",
                                "min(x, y)",
                                "max(x, y, z)",
                                "where(x < y, z, x*y)",
                                "(x <= 0.2) + (0.2 <= x)*y",
                                "table(\"bumps\", x + y)",
                                "where(abs(x) > 0.5 and y < x*z, sin(x), cos(y))",
                                "abs(x - abs(y - abs(z)))",
                                "where(not (x > 0 or y > 0), 3*z, max(-1, min(1, 4*z)))",
                                "sign(x)*sign(y)*floor(z)"};

TEST(PinnedLaw, IsTheLawOnItsOwnSideOfAllBorders) {
  std::mt19937 random(1);
  std::uniform_real_distribution<> uniform(-2.0, 2.0);
  for (const char* formula : kChoices) {
    const Program law = compile({formula, "x", "y"});
    EXPECT_TRUE(chooses_by_state(law)) << formula;
    const PinnedLaw pinned = pin_choices(law);
    for (int i = 0; i < 200; ++i) {
      const std::vector<double> q{uniform(random), uniform(random), uniform(random)};
      Program on_sides = pinned.law;
      set_pins(pinned, sides_at(pinned, 0.5, q), on_sides);
      const double expected = values(law, 0.5, q)[0];
      ASSERT_NEAR(values(on_sides, 0.5, q)[0], expected, 1e-14 * (1.0 + std::abs(expected))) << formula;
    }
  }
}

TEST(PinnedLaw, LeavesWhatTimeOrOtherChoicesDecide) {
  for (const char* formula : {"x + y*z", "where(t > 1, x, y)", "floor(3*t)*x", "table(\"bumps\", t)", "norm([x, y, z])",
                              "where(x == 0, 1, 1/x)", "min(t, 2)*abs(t - 1)*z"})
    EXPECT_FALSE(chooses_by_state(compile({formula}))) << formula;
  // one function decides all of it
  EXPECT_EQ(pin_choices(compile({"sign(x) + abs(x)*(x > 0) - (x <= 0) - min(x, 0)", "y", "z"})).borders.size(), 1u);
  EXPECT_EQ(pin_choices(compile({"(x < y) + (y < x) + max(x, y)", "y", "z"})).borders.size(), 1u);
  EXPECT_EQ(pin_choices(compile({"where((x > 0) + (y > 0) > 1, 1, 2)", "y", "z"})).borders.size(), 2u);
}

TEST(PinnedLaw, KnowsWhichOutputABorderChanges) {
  const PinnedLaw pinned = pin_choices(compile({"z", "x*abs(y)", "sign(z) + abs(y)"}));
  ASSERT_EQ(pinned.borders.size(), 2u);
  std::vector<int> outputs{first_output_of(pinned, 0), first_output_of(pinned, 1)};
  std::sort(outputs.begin(), outputs.end());
  EXPECT_EQ(outputs, (std::vector{1, 2}));
}

/// Functions whose zero a motion may slide along, with every operation that has a derivative.
const char* const kFunctions[] = {"x - 0.3*y",
                                  "x*y - z + t",
                                  "x/(2 + y) - 3/(4 + z) + x/5",
                                  "(x + 3)^2 - (y + 3)^3.5",
                                  "(x + 3)^(y/4) - 2",
                                  "sqrt(x + 4) - cbrt(y + 5)",
                                  "exp(x/2) - log(y + 4) + log10(z + 5)",
                                  "sin(x + y) + cos(t*z) + x",
                                  "tan(x/3) + asin(y/4) - acos(z/4)",
                                  "atan(x) + atan2(y + 5, x + z + 9)",
                                  "sinh(x) - cosh(y/2) + tanh(z)",
                                  "norm([x + 3, y, z]) - 3",
                                  "2 - x + -y*(7 - x)"};

TEST(SlidingLaw, KeepsTheFunctionOfItsBorder) {
  std::mt19937 random(2);
  std::uniform_real_distribution<> uniform(-1.0, 1.0);
  for (const std::string function : kFunctions) {
    const Program when = compile({function});
    const PinnedLaw pinned =
        pin_choices(compile({"y - 2*sign(" + function + ")", "0.5 + x + where(" + function + " < 0, 1, 3)", "x*z"}));
    ASSERT_EQ(pinned.borders.size(), 1u) << function;
    for (int i = 0; i < 50; ++i) {
      const double t = uniform(random);
      const std::vector<double> q{uniform(random), uniform(random), uniform(random)};
      const std::vector<SlidingBorder> along{{0, 0.0}};
      const auto sliding = make_sliding_law(pinned, sides_at(pinned, t, q), along);
      ASSERT_TRUE(sliding) << function;
      const std::vector<double> rate = values(sliding->law, t, q);
      std::vector<double> gradient(3);
      double change = 0.0;
      ProgramJacobian jacobian(when);
      jacobian(t, q.data(), gradient.data(), &change);
      double size = std::abs(change);
      for (std::size_t k = 0; k < 3; ++k) {
        change += gradient[k] * rate[k];
        size += std::abs(gradient[k] * rate[k]);
      }
      ASSERT_NEAR(change, 0.0, 1e-12 * (1.0 + size)) << function;
      // the third component knows nothing of the border
      ASSERT_EQ(rate[2], q[0] * q[2]);
    }
  }
}

TEST(PinnedLaw, KnowsDirectionsThatTheirOwnVectorReactsTo) {
  const auto directions = [](std::initializer_list<std::string> formulas) {
    return pin_choices(compile(formulas)).directions.size();
  };
  for (const char* way : {"-3*dot(unit([x, y, z]), [1, 0, 0])", "1 - 2*x/norm([x, y, z])", "z - 2/norm([x, y, z])*x",
                          "-(x*t)/norm([x, y, z])*2", "-(3*x)/norm([x, y, z])"})
    EXPECT_EQ(directions({way, "-y/norm([x, y, z])", "-z/norm([x, y, z])"}), 1u) << way;
  // a force to a centre, a drag, and a direction that no rate of its own vector reads
  EXPECT_EQ(directions({"z", "z", "-x/norm([x, y, 0])"}), 0u);
  EXPECT_EQ(directions({"-x*norm([x, y, z])", "-y", "-z"}), 0u);
  EXPECT_EQ(directions({"-x/norm([x, y, z])^3", "-y", "-z"}), 0u);
}

TEST(SlidingLaw, HoldsTheVectorOfADirection) {
  const PinnedLaw pinned = pin_choices(compile({"1 + z - 3*x/norm([x, y, 0])", "t - 2*y/norm([x, y, 0])", "x + 5"}));
  ASSERT_EQ(pinned.directions.size(), 1u);
  const std::vector<double> q{0.0, 0.0, 0.5};
  const std::vector<SlidingBorder> along{{0, 0.0}};
  const auto sliding = make_sliding_law(pinned, {}, along);
  ASSERT_TRUE(sliding);
  const std::vector<double> rate = values(sliding->law, 0.25, q);
  EXPECT_EQ(rate, (std::vector{0.0, 0.0, 5.0}));
  const double u = 1.5 / 3.0, v = 0.25 / 2.0;
  EXPECT_NEAR(values(sliding->shares, 0.25, q)[0], 0.5 * (1.0 + u * u + v * v), 1e-15);
  const std::vector<double> holds = values(sliding->holds, 0.25, q), expected{u, v, 1.5, 0.25, -5.0};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(holds[i], expected[i], 1e-15) << i;
}

TEST(SlidingLaw, OfTwoBordersKeepsBoth) {
  const PinnedLaw pinned = pin_choices(compile({"1 - 4*sign(x) + 3*sign(y - x)", "-3*sign(y - x)", "0"}));
  ASSERT_EQ(pinned.borders.size(), 2u);
  const std::vector<double> q{0.0, 0.0, 0.0};
  const std::vector<SlidingBorder> along{{0, 0.0}, {1, 0.0}};
  const auto sliding = make_sliding_law(pinned, sides_at(pinned, 0.0, q), along);
  ASSERT_TRUE(sliding);
  for (const double rate : values(sliding->law, 0.0, q)) EXPECT_NEAR(rate, 0.0, 1e-15);
  for (const double rest : values(sliding->residuals, 0.0, q)) EXPECT_NEAR(rest, 0.0, 1e-15);
  // a product of two choices does not add up
  const PinnedLaw product = pin_choices(compile({"-sign(x)*(2 + sign(y))", "-sign(y)", "0"}));
  const auto mixed = make_sliding_law(product, sides_at(product, 0.0, q), along);
  ASSERT_TRUE(mixed);
  double largest = 0.0;
  for (const double rest : values(mixed->residuals, 0.0, q)) largest = std::max(largest, std::abs(rest));
  EXPECT_GT(largest, 0.5);
}

TEST(SlidingLaw, FollowsATableOfTimeUnlessItHasTooManyPoints) {
  const PinnedLaw pinned = pin_choices(compile({"-9*sign(x - table(\"bumps\", t))", "0", "0"}));
  ASSERT_EQ(pinned.borders.size(), 1u);
  const std::vector<SlidingBorder> along{{0, 0.0}};
  const auto sliding = make_sliding_law(pinned, std::vector<BorderSide>(1), along);
  ASSERT_TRUE(sliding);
  const auto slope = [&](double t) { return values(sliding->law, t, {0.0, 0.0, 0.0})[0]; };
  const Program bumps = compile({"table(\"bumps\", t)", "0", "0"});
  const auto height = [&](double t) { return values(bumps, t, {0.0, 0.0, 0.0})[0]; };
  // central differences: of a cubic they are off by h^2 c3
  constexpr double kStep = 1e-5;
  for (const double t : {-8.0, -0.5, 0.2, 0.4, 1.0, 5.0, 8.9})
    EXPECT_NEAR(slope(t), (height(t + kStep) - height(t - kStep)) / (2.0 * kStep), 1e-8) << t;
  EXPECT_TRUE(std::isnan(slope(10.0)));
  EXPECT_TRUE(std::isnan(slope(-10.0)));

  const PinnedLaw many = pin_choices(compile({"-sign(x - table(\"many\", t))", "0", "0"}));
  EXPECT_FALSE(make_sliding_law(many, std::vector<BorderSide>(1), along));
}

}  // namespace
}  // namespace trajet
