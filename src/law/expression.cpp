#include "trajet/law/expression.hpp"

#include <algorithm>
#include <utility>

#include "syntax.hpp"
#include "trajet/portable.hpp"
#include "trajet/text/shortest_text.hpp"

namespace trajet {
namespace {

using detail::Formula;
using detail::SyntaxNode;

SyntaxNode number_node(const ExtendedConstant& value, const SourceLocation& where) {
  SyntaxNode node;
  node.where = where;
  node.value = value;
  node.text = shortest_text(value.value);
  return node;
}

Formula number_formula(const ExtendedConstant& value, const SourceLocation& where) {
  return {number_node(value, where), where, shortest_text(value.value)};
}

Formula vector_formula(const SyntaxNode& x, const SyntaxNode& y, const SyntaxNode& z, const SourceLocation& where,
                       std::string text) {
  SyntaxNode node;
  node.kind = SyntaxNode::Kind::vector;
  node.where = where;
  node.text = "[";
  node.height = 1 + std::max({x.height, y.height, z.height});
  node.children = {x, y, z};
  return {std::move(node), where, std::move(text)};
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

Expression::Expression(detail::Formula formula) : formula_(std::make_shared<const Formula>(std::move(formula))) {}

Expression::Expression(double value) : Expression(number_formula(value, {})) {}

Expression::Expression(const Vector3& value)
    : Expression(vector_formula(
          number_node(value.x(), {}), number_node(value.y(), {}), number_node(value.z(), {}), {},
          "[" + shortest_text(value.x()) + ", " + shortest_text(value.y()) + ", " + shortest_text(value.z()) + "]")) {}

Expression::Expression(const char* text) : Expression(detail::parse_formula(text, {}, {})) {}

Expression::Expression(const std::string& text) : Expression(detail::parse_formula(text, {}, {})) {}

Expression Expression::parse(std::string_view text, const SourceLocation& where,
                             std::span<const std::string> dashed_names) {
  return Expression(detail::parse_formula(text, where, dashed_names));
}

Expression Expression::vector(const Expression& x, const Expression& y, const Expression& z) {
  return Expression(vector_formula(x.root(), y.root(), z.root(), x.where(),
                                   "[" + x.text() + ", " + y.text() + ", " + z.text() + "]"));
}

Expression Expression::number(const ExtendedConstant& value, const SourceLocation& where) {
  return Expression(number_formula(value, where));
}

Expression Expression::quantity(const ExtendedConstant& value, const Dimension& dimension,
                                const SourceLocation& where) {
  Formula formula = number_formula(value, where);
  formula.root.dimension = dimension;
  return Expression(std::move(formula));
}

Expression Expression::relocated(const std::function<SourceLocation(const SourceLocation&)>& place) const {
  Formula formula = *formula_;
  formula.where = place(formula.where);
  relocate(formula.root, place);
  return Expression(std::move(formula));
}

bool Expression::is_condition() const {
  using enum detail::Operation;
  constexpr detail::Operation kConditions[] = {less,      less_equal,  greater,    greater_equal, equal,
                                               not_equal, logical_and, logical_or, logical_not};
  return root().kind == SyntaxNode::Kind::operation &&
         ranges::find(kConditions, root().operation) != std::end(kConditions);
}

const SourceLocation& Expression::where() const { return formula_->where; }

const std::string& Expression::text() const { return formula_->text; }

const detail::SyntaxNode& Expression::root() const { return formula_->root; }

std::vector<std::string> Expression::names() const {
  std::vector<std::string> names;
  collect_names(root(), names);
  return names;
}

std::vector<Expression::TableUse> Expression::tables() const {
  std::vector<TableUse> tables;
  collect_tables(root(), tables);
  return tables;
}

bool is_reserved_name(std::string_view name) {
  constexpr std::string_view kWords[] = {"t", "pi", "and", "or", "not"};
  return detail::find_function(name) != nullptr || ranges::find(kWords, name) != std::end(kWords);
}

}  // namespace trajet
