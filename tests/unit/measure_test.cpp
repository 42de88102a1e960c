#include "trajet/law/measure.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "trajet/error.hpp"

namespace trajet {
namespace {

constexpr Dimension kDragPerMass{{-1}};

/// What is known in the tests: names of the state, constants with a unit, constants without.
Measure of_name(std::string_view name) {
  static const std::map<std::string, Measure, std::less<>> names = {
      {"x", Measure::moving(kLength)},
      {"v", Measure::moving(kSpeed)},
      {"t", Measure::moving(kTime)},
      {"length", Measure::known(kLength, true)},
      {"speed", Measure::known(kSpeed, true)},
      {"g", Measure::known(kAcceleration, true)},
      {"k", Measure::known(kDragPerMass, true)},
      {"angle", Measure::known(kAngle, true)},
      {"m", Measure::known(kMass, true)},
      {"bare", {}},
  };
  const auto found = names.find(name);
  return found == names.end() ? Measure{} : found->second;
}

struct Case {
  const char* formula;
  Dimension expected;
  const char* fault;  ///< what its error says; empty: none
};

const Case kCases[] = {
    // what is written fits or does not
    {"speed", kSpeed, ""},
    {"length", kSpeed, "1:1: error: speed [m/s] expected, got length [m]"},
    {"-length", kSpeed, "1:1: error: speed"},
    {"2*length", kSpeed, "1:1: error: speed [m/s] expected, got length [m]"},
    {"length/2", kSpeed, "got length"},
    {"pi*length", kSpeed, "got length"},
    {"length/t", kSpeed, ""},
    {"speed^2/(2*g)", kLength, ""},
    {"sqrt(2*g*length)", kSpeed, ""},
    {"(length*g)^0.5", kSpeed, ""},
    {"(length*g)^(1/2)", kMass, ""},  // an exponent that is computed is not followed
    {"speed^-1", kSpeed, "got [m^-1 s]"},
    {"speed*[cos(angle), 0, sin(angle)]", kSpeed, ""},
    {"length*[cos(angle), 0, sin(angle)]", kSpeed, "got length"},
    {"[speed, 0, length]", kSpeed, "1:1: error: the components of a vector must have one dimension, got speed [m/s]"},
    {"[0, 0, length]", kSpeed, "1:8: error: speed [m/s] expected, got length [m]"},
    {"[0, 1, 2*length]", kSpeed, "1:8: error: speed"},
    {"angle", kDimensionless, ""},
    {"length*angle", kLength, ""},
    {"speed/length", kAngularVelocity, ""},
    {"norm([length, 0, 0])", kMass, "got length"},
    {"dot([speed, 0, 0], [speed, 0, 0])", kSpeed, "got [m^2 s^-2]"},
    {"cross([speed, 0, 0], [0, 0, 1])", kLength, "got speed"},
    {"unit([speed, 0, 0])*length", kLength, ""},
    {"where(t < 2, speed, 0)", kSpeed, ""},
    {"where(x < 2, speed, length)", kSpeed, "what 'where' takes must have one dimension"},
    {"min(speed, 3, length)", kSpeed, "what 'min' takes"},
    {"floor(x/length)", kDimensionless, ""},
    {"table('a', length)*speed", kMass, ""},
    // sums and comparisons
    {"speed + 3", kSpeed, ""},
    {"3 + length", kSpeed, "got length"},
    {"speed + length", kSpeed, "1:7: error: what '+' takes must have one dimension, got speed [m/s] and length [m]"},
    {"x - speed", kLength, "1:3: error: what '-' takes must have one dimension, got length [m] and speed [m/s]"},
    {"x > speed", kDimensionless, "what '>' takes"},
    {"t < 3 and x > length", kDimensionless, ""},
    {"1 + length/x", kDimensionless, ""},
    {"1 + length", kDimensionless, "got length"},
    // functions
    {"sin(length)", kDimensionless, "'sin' takes a number without unit or an angle, got length [m]"},
    {"exp(-t/2)", kDimensionless, ""},
    {"exp(-length)", kDimensionless, "'exp' takes a number without unit, got length [m]"},
    {"log(1 + t/length)", kDimensionless, ""},  // times 1 m/s, which is left out
    {"2^length", kDimensionless, "an exponent is a number without unit, got length [m]"},
    {"atan2(length, speed)", kAngle, "what 'atan2' takes"},
    // without units, nothing contradicts
    {"-x", kAcceleration, ""},
    {"-4*x - 0.2*v", kAcceleration, ""},
    {"x + v", kLength, ""},
    {"sin(x)", kLength, ""},
    {"bare", kMass, ""},
    {"bare*length", kSpeed, ""},
    {"length + bare", kSpeed, "got length"},
    // constants hide in the factors of a law
    {"[0, 0, -g] - 0.003*norm(v)*v", kAcceleration, ""},
    {"[0, 0, -g] - 2*v", kAcceleration, ""},
    {"[0, 0, -g] - 2*(v - speed)", kAcceleration, ""},
    {"0.01*length", kSpeed, ""},
    {"[0, 0, -g] - k*norm(v)*v", kAcceleration, ""},
    {"[0, 0, -g] - k*v", kAcceleration, "1:12: error: what '-' takes must have one dimension, got acceleration"},
    {"-g*x/length", kAcceleration, ""},
    {"-g*x", kAcceleration, "got [m^2 s^-2]"},
};

TEST(Measure, DimensionsOfFormulas) {
  for (const Case& c : kCases) {
    std::string message;
    try {
      require_dimension(Expression::parse(c.formula, {"", 1, 1}), c.expected, of_name);
    } catch (const InputError& error) {
      message = error.what();
    }
    if (*c.fault == '\0') {
      EXPECT_EQ(message, "") << c.formula;
    } else {
      EXPECT_NE(message.find(c.fault), std::string::npos) << c.formula << ": " << message;
    }
  }
}

TEST(Measure, AFrequencyIsNoAngularVelocity) {
  const auto names = [](std::string_view name) {
    Measure found = Measure::known(name == "f" ? kFrequency : kAngularVelocity, true);
    found.is_frequency = name == "f";
    return found;
  };
  const auto fault = [&](const char* formula) {
    try {
      require_dimension(formula, kAngularVelocity, names);
    } catch (const InputError& error) {
      return error.message();
    }
    return std::string();
  };
  for (const char* formula : {"f", "-f", "[0, 0, f]", "f*[0, 0, 1]"})
    EXPECT_NE(fault(formula).find("got frequency [1/s]: write rev/s"), std::string::npos) << formula;
  for (const char* formula : {"w", "2*pi*f", "[0, 0, 2*pi*f]", "w*[0, 0, 1]"}) EXPECT_EQ(fault(formula), "") << formula;
}

}  // namespace
}  // namespace trajet
