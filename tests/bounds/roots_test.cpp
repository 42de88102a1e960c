// The bounds of roots: Horner's rounding, Root::error_bound, and the crossings of an event, against a hundred digits.

#include "trajet/math/roots.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

#include "bounds/exact.hpp"
#include "trajet/event/event_watch.hpp"
#include "trajet/law/program_builder.hpp"
#include "trajet/ode/segment.hpp"

namespace trajet {
namespace {

using test::Coverage;
using test::Random;
using test::Rational;
using test::Real;

/// |error| / bound of the value that Horner's rule gives.
double horner_coverage(const std::vector<double>& p, double t) {
  const FunctionSample sample = PolynomialFunction(p, 0.0, 1.0, 0.0).at(t);
  const Rational error = abs(Rational(sample.jet.value) - test::evaluate(std::span<const double>(p), Rational(t)));
  return error == 0 ? 0.0 : static_cast<double>(error / Rational(sample.value_error));
}

TEST(RootBounds, HornersRuleRoundsNoMoreThanItSays) {
  Random random(11);
  Coverage coverage;
  for (int sample = 0; sample < 20000; ++sample) {
    const int degree = random.integer(1, 12);
    std::vector<double> p = random.coefficients(degree);
    coverage.add(horner_coverage(p, random.scaled(1e-3, 10.0)), 1.0, "degree " + std::to_string(degree));
  }
  std::printf("largest |error| / bound %.3f, %s\n", coverage.largest(), coverage.what().c_str());
  EXPECT_LE(coverage.largest(), 1.0);
  EXPECT_GE(coverage.largest(), 0.3);
}

/// The coverage of the bounds of all crossings of one polynomial.
void check_crossings(const std::vector<double>& p, double begin, double end, Coverage& coverage) {
  visit_roots(p, begin, end, 0.0, [&](const Root& root) {
    if (root.kind != RootKind::crossing || root.at_begin || root.at_end) return true;
    const std::span<const double> c(p);
    const Real exact = test::root_near([&](const Real& t) { return test::evaluate(c, t); }, root.time,
                                       2.0 * root.error_bound);
    EXPECT_FALSE(isnan(exact)) << root.time << " +- " << root.error_bound;
    coverage.add(std::abs(static_cast<double>(Real(root.time) - exact)), root.error_bound,
                 "degree " + std::to_string(p.size() - 1));
    return true;
  });
}

TEST(RootBounds, RootsLieWithinTheirErrorBounds) {
  Random random(12);
  Coverage coverage;
  for (int sample = 0; sample < 6000; ++sample) {
    std::vector<double> p = random.coefficients(random.integer(1, 9));
    if (sample % 3 == 0) p[0] *= 1e-3;  // a root near the begin, where the terms are small
    check_crossings(p, random.uniform(-1.5, 0.0), random.uniform(0.0, 1.5), coverage);
  }
  std::printf("largest |error| / bound %.3f, %s\n", coverage.largest(), coverage.what().c_str());
  EXPECT_LE(coverage.largest(), 1.0);
  // Half of the bound would be reached by none of these either: the window tells that it has not become larger or
  // smaller.
  EXPECT_GE(coverage.largest(), 0.2);
  EXPECT_LE(coverage.largest(), 0.45);
}

/// Two roots that hardly differ: the bound is the run of times at which the function cannot be told from zero.
TEST(RootBounds, NearlyDoubleRootsLieWithinTheirErrorBounds) {
  Random random(13);
  int touches = 0;
  for (int sample = 0; sample < 2000; ++sample) {
    // (t - r)^2 = d^2 to rounding
    const double r = random.uniform(0.2, 0.8);
    const double d = std::exp(random.uniform(std::log(1e-10), std::log(1e-5)));
    const std::vector<double> p{r * r - d * d, -2.0 * r, 1.0};
    // exactly: the vertex and the two roots, if the rounded coefficients have them
    const Real vertex = -Real(p[1]) / 2;
    const Real square = vertex * vertex - Real(p[0]);
    const Real exact[] = {vertex - sqrt(square < 0 ? Real(0) : square), vertex + sqrt(square < 0 ? Real(0) : square)};
    std::vector<Root> found;
    visit_roots(p, 0.0, 1.0, 0.0, [&](const Root& root) {
      found.push_back(root);
      return true;
    });
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Root& root = found[i];
      touches += root.kind == RootKind::touch;
      const Real& nearest = found.size() == 2 ? exact[i] : abs(exact[0] - root.time) < abs(exact[1] - root.time) ? exact[0] : exact[1];
      EXPECT_LE(abs(Real(root.time) - nearest), Real(root.error_bound)) << r << " " << d;
      EXPECT_LE(root.error_bound, 1e-6);
    }
    if (square > 1e-14) {
      EXPECT_EQ(found.size(), 2u) << r << " " << d;
    }
  }
  EXPECT_GT(touches, 100);
}

Segment<> segment_of(double t0, double t1, const std::vector<std::vector<double>>& components) {
  Segment<> segment;
  segment.resize(static_cast<int>(components.size()), static_cast<int>(components[0].size()) - 1);
  segment.set_interval(t0, t1);
  segment.error_bound().setZero();
  for (Eigen::Index i = 0; i < segment.coefficients().rows(); ++i)
    for (Eigen::Index k = 0; k < segment.coefficients().cols(); ++k)
      segment.coefficients()(i, k) = components[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
  return segment;
}

Program program_of(const std::string& formula) {
  Symbols symbols;
  symbols.set_input("t", 0);
  symbols.set_input("x", 1);
  symbols.set_input("y", 2);
  ProgramBuilder builder(3);
  builder.add_output(builder.compile_scalar(Expression::parse(formula, {}), symbols));
  return builder.build();
}

struct WatchedFormula {
  const char* text;
  Real (*value)(const Real& t, const Real& x, const Real& y);
};

TEST(RootBounds, EventsLieWithinTheirErrorBounds) {
  const WatchedFormula formulas[] = {
      {"x", [](const Real&, const Real& x, const Real&) { return x; }},
      {"x*y - 1/4", [](const Real&, const Real& x, const Real& y) { return Real(x * y - Real(0.25)); }},
      {"sqrt(x^2 + y^2) - 1", [](const Real&, const Real& x, const Real& y) { return Real(sqrt(x * x + y * y) - 1); }},
      {"sin(3*x) - y", [](const Real&, const Real& x, const Real& y) { return Real(sin(3 * x) - y); }},
      {"exp(x) - 2*t", [](const Real& t, const Real& x, const Real&) { return Real(exp(x) - 2 * t); }},
  };
  Random random(14);
  for (const WatchedFormula& formula : formulas) {
    Coverage coverage;
    int found = 0;
    for (int sample = 0; sample < 1500; ++sample) {
      const int degree = random.integer(1, 6);
      const double t0 = sample % 2 == 0 ? 0.0 : random.uniform(0.0, 100.0);
      const std::vector<double> x = random.coefficients(degree, 2.0);
      const std::vector<double> y = random.coefficients(degree, 2.0);
      const Segment<> segment = segment_of(t0, t0 + 1.0, {x, y});
      EventWatch watch(program_of(formula.text), CrossingDirection::any);
      const double start[] = {x[0], y[0]};
      const double no_rounding[] = {0.0, 0.0};
      watch.restart(t0, start, start, no_rounding);
      watch.search(segment, t0);
      const EventWatch::Crossing& crossing = watch.next();
      if (!crossing.found || crossing.undecided) continue;
      const auto value = [&](const Real& t) {
        const Real tau = t - Real(t0);
        return formula.value(t, test::evaluate(std::span<const double>(x), tau),
                             test::evaluate(std::span<const double>(y), tau));
      };
      const Real exact = test::root_near(value, crossing.time, 2.0 * crossing.error_bound);
      ASSERT_FALSE(isnan(exact)) << formula.text << ": " << crossing.time << " +- " << crossing.error_bound;
      EXPECT_EQ(value(exact + 1e-9) > 0, crossing.direction > 0) << formula.text;
      coverage.add(std::abs(static_cast<double>(Real(crossing.time) - exact)), crossing.error_bound);
      ++found;
    }
    std::printf("%-20s %4d crossings, largest |error| / bound %.3f\n", formula.text, found, coverage.largest());
    EXPECT_GT(found, 300) << formula.text;
    EXPECT_LE(coverage.largest(), 1.0) << formula.text;
    EXPECT_GE(coverage.largest(), 0.1) << formula.text;
  }
}

}  // namespace
}  // namespace trajet
