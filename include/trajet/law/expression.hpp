#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trajet/error.hpp"
#include "trajet/law/dimension.hpp"
#include "trajet/math/extended_constant.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

namespace detail {
struct SyntaxNode;
class Formula;
}  // namespace detail

/// A formula as a user wrote it: parsed, not yet bound to the meaning of its names. Cheap to copy.
///
/// Scalar or 3-vector valued. Grammar and functions: docs/formats/expressions.md.
class Expression {
 public:
  Expression(double value);             // NOLINT(google-explicit-constructor): a number is a formula
  Expression(const Vector3& value);     // NOLINT(google-explicit-constructor)
  Expression(const char* text);         // NOLINT(google-explicit-constructor): parses; throws InputError
  Expression(const std::string& text);  // NOLINT(google-explicit-constructor)
  /// Parses `text`, whose first character stands at `where`. Throws InputError that points at the offending token.
  /// `dashed_names`: known names that contain `-`; where the text has one, it is that name and not a subtraction.
  static Expression parse(std::string_view text, const SourceLocation& where = {},
                          std::span<const std::string> dashed_names = {});
  /// A vector built of three scalar formulas, as `[a, b, c]`.
  static Expression vector(const Expression& x, const Expression& y, const Expression& z);
  /// A number that stands at `where` in a file: errors about its use point there.
  static Expression number(const ExtendedConstant& value, const SourceLocation& where);
  /// A number of SI units that was written with a unit of that dimension.
  static Expression quantity(const ExtendedConstant& value, const Dimension& dimension, const SourceLocation& where);

  /// The same with `place(where)` for every place in it: of a text that was cut out of another.
  Expression relocated(const std::function<SourceLocation(const SourceLocation&)>& place) const;

  /// Whether its outermost operator is a comparison, `and`, `or` or `not`, so that it is 1 or 0.
  bool is_condition() const;

  SourceLocation where() const;
  /// The text it was parsed from, or an equivalent one.
  std::string text() const;
  /// The names it uses, as written (`v0`, `sun.r`, `t`; not `pi`), each once, in order of appearance.
  std::vector<std::string> names() const;

  /// A table that the formula looks up, and where it says so.
  struct TableUse {
    std::string name;
    SourceLocation where;
  };
  /// In order of appearance.
  std::vector<TableUse> tables() const;

  /// One number, or the three of a vector.
  struct Numbers {
    int count = 0;
    std::array<ExtendedConstant, 3> values{};
  };
  /// The numbers without units that it is; none if it is any other formula.
  Numbers numbers() const;

  std::shared_ptr<const detail::SyntaxNode> tree() const;

 private:
  explicit Expression(std::shared_ptr<const detail::Formula> formula) : formula_(std::move(formula)) {}
  std::shared_ptr<const detail::Formula> formula_;
};

/// Whether the language gives the name a meaning of its own, so that no parameter, state or body can have it:
/// a function, `pi`, `t`, `and`, `or`, `not`.
bool is_reserved_name(std::string_view name);

}  // namespace trajet
