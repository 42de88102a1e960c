#include <algorithm>
#include <array>
#include <numbers>

#include "foreign_words.hpp"
#include "lexer.hpp"
#include "syntax.hpp"
#include "trajet/portable.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet::detail {
namespace {

/// Brackets within brackets; keeps the recursion of the parser shallow.
constexpr int kMaxNesting = 200;
/// Levels of the tree, which a long sum also makes; keeps the recursions over the tree shallow.
constexpr int kMaxHeight = 1000;
constexpr std::size_t kMaxLength = 1 << 20;

constexpr int kUnlimited = 1000;

constexpr FunctionInfo kFunctions[] = {
    {"sqrt", Operation::sqrt, 1, 1},        {"cbrt", Operation::cbrt, 1, 1},   {"exp", Operation::exp, 1, 1},
    {"log", Operation::log, 1, 1},          {"log10", Operation::log10, 1, 1}, {"sin", Operation::sin, 1, 1},
    {"cos", Operation::cos, 1, 1},          {"tan", Operation::tan, 1, 1},     {"asin", Operation::asin, 1, 1},
    {"acos", Operation::acos, 1, 1},        {"atan", Operation::atan, 1, 1},   {"atan2", Operation::atan2, 2, 2},
    {"sinh", Operation::sinh, 1, 1},        {"cosh", Operation::cosh, 1, 1},   {"tanh", Operation::tanh, 1, 1},
    {"abs", Operation::abs, 1, 1},          {"sign", Operation::sign, 1, 1},   {"min", Operation::min, 2, kUnlimited},
    {"max", Operation::max, 2, kUnlimited}, {"pow", Operation::pow, 2, 2},     {"floor", Operation::floor, 1, 1},
    {"dot", Operation::dot, 2, 2},          {"cross", Operation::cross, 2, 2}, {"norm", Operation::norm, 1, 1},
    {"unit", Operation::unit, 1, 1},        {"where", Operation::where, 3, 3}, {"table", Operation::table, 2, 2},
};

/// An infix operator: it takes an operand on its right whose operators bind tighter than `right`.
struct InfixOperator {
  std::string_view text;
  Operation operation;
  int left;
  int right;
};

// Binding powers, loosest first: or, and, not, comparisons, sums, products, sign, power.
constexpr int kNotPower = 5;
constexpr int kComparisonPower = 7;
constexpr int kSignPower = 13;
constexpr InfixOperator kInfixOperators[] = {
    {"or", Operation::logical_or, 1, 2},
    {"and", Operation::logical_and, 3, 4},
    {"<", Operation::less, kComparisonPower, 8},
    {"<=", Operation::less_equal, kComparisonPower, 8},
    {">", Operation::greater, kComparisonPower, 8},
    {">=", Operation::greater_equal, kComparisonPower, 8},
    {"==", Operation::equal, kComparisonPower, 8},
    {"!=", Operation::not_equal, kComparisonPower, 8},
    {"+", Operation::add, 9, 10},
    {"-", Operation::subtract, 9, 10},
    {"*", Operation::multiply, 11, 12},
    {"/", Operation::divide, 11, 12},
    {"^", Operation::power, 15, 14},  // to the right: 2^3^2 = 2^9
};

class Parser {
 public:
  Parser(std::string_view text, const SourceLocation& where, std::span<const std::string> dashed_names)
      : lexer_(text, where, dashed_names) {
    advance();
  }

  SyntaxNode formula() {
    SyntaxNode root = expression(0);
    if (token_.kind != TokenKind::end) fail("an operator is expected before " + quoted(token_) + unit_hint());
    return root;
  }

 private:
  /// An expression of operators that bind at least as tight as `power`.
  SyntaxNode expression(int power) {
    if (++nesting_ > kMaxNesting) fail("nested deeper than " + std::to_string(kMaxNesting) + " levels");
    SyntaxNode left = operand();
    if (left.kind == SyntaxNode::Kind::name && is_symbol("["))
      fail("a component has a name: vx, vy, vz of v, x, y, z of r; of '" + left.text + "' there is no '['");
    bool compared = false;
    while (const InfixOperator* infix = infix_operator()) {
      if (infix->left < power) break;
      if (compared && infix->left == kComparisonPower) fail("comparisons do not chain: write a < b and b < c");
      compared = infix->left == kComparisonPower;
      SyntaxNode node = take(SyntaxNode::Kind::operation, infix->operation);
      add_child(node, std::move(left));
      add_child(node, expression(infix->right));
      left = std::move(node);
    }
    --nesting_;
    return left;
  }

  const InfixOperator* infix_operator() const {
    if (token_.kind != TokenKind::symbol && token_.kind != TokenKind::name) return nullptr;
    const auto found = ranges::find(kInfixOperators, token_.text, &InfixOperator::text);
    return found == std::end(kInfixOperators) ? nullptr : found;
  }

  SyntaxNode operand() {
    switch (token_.kind) {
      case TokenKind::number:
        return take(SyntaxNode::Kind::number);
      case TokenKind::name:
        return named();
      case TokenKind::symbol:
        return prefixed();
      case TokenKind::string:
        fail("a quoted text is only allowed as the file of table(\"FILE\", x)");
      case TokenKind::end:
        break;
    }
    fail("the expression ends where a number, a name or '(' is expected");
  }

  SyntaxNode prefixed() {
    if (is_symbol("-")) return unary(Operation::negate, kSignPower);
    if (is_symbol("+")) {
      advance();
      return expression(kSignPower);
    }
    if (is_symbol("(")) {
      advance();
      SyntaxNode inner = expression(0);
      expect(")");
      return inner;
    }
    if (is_symbol("[")) {
      SyntaxNode node = take(SyntaxNode::Kind::vector);
      for (int i = 0; i < 3; ++i) {
        if (i > 0) expect(",", "a vector has three components: ");
        add_child(node, expression(0));
      }
      expect("]", "a vector has three components: ");
      return node;
    }
    fail("a number, a name or '(' is expected before " + quoted(token_));
  }

  SyntaxNode unary(Operation operation, int power) {
    SyntaxNode node = take(SyntaxNode::Kind::operation, operation);
    add_child(node, expression(power));
    return node;
  }

  SyntaxNode named() {
    if (token_.text == "not") return unary(Operation::logical_not, kNotPower);
    if (token_.text == "and" || token_.text == "or")
      fail("a number, a name or '(' is expected before " + quoted(token_));
    SyntaxNode node = take(SyntaxNode::Kind::name);
    const FunctionInfo* function = find_function(node.text);
    if (is_symbol("(")) return call(std::move(node), function);
    if (function != nullptr)
      throw InputError(node.where, "'" + node.text + "' is a function: write " + node.text + "(...)");
    if (node.text == "pi") {
      node.kind = SyntaxNode::Kind::number;
      node.value = std::numbers::pi;
    }
    return node;
  }

  SyntaxNode call(SyntaxNode node, const FunctionInfo* function) {
    if (function == nullptr) {
      std::string remedy = remedy_for_function(node.text);
      std::vector<std::string_view> names;
      for (const FunctionInfo& known : kFunctions) names.push_back(known.name);
      if (remedy.empty()) remedy = did_you_mean(node.text, names);
      throw InputError(node.where, "there is no function '" + node.text + "'" + remedy);
    }
    node.kind = SyntaxNode::Kind::operation;
    node.operation = function->operation;
    advance();
    if (node.operation == Operation::table) {
      if (token_.kind != TokenKind::string) fail("the first argument of table is a file name in quotes");
      node.table = token_.text;
      advance();
      expect(",");
    }
    const int first = node.operation == Operation::table ? 1 : 0;
    if (!is_symbol(")")) add_child(node, expression(0));
    while (is_symbol(",")) {
      advance();
      add_child(node, expression(0));
    }
    expect(")", "", node.text);
    const int count = first + static_cast<int>(node.children.size());
    if (count < function->min_arguments || count > function->max_arguments) {
      throw InputError(node.where,
                       node.text + " takes " + argument_count(*function) + ", got " + std::to_string(count));
    }
    return node;
  }

  static std::string argument_count(const FunctionInfo& function) {
    const std::string number = std::to_string(function.min_arguments);
    if (function.max_arguments == kUnlimited) return number + " or more arguments";
    return number + (function.min_arguments == 1 ? " argument" : " arguments");
  }

  /// Makes a node of the current token and moves on.
  SyntaxNode take(SyntaxNode::Kind kind, Operation operation = Operation::negate) {
    SyntaxNode node;
    node.kind = kind;
    node.where = lexer_.location(token_);
    node.operation = operation;
    node.text = token_.text;
    node.value = token_.value;
    advance();
    return node;
  }

  void add_child(SyntaxNode& node, SyntaxNode child) {
    node.height = std::max(node.height, child.height + 1);
    if (node.height > kMaxHeight)
      throw InputError(node.where, "longer than " + std::to_string(kMaxHeight) + " operations in a row");
    node.children.push_back(std::move(child));
  }

  void advance() {
    last_ = token_;
    token_ = lexer_.next();
  }

  /// What to write where a name stands behind a number: "sin(30 deg)".
  std::string unit_hint() const {
    if (last_.kind != TokenKind::number || token_.kind != TokenKind::name) return {};
    const std::string number(last_.text), name(token_.text);
    return "; write " + number + "*" + name + ", or give a parameter the value \"" + number + " " + name +
           "\" if that is a unit";
  }

  bool is_symbol(std::string_view text) const { return token_.kind == TokenKind::symbol && token_.text == text; }

  void expect(std::string_view symbol, std::string_view reason = "", const std::string& function = "") {
    if (!is_symbol(symbol)) {
      const std::string of = function.empty() ? "" : " to end the arguments of " + function;
      fail(std::string(reason) + "'" + std::string(symbol) + "' is expected" + of +
           (token_.kind == TokenKind::end ? " at the end" : " before " + quoted(token_) + unit_hint()));
    }
    advance();
  }

  static std::string quoted(const Token& token) { return "'" + std::string(token.text.substr(0, 40)) + "'"; }

  [[noreturn]] void fail(const std::string& message) const { throw InputError(lexer_.location(token_), message); }

  Lexer lexer_;
  Token token_;
  Token last_;  // before it
  int nesting_ = 0;
};

}  // namespace

const FunctionInfo* find_function(std::string_view name) {
  const auto found = ranges::find(kFunctions, name, &FunctionInfo::name);
  return found == std::end(kFunctions) ? nullptr : found;
}

SyntaxNode parse_formula(std::string_view text, const SourceLocation& where,
                         std::span<const std::string> dashed_names) {
  if (text.size() > kMaxLength)
    throw InputError(where, "an expression of more than " + std::to_string(kMaxLength) + " characters");
  return Parser(text, where, dashed_names).formula();
}

}  // namespace trajet::detail
