#include "trajet/law/dimension.hpp"

#include <string_view>

namespace trajet {

namespace {

struct NamedDimension {
  Dimension dimension;
  std::string_view name;
};

constexpr NamedDimension kNamedDimensions[] = {
    {kDimensionless, "number without unit [1]"},
    {kLength, "length [m]"},
    {kMass, "mass [kg]"},
    {kTime, "time [s]"},
    {kSpeed, "speed [m/s]"},
    {kAcceleration, "acceleration [m/s^2]"},
    {kForce, "force [N]"},
    {kAngle, "angle [rad]"},
    {kFrequency, "frequency [1/s]"},
    {kAngularVelocity, "angular velocity [rad/s]"},
    {kAngularAcceleration, "angular acceleration [rad/s^2]"},
    {{{2}}, "area [m^2]"},
    {{{3}}, "volume [m^3]"},
    {kDensity, "density [kg/m^3]"},
    {{{1, 1, -1}}, "momentum [kg m/s]"},
    {kInertia, "moment of inertia [kg m^2]"},
    {kTorque, "energy or torque [J]"},
    {{{2, 1, -3}}, "power [W]"},
    {{{-1, 1, -2}}, "pressure [Pa]"},
    {{{0, 1, -1}}, "mass flow [kg/s]"},
    {{{0, 1, -2}}, "stiffness [N/m]"},
    {{{0, 0, 0, 0, 1}}, "temperature [K]"},
};

constexpr std::string_view kBaseSymbols[Dimension::kBaseUnits] = {"m", "kg", "s", "A", "K", "mol", "cd", "rad"};

}  // namespace

std::string describe(const Dimension& dimension) {
  Dimension plain = dimension;  // where the radians of a product say nothing: m rad/s
  plain.powers.back() = 0;
  for (const Dimension& candidate : {dimension, plain})
    for (const NamedDimension& named : kNamedDimensions)
      if (named.dimension == candidate) return std::string(named.name);
  std::string text;
  for (std::size_t i = 0; i < Dimension::kBaseUnits; ++i) {
    const int power = dimension.powers[i];
    if (power == 0) continue;
    text += (text.empty() ? "[" : " ") + std::string(kBaseSymbols[i]);
    if (power != 1) text += "^" + std::to_string(power);
  }
  return text + "]";
}

bool interchangeable(const Dimension& a, const Dimension& b) {
  Dimension c = a;
  c.powers.back() = b.powers.back();
  return c == b;
}

Dimension product(const Dimension& a, const Dimension& b, int power) {
  Dimension result = a;
  for (std::size_t i = 0; i < Dimension::kBaseUnits; ++i)
    result.powers[i] = static_cast<std::int16_t>(result.powers[i] + power * b.powers[i]);
  return result;
}

std::optional<Dimension> power_of(const Dimension& a, int numerator, int denominator) {
  Dimension result;
  for (std::size_t i = 0; i < Dimension::kBaseUnits; ++i) {
    const int power = a.powers[i] * numerator;
    if (power % denominator != 0) return std::nullopt;
    result.powers[i] = static_cast<std::int16_t>(power / denominator);
  }
  return result;
}

}  // namespace trajet
