#include "trajet/io/units.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <locale>
#include <sstream>
#include <string>

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
    {{{0, 0, -1}}, "frequency [1/s]"},
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

constexpr std::string_view kOperators = "+-*/^<>=!&|,()[]";

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// What a number too small or too large for a double rounds to.
double zero_or_infinity(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double number = 0.0;
  stream >> number;  // fails where the number is too large
  return stream.fail() ? std::numeric_limits<double>::infinity() : number;
}

}  // namespace

std::string describe(const Dimension& dimension) {
  for (const NamedDimension& named : kNamedDimensions)
    if (named.dimension == dimension) return std::string(named.name);
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

std::optional<QuantityText> split_quantity(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  if (text.empty() || (text.front() != '.' && (text.front() < '0' || text.front() > '9'))) return std::nullopt;

  QuantityText quantity;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), quantity.number);
  if (error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range) quantity.number = zero_or_infinity(std::string(text.data(), end));
  if (negative) quantity.number = -quantity.number;

  quantity.unit = text.substr(static_cast<std::size_t>(end - text.data()));
  if (quantity.unit.empty() || !is_blank(quantity.unit.front())) return std::nullopt;
  while (is_blank(quantity.unit.front())) quantity.unit.remove_prefix(1);
  if (kOperators.find(quantity.unit.front()) != std::string_view::npos) return std::nullopt;
  for (const std::string_view word : {"and", "or"}) {
    const std::string_view rest = quantity.unit.substr(std::min(word.size(), quantity.unit.size()));
    if (quantity.unit.starts_with(word) && !rest.empty() && (is_blank(rest.front()) || rest.front() == '('))
      return std::nullopt;
  }
  return quantity;
}

}  // namespace trajet
