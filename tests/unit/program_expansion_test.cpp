#include "trajet/law/program_expansion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "trajet/law/evaluate.hpp"
#include "trajet/law/program_builder.hpp"
#include "trajet/math/series.hpp"

namespace trajet {
namespace {

using Rates = std::vector<std::string>;

/// dq/dt = rates over t and the states x, y, z, and the tables of `outer`.
Program compile(const Rates& rates, const Symbols& outer = Symbols()) {
  Symbols symbols(&outer);
  symbols.set_input("t", 0);
  const char* const names[] = {"x", "y", "z"};
  for (std::size_t i = 0; i < rates.size(); ++i) symbols.set_input(names[i], static_cast<int>(i) + 1);
  ProgramBuilder builder(static_cast<int>(rates.size()) + 1);
  for (const std::string& rate : rates) builder.add_output(builder.compile_scalar(rate, symbols));
  return builder.build();
}

/// Coefficient k of component 0.
std::vector<double> first_component(const Rates& rates, double t, const std::vector<double>& q, int order) {
  ProgramExpansion expansion(compile(rates));
  std::vector<double> coefficients(q.size() * static_cast<std::size_t>(order + 1));
  expansion.expand(t, q.data(), order, coefficients.data());
  std::vector<double> result;
  for (std::size_t k = 0; k < coefficients.size(); k += q.size()) result.push_back(coefficients[k]);
  return result;
}

void expect_coefficients(const std::vector<double>& computed, const std::vector<double>& expected,
                         const std::string& law) {
  ASSERT_EQ(computed.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    // a coefficient collects the rounding of order^2 operations on coefficients of its size or, where it cancels, on
    // larger
    EXPECT_NEAR(computed[k], expected[k], 1e-13 * (1.0 + std::abs(expected[k]))) << law << ", coefficient " << k;
  }
}

TEST(ProgramExpansion, known_series) {
  expect_coefficients(first_component({"x"}, 0, {1}, 5), {1, 1, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120}, "exp t");
  expect_coefficients(first_component({"1 + x^2"}, 0, {0}, 7), {0, 1, 0, 1.0 / 3, 0, 2.0 / 15, 0, 17.0 / 315}, "tan t");
  expect_coefficients(first_component({"y", "-x"}, 0, {0, 1}, 5), {0, 1, 0, -1.0 / 6, 0, 1.0 / 120}, "sin t");
  expect_coefficients(first_component({"-x^2/2"}, 0, {1}, 4), {1, -0.5, 0.25, -0.125, 0.0625}, "2/(2 + t)");
  expect_coefficients(first_component({"1/(1 + t)"}, 0, {0}, 4), {0, 1, -0.5, 1.0 / 3, -0.25}, "log(1 + t)");
  expect_coefficients(first_component({"1/sqrt(1 - t^2)"}, 0, {0}, 5), {0, 1, 0, 1.0 / 6, 0, 3.0 / 40}, "asin t");
}

/// Integral from 0 to t, plus `constant`; drops the highest coefficient.
template <int N>
Series<double, N> integral(const Series<double, N>& x, double constant) {
  return Series<double, N>::from([&](int k) { return k > 0 ? x[k - 1] / k : constant; });
}

/// The expansion by brute force: q = q0 + integral of the whole law on longer and longer series.
template <int N>
std::vector<double> by_repeated_integration(const Program& program, double t, const std::vector<double>& q0) {
  using S = Series<double, N>;
  Evaluator<S> evaluate(program);
  std::vector<S> q(q0.begin(), q0.end()), rate(q0.size());
  for (int pass = 0; pass < N; ++pass) {
    evaluate(S::variable(t), q.data(), rate.data());
    for (std::size_t i = 0; i < q.size(); ++i) q[i] = integral(rate[i], q0[i]);
  }
  std::vector<double> coefficients;
  for (int k = 0; k <= N; ++k) {
    for (const S& component : q) coefficients.push_back(component[k]);
  }
  return coefficients;
}

/// What no recurrence enters: the polynomial of an expansion satisfies the law, evaluated on plain numbers, at times
/// around its own. q' - g(t, q) is then what the terms left out make, and rounding.
void expect_to_solve(const Program& program, double t, const std::vector<double>& q, const std::string& law) {
  constexpr int kOrder = 24;
  const std::size_t n = q.size();
  ProgramExpansion expansion(program);
  std::vector<double> c(n * (kOrder + 1));
  expansion.expand(t, q.data(), kOrder, c.data());
  Evaluator<double> evaluate(program);
  for (const double tau : {-0.08, -0.02, 0.02, 0.08}) {
    std::vector<double> value(n), rate(n), expected(n);
    for (std::size_t k = kOrder + 1; k-- > 0;)
      for (std::size_t i = 0; i < n; ++i) {
        rate[i] = rate[i] * tau + value[i];
        value[i] = value[i] * tau + c[k * n + i];
      }
    evaluate(t + tau, value.data(), expected.data());
    for (std::size_t i = 0; i < n; ++i) {
      const double last = (kOrder + 1) * std::abs(c[kOrder * n + i] * std::pow(tau, kOrder));
      EXPECT_NEAR(rate[i], expected[i], 4e-14 * (1.0 + std::abs(expected[i])) + 100.0 * last)
          << law << ", component " << i << ", at " << tau;
      EXPECT_LT(last, 1e-11) << law << ": the times are too far off to tell anything";
    }
  }
}

TEST(ProgramExpansion, every_operation_agrees_with_series_arithmetic_and_solves_the_law) {
  constexpr int kOrder = 12;
  const Rates laws[] = {
      {"x*y + z/t - 3*x/y", "x - y - 2", "2 - x + 3/y"},
      {"sqrt(x) + cbrt(y)", "z^3", "-x/3"},
      {"exp(-x)*log(y)", "log10(z + x)", "1/x"},
      {"sin(x)*cos(x)", "sin(y)", "cos(z)"},
      {"tan(x/2)", "tanh(y)", "sinh(z)*cosh(z)/9"},
      {"sinh(x/2)", "cosh(y/3)", "atan(z)"},
      {"asin(x/3)", "acos(y/4)", "atan2(z, x)"},
      {"x^0.3", "x^y", "2^z"},
      {"-norm([x, y, z])*x", "-norm([x, y, z])*y", "-9.81 - norm([x, y, z])*z"},
      {"y", "-x/(x^2 + y^2)^1.5", "dot(unit([x, y, z]), [1, 2, 3])"},
  };
  for (const Rates& law : laws) {
    const Program program = compile(law);
    const std::vector<double> q{1.1, 1.7, 0.8};
    const auto expected = by_repeated_integration<kOrder>(program, 0.9, q);
    ProgramExpansion expansion(program);
    std::vector<double> coefficients(expected.size());
    expansion.expand(0.9, q.data(), kOrder, coefficients.data());
    const std::string text = law[0] + "; " + law[1] + "; " + law[2];
    expect_coefficients(coefficients, expected, text);
    expect_to_solve(program, 0.9, q, text);
  }
}

TEST(ProgramExpansion, is_extended_where_its_coefficients_are) {
  using Number = long double;
  struct Known {
    const char* rate;
    std::function<Number(Number)> value;
  };
  const Known functions[] = {
      {"1/t", [](Number t) { return 1 / t; }},
      {"t^2/3", [](Number t) { return t * t / 3; }},
      {"sqrt(t)", [](Number t) { return std::sqrt(t); }},
      {"cbrt(t)", [](Number t) { return std::cbrt(t); }},
      {"exp(t)", [](Number t) { return std::exp(t); }},
      {"log(t)", [](Number t) { return std::log(t); }},
      {"log10(t)", [](Number t) { return std::log10(t); }},
      {"sin(t)", [](Number t) { return std::sin(t); }},
      {"cos(t)", [](Number t) { return std::cos(t); }},
      {"tan(t)", [](Number t) { return std::tan(t); }},
      {"sinh(t)", [](Number t) { return std::sinh(t); }},
      {"cosh(t)", [](Number t) { return std::cosh(t); }},
      {"tanh(t)", [](Number t) { return std::tanh(t); }},
      {"asin(t)", [](Number t) { return std::asin(t); }},
      {"acos(t)", [](Number t) { return std::acos(t); }},
      {"atan(t)", [](Number t) { return std::atan(t); }},
      {"atan2(t, 2)", [](Number t) { return std::atan2(t, Number(2)); }},
      {"t^0.3", [](Number t) { return std::pow(t, Number(0.3L)); }},
      {"t^t", [](Number t) { return std::pow(t, t); }},
      {"norm([t, 1, 2])", [](Number t) { return std::sqrt(t * t + 5); }},
      {"abs(t - 1)", [](Number t) { return 1 - t; }},
      {"max(t/3, t^2/3)", [](Number t) { return t / 3; }},
      {"where(t < 1, t/7, 0)", [](Number t) { return t / 7; }},
  };
  constexpr int kOrder = 24;
  const Number start = 0.0L, tau = 0.01L;  // the terms left out are below (0.01 / 0.5)^24 = 1e-41
  for (const Known& function : functions) {
    ProgramExpansionT<Number> expansion(compile({function.rate}));
    std::vector<Number> c(kOrder + 1);
    expansion.expand(0.5, &start, kOrder, c.data());
    Number rate = 0;
    for (int k = kOrder; k >= 1; --k) rate = rate * tau + static_cast<Number>(k) * c[static_cast<std::size_t>(k)];
    // the function and its first coefficients are rounded, relative to numbers up to 2
    EXPECT_NEAR(static_cast<double>(rate - function.value(0.5L + tau)), 0.0,
                16 * std::numeric_limits<Number>::epsilon())
        << function.rate;
  }
}

TEST(ProgramExpansion, constants_are_extended_where_its_coefficients_are) {
  // each rate is its constant at t = 1
  const struct {
    const char* rate;
    long double value;
  } constants[] = {{"8/3*t", 8.0L / 3.0L},
                   {"0.1*t", 0.1L},
                   {"t/0.3", 1.0L / 0.3L},
                   {"0.7/t", 0.7L},
                   {"t - 0.1", 1.0L - 0.1L},
                   {"0.1 - t", 0.1L - 1},
                   {"0.1 + 0*t", 0.1L},
                   {"1.1^(0.3*t)", std::pow(1.1L, 0.3L)},
                   {"(1.1*t)^0.3", std::pow(1.1L, 0.3L)},
                   {"10*(0.1*t)", 1.0L}};
  for (const auto& constant : constants) {
    ProgramExpansionT<long double> extended(compile({constant.rate}));
    const long double start = 0.0L;
    std::array<long double, 2> c{};
    extended.expand(1.0, &start, 1, c.data());
    EXPECT_NEAR(static_cast<double>(c[1] - constant.value), 0.0, 4 * std::numeric_limits<long double>::epsilon())
        << constant.rate;
  }
}

TEST(ProgramExpansion, order_may_change_from_call_to_call) {
  ProgramExpansion expansion(compile({"-x*norm([x, 1, t])"}));
  const double q = 0.8;
  std::vector<double> low(6), high(21), again(6);
  expansion.expand(0.3, &q, 5, low.data());
  expansion.expand(0.3, &q, 20, high.data());
  expansion.expand(0.3, &q, 5, again.data());
  for (std::size_t k = 0; k < low.size(); ++k) {
    EXPECT_EQ(low[k], high[k]);
    EXPECT_EQ(low[k], again[k]);
  }
}

/// A motion carried from branch to branch as an integrator does.
struct Leg {
  double time;   ///< of its start
  double state;  ///< at its start
  double rate;   ///< just behind its start
};

std::vector<Leg> follow(const Rates& rates, double t, double x, double duration, int order = 8,
                        const Symbols& outer = Symbols()) {
  ProgramExpansion expansion(compile(rates, outer));
  std::vector<Leg> legs;
  const double end = t + duration;
  for (int expansions = 0; expansions < 40; ++expansions) {
    std::vector<double> c(static_cast<std::size_t>(order) + 1);
    expansion.expand(t, &x, order, c.data());
    const double step = expansion.duration_until_branch(end - t);
    if (std::abs(step) < 1e-15) continue;
    legs.push_back({t, x, c[1]});
    x = 0.0;
    for (std::size_t k = c.size(); k-- > 0;) x = x * step + c[k];
    if (step == end - t) {
      legs.push_back({end, x, 0.0});
      return legs;
    }
    t += step;
  }
  ADD_FAILURE() << "no progress from t = " << t;
  return legs;
}

struct BranchCase {
  std::string law;
  double t, x, duration;
  std::vector<double> times;  ///< of the branches
  double end;                 ///< the state at the end, by hand
};

TEST(ProgramExpansion, branches_end_where_they_should) {
  const BranchCase cases[] = {
      {"abs(t - 1)", 0, 0, 3, {1}, 2.5},
      {"abs(t - 1)", 3, 0, -3, {1}, -2.5},
      {"abs(t)", 0, 0, 3, {}, 4.5},
      {"abs(t)", 0, 0, -3, {}, -4.5},
      {"abs(t^3)", -1, 0, 2, {0}, 0.5},
      {"abs((t - 1)^2)", 0, 0, 2, {}, 2.0 / 3},  // touches zero: no branch
      {"where(t < 1, 2, -3)", 0.5, 0, 1.5, {1}, -2},
      {"where(t < 1, 2, -3)", 1, 0, 1, {}, -3},
      {"where(t < 1, 2, -3)", 1, 0, -1, {}, -2},
      {"where(t <= 1, 2, -3)", 1, 0, 1, {}, -3},
      {"where(t > 1, 2, -3)", 1, 0, 1, {}, 2},
      {"where(t >= 1, 2, -3)", 1, 0, -1, {}, 3},
      {"where(t == 1, 100, 1)", 1, 0, 1, {}, 1},
      {"where(t != 1, 1, 100)", 0, 0, 2, {}, 2},
      {"where(x, 5, 1)", 0, 0, 1, {}, 5},  // x leaves zero at once
      {"floor(t)", 0.5, 0, 3, {1, 2, 3}, 4.5},
      {"floor(t)", 1, 0, -1.5, {0}, 0.5},
      {"floor(2*t)/2", 0, 0, 1, {0.5}, 0.25},
      {"sign(t - 1)", 0, 0, 3, {1}, 1},
      {"min(t, 2 - t)", 0, 0, 2, {1}, 1},
      {"max(t, 2 - t)", 0, 0, 2, {1}, 3},
      {"norm([1 - t, 0, 1 - t])", 0, 0, 2, {1}, std::sqrt(2.0)},
      {"norm([3*t, 0, 4*t])", 0, 0, 2, {}, 10},
      {"norm([3*t, 0, 4*t])", 0, 0, -2, {}, -10},
      {"norm([3*t, 0, 4*t])", -1, 0, 2, {0}, 5},
      {"where(x < 1, 2, 0.5)", 0, 0, 1.5, {0.5}, 1.5},
      {"where(abs(t - 1) < 0.5, 1, 0)", 0, 0, 2, {0.5, 1, 1.5}, 1},
      {"-sign(x - 1)", 0, 0, 3, {1}, 1},  // comes to rest
      {"-2*sign(x)", 0, 1, 2, {0.5}, 0},
  };
  for (const BranchCase& c : cases) {
    const std::vector<Leg> legs = follow({c.law}, c.t, c.x, c.duration);
    ASSERT_EQ(legs.size(), c.times.size() + 2) << c.law << " from " << c.t << " by " << c.duration;
    // roots of polynomials of low degree near 1: a few last bits
    for (std::size_t i = 0; i < c.times.size(); ++i) EXPECT_NEAR(legs[i + 1].time, c.times[i], 4e-15) << c.law;
    EXPECT_NEAR(legs.back().state, c.end, 1e-14) << c.law;
  }
}

TEST(ProgramExpansion, bouncing_sign_follows_its_closed_form) {
  // x'' = -sign x, from rest at 1/2: arcs of parabolas, a quarter period of 1 each
  ProgramExpansion expansion(compile({"y", "-sign(x)"}));
  double t = 0.0, q[2] = {0.5, 0.0}, c[2 * 4];
  std::vector<double> crossings;
  while (t < 8.0) {
    expansion.expand(t, q, 3, c);
    const double step = expansion.duration_until_branch(8.0 - t);
    for (int i = 0; i < 2; ++i) q[i] = ((c[6 + i] * step + c[4 + i]) * step + c[2 + i]) * step + c[i];
    t = step == 8.0 - t ? 8.0 : t + step;
    if (t < 8.0 && step > 0.0) crossings.push_back(t);
  }
  ASSERT_EQ(crossings.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(crossings[i], 1.0 + 2.0 * static_cast<double>(i), 1e-14);
  EXPECT_NEAR(q[0], 0.5, 1e-14);
  EXPECT_NEAR(q[1], 0.0, 1e-14);
}

TEST(ProgramExpansion, a_state_set_from_outside_forgets_the_branch_behind) {
  // The search ends where x reaches 1. Starting from x = 0.5 there, the branch is that of 0.5, not the one behind 1.
  ProgramExpansion expansion(compile({"where(x < 1, 2, -7)"}));
  double x = 0.0, c[4];
  expansion.expand(0.0, &x, 3, c);
  const double t = expansion.duration_until_branch(3.0);
  EXPECT_NEAR(t, 0.5, 1e-15);
  x = 0.5;
  expansion.expand(t, &x, 3, c);
  EXPECT_EQ(c[1], 2.0);
}

TEST(ProgramExpansion, no_series_is_not_a_number) {
  // the root of t at t = 0, and of what vanishes for good
  EXPECT_TRUE(std::isnan(first_component({"sqrt(t)"}, 0, {1}, 3)[2]));
  expect_coefficients(first_component({"sqrt(x) + x^0.3 + cbrt(x)"}, 0, {0}, 3), {0, 0, 0, 0}, "zero");
}

TEST(ProgramExpansion, tables_end_at_their_points) {
  Symbols scene;
  scene.set_table(
      "thrust", std::make_shared<const LookupTable>(std::vector{0.0, 1.0, 3.0, 4.0}, std::vector{0.0, 2.0, 2.0, 0.0}));
  const Rates law{"table('thrust', t)"};
  const std::vector<Leg> legs = follow(law, 0.0, 0.0, 4.0, 8, scene);
  ASSERT_EQ(legs.size(), 4u);
  EXPECT_NEAR(legs[1].time, 1.0, 4e-15);
  EXPECT_NEAR(legs[2].time, 3.0, 4e-15);
  // The cubic from (0, 0) to (1, 2) with slope 0 at its end and d at its start has the area 1 + d/12. The
  // last piece mirrors the first; the middle is level.
  const Program program = compile(law, scene);
  const double d = program.tables[0]->cell(0).c1;
  EXPECT_EQ(legs[0].rate, 0.0);
  EXPECT_NEAR(legs.back().state, 2.0 * (1.0 + d / 12.0) + 4.0, 1e-14);
  const std::vector<Leg> back = follow(law, 4.0, 0.0, -4.0, 8, scene);
  EXPECT_NEAR(back.back().state, -legs.back().state, 1e-14);

  ProgramExpansion expansion(program);
  double x = 0.0, c[4];
  expansion.expand(4.5, &x, 3, c);
  EXPECT_TRUE(std::isnan(c[1]));  // beyond the data
}

}  // namespace
}  // namespace trajet
