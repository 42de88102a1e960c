#include "formula.hpp"

#include <algorithm>
#include <utility>

#include "trajet/text/shortest_text.hpp"

namespace trajet::detail {

SyntaxNode number_node(const ExtendedConstant& value, const SourceLocation& where) {
  SyntaxNode node;
  node.where = where;
  node.value = value;
  node.text = shortest_text(value.value);
  return node;
}

SyntaxNode vector_node(SyntaxNode x, SyntaxNode y, SyntaxNode z, const SourceLocation& where) {
  SyntaxNode node;
  node.kind = SyntaxNode::Kind::vector;
  node.where = where;
  node.text = "[";
  node.height = 1 + std::max({x.height, y.height, z.height});
  node.children = {std::move(x), std::move(y), std::move(z)};
  return node;
}

ParsedFormula::ParsedFormula(SyntaxNode root, SourceLocation where, std::string text)
    : root_(std::move(root)), where_(std::move(where)), text_(std::move(text)) {}

NumberFormula::NumberFormula(const ExtendedConstant& value, SourceLocation where)
    : value_(value), where_(std::move(where)) {}

std::string NumberFormula::text() const { return shortest_text(value_.value); }

std::shared_ptr<const SyntaxNode> NumberFormula::tree(const std::shared_ptr<const Formula>&) const {
  return std::make_shared<const SyntaxNode>(number_node(value_, where_));
}

VectorOfNumbers::VectorOfNumbers(const std::array<ExtendedConstant, 3>& values, const SourceLocation& where_x,
                                 int column_y, int column_z)
    : file_(where_x.file), line_(where_x.line), columns_{where_x.column, column_y, column_z} {
  for (std::size_t i = 0; i < 3; ++i) {
    values_[i] = values[i].value;
    remainders_[i] = static_cast<float>(values[i].remainder);
  }
}

bool VectorOfNumbers::keeps(const ExtendedConstant& value) {
  return static_cast<double>(static_cast<float>(value.remainder)) == value.remainder;
}

ExtendedConstant VectorOfNumbers::value(std::size_t component) const {
  ExtendedConstant value(values_[component]);
  value.remainder = static_cast<double>(remainders_[component]);
  return value;
}

std::string VectorOfNumbers::text() const {
  return "[" + shortest_text(values_[0]) + ", " + shortest_text(values_[1]) + ", " + shortest_text(values_[2]) + "]";
}

std::shared_ptr<const SyntaxNode> VectorOfNumbers::tree(const std::shared_ptr<const Formula>&) const {
  const auto component = [this](std::size_t i) { return number_node(value(i), where(i)); };
  return std::make_shared<const SyntaxNode>(vector_node(component(0), component(1), component(2), where(0)));
}

}  // namespace trajet::detail
