#pragma once

#include <array>
#include <memory>
#include <string>

#include "syntax.hpp"
#include "trajet/error.hpp"
#include "trajet/law/expression.hpp"
#include "trajet/math/extended_constant.hpp"

namespace trajet::detail {

/// A whole formula: what an Expression shares among its copies. Scenes have numbers by the hundred thousand, which are
/// kept without a tree.
class Formula {
 public:
  virtual ~Formula() = default;
  virtual SourceLocation where() const = 0;
  virtual std::string text() const = 0;
  /// `self`: this formula, which lives as long as the tree.
  virtual std::shared_ptr<const SyntaxNode> tree(const std::shared_ptr<const Formula>& self) const = 0;
  /// Those that it is, if it is nothing else.
  virtual Expression::Numbers numbers() const { return {}; }
};

/// A formula that was parsed, or put together.
class ParsedFormula final : public Formula {
 public:
  ParsedFormula(SyntaxNode root, SourceLocation where, std::string text);

  SourceLocation where() const override { return where_; }
  std::string text() const override { return text_; }
  std::shared_ptr<const SyntaxNode> tree(const std::shared_ptr<const Formula>& self) const override {
    return {self, &root_};
  }

 private:
  SyntaxNode root_;
  SourceLocation where_;
  std::string text_;
};

/// A number without a unit.
class NumberFormula final : public Formula {
 public:
  NumberFormula(const ExtendedConstant& value, SourceLocation where);

  SourceLocation where() const override { return where_; }
  std::string text() const override;
  std::shared_ptr<const SyntaxNode> tree(const std::shared_ptr<const Formula>& self) const override;
  Expression::Numbers numbers() const override { return {1, {value_}}; }

 private:
  ExtendedConstant value_;
  SourceLocation where_;
};

/// Three numbers without units that stand on one line. Of their remainders the bits that single precision has.
class VectorOfNumbers final : public Formula {
 public:
  VectorOfNumbers(const std::array<ExtendedConstant, 3>& values, const SourceLocation& where_x, int column_y,
                  int column_z);
  /// Whether the number is kept as it is: always where Extended has 64 bits, but for the tiniest.
  static bool keeps(const ExtendedConstant& value);

  SourceLocation where() const override { return where(0); }
  std::string text() const override;
  std::shared_ptr<const SyntaxNode> tree(const std::shared_ptr<const Formula>& self) const override;
  Expression::Numbers numbers() const override { return {3, {value(0), value(1), value(2)}}; }

 private:
  SourceLocation where(std::size_t component) const { return {file_, line_, columns_[component]}; }
  ExtendedConstant value(std::size_t component) const;

  TextName file_;
  std::array<double, 3> values_{};
  std::array<float, 3> remainders_{};
  int line_;
  std::array<int, 3> columns_;
};

/// The node of a number without a unit.
SyntaxNode number_node(const ExtendedConstant& value, const SourceLocation& where);

/// The node of a vector of three components.
SyntaxNode vector_node(SyntaxNode x, SyntaxNode y, SyntaxNode z, const SourceLocation& where);

}  // namespace trajet::detail
