#include <algorithm>
#include <array>
#include <numbers>

#include "trajet/io/units.hpp"
#include "trajet/portable.hpp"

namespace trajet::detail {

namespace {

struct NamedUnit {
  std::string_view name;
  Unit unit;
};

constexpr double kPi = std::numbers::pi;
constexpr Extended kExactPi = std::numbers::pi_v<Extended>;

/// Common units, so that an ordinary scene need not load the database of UDUNITS-2 (5 ms, more than the run of most
/// scenes). A test holds each entry against UDUNITS-2, which lacks `deg`, `rev`, `fps` and `moa`, reads `mph` as
/// milliphot, a brightness, `g0` as 1, and `mil` as a thousandth of an inch.
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
    NamedUnit{"slug", {0.45359237 * 9.80665, 0.3048, kMass}},  // lbf s^2/ft; UDUNITS-2 knows six digits
    NamedUnit{"grain", {6479891, 1e11, kMass}},
    NamedUnit{"g0", {980665, 100000, kAcceleration}},
    NamedUnit{"N", {1, 1, kForce}},
    NamedUnit{"kN", {1000, 1, kForce}},
    NamedUnit{"J", {1, 1, kTorque}},
    NamedUnit{"Hz", {1, 1, kFrequency}},
    NamedUnit{"mph", {1609344, 3600000, kSpeed}},
    NamedUnit{"fps", {3048, 10000, kSpeed}},
    NamedUnit{"knot", {1852, 3600, kSpeed}},
    NamedUnit{"rad", {1, 1, kAngle}},
    NamedUnit{"deg", {kPi, 180, kAngle, kExactPi / 180}},
    NamedUnit{"degree", {kPi, 180, kAngle, kExactPi / 180}},
    NamedUnit{"degrees", {kPi, 180, kAngle, kExactPi / 180}},
    NamedUnit{"°", {kPi, 180, kAngle, kExactPi / 180}},
    NamedUnit{"mrad", {1, 1000, kAngle}},
    NamedUnit{"mil", {1, 1000, kAngle}},
    NamedUnit{"moa", {kPi, 10800, kAngle, kExactPi / 10800}},
    NamedUnit{"rev", {2 * kPi, 1, kAngle, 2 * kExactPi}},
    NamedUnit{"revolution", {2 * kPi, 1, kAngle, 2 * kExactPi}},
    NamedUnit{"turn", {2 * kPi, 1, kAngle, 2 * kExactPi}},
    NamedUnit{"rpm", {kPi, 30, kAngularVelocity, kExactPi / 30}},
    NamedUnit{"%", {1, 100, kDimensionless}},
    NamedUnit{"1", {1, 1, kDimensionless}},
};

constexpr auto kNames = [] {
  std::array<std::string_view, kCommonUnits.size()> names;
  ranges::transform(kCommonUnits, names.begin(), &NamedUnit::name);
  return names;
}();

}  // namespace

std::span<const std::string_view> common_unit_names() { return kNames; }

const Unit* common_unit(std::string_view name) {
  const auto found = ranges::find(kCommonUnits, name, &NamedUnit::name);
  return found == kCommonUnits.end() ? nullptr : &found->unit;
}

}  // namespace trajet::detail
