#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "trajet/law/dimension.hpp"
#include "trajet/portable.hpp"

namespace trajet {

/// A unit of measurement: `x unit` is `x * numerator / denominator` in SI. Two factors, so that 20 cm is exactly 0.2 m.
struct Unit {
  double numerator = 1.0;
  double denominator = 1.0;
  Dimension dimension;
  /// Numerator / denominator in extended precision.
  Extended exact_factor = static_cast<Extended>(numerator) / static_cast<Extended>(denominator);
};

/// The unit that `text` names: `m/s`, `km/h`, `m s^-2`, `J/(kg K)`, `deg`, `rpm`, `grain`.
///
/// Products (blank, `.`, `*`), quotients (`/`, which divides by the one factor that follows) and whole powers (`^2`,
/// `2`, `²`) of names; the names are those of UDUNITS-2, and `deg`, `rev`, `mph`, `fps` (foot per second), `g0`
/// (standard gravity), `moa` (minute of angle), `mil` (a thousandth of a radian, as in sights).
///
/// Throws InputError without a place for unknown units, for those that UDUNITS-2 knows by accident only (`nmi`: a
/// billionth of a mile), and for those that are no multiple of SI units: temperatures with an offset (`degC`),
/// logarithms. Thread-safe.
Unit parse_unit(std::string_view text);

/// A quantity string in its two parts.
struct QuantityText {
  double number = 0.0;
  Extended exact_number = 0.0L;  ///< in extended precision
  std::string_view number_text{};
  std::string_view unit{};
};

/// Splits `text` of the form "number, blank, unit"; nothing if it has another form (then it is an expression).
/// A number beyond the range of double becomes infinity or zero.
std::optional<QuantityText> split_quantity(std::string_view text);

namespace detail {
/// A single unit, prefix and all, according to UDUNITS-2, whose database takes 5 ms to load, once; nothing if it knows
/// none of that name. Throws InputError if it is no multiple of SI units, or is a prefix before what takes none.
std::optional<Unit> udunits_unit(std::string_view name);
/// A single common unit without that database; nullptr if it is not among them.
const Unit* common_unit(std::string_view name);
std::span<const std::string_view> common_unit_names();
}  // namespace detail

}  // namespace trajet
