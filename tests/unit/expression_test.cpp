#include "trajet/law/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "trajet/law/program_builder.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet {
namespace {

Symbols some_symbols() {
  Symbols symbols;
  symbols.set_constant("a", 2.0);
  symbols.set_constant("b", 3.0);
  symbols.set_constant("c", 5.0);
  symbols.set_constant("speed", 7.0);
  symbols.set_constant("v", Vector3(1.0, 2.0, 2.0));
  symbols.set_constant("w", Vector3(4.0, 5.0, 6.0));
  symbols.set_constant("sun.r", Vector3(10.0, 20.0, 30.0));
  symbols.set_constant("front-wheel.vx", 11.0);
  symbols.set_constant("front", 100.0);
  symbols.set_constant("wheel.vx", 1.0);
  symbols.forbid("t", "t is not allowed in a parameter");
  return symbols;
}

double scalar(const char* text) { return evaluate_scalar(text, some_symbols()); }
Vector3 vector(const char* text) { return evaluate_vector(text, some_symbols()); }

struct ScalarCase {
  const char* text;
  double value;
};

TEST(Expression, precedence_and_associativity) {
  // Every operator between neighbours of lower and higher precedence; small integers, so that equality is exact.
  const ScalarCase cases[] = {
      {"1 + 2*3", 7},
      {"(1 + 2)*3", 9},
      {"8 - 4 - 2", 2},
      {"16/4/2", 2},
      {"16/4*2", 8},
      {"2^3^2", 512},
      {"(2^3)^2", 64},
      {"-2^2", -4},
      {"(-2)^2", 4},
      {"2^-1", 0.5},
      {"2^-2^2", 0.0625},
      {"-2^-2", -0.25},
      {"- -3", 3},
      {"+3", 3},
      {"--2^2", 4},
      {"2*-3", -6},
      {"2 - -3", 5},
      {"-a*b", -6},
      {"6/-a", -3},
      {"a^b*c", 40},
      {"a*b^a", 18},
      {"1 < 2", 1},
      {"2 <= 2", 1},
      {"2 < 2", 0},
      {"3 > 2", 1},
      {"2 >= 3", 0},
      {"2 == 2", 1},
      {"2 != 2", 0},
      {"1 + 1 == 2", 1},
      {"1 < 2 and 2 < 1", 0},
      {"1 < 2 or 2 < 1", 1},
      {"not 1 < 2", 0},
      {"not 0 and 0", 0},
      {"1 or 0 and 0", 1},
      {"(1 < 2) < 3", 1},
      {".5", 0.5},
      {"5.", 5},
      {"1e-3", 1e-3},
      {"1E2", 100},
      {"1.5e+1", 15},
      {"a\n + b\t*\r\nc", 17},
      {"where(a < b, 1, 2)", 1},
      {"where(0, 1, 2)", 2},
      {"min(3, 1, 2)", 1},
      {"max(3, 1, 2, 9)", 9},
      {"pow(2, 10)", 1024},
      {"floor(-1.5)", -2},
      {"sign(-3)", -1},
      {"sign(0)", 0},
      {"abs(-3)", 3},
  };
  for (const ScalarCase& c : cases) EXPECT_EQ(scalar(c.text), c.value) << c.text;
}

TEST(Expression, functions_are_those_of_the_standard_library) {
  volatile const double argument = 0.4;  // or the compiler computes the functions, to other last bits than the library
  const double x = argument;
  Symbols symbols;
  symbols.set_constant("x", x);
  const ScalarCase cases[] = {
      {"sqrt(x)", std::sqrt(x)},   {"cbrt(x)", std::cbrt(x)},   {"exp(x)", std::exp(x)},
      {"log(x)", std::log(x)},     {"log10(x)", std::log10(x)}, {"sin(x)", std::sin(x)},
      {"cos(x)", std::cos(x)},     {"tan(x)", std::tan(x)},     {"asin(x)", std::asin(x)},
      {"acos(x)", std::acos(x)},   {"atan(x)", std::atan(x)},   {"atan2(x, -2)", std::atan2(x, -2.0)},
      {"sinh(x)", std::sinh(x)},   {"cosh(x)", std::cosh(x)},   {"tanh(x)", std::tanh(x)},
      {"x^2.3", std::pow(x, 2.3)}, {"2^x", std::pow(2.0, x)},   {"pi", std::numbers::pi},
  };
  for (const ScalarCase& c : cases) EXPECT_EQ(evaluate_scalar(c.text, symbols), c.value) << c.text;
}

TEST(Expression, vectors) {
  EXPECT_EQ(vector("v + w"), Vector3(5, 7, 8));
  EXPECT_EQ(vector("v - w"), Vector3(-3, -3, -4));
  EXPECT_EQ(vector("-v"), Vector3(-1, -2, -2));
  EXPECT_EQ(vector("a*v"), Vector3(2, 4, 4));
  EXPECT_EQ(vector("v*a/4"), Vector3(0.5, 1, 1));
  EXPECT_EQ(vector("[a, b, 1 + c]"), Vector3(2, 3, 6));
  EXPECT_EQ(vector("cross([1, 0, 0], [0, 1, 0])"), Vector3(0, 0, 1));
  EXPECT_EQ(vector("cross(v, w)"), Vector3(1, 2, 2).cross(Vector3(4, 5, 6)));
  EXPECT_EQ(vector("unit([0, 0, -3])"), Vector3(0, 0, -1));
  EXPECT_EQ(vector("where(a > b, v, w)"), Vector3(4, 5, 6));
  EXPECT_EQ(vector("2*sun.r"), Vector3(20, 40, 60));
  EXPECT_EQ(scalar("dot(v, w)"), 26);
  EXPECT_EQ(scalar("norm(v)"), 3);
}

struct ErrorCase {
  const char* text;
  int column;
  const char* words;
};

TEST(Expression, errors_point_at_the_token) {
  const ErrorCase cases[] = {
      {"", 1, "ends where"},
      {"1 +", 4, "ends where"},
      {"2 x", 3, "an operator is expected before 'x'"},
      {"(1 + 2", 7, "')' is expected"},
      {"1 + )", 5, "before ')'"},
      {"a ** b", 3, "did you mean '^'"},
      {"a = b", 3, "did you mean '=='"},
      {"a && b", 3, "did you mean 'and'"},
      {"!a", 1, "did you mean 'not'"},
      {"a # b", 3, "'#' is not allowed"},
      {"a + ©", 5, "'©' is not allowed"},
      {"1 < 2 < 3", 7, "do not chain"},
      {"1 < (2) < 3", 9, "do not chain"},
      {"1e999", 1, "outside the range"},
      {"a + sqr(b)", 5, "did you mean 'sqrt'"},
      {"a + SIN(b)", 5, "did you mean 'sin'"},
      {"sin", 1, "is a function"},
      {"sin(1, 2)", 1, "takes 1 argument, got 2"},
      {"atan2(1)", 1, "takes 2 arguments, got 1"},
      {"min(1)", 1, "2 or more arguments"},
      {"sin()", 1, "got 0"},
      {"[1, 2]", 6, "three components"},
      {"[1, 2, 3, 4]", 9, "three components"},
      {"table(a, 1)", 7, "file name in quotes"},
      {"\"x\" + 1", 1, "only allowed as the file"},
      {"table(\"x", 7, "closing quote"},
      {"a + sped", 5, "did you mean 'speed'"},
      {"a + zzzzzz", 5, "unknown name 'zzzzzz'"},
      {"a + t", 5, "t is not allowed in a parameter"},
      {"a + v", 3, "needs two scalars or two vectors, got a scalar and a vector"},
      {"v*w", 2, "dot(a, b)"},
      {"a/v", 2, "divisor"},
      {"v^2", 2, "dot(v, v)"},
      {"abs(v)", 1, "norm(v)"},
      {"v < w", 3, "takes scalars"},
      {"[a, v, b]", 5, "component"},
      {"dot(v, a)", 1, "takes vectors"},
      {"where(v, 1, 2)", 1, "condition"},
      {"where(1, v, 2)", 1, "a vector and a scalar"},
      {"a.b", 1, "unknown name 'a.b'"},
      {"1..2", 3, "an operator is expected"},
      // what other notations have
      {"ln(a)", 1, "write log(x)"},
      {"if(a > b, a, b)", 1, "write where(c, a, b)"},
      {"a > b ? a : b", 7, "write where(c, a, b)"},
      {"a**2", 2, "did you mean '^'?"},
      {"|a - b|", 1, "write abs(x), of a vector norm(v)"},
      {"a + v[0]", 6, "vx, vy, vz of v"},
      {"[0, 0, v[2]]", 9, "vx, vy, vz of v"},
      {"sin(30°)", 7, "radians"},
      {"sin(30 deg)", 8, "write 30*deg, or give a parameter the value \"30 deg\" if that is a unit"},
      {"2 a", 3, "before 'a'; write 2*a"},
      {"a*g0", 3, "unknown name 'g0': formulas are in SI units, write 9.80665 or give a parameter the value \"1 g0\""},
      {"sin(2*moa)", 7, "write pi/10800"},
      {"e^a", 1, "write exp(1)"},
      {"2*π", 3, "write pi"},
      {"a − b", 3, "did you mean '-'?"},
      {"a×b", 2, "did you mean '*'?"},
      {"a²", 2, "did you mean '^2'?"},
  };
  for (const ErrorCase& c : cases) {
    try {
      evaluate_constant(Expression::parse(c.text, {"scene.toml", 7, 21}), some_symbols());
      ADD_FAILURE() << "no error: " << c.text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.where().file, "scene.toml");
      EXPECT_EQ(error.where().line, 7) << c.text;
      EXPECT_EQ(error.where().column, 20 + c.column) << c.text << ": " << error.what();
      EXPECT_NE(error.message().find(c.words), std::string::npos) << c.text << ": " << error.what();
    }
  }
}

TEST(Expression, a_scalar_where_a_vector_is_expected_says_what_to_write) {
  try {
    vector("-a");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.message(), "a vector is expected, this is a scalar: write its direction too, [0, 0, -a]");
  }
}

TEST(Expression, constants_fold_in_extended_precision) {
  const auto constant = [](const char* text) {
    return std::get<ExtendedConstant>(evaluate_constant(text, some_symbols())).as<long double>();
  };
  EXPECT_EQ(constant("8/3"), 8.0L / 3.0L);
  EXPECT_EQ(constant("0.1"), 0.1L);
  EXPECT_EQ(constant("sqrt(2)*0.7"), std::sqrt(2.0L) * 0.7L);
  EXPECT_EQ(constant("2^0.3"), std::pow(2.0L, 0.3L));
  EXPECT_EQ(constant("8/3 - 8/3"), 0.0L);
  // what chooses does as it does in double precision: there 3*0.1 is more than 0.3
  EXPECT_EQ(constant("3*0.1 > 0.3"), 1.0L);
  EXPECT_EQ(constant("floor(0.3/0.1)"), 2.0L);
  EXPECT_EQ(evaluate_scalar("0.1 + 0.2", some_symbols()), 0.1 + 0.2);
}

TEST(Expression, lines_of_a_long_formula_are_counted) {
  try {
    scalar("a +\n b +\n  nothing_like_it");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.where().line, 3);
    EXPECT_EQ(error.where().column, 3);
    EXPECT_STREQ(error.what(), "3:3: error: unknown name 'nothing_like_it'");
  }
}

TEST(Expression, wrong_shape_points_at_the_formula) {
  EXPECT_THROW(scalar("v"), InputError);
  EXPECT_THROW(vector("a"), InputError);
}

TEST(Expression, names_with_dashes_are_names_only_where_they_are_known) {
  const std::string dashed[] = {"front-wheel", "front-wheel-drive"};
  const Symbols symbols = some_symbols();
  EXPECT_EQ(evaluate_scalar(Expression::parse("2*front-wheel.vx", {}, dashed), symbols), 22);
  EXPECT_EQ(evaluate_scalar(Expression::parse("front -wheel.vx", {}, dashed), symbols), 99);
  EXPECT_EQ(scalar("front-wheel.vx"), 99);
  EXPECT_EQ(Expression::parse("front-wheel-drive.r - front-wheel.vx-1", {}, dashed).names(),
            (std::vector<std::string>{"front-wheel-drive.r", "front-wheel.vx"}));
  EXPECT_EQ(Expression::parse("front-wheels", {}, dashed).names(), (std::vector<std::string>{"front", "wheels"}));
}

TEST(Expression, keeps_text_place_and_names) {
  const Expression e = Expression::parse("v0*cos(theta) + t*v0 + pi", {"s.toml", 2, 3});
  EXPECT_EQ(e.text(), "v0*cos(theta) + t*v0 + pi");
  EXPECT_EQ(e.where().column, 3);
  EXPECT_EQ(e.names(), (std::vector<std::string>{"v0", "theta", "t"}));
  EXPECT_EQ(Expression(0.1).text(), "0.1");
  EXPECT_EQ(Expression(Vector3(1, 2, 0.5)).text(), "[1, 2, 0.5]");
  EXPECT_EQ(Expression::vector("a", "b", 3.0).text(), "[a, b, 3]");
  EXPECT_EQ(evaluate_vector(Expression::vector("a", "b", 3.0), some_symbols()), Vector3(2, 3, 3));
}

TEST(Expression, depth_and_length_are_limited) {
  const auto nested = [](int n) {
    return std::string(static_cast<std::size_t>(n), '(') + "1" + std::string(static_cast<std::size_t>(n), ')');
  };
  EXPECT_EQ(scalar(nested(150).c_str()), 1);
  EXPECT_THROW(Expression(nested(100000)), InputError);
  EXPECT_THROW(Expression(std::string(100000, '-') + "1"), InputError);
  EXPECT_THROW(Expression("2" + std::string(100000, '^') + "1"), InputError);
  std::string sum = "1";
  for (int i = 1; i < 500; ++i) sum += "+1";
  EXPECT_EQ(scalar(sum.c_str()), 500);
  for (int i = 0; i < 100000; ++i) sum += "+1";
  EXPECT_THROW(Expression{sum}, InputError);
  EXPECT_THROW(Expression(std::string(3000000, ' ')), InputError);
}

TEST(Expression, reserved_names) {
  for (const char* name : {"t", "pi", "and", "or", "not", "sin", "where", "table"})
    EXPECT_TRUE(is_reserved_name(name)) << name;
  for (const char* name : {"x", "T", "sine", ""}) EXPECT_FALSE(is_reserved_name(name)) << name;
}

TEST(DidYouMean, nearest_name_or_none) {
  const std::string_view known[] = {"velocity", "position", "mass", "x"};
  EXPECT_EQ(did_you_mean("velocty", known), "; did you mean 'velocity'?");
  EXPECT_EQ(did_you_mean("MASS", known), "; did you mean 'mass'?");
  EXPECT_EQ(did_you_mean("psoition", known), "; did you mean 'position'?");
  EXPECT_EQ(did_you_mean("temperature", known), "");
  EXPECT_EQ(did_you_mean("q", known), "");
  const std::string_view short_names[] = {"vx", "vy"};
  EXPECT_EQ(did_you_mean("yv", short_names), "; did you mean 'vy'?");
}

}  // namespace
}  // namespace trajet
