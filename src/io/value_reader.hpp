#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formula_text.hpp"
#include "toml_document.hpp"
#include "trajet/io/units.hpp"
#include "trajet/law/expression.hpp"

namespace trajet::detail {

/// One table of a scene file: typed access to its values, every fault an InputError at its place.
class TableReader {
 public:
  /// `title` names the table in messages: `[time]`, `[[body]]`.
  TableReader(const TomlDocument& document, const toml::table& table, std::string title, SourceLocation where,
              FormulaReader& formulas)
      : document_(document), table_(table), title_(std::move(title)), where_(where), formulas_(formulas) {}

  /// The same table under another title.
  TableReader titled(std::string title) const { return {document_, table_, std::move(title), where_, formulas_}; }

  const std::string& title() const { return title_; }
  const toml::table& table() const { return table_; }
  /// Of the table.
  const SourceLocation& where() const { return where_; }
  /// Of the value of `key`, or of the table if there is none.
  SourceLocation where(std::string_view key) const;

  /// Throws at the first key that is not `allowed`.
  void check_keys(std::span<const std::string_view> allowed) const;

  bool has(std::string_view key) const { return table_.contains(key); }
  bool is_array(std::string_view key) const { return has(key) && table_.get(key)->is_array(); }
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;

  // Each throws if the key is missing, unless there is a default.
  std::string text(std::string_view key) const;
  /// An array of strings, which may be empty.
  std::vector<std::string> texts(std::string_view key) const;
  /// true or false.
  bool flag(std::string_view key) const;
  long whole_number(std::string_view key, long smallest, long default_value) const;
  Expression scalar(std::string_view key, std::optional<Dimension> expected) const;
  Expression vector(std::string_view key, std::optional<Dimension> expected) const;
  /// A scalar or a vector.
  Expression formula(std::string_view key) const;
  std::vector<Expression> scalars(std::string_view key, std::size_t count, Dimension expected) const;
  std::vector<Expression> vectors(std::string_view key, std::size_t count, Dimension expected) const;
  /// Any number, at least one.
  std::vector<Expression> scalar_list(std::string_view key, Dimension expected) const;
  std::vector<Expression> vector_list(std::string_view key, Dimension expected) const;
  TableReader subtable(std::string_view key) const;
  /// An array of tables, at least one; each has the title `title`.
  std::vector<TableReader> subtables(std::string_view key, const std::string& title) const;

  std::optional<Expression> optional_scalar(std::string_view key, Dimension expected) const;
  std::optional<Expression> optional_vector(std::string_view key, Dimension expected) const;

  /// The index among `choices` of the word that `key` holds, or `default_choice`.
  std::size_t choice(std::string_view key, std::span<const std::string_view> choices, std::size_t default_choice) const;

 private:
  const toml::node& required(std::string_view key) const;
  const toml::array& array(std::string_view key, std::size_t count) const;
  Expression scalar_of(const toml::node& node, std::optional<Dimension> expected) const;
  Expression vector_of(const toml::node& node, std::optional<Dimension> expected) const;
  Expression expression_of(const toml::value<std::string>& value, std::optional<Dimension> expected) const;
  [[noreturn]] void fail_type(const toml::node& node, const std::string& expected) const;

  const TomlDocument& document_;
  const toml::table& table_;
  std::string title_;
  SourceLocation where_;
  FormulaReader& formulas_;
};

}  // namespace trajet::detail
