#include <algorithm>
#include <array>
#include <charconv>
#include <numbers>

#include "trajet/io/units.hpp"

namespace trajet::detail {

namespace {

struct NamedUnit {
  std::string_view name;
  Unit unit;
};

constexpr double kPi = std::numbers::pi;
constexpr Dimension kPerTime{{0, 0, -1}};
constexpr Dimension kEnergy{{2, 1, -2}};
constexpr Dimension kAngularSpeed{{0, 0, -1, 0, 0, 0, 0, 1}};

/// Common units, so that an ordinary scene need not load the database of UDUNITS-2 (5 ms, more than the run of most
/// scenes). A test holds each entry against UDUNITS-2.
constexpr std::array kCommonUnits{
    NamedUnit{"m", {1, 1, kLength}},
    NamedUnit{"cm", {1, 100, kLength}},
    NamedUnit{"mm", {1, 1000, kLength}},
    NamedUnit{"um", {1, 1e6, kLength}},
    NamedUnit{"km", {1000, 1, kLength}},
    NamedUnit{"in", {254, 10000, kLength}},
    NamedUnit{"inch", {254, 10000, kLength}},
    NamedUnit{"ft", {3048, 10000, kLength}},
    NamedUnit{"foot", {3048, 10000, kLength}},
    NamedUnit{"feet", {3048, 10000, kLength}},
    NamedUnit{"yd", {9144, 10000, kLength}},
    NamedUnit{"yard", {9144, 10000, kLength}},
    NamedUnit{"mile", {1609344, 1000, kLength}},
    NamedUnit{"s", {1, 1, kTime}},
    NamedUnit{"ms", {1, 1000, kTime}},
    NamedUnit{"us", {1, 1e6, kTime}},
    NamedUnit{"min", {60, 1, kTime}},
    NamedUnit{"h", {3600, 1, kTime}},
    NamedUnit{"hour", {3600, 1, kTime}},
    NamedUnit{"kg", {1, 1, kMass}},
    NamedUnit{"g", {1, 1000, kMass}},
    NamedUnit{"mg", {1, 1e6, kMass}},
    NamedUnit{"lb", {45359237, 1e8, kMass}},
    NamedUnit{"grain", {6479891, 1e11, kMass}},
    NamedUnit{"N", {1, 1, kForce}},
    NamedUnit{"kN", {1000, 1, kForce}},
    NamedUnit{"J", {1, 1, kEnergy}},
    NamedUnit{"Hz", {1, 1, kPerTime}},
    NamedUnit{"mph", {1609344, 3600000, kSpeed}},
    NamedUnit{"knot", {1852, 3600, kSpeed}},
    NamedUnit{"rad", {1, 1, kAngle}},
    NamedUnit{"deg", {kPi, 180, kAngle}},
    NamedUnit{"degree", {kPi, 180, kAngle}},
    NamedUnit{"degrees", {kPi, 180, kAngle}},
    NamedUnit{"°", {kPi, 180, kAngle}},
    NamedUnit{"rev", {2 * kPi, 1, kAngle}},
    NamedUnit{"revolution", {2 * kPi, 1, kAngle}},
    NamedUnit{"turn", {2 * kPi, 1, kAngle}},
    NamedUnit{"rpm", {kPi, 30, kAngularSpeed}},
    NamedUnit{"%", {1, 100, kDimensionless}},
    NamedUnit{"1", {1, 1, kDimensionless}},
};

const Unit* find_common(std::string_view name) {
  for (const NamedUnit& entry : kCommonUnits)
    if (entry.name == name) return &entry.unit;
  return nullptr;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes a name off the front of `text`: letters, or one of the signs for degree, per cent and one.
std::string_view take_name(std::string_view& text) {
  std::size_t length = 0;
  while (length < text.size() && is_letter(text[length])) ++length;
  for (const std::string_view sign : {"°", "%", "1"})
    if (length == 0 && text.starts_with(sign)) length = sign.size();
  const std::string_view name = text.substr(0, length);
  text.remove_prefix(length);
  return name;
}

/// Takes a power off the front of `text`: `2`, `^2`, `-2`, `^-2`; 1 if there is none.
int take_power(std::string_view& text) {
  std::string_view digits = text.starts_with('^') ? text.substr(1) : text;
  int power = 1;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), power);
  if (error == std::errc()) text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return power;
}

/// `product` times `factor` to the `power`.
void multiply(Unit& product, const Unit& factor, int power) {
  for (int i = 0; i < power; ++i) product.numerator *= factor.numerator, product.denominator *= factor.denominator;
  for (int i = 0; i > power; --i) product.numerator *= factor.denominator, product.denominator *= factor.numerator;
  for (std::size_t i = 0; i < Dimension::kBaseUnits; ++i)
    product.dimension.powers[i] += power * factor.dimension.powers[i];
}

}  // namespace

std::optional<Unit> common_unit(std::string_view text) {
  // unit = factor { (blank | "." | "*" | "/") factor };  factor = name [ ["^"] integer ].  "/" divides by one factor
  // only.
  constexpr int kMaxPower = 4;  // higher ones are left to UDUNITS-2, which knows its limits
  Unit unit;
  int sign = 1;
  while (true) {
    const std::string_view name = take_name(text);
    const Unit* factor = find_common(name);
    if (factor == nullptr) return std::nullopt;
    const bool is_number = is_digit(name.front());
    const int power = is_number ? 1 : take_power(text);
    if (power > kMaxPower || power < -kMaxPower) return std::nullopt;
    multiply(unit, *factor, sign * power);
    if (text.empty()) return unit;

    const std::size_t next = text.find_first_not_of(' ');
    const bool blank = next != 0;
    text.remove_prefix(std::min(next, text.size()));
    sign = text.starts_with('/') ? -1 : 1;
    if (text.starts_with('/') || text.starts_with('*') || text.starts_with('.')) {
      text.remove_prefix(1);
      text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    } else if (!blank) {
      return std::nullopt;
    }
  }
}

}  // namespace trajet::detail
