#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace trajet {

/// Powers of the base units m, kg, s, A, K, mol, cd, rad.
struct Dimension {
  static constexpr std::size_t kBaseUnits = 8;
  std::array<int, kBaseUnits> powers{};
  bool operator==(const Dimension&) const = default;
};

inline constexpr Dimension kDimensionless{};
inline constexpr Dimension kLength{{1}};
inline constexpr Dimension kMass{{0, 1}};
inline constexpr Dimension kTime{{0, 0, 1}};
inline constexpr Dimension kSpeed{{1, 0, -1}};
inline constexpr Dimension kAcceleration{{1, 0, -2}};
inline constexpr Dimension kForce{{1, 1, -2}};
inline constexpr Dimension kAngle{{0, 0, 0, 0, 0, 0, 0, 1}};
inline constexpr Dimension kAngularVelocity{{0, 0, -1, 0, 0, 0, 0, 1}};
inline constexpr Dimension kAngularAcceleration{{0, 0, -2, 0, 0, 0, 0, 1}};
inline constexpr Dimension kDensity{{-3, 1}};
inline constexpr Dimension kInertia{{2, 1}};
inline constexpr Dimension kTorque{{2, 1, -2}};

/// Name and SI unit for messages: `length [m]`, `[m^2 kg^3]` where the dimension has no common name.
std::string describe(const Dimension& dimension);

/// Whether a quantity of one dimension may stand for one of the other: equal but for radians, which are numbers in SI.
bool interchangeable(const Dimension& a, const Dimension& b);

/// A unit of measurement: `x unit` is `x * numerator / denominator` in SI. Two factors, so that 20 cm is exactly 0.2 m.
struct Unit {
  double numerator = 1.0;
  double denominator = 1.0;
  Dimension dimension;
};

/// The unit that `text` names: `m/s`, `km/h`, `m s^-2`, `J/(kg K)`, `deg`, `rpm`, `grain`.
///
/// Products (blank, `.`, `*`), quotients (`/`, which divides by the one factor that follows) and whole powers (`^2`,
/// `2`, `²`) of names; the names are those of UDUNITS-2, and `deg` (degree), `rev` (revolution), `mph` (mile per hour).
///
/// Throws InputError without a place for unknown units and for those that are no multiple of SI units: temperatures
/// with an offset (`degC`), logarithms. Thread-safe.
Unit parse_unit(std::string_view text);

/// A quantity string in its two parts.
struct QuantityText {
  double number = 0.0;
  std::string_view unit;
};

/// Splits `text` of the form "number, blank, unit"; nothing if it has another form (then it is an expression).
/// A number beyond the range of double becomes infinity or zero.
std::optional<QuantityText> split_quantity(std::string_view text);

namespace detail {
/// A single unit, prefix and all, according to UDUNITS-2, whose database takes 5 ms to load, once; nothing if it knows
/// none of that name. Throws InputError if it is no multiple of SI units.
std::optional<Unit> udunits_unit(std::string_view name);
/// A single common unit without that database; nullptr if it is not among them.
const Unit* common_unit(std::string_view name);
}  // namespace detail

}  // namespace trajet
