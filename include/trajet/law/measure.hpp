#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "trajet/law/dimension.hpp"
#include "trajet/law/expression.hpp"

namespace trajet {

/// What is known of the dimension of a number in SI units.
///
/// Scenes may be written without units, with constants that are what SI makes of them: `-r`, `0.01*norm(v)*v`. So two
/// dimensions contradict each other only where a unit was written for one of them.
struct Measure {
  enum class Kind {
    any,     ///< nothing: a constant without a unit fits everything, and so does what is computed with it
    factor,  ///< as `any`; but a small number such as 2, 1/2 or pi changes no constant that it multiplies
    known,
  };
  Kind kind = Kind::any;
  Dimension dimension{};      ///< where known
  bool is_written = false;    ///< a unit was written for something that it is computed from
  bool moves = false;         ///< it depends on the time or the state, where constants hide in factors
  bool is_frequency = false;  ///< a constant whose unit was written as one per time, without radians or turns

  static Measure known(const Dimension& dimension, bool is_written) {
    return {.kind = Kind::known, .dimension = dimension, .is_written = is_written};
  }
  /// Of a name for what changes in time.
  static Measure moving(const Dimension& dimension) {
    return {.kind = Kind::known, .dimension = dimension, .moves = true};
  }
  bool contradicts(const Dimension& expected) const {
    return kind == Kind::known && is_written && !interchangeable(dimension, expected);
  }
};

/// What is known of the names of a formula.
using MeasureOfName = std::function<Measure(std::string_view name)>;

/// What is known of a formula's value, of all of its components alike. Throws InputError at the operator, function or
/// vector whose operands contradict each other. The formula must be one that compiles.
Measure measure(const Expression& formula, const MeasureOfName& names);

/// Throws InputError, at the component that is wrong, where a formula does not have the `expected` dimension.
void require_dimension(const Expression& formula, const Dimension& expected, const MeasureOfName& names);

/// The same of a constant that was written with a unit: the message, or nothing if it fits.
std::string dimension_fault(const Measure& measure, const Dimension& expected);

}  // namespace trajet
