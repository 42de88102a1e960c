#include "src/law/block_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "trajet/law/evaluate.hpp"
#include "trajet/law/program_builder.hpp"
#include "trajet/law/program_expansion.hpp"
#include "trajet/law/rate_evaluator.hpp"
#include "trajet/ode/registry.hpp"
#include "trajet/scene/program_system.hpp"

/// Laws in blocks against the same laws number by number: `Evaluator` and the expansion in extended precision know no
/// blocks.
namespace trajet {
namespace {

constexpr int kDimension = 8;  // r, v, and two numbers m, n

/// The law of a body and two numbers.
Program compile(const std::string& acceleration, const std::string& m = "-m*norm(v)", const std::string& n = "0") {
  Symbols symbols;
  symbols.set_input("t", 0);
  symbols.set_inputs("r", {1, 2, 3});
  symbols.set_inputs("v", {4, 5, 6});
  const char* const names[] = {"x", "y", "z", "vx", "vy", "vz", "m", "n"};
  for (int i = 0; i < kDimension; ++i) symbols.set_input(names[i], 1 + i);
  ProgramBuilder builder(1 + kDimension);
  builder.add_output(builder.inputs({4, 5, 6}));
  builder.add_output(builder.compile_vector(acceleration, symbols));
  builder.add_output(builder.compile_scalar(m, symbols));
  builder.add_output(builder.compile_scalar(n, symbols));
  return builder.build();
}

/// Expressions of vectors and scalars, all of moderate size and without branches or poles near the states used.
class RandomFormula {
 public:
  explicit RandomFormula(unsigned seed) : random_(seed) {}

  std::string vector(int depth) {
    if (depth == 0) return one_of({"r", "v", "[0.3, 0, 0]", "[0, 0, -0.981]", "[0.2, -0.1, 0.4]", "[vy, -vx, 0]"});
    switch (below(8)) {
      case 0:
        return "(" + vector(depth - 1) + " + " + vector(depth - 1) + ")";
      case 1:
        return "(" + vector(depth - 1) + " - " + vector(depth - 1) + ")";
      case 2:
        return scalar(depth - 1) + "*" + vector(depth - 1);
      case 3:
        return vector(depth - 1) + "/(3 + " + scalar(depth - 1) + "^2)";
      case 4:
        return "cross(" + vector(depth - 1) + ", " + vector(depth - 1) + ")";
      case 5:
        return "(-" + vector(depth - 1) + ")/" + one_of({"2", "3", "0.7"});
      case 6:
        return "[" + scalar(depth - 1) + ", " + scalar(depth - 1) + ", " + scalar(depth - 1) + "]";
      default:
        return "where(t < 5, " + vector(depth - 1) + ", r)";
    }
  }

  std::string scalar(int depth) {
    if (depth == 0) return one_of({"x", "vy", "vz", "t", "m", "n", "0.5", "-2", "0.3"});
    switch (below(8)) {
      case 0:
        return "(" + scalar(depth - 1) + " - " + scalar(depth - 1) + ")";
      case 1:
        return "(" + scalar(depth - 1) + "*" + scalar(depth - 1) + ")";
      case 2:
        return "norm(" + vector(depth - 1) + " + [5, 0.1, -4])";
      case 3:
        return "(dot(" + vector(depth - 1) + ", " + vector(depth - 1) + ")/4)";
      case 4:
        return "sin(" + scalar(depth - 1) + ")";
      case 5:
        return "(0.4 - " + scalar(depth - 1) + ")";
      case 6:
        return "cos(" + scalar(depth - 1) + ")/(1.3 + " + scalar(depth - 1) + "^2)";
      default:
        return "norm([x, vy, 3])^3/30";
    }
  }

 private:
  unsigned below(unsigned n) { return static_cast<unsigned>(random_() % n); }
  std::string one_of(const std::vector<std::string>& texts) {
    return texts[below(static_cast<unsigned>(texts.size()))];
  }

  std::mt19937 random_;
};

const std::vector<double> kState{0.3, -0.4, 0.7, 1.1, 0.6, -0.5, 0.8, -0.3};

bool works_in_blocks(const Program& program) { return detail::bundle(program).has_value(); }

/// The largest difference of two numbers over their size, or over 1 where they are smaller; not a number if one is.
template <class A, class B>
double difference(const A& a, const B& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double size = 1.0 + std::abs(static_cast<double>(b[i]));
    const double each = std::abs(static_cast<double>(a[i] - b[i])) / size;
    if (std::isnan(each)) return each;
    largest = std::max(largest, each);
  }
  return largest;
}

std::vector<double> rate_in_blocks(RateEvaluator& evaluate, double t, const std::vector<double>& q) {
  std::vector<double> rate(q.size());
  evaluate(t, q.data(), rate.data());
  return rate;
}

std::vector<double> rate_by_numbers(const Program& program, double t, const std::vector<double>& q) {
  std::vector<double> rate(q.size());
  Evaluator<double> evaluate(program);
  evaluate(t, q.data(), rate.data());
  return rate;
}

/// Taylor coefficients times 0.1^k: what a step would make of them.
template <class Number>
std::vector<Number> terms(ProgramExpansionT<Number>& expansion, double t, const std::vector<double>& q, int order) {
  const std::vector<Number> start(q.begin(), q.end());
  std::vector<Number> c(q.size() * static_cast<std::size_t>(order + 1));
  expansion.expand(t, start.data(), order, c.data());
  Number power = 1;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (k > 0 && k % q.size() == 0) power *= Number(0.1);
    c[k] *= power;
  }
  return c;
}

TEST(BlockProgram, random_laws_have_the_rates_and_the_series_that_they_have_number_by_number) {
  constexpr int kLaws = 1000, kOrder = 30;  // beyond the orders whose sums have no loops
  int in_blocks = 0;
  for (unsigned seed = 0; seed < kLaws; ++seed) {
    RandomFormula random(seed);
    const std::string acceleration = random.vector(3), m = random.scalar(1), n = random.scalar(0);
    const Program program = compile(acceleration, m, n);
    in_blocks += works_in_blocks(program) ? 1 : 0;
    const std::string law = acceleration + "; " + m + "; " + n;
    RateEvaluator evaluate(program);
    // the compiler may round a product and a sum once or twice: a few roundings of intermediate numbers up to 1e2
    EXPECT_LT(difference(rate_in_blocks(evaluate, 0.9, kState), rate_by_numbers(program, 0.9, kState)), 1e-13) << law;
    ProgramExpansion blocks(program);
    ProgramExpansionT<Extended> numbers(program);
    // as in expect_coefficients of program_expansion_test: roundings of order^2 operations
    EXPECT_LT(difference(terms(blocks, 0.9, kState, kOrder), terms(numbers, 0.9, kState, kOrder)), 1e-12) << law;
  }
  EXPECT_GT(in_blocks, 150);
}

TEST(BlockProgram, laws_of_vectors_are_instructions_on_vectors) {
  const struct {
    const char* acceleration;
    std::size_t instructions;  ///< on blocks and numbers, those of m and n included
  } laws[] = {
      {"[-vx*vx/2, -vy*vy, -vz*vz/3]", 2 + 0},  // square, quotient by constants
      {"-r/norm(r)^3", 5},                      // norm, square, product, quotient, negation
      {"[0, 0, -9.81] - 0.0126*norm(v)*v + cross([0, 0, 0.3], v)", 6},
  };
  for (const auto& law : laws) {
    const auto blocks = detail::bundle(compile(law.acceleration, "0", "0"));
    ASSERT_TRUE(blocks.has_value()) << law.acceleration;
    EXPECT_EQ(blocks->instructions.size(), law.instructions) << law.acceleration;
    ASSERT_GE(blocks->groups.size(), 2u);
    EXPECT_EQ(blocks->groups[0].count, 3);
    EXPECT_EQ(blocks->groups[1].count, 3);
  }
}

TEST(BlockProgram, numbers_that_are_alike_by_chance_share_a_block) {
  // Euler's equations and the quaternion's, written as seven numbers
  Symbols symbols;
  const char* const names[] = {"q0", "q1", "q2", "q3", "w1", "w2", "w3"};
  for (int i = 0; i < 7; ++i) symbols.set_input(names[i], 1 + i);
  ProgramBuilder builder(8);
  for (const char* rate : {"-(q1*w1 + q2*w2 + q3*w3)/2", "(q0*w1 + q2*w3 - q3*w2)/2", "(q0*w2 + q3*w1 - q1*w3)/2",
                           "(q0*w3 + q1*w2 - q2*w1)/2", "-w2*w3", "w3*w1", "-w1*w2/3"})
    builder.add_output(builder.compile_scalar(Expression(rate), symbols));
  const Program program = builder.build();
  const auto blocks = detail::bundle(program);
  ASSERT_TRUE(blocks.has_value());
  EXPECT_LT(blocks->instructions.size(), program.instructions.size() * 2 / 3);
  const std::vector<double> q{0.5, -0.5, 0.1, 0.7, 1.5, -0.4, 0.9};
  RateEvaluator evaluate(program);
  EXPECT_LT(difference(rate_in_blocks(evaluate, 0.0, q), rate_by_numbers(program, 0.0, q)), 1e-15);
  ProgramExpansion in_blocks(program);
  ProgramExpansionT<Extended> by_numbers(program);
  EXPECT_LT(difference(terms(in_blocks, 0.0, q, 20), terms(by_numbers, 0.0, q, 20)), 1e-15);
}

TEST(BlockProgram, both_ways_of_time_have_the_same_series) {
  const Program program = compile("-0.1*norm(v)*v + cross([0, 1, 0.3], v) - r/norm(r)^3");
  ASSERT_TRUE(works_in_blocks(program));
  ProgramExpansion forth(program), back(program);
  const std::vector<double> first = terms(forth, 0.9, kState, 12);
  terms(back, 0.9, kState, 12);
  EXPECT_EQ(back.duration_until_branch(-0.01), -0.01);  // from now on it searches backward
  EXPECT_LT(difference(terms(back, 0.9, kState, 12), first), 1e-14);
}

TEST(BlockProgram, a_length_that_vanishes_has_the_series_that_it_has_number_by_number) {
  // from rest: |v| = 9.81 t + …, whose expansion is one in t >= 0 only
  const Program program = compile("[0, 0, -9.81] - 0.1*norm(v)*v");
  ASSERT_TRUE(works_in_blocks(program));
  std::vector<double> rest = kState;
  std::fill_n(rest.begin() + 3, 3, 0.0);
  ProgramExpansion in_blocks(program);
  ProgramExpansionT<Extended> by_numbers(program);
  EXPECT_LT(difference(terms(in_blocks, 0.0, rest, 12), terms(by_numbers, 0.0, rest, 12)), 1e-14);
  // and in blocks again, behind it
  EXPECT_LT(difference(terms(in_blocks, 0.1, kState, 12), terms(by_numbers, 0.1, kState, 12)), 1e-14);
}

TEST(BlockProgram, a_branch_that_a_vector_decides_ends_where_it_does_number_by_number) {
  const Program program = compile("where(z < 1, [0, 0, 2], [0, 0, -3]) - 0.1*norm(v)*v - 0.2*r/norm(r)^3", "0", "0");
  ASSERT_TRUE(works_in_blocks(program));
  ProgramExpansion in_blocks(program);
  ProgramExpansionT<Extended> by_numbers(program);
  std::vector<double> q = kState;
  q[2] = 0.99;  // so near that the series leaves nothing out
  q[5] = 0.5;
  std::vector<double> c(q.size() * 17);
  in_blocks.expand(0.0, q.data(), 16, c.data());
  terms(by_numbers, 0.0, q, 16);
  const double s = in_blocks.duration_until_branch(5.0);
  ASSERT_LT(s, 1.0);
  EXPECT_NEAR(s, by_numbers.duration_until_branch(5.0), 4e-15);
  // from where it is then, the other branch is taken, though rounding has put it on this side
  for (std::size_t i = 0; i < q.size(); ++i) {
    q[i] = 0.0;
    for (std::size_t k = 17; k-- > 0;) q[i] = q[i] * s + c[k * q.size() + i];
  }
  q[2] = 1.0 - 1e-15;
  EXPECT_LT(difference(terms(in_blocks, s, q, 8), terms(by_numbers, s, q, 8)), 1e-13);
  in_blocks.expand(s, q.data(), 16, c.data());
  EXPECT_LT(2.0 * c[2 * q.size() + 2], -3.0);
}

/// A law that offers no border.
class ByNumbers final : public System {
 public:
  explicit ByNumbers(const Program& program) : system_(program), evaluate_(program) {}
  int dimension() const override { return system_.dimension(); }
  void rate(double t, const double* q, double* dq) override { evaluate_(t, q, dq); }
  void jacobian(double, const double*, double*, double*) override {}
  void expand(double, const double*, int, double*) override {}
  void expand(double, const Extended*, int, Extended*) override {}
  double duration_until_branch(double duration) override { return duration; }
  int polynomial_degree() const override { return -1; }
  Structure structure() const override { return system_.structure(); }

 private:
  ProgramSystem system_;
  Evaluator<double> evaluate_;
};

/// A body that turns without torque: r, v, a quaternion, and the angular velocity in its own frame.
Program compile_solid() {
  Symbols symbols;
  symbols.set_inputs("v", {4, 5, 6});
  const char* const names[] = {"q0", "q1", "q2", "q3", "w1", "w2", "w3"};
  for (int i = 0; i < 7; ++i) symbols.set_input(names[i], 7 + i);
  ProgramBuilder builder(14);
  builder.add_output(builder.inputs({4, 5, 6}));
  builder.add_output(builder.compile_vector(Expression("[0, 0, -9.81] - 0.1*norm(v)*v"), symbols));
  for (const char* rate : {"-(q1*w1 + q2*w2 + q3*w3)/2", "(q0*w1 + q2*w3 - q3*w2)/2", "(q0*w2 + q3*w1 - q1*w3)/2",
                           "(q0*w3 + q1*w2 - q2*w1)/2", "-w2*w3", "w3*w1", "-w1*w2/3"})
    builder.add_output(builder.compile_scalar(Expression(rate), symbols));
  return builder.build();
}

TEST(BlockProgram, methods_take_the_same_steps_over_the_border_as_number_by_number) {
  Symbols symbols;
  symbols.set_inputs("r", {1, 2, 3});
  symbols.set_inputs("v", {4, 5, 6});
  ProgramBuilder point(7);
  point.add_output(point.inputs({4, 5, 6}));
  point.add_output(point.compile_vector(Expression("-r/norm(r)^3 + cross([0.1, 0.2, 0.3], v)"), symbols));
  for (const Program& program : {point.build(), compile_solid()}) {
    std::vector<double> start{1, 0.2, -0.3, 0.1, 1.1, 0.3, 0.5, -0.5, 0.1, 0.7, 1.5, -0.4, 0.9};
    start.resize(program.outputs.size());
    ProgramSystem in_blocks(program);
    ByNumbers by_numbers(program);
    ASSERT_FALSE(in_blocks.block_border().lanes.empty());
    ASSERT_TRUE(by_numbers.block_border().lanes.empty());
    // a tolerance of its own for each component, so that a mistaken one shows in the steps
    std::vector<double> tolerances(start.size());
    for (std::size_t i = 0; i < tolerances.size(); ++i) tolerances[i] = i % 3 == 1 ? 1e-9 : 1e-4;
    for (const char* name : {"euler", "midpoint", "heun", "rk4", "rk4-3/8", "bs32", "dopri5", "dop853"}) {
      const MethodInfo* method = find_method(name);
      ASSERT_NE(method, nullptr) << name;
      StepOptions options{.rtol = 0.0, .component_atol = std::make_shared<const std::vector<double>>(tolerances)};
      if (method->needs_step()) options.step = 0.125;
      Segment<> of_blocks, of_numbers;
      const auto end = [&](System& system, Segment<>& last, long& steps) {
        const auto stepper = method->make(system, options);
        stepper->start(0.0, Eigen::Map<const Eigen::VectorXd>(start.data(), static_cast<Eigen::Index>(start.size())));
        while (stepper->time() != 2.0)
          if (stepper->advance(2.0) != StepStatus::ok) break;
        stepper->fill_segment(last);
        steps = stepper->statistics().steps;
        return stepper->state();
      };
      long steps = 0, expected_steps = -1;
      const Eigen::VectorXd state = end(in_blocks, of_blocks, steps),
                            expected = end(by_numbers, of_numbers, expected_steps);
      EXPECT_EQ(steps, expected_steps) << name;
      // rounding that differs, over a few revolutions at most
      EXPECT_LT((state - expected).cwiseAbs().maxCoeff(), 1e-12) << name;
      const double middle = 0.5 * (of_numbers.t0() + of_numbers.t1());
      EXPECT_LT((of_blocks.state(middle) - of_numbers.state(middle)).cwiseAbs().maxCoeff(), 1e-12) << name;
      EXPECT_LT((of_blocks.error_bound() - of_numbers.error_bound()).cwiseAbs().maxCoeff(), 1e-12) << name;
    }
  }
}

TEST(BlockProgram, products_of_vectors_are_one_instruction) {
  const Program program = compile("-dot(r, v)*v - r*dot(v, [0.1, 0.2, 0.3])", "0", "0");
  const auto blocks = detail::bundle(program);
  ASSERT_TRUE(blocks.has_value());
  const auto count = std::count_if(blocks->instructions.begin(), blocks->instructions.end(),
                                   [](const auto& i) { return i.kind == detail::BlockInstruction::Kind::dot; });
  EXPECT_EQ(count, 2);
  ProgramExpansion in_blocks(program);
  ProgramExpansionT<Extended> by_numbers(program);
  EXPECT_LT(difference(terms(in_blocks, 0.0, kState, 20), terms(by_numbers, 0.0, kState, 20)), 1e-14);
}

TEST(BlockProgram, vectors_that_change_alike_change_each) {
  Symbols symbols;
  symbols.set_inputs("v", {4, 5, 6});
  ProgramBuilder builder(7);
  const ProgramBuilder::Value rate = builder.compile_vector(Expression("-norm(v)*v"), symbols);
  builder.add_output(rate);
  builder.add_output(rate);
  const Program program = builder.build();
  ASSERT_TRUE(works_in_blocks(program));
  const std::vector<double> q{0, 0, 0, 1, -2, 2};
  RateEvaluator evaluate(program);
  EXPECT_EQ(rate_in_blocks(evaluate, 0.0, q), (std::vector<double>{-3, 6, -6, -3, 6, -6}));
  ProgramExpansion expansion(program);
  const std::vector<double> series = terms(expansion, 0.0, q, 6);
  for (std::size_t k = 6; k < series.size(); k += 6)
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(series[k + i], series[k + 3 + i]);
}

TEST(BlockProgram, constants_may_be_replaced) {
  // the 3 lies in a slot, and in a lane of the block whose length is taken
  const Program program = compile("norm([vx, vy, 3])*v", "0", "0");
  ASSERT_TRUE(works_in_blocks(program));
  const auto three = std::find_if(program.constants.begin(), program.constants.end(),
                                  [](const Program::Constant& constant) { return constant.value.value == 3.0; });
  ASSERT_NE(three, program.constants.end());
  RateEvaluator evaluate(program);
  ProgramExpansion expansion(program);
  terms(expansion, 0.0, kState, 4);
  evaluate.set_constant(three->slot, -7.0);
  expansion.set_constant(three->slot, -7.0);
  const Program other = compile("norm([vx, vy, -7])*v", "0", "0");
  ProgramExpansion expected(other);
  EXPECT_LT(difference(rate_in_blocks(evaluate, 0.0, kState), rate_by_numbers(other, 0.0, kState)), 1e-15);
  EXPECT_EQ(terms(expansion, 0.0, kState, 4), terms(expected, 0.0, kState, 4));
}

}  // namespace
}  // namespace trajet
