#include "trajet/law/expression.hpp"

#include <array>
#include <utility>

#include "formula.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

using detail::Formula;
using detail::NumberFormula;
using detail::ParsedFormula;
using detail::SyntaxNode;
using detail::VectorOfNumbers;

std::shared_ptr<const Formula> parsed(std::string_view text, const SourceLocation& where,
                                      std::span<const std::string> dashed_names) {
  return std::make_shared<const ParsedFormula>(detail::parse_formula(text, where, dashed_names), where,
                                               std::string(text));
}

void collect_names(const SyntaxNode& node, std::vector<std::string>& names) {
  if (node.kind == SyntaxNode::Kind::name && ranges::find(names, node.text) == names.end()) names.push_back(node.text);
  for (const SyntaxNode& child : node.children) collect_names(child, names);
}

void collect_tables(const SyntaxNode& node, std::vector<Expression::TableUse>& tables) {
  const bool is_table = node.kind == SyntaxNode::Kind::operation && node.operation == detail::Operation::table;
  if (is_table) tables.push_back({node.table, node.where});
  for (const SyntaxNode& child : node.children) collect_tables(child, tables);
}

void relocate(SyntaxNode& node, const std::function<SourceLocation(const SourceLocation&)>& place) {
  node.where = place(node.where);
  for (SyntaxNode& child : node.children) relocate(child, place);
}

}  // namespace

Expression::Expression(double value) : Expression(number(value, {})) {}

Expression::Expression(const Vector3& value)
    : Expression(std::make_shared<const VectorOfNumbers>(
          std::array<ExtendedConstant, 3>{value.x(), value.y(), value.z()}, SourceLocation(), 0, 0)) {}

Expression::Expression(const char* text) : Expression(parsed(text, {}, {})) {}

Expression::Expression(const std::string& text) : Expression(parsed(text, {}, {})) {}

Expression Expression::parse(std::string_view text, const SourceLocation& where,
                             std::span<const std::string> dashed_names) {
  return Expression(parsed(text, where, dashed_names));
}

Expression Expression::vector(const Expression& x, const Expression& y, const Expression& z) {
  const SourceLocation where = x.where(), where_y = y.where(), where_z = z.where();
  const auto stands_beside = [&](const SourceLocation& other) {
    return other.line == where.line && other.file == where.file;
  };
  const std::array parts{x.numbers(), y.numbers(), z.numbers()};
  const auto is_number = [](const Numbers& part) { return part.count == 1 && VectorOfNumbers::keeps(part.values[0]); };
  if (ranges::all_of(parts, is_number) && stands_beside(where_y) && stands_beside(where_z))
    return Expression(std::make_shared<const VectorOfNumbers>(
        std::array{parts[0].values[0], parts[1].values[0], parts[2].values[0]}, where, where_y.column, where_z.column));
  return Expression(std::make_shared<const ParsedFormula>(detail::vector_node(*x.tree(), *y.tree(), *z.tree(), where),
                                                          where,
                                                          "[" + x.text() + ", " + y.text() + ", " + z.text() + "]"));
}

Expression Expression::number(const ExtendedConstant& value, const SourceLocation& where) {
  return Expression(std::make_shared<const NumberFormula>(value, where));
}

Expression Expression::quantity(const ExtendedConstant& value, const Dimension& dimension,
                                const SourceLocation& where) {
  SyntaxNode node = detail::number_node(value, where);
  node.dimension = dimension;
  const std::string text = node.text;
  return Expression(std::make_shared<const ParsedFormula>(std::move(node), where, text));
}

Expression Expression::relocated(const std::function<SourceLocation(const SourceLocation&)>& place) const {
  SyntaxNode root = *tree();
  relocate(root, place);
  return Expression(std::make_shared<const ParsedFormula>(std::move(root), place(where()), text()));
}

bool Expression::is_condition() const {
  using enum detail::Operation;
  constexpr detail::Operation kConditions[] = {less,      less_equal,  greater,    greater_equal, equal,
                                               not_equal, logical_and, logical_or, logical_not};
  const std::shared_ptr<const SyntaxNode> root = tree();
  return root->kind == SyntaxNode::Kind::operation &&
         ranges::find(kConditions, root->operation) != std::end(kConditions);
}

SourceLocation Expression::where() const { return formula_->where(); }

std::string Expression::text() const { return formula_->text(); }

Expression::Numbers Expression::numbers() const { return formula_->numbers(); }

std::shared_ptr<const SyntaxNode> Expression::tree() const { return formula_->tree(formula_); }

std::vector<std::string> Expression::names() const {
  std::vector<std::string> names;
  collect_names(*tree(), names);
  return names;
}

std::vector<Expression::TableUse> Expression::tables() const {
  std::vector<TableUse> tables;
  collect_tables(*tree(), tables);
  return tables;
}

bool is_reserved_name(std::string_view name) {
  constexpr std::string_view kWords[] = {"t", "pi", "and", "or", "not"};
  return detail::find_function(name) != nullptr || ranges::find(kWords, name) != std::end(kWords);
}

}  // namespace trajet
