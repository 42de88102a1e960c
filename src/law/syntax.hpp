#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trajet/error.hpp"
#include "trajet/law/dimension.hpp"
#include "trajet/math/extended_constant.hpp"

namespace trajet::detail {

/// What a node of the syntax tree does with its children: operators and functions alike.
enum class Operation {
  // operators
  negate,
  logical_not,
  add,
  subtract,
  multiply,
  divide,
  power,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  logical_and,
  logical_or,
  // functions
  sqrt,
  cbrt,
  exp,
  log,
  log10,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  atan2,
  sinh,
  cosh,
  tanh,
  abs,
  sign,
  min,
  max,
  pow,
  floor,
  dot,
  cross,
  norm,
  unit,
  where,
  table,
};

/// A node of a parsed formula. Names have no meaning yet.
struct SyntaxNode {
  enum class Kind { number, name, vector, operation };

  Kind kind = Kind::number;
  SourceLocation where;                     ///< of the token that makes it: number, name, `[`, operator, function name
  ExtendedConstant value{};                 ///< number, in SI units
  std::optional<Dimension> dimension{};     ///< of a number that was written with a unit
  Operation operation = Operation::negate;  ///< operation
  std::string text;                         ///< name, or the operator or function as written
  std::string table;                        ///< operation `table`: its name as written
  std::vector<SyntaxNode> children;
  int height = 1;  ///< levels of the tree below and including this node
};

/// A function of the language and how many arguments it takes.
struct FunctionInfo {
  std::string_view name;
  Operation operation;
  int min_arguments;
  int max_arguments;
};

/// The function of that name, or nullptr.
const FunctionInfo* find_function(std::string_view name);

/// Parses a formula. Throws InputError that points at the offending token.
SyntaxNode parse_formula(std::string_view text, const SourceLocation& where, std::span<const std::string> dashed_names);

}  // namespace trajet::detail
