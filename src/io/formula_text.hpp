#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trajet/io/units.hpp"
#include "trajet/law/expression.hpp"
#include "trajet/law/lookup_table.hpp"
#include "trajet/law/measure.hpp"

namespace trajet::detail {

/// Reads the formulas of one scene, and the tables that they look up.
class FormulaReader {
 public:
  using Tables = std::map<std::string, std::shared_ptr<const LookupTable>>;

  /// `scene_file` is where the paths of tables start from. `tables` are known already.
  explicit FormulaReader(std::string scene_file, Tables tables = {})
      : scene_file_(std::move(scene_file)), tables_(std::move(tables)) {}

  /// A parameter, an extra state or a body. Names with `-` must be known before formulas use them.
  void add_name(std::string_view name);

  /// Reads the text of a scalar or a vector: a quantity ("500 m/s"), a vector of quantities and expressions
  /// ("[3 m/s, 0, v0]"), or an expression ("v0*cos(theta)").
  ///
  /// `where` is the place of its first character. A quantity must have the `expected` dimension, if there is one; the
  /// dimensions of expressions are found when all names are known. Throws InputError at the place of the fault.
  Expression read(std::string_view text, const SourceLocation& where, std::optional<Dimension> expected) const;

  /// Reads the tables that a formula looks up and that are not known yet. Throws FileError at the place that names one
  /// that cannot be read, InputError that points into it if it is wrong.
  void read_tables(const Expression& formula);

  const Tables& tables() const { return tables_; }

 private:
  bool is_name(std::string_view text) const;
  /// A vector in brackets of which at least one component is a quantity; nothing where it is anything else.
  std::optional<Expression> vector_of_quantities(std::string_view text, const SourceLocation& where,
                                                 std::optional<Dimension> expected) const;
  Expression quantity(const QuantityText& quantity, const SourceLocation& where, const SourceLocation& where_unit,
                      std::optional<Dimension> expected) const;
  void refuse_missing_blank(std::string_view text, const SourceLocation& where) const;

  std::string scene_file_;
  Tables tables_;
  std::vector<std::string> names_;
  std::vector<std::string> dashed_names_;
};

}  // namespace trajet::detail
