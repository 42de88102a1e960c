#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "trajet/io/units.hpp"
#include "trajet/law/expression.hpp"

namespace trajet::detail {

/// Reads the text of a scalar: a quantity ("500 m/s") or an expression ("v0*cos(theta)").
///
/// `where` is the place of its first character. A quantity must have the `expected` dimension, if there is one;
/// expressions carry no units. Throws InputError at the place of the fault.
Expression read_formula(std::string_view text, const SourceLocation& where, std::span<const std::string> dashed_names,
                        std::optional<Dimension> expected);

}  // namespace trajet::detail
