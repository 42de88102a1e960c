#include "trajet/law/program.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "trajet/law/evaluate.hpp"
#include "trajet/law/program_builder.hpp"
#include "trajet/math/interval.hpp"
#include "trajet/math/pack.hpp"
#include "trajet/math/series.hpp"

namespace trajet {
namespace {

constexpr int kInputs = 7;  // t, v, r

Symbols some_symbols() {
  Symbols symbols;
  symbols.set_input("t", 0);
  symbols.set_inputs("v", {1, 2, 3});
  symbols.set_inputs("r", {4, 5, 6});
  symbols.set_input("x", 4);
  symbols.set_input("y", 5);
  symbols.set_input("z", 6);
  return symbols;
}

Program compile(std::initializer_list<const char*> formulas) {
  ProgramBuilder builder(kInputs);
  for (const char* formula : formulas) builder.add_output(builder.compile(formula, some_symbols()));
  return builder.build();
}

std::vector<Opcode> opcodes(const Program& program) {
  std::vector<Opcode> result;
  for (const Instruction& instruction : program.instructions) result.push_back(instruction.opcode);
  return result;
}

using Opcodes = std::vector<Opcode>;

TEST(Program, rewrites) {
  const struct {
    const char* formula;
    Opcodes opcodes;
  } cases[] = {
      {"x + 0", {}},
      {"0 + x", {}},
      {"x*1", {}},
      {"x/1", {}},
      {"x^1", {}},
      {"-(-x)", {}},
      {"1*(2 + 3)*0.5", {}},
      {"where(1 < 2, x, sin(x))", {}},
      {"0*x", {Opcode::multiply_constant}},  // stays: 0 times infinity is not 0
      {"x - x", {Opcode::subtract}},
      {"x - 2", {Opcode::add_constant}},
      {"2 - x", {Opcode::constant_minus}},
      {"x + x", {Opcode::multiply_constant}},
      {"x/4", {Opcode::multiply_constant}},
      {"x/3", {Opcode::divide_constant}},
      {"-x/3", {Opcode::divide_constant}},
      {"-(x*3)", {Opcode::multiply_constant}},
      {"3/-x", {Opcode::constant_over}},
      {"x*x", {Opcode::square}},
      {"x^2", {Opcode::square}},
      {"(-x)^2", {Opcode::square}},
      {"x^3", {Opcode::square, Opcode::multiply}},
      {"x^-2", {Opcode::square, Opcode::constant_over}},
      {"x^0.5", {Opcode::sqrt}},
      {"x^1.5", {Opcode::sqrt, Opcode::multiply}},
      {"x^0.3", {Opcode::power_constant}},
      {"x^y", {Opcode::power}},
      {"sqrt(x*x + y^2 + z^2)", {Opcode::norm}},
      {"sqrt(dot(v, v))", {Opcode::norm}},
      {"norm(-v)", {Opcode::norm}},
      {"sqrt(x^2)", {Opcode::abs}},
      {"norm([0, x, 0])", {Opcode::abs}},
      {"sqrt(x^2 + y)", {Opcode::square, Opcode::add, Opcode::sqrt}},
      {"sin(x)", {Opcode::sin}},
      {"sin(x) + cos(x)", {Opcode::sin_cos, Opcode::add}},
      {"cos(x) - sin(x)", {Opcode::sin_cos, Opcode::subtract}},
      {"sinh(x)*cosh(x)", {Opcode::sinh_cosh, Opcode::multiply}},
      {"dot([0, 0, 2], v)", {Opcode::multiply_constant}},
      {"x > y", {Opcode::less}},
      {"x and y", {Opcode::where}},
  };
  for (const auto& c : cases) EXPECT_EQ(opcodes(compile({c.formula})), c.opcodes) << c.formula;
}

TEST(Program, computes_nothing_twice) {
  EXPECT_EQ(compile({"norm(v)*x", "norm(v)*y", "x*norm(v)"}).instructions.size(), 3u);
  EXPECT_EQ(compile({"x*y + z", "y*x - z"}).instructions.size(), 3u);
  EXPECT_EQ(compile({"-0.5*norm(v)*v"}).instructions.size(), 5u);  // norm, -0.5 norm, three products
  EXPECT_EQ(compile({"(x + 2)*(x - -2)"}).instructions.size(), 2u);
}

TEST(Program, computes_only_its_outputs) {
  ProgramBuilder builder(kInputs);
  builder.compile("sin(x)*exp(y)", some_symbols());
  builder.add_output(builder.compile("z*z", some_symbols()));
  EXPECT_EQ(opcodes(builder.build()), Opcodes{Opcode::square});
}

TEST(Program, outputs_may_be_inputs_and_constants) {
  const Program program = compile({"y", "2*3", "v"});
  EXPECT_TRUE(program.instructions.empty());
  Evaluator<double> evaluate(program);
  const std::array<double, 6> state{1, 2, 3, 4, 5, 6};
  std::array<double, 5> outputs{};
  evaluate(0.0, state.data(), outputs.data());
  EXPECT_EQ(outputs, (std::array<double, 5>{5, 6, 1, 2, 3}));
}

TEST(Program, drag_law_has_the_instructions_that_a_hand_would_write) {
  // dv_i/dt = -v_i^2 / k_i: a square and a division each
  EXPECT_EQ(opcodes(compile({"-x^2/3"})), (Opcodes{Opcode::square, Opcode::divide_constant}));
}

/// The outputs of a program that was opened again.
Program reopened(const Program& program) {
  ProgramBuilder builder(program);
  for (std::size_t i = 0; i < program.outputs.size(); ++i)
    builder.add_output({false, {builder.output_of_base(static_cast<int>(i)), 0, 0}});
  return builder.build();
}

TEST(Program, opened_again_is_the_same) {
  for (const char* formula : {"-x/3", "[x, 2, sin(x)*cos(x)]", "where(x < y, norm(v), x^0.3)",
                              "[cos(y), sin(y), sinh(z)*cosh(z)]", "v - 2*dot(v, r)*r", "x*y - y*x + atan2(x, y)",
                              "[x, 0, 8/3*t]", "min(x, max(y, 3))", "cross(v, r)/dot(r, r)"}) {
    const Program program = compile({formula, "x*y"});
    const Program again = reopened(program);
    EXPECT_EQ(opcodes(again), opcodes(program)) << formula;
    EXPECT_EQ(again.constants.size(), program.constants.size()) << formula;
    const std::array<double, kInputs - 1> state{0.3, -1.2, 0.7, 1.1, 2.3, -0.4};
    std::vector<double> expected(program.outputs.size()), computed(program.outputs.size());
    Evaluator<double> before(program), after(again);
    before(0.9, state.data(), expected.data());
    after(0.9, state.data(), computed.data());
    EXPECT_EQ(computed, expected) << formula;
  }
}

TEST(Program, opened_again_computes_nothing_twice) {
  ProgramBuilder builder(compile({"sin(x)*y", "norm(v)"}));
  const int product = builder.output_of_base(0);
  // sin(x)*y, asked for once more, and what is new of it
  const auto again = builder.compile("sin(x)*y + 1", some_symbols());
  builder.add_output({false, {product, 0, 0}});
  builder.add_output(again);
  EXPECT_EQ(opcodes(builder.build()), (Opcodes{Opcode::sin, Opcode::multiply, Opcode::add_constant}));
}

TEST(Program, force_by_mass) {
  ProgramBuilder builder(kInputs);
  const auto force = builder.compile_vector("[x, 2*y, -z]", some_symbols());
  builder.add_output(builder.divide(force, builder.compile_scalar("t + 1", some_symbols())));
  const Program program = builder.build();
  Evaluator<double> evaluate(program);
  const std::array<double, 6> state{0, 0, 0, 4, 5, 6};
  std::array<double, 3> outputs{};
  evaluate(3.0, state.data(), outputs.data());
  EXPECT_EQ(outputs, (std::array<double, 3>{1.0, 2.5, -1.5}));
}

// A formula made at random, as text and as its value by <cmath> alone.
struct RandomFormula {
  std::string text;
  double value;
};

constexpr std::array<double, kInputs> kPoint{0.7, 1.3, -0.4, 0.9, 0.6, -1.1, 2.2};

double oracle_sign(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : x; }

RandomFormula random_formula(rc::Random& random, int depth) {
  const auto pick = [&](std::uint64_t n) { return random.next() % n; };
  const auto number = [](double value) {
    std::ostringstream out;
    out.precision(17);
    out << value;
    return out.str();
  };
  if (depth == 0 || pick(6) == 0) {
    switch (pick(4)) {
      case 0:
        return {"t", kPoint[0]};
      case 1:
        return {"x", kPoint[4]};
      case 2:
        return {"y", kPoint[5]};
      default: {
        const double value = static_cast<double>(pick(41)) / 8.0;
        return {number(value), value};
      }
    }
  }
  const RandomFormula a = random_formula(random, depth - 1);
  const auto unary = [&](const char* name, double value) {
    return RandomFormula{std::string(name) + "(" + a.text + ")", value};
  };
  switch (pick(24)) {
    case 0:
      return unary("sin", std::sin(a.value));
    case 1:
      return unary("cos", std::cos(a.value));
    case 2:
      return unary("tanh", std::tanh(a.value));
    case 3:
      return unary("atan", std::atan(a.value));
    case 4:
      return unary("abs", std::abs(a.value));
    case 5:
      return unary("sqrt", std::sqrt(a.value));
    case 6:
      return unary("cbrt", std::cbrt(a.value));
    case 7:
      return unary("sign", oracle_sign(a.value));
    case 8:
      return unary("floor", std::floor(a.value));
    case 9:
      return unary("-", -a.value);
    case 10:
      return {"(" + a.text + ")^3", a.value * a.value * a.value};
    case 11:
      return {"(" + a.text + ")^-2", 1.0 / (a.value * a.value)};
    default:
      break;
  }
  const RandomFormula b = random_formula(random, depth - 1);
  const auto binary = [&](const char* symbol, double value) {
    return RandomFormula{"(" + a.text + ")" + symbol + "(" + b.text + ")", value};
  };
  switch (pick(10)) {
    case 0:
    case 1:
      return binary(" + ", a.value + b.value);
    case 2:
    case 3:
      return binary(" - ", a.value - b.value);
    case 4:
      return binary("*", a.value * b.value);
    case 5:
      return binary("/", a.value / b.value);
    case 6:
      return {"min(" + a.text + ", " + b.text + ")", std::min(a.value, b.value)};
    case 7:
      return {"atan2(" + a.text + ", " + b.text + ")", std::atan2(a.value, b.value)};
    case 8:
      return binary(" < ", a.value < b.value ? 1.0 : 0.0);
    default:
      return {"where((" + a.text + ") > 0.5, " + b.text + ", x)", a.value > 0.5 ? b.value : kPoint[4]};
  }
}

/// The rewrites keep every bit but for signs of zero and integer powers, written here as the compiler writes them; a
/// sign of zero shows where it is divided by or in atan2.
bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

TEST(Program, random_formulas_equal_a_walk_over_their_tree) {
  rc::Random random(20240229);
  int compared = 0;
  for (int repeat = 0; repeat < 20000; ++repeat) {
    const RandomFormula formula = random_formula(random, 5);
    if (!std::isfinite(formula.value)) continue;
    const Program program = compile({formula.text.c_str()});
    Evaluator<double> evaluate(program);
    double value = 0.0;
    evaluate(kPoint[0], kPoint.data() + 1, &value);
    EXPECT_TRUE(same(value, formula.value)) << formula.text << ": " << value << " instead of " << formula.value;
    ++compared;
  }
  EXPECT_GT(compared, 10000);
}

const char* const kSmooth[] = {
    "x*y + z/t - 3*x/y",
    "sqrt(x) + cbrt(x)",
    "exp(x)*log(t) + log10(t)",
    "sin(y)*cos(z) + tan(x)",
    "asin(y/3) + acos(y/3) + atan(z)",
    "atan2(y, x)",
    "sinh(y)*cosh(y) + tanh(z)",
    "x^2.5 + x^0.3 + x^y",
    "norm(v)*dot(v, r)",
    "1/(1 + x^2) - 2",
};
const char* const kBranching[] = {"abs(y) + min(x, y, z)*max(x, z)", "sign(y) + floor(z)",
                                  "where(x < y, x, z)*(x <= z) + (x == y)"};

TEST(Program, series_follow_the_function) {
  // Along the line input(s) = point + s direction. Differences with h = 1e-3 err by h^2 times a third derivative of up
  // to 1e2.
  const double h = 1e-3;
  std::vector<const char*> formulas(std::begin(kSmooth), std::end(kSmooth));
  formulas.insert(formulas.end(), std::begin(kBranching), std::end(kBranching));
  for (const char* formula : formulas) {
    const Program program = compile({formula});
    Evaluator<double> evaluate(program);
    const auto at = [&](double s) {
      std::array<double, kInputs> inputs = kPoint;
      for (std::size_t i = 0; i < inputs.size(); ++i) inputs[i] += s * (1.0 - 0.25 * static_cast<double>(i));
      double value = 0.0;
      evaluate(inputs[0], inputs.data() + 1, &value);
      return value;
    };
    Evaluator<Series<double, 2>> evaluate_series(program);
    std::array<Series<double, 2>, kInputs> inputs;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      inputs[i] = kPoint[i];
      inputs[i][1] = 1.0 - 0.25 * static_cast<double>(i);
    }
    Series<double, 2> series;
    evaluate_series(inputs[0], inputs.data() + 1, &series);
    EXPECT_NEAR(series[0], at(0.0), 1e-14 * (1.0 + std::abs(at(0.0)))) << formula;
    EXPECT_NEAR(series[1], (at(h) - at(-h)) / (2.0 * h), 1e-4) << formula;
    EXPECT_NEAR(series[2], 0.5 * (at(h) - 2.0 * at(0.0) + at(-h)) / (h * h), 1e-3) << formula;
  }
}

TEST(Program, packs_and_intervals_agree_with_double) {
  std::vector<const char*> formulas(std::begin(kSmooth), std::end(kSmooth));
  formulas.insert(formulas.end(), std::begin(kBranching), std::end(kBranching));
  for (const char* formula : formulas) {
    const Program program = compile({formula});
    Evaluator<double> evaluate(program);
    Evaluator<Pack> evaluate_pack(program);
    Evaluator<Interval> evaluate_interval(program);
    std::array<Pack, kInputs> packs;
    std::array<Interval, kInputs> intervals;
    std::array<std::array<double, kPackSize>, kInputs> lanes;
    for (std::size_t i = 0; i < kPoint.size(); ++i) {
      for (std::size_t lane = 0; lane < kPackSize; ++lane)
        lanes[i][lane] = kPoint[i] + 0.01 * static_cast<double>(lane);
      packs[i] = Pack::load_unaligned(lanes[i].data());
      intervals[i] = Interval(lanes[i].front(), lanes[i].back());
    }
    Pack pack;
    evaluate_pack(packs[0], packs.data() + 1, &pack);
    Interval interval;
    evaluate_interval(intervals[0], intervals.data() + 1, &interval);
    for (std::size_t lane = 0; lane < kPackSize; ++lane) {
      std::array<double, kInputs> inputs;
      for (std::size_t i = 0; i < inputs.size(); ++i) inputs[i] = lanes[i][lane];
      double value = 0.0;
      evaluate(inputs[0], inputs.data() + 1, &value);
      EXPECT_NEAR(pack.get(lane), value, 1e-13 * (1.0 + std::abs(value)))
          << formula;  // functions differ by a few last bits
      EXPECT_LE(interval.lower(), value) << formula;
      EXPECT_GE(interval.upper(), value) << formula;
    }
  }
}

TEST(Program, polynomial_degree_is_read_off_the_law) {
  const auto degree = [](std::initializer_list<const char*> rates) {
    Symbols symbols;
    symbols.set_input("t", 0);
    const char* const names[] = {"a", "b", "c"};
    for (int i = 0; i < 3; ++i) symbols.set_input(names[i], i + 1);
    ProgramBuilder builder(static_cast<int>(rates.size()) + 1);
    for (const char* rate : rates) builder.add_output(builder.compile_scalar(rate, symbols));
    return polynomial_degree(builder.build());
  };
  EXPECT_EQ(degree({"b", "-9.8"}), 2);
  EXPECT_EQ(degree({"b", "t"}), 3);
  EXPECT_EQ(degree({"b", "c*t + 1", "2"}), 4);
  EXPECT_EQ(degree({"b^2", "t/3"}), 5);
  EXPECT_EQ(degree({"b", "sin(2)"}), 2);
  EXPECT_EQ(degree({"b", "-a"}), -1);
  EXPECT_EQ(degree({"a"}), -1);
  EXPECT_EQ(degree({"1/t"}), -1);
  EXPECT_EQ(degree({"sin(t)"}), -1);
  EXPECT_EQ(degree({"abs(t)"}), -1);
  EXPECT_EQ(degree({"where(t < 1, 1, 2)"}), -1);
  EXPECT_EQ(degree({"b^10", "c^10", "t"}), -1);  // 211: beyond every Segment
}

}  // namespace
}  // namespace trajet
