#include "graph.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trajet/law/evaluate.hpp"
#include "trajet/portable.hpp"

namespace trajet::detail {
namespace {

/// Division by k is multiplication by 1/k to the last bit where k is a power of two and 1/k a normal number.
bool has_exact_reciprocal(const ExtendedConstant& k) {
  int exponent = 0;
  return k.remainder == 0.0 && std::abs(std::frexp(k.value, &exponent)) == 0.5 && std::isnormal(1.0 / k.value);
}

std::array<std::uint64_t, 2> bits(const ExtendedConstant& k) {
  return {bit_cast<std::uint64_t>(k.value), bit_cast<std::uint64_t>(k.remainder)};
}

/// Whether the result is decided in double precision: what chooses must choose alike in every precision.
bool is_decided_in_double(Opcode opcode) {
  switch (opcode) {
    case Opcode::less:
    case Opcode::less_equal:
    case Opcode::equal:
    case Opcode::sign:
    case Opcode::floor:
    case Opcode::table:
      return true;
    default:
      return false;
  }
}

bool is_commutative(Opcode opcode) {
  return opcode == Opcode::add || opcode == Opcode::multiply || opcode == Opcode::equal;
}

/// Functions of one argument that cost little more together than alone.
struct Twins {
  Opcode sine, cosine, both;
};
constexpr Twins kTwins[] = {{Opcode::sin, Opcode::cos, Opcode::sin_cos},
                            {Opcode::sinh, Opcode::cosh, Opcode::sinh_cosh}};

}  // namespace

std::size_t Graph::KeyHash::operator()(const Key& key) const {
  std::uint64_t hash = key.constant_bits[0] + 31 * key.constant_bits[1] + static_cast<std::uint64_t>(key.opcode);
  for (const int operand : key.operands) {
    hash =
        (hash ^ static_cast<std::uint64_t>(operand)) * 0x9e3779b97f4a7c15ULL;  // 2^64 / golden ratio: spreads the bits
    hash ^= hash >> 29;
  }
  return static_cast<std::size_t>(hash);
}

Graph::Graph(int input_count) : input_count_(input_count) {
  Node input;
  input.kind = Node::Kind::input;
  nodes_.assign(static_cast<std::size_t>(input_count), input);
}

Graph::Graph(const Program& program) : Graph(program.input_count) {
  tables_ = program.tables;
  reopened_outputs_ = insert(program);
}

std::vector<int> Graph::insert(const Program& program) {
  std::vector<int> nodes(static_cast<std::size_t>(program.slot_count));  // of the slots
  const auto node_in = [&](std::int32_t slot) -> int& { return nodes[static_cast<std::size_t>(slot)]; };
  for (int i = 0; i < program.input_count; ++i) node_in(i) = i;
  for (const Program::Constant& each : program.constants) node_in(each.slot) = constant(each.value);
  for (const Instruction& i : program.instructions) {
    const auto* twins = ranges::find(kTwins, i.opcode, &Twins::both);
    if (twins != std::end(kTwins)) {
      node_in(i.result) = operation(twins->sine, {node_in(i.a)});
      node_in(i.b) = operation(twins->cosine, {node_in(i.a)});
      continue;
    }
    const int count = operand_count(i.opcode);
    std::array<int, 3> operands{node_in(i.a), count > 1 ? node_in(i.b) : 0, count > 2 ? node_in(i.c) : 0};
    node_in(i.result) = i.opcode == Opcode::table ? table(program.tables[static_cast<std::size_t>(i.b)], operands[0])
                                                  : operation(i.opcode, operands, i.constant);
  }
  std::vector<int> outputs;
  for (const std::int32_t slot : program.outputs) outputs.push_back(node_in(slot));
  return outputs;
}

int Graph::constant(const ExtendedConstant& value) {
  const auto [place, is_new] = known_constants_.try_emplace({{}, {}, bits(value)}, static_cast<int>(nodes_.size()));
  if (is_new) {
    Node node;
    node.kind = Node::Kind::constant;
    node.constant = value;
    nodes_.push_back(node);
  }
  return place->second;
}

std::optional<ExtendedConstant> Graph::constant_value(int index) const {
  if (node(index).kind != Node::Kind::constant) return std::nullopt;
  return node(index).constant;
}

int Graph::operation(Opcode opcode, std::array<int, 3> operands, const ExtendedConstant& constant) {
  if (is_commutative(opcode) && operands[0] > operands[1]) std::swap(operands[0], operands[1]);
  Node node;
  node.opcode = opcode;
  node.operands = operands;
  node.constant = constant;
  const int count = operand_count(opcode);
  if (std::all_of(operands.begin(), operands.begin() + count,
                  [this](int o) { return constant_value(o).has_value(); })) {
    return fold(node);
  }
  const auto [place, is_new] = known_.try_emplace({opcode, operands, bits(constant)}, static_cast<int>(nodes_.size()));
  if (is_new) nodes_.push_back(node);
  return place->second;
}

int Graph::fold(const Node& node) {
  const double value = computed<double>(node);
  if (is_decided_in_double(node.opcode)) return constant(value);
  return constant({value, computed<Extended>(node)});
}

template <class T>
T Graph::computed(const Node& node) const {
  // slots: three operands and the result
  std::array<T, 4> slots{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(operand_count(node.opcode)); ++i) {
    slots[i] = constant_value(node.operands[i])->template as<T>();
  }
  Program program;
  Instruction instruction{node.opcode, 3, 0, 1, 2, node.constant};
  if (node.opcode == Opcode::table) {
    program.tables.push_back(tables_[static_cast<std::size_t>(node.operands[1])]);
    instruction.b = 0;
  }
  program.instructions.push_back(instruction);
  run_instructions(program, slots.data());
  return slots[3];
}

int Graph::add_constant(int a, const ExtendedConstant& k) {
  if (k.value == 0.0) return a;
  if (a == clock_) return add_constant(0, node(a).constant + k);
  if (is(a, Opcode::negate)) return operation(Opcode::constant_minus, {operand(a)}, k);
  return operation(Opcode::add_constant, {a}, k);
}

int Graph::add(int a, int b) {
  if (const auto k = constant_value(b)) return add_constant(a, *k);
  if (const auto k = constant_value(a)) return add_constant(b, *k);
  if (is(b, Opcode::negate)) return subtract(a, operand(b));
  if (is(a, Opcode::negate)) return subtract(b, operand(a));
  if (a == b) return multiply_constant(a, 2.0);
  return operation(Opcode::add, {a, b});
}

int Graph::subtract(int a, int b) {
  if (const auto k = constant_value(b)) return add_constant(a, -*k);
  if (is(b, Opcode::negate)) return add(a, operand(b));
  if (is_constant(a, 0.0)) return negate(b);
  if (const auto k = constant_value(a)) {
    if (b == clock_) return operation(Opcode::constant_minus, {0}, *k + -node(b).constant);
    return operation(Opcode::constant_minus, {b}, *k);
  }
  if (is(a, Opcode::negate)) return negate(add(operand(a), b));
  return operation(Opcode::subtract, {a, b});
}

int Graph::negate(int a) {
  const ExtendedConstant k = node(a).constant;
  if (node(a).kind == Node::Kind::constant) return constant(-k);
  if (is(a, Opcode::negate)) return operand(a);
  if (is(a, Opcode::subtract)) return operation(Opcode::subtract, {operand(a, 1), operand(a, 0)});
  if (is(a, Opcode::add_constant)) return operation(Opcode::constant_minus, {operand(a)}, -k);
  if (is(a, Opcode::constant_minus)) return operation(Opcode::add_constant, {operand(a)}, -k);
  if (is(a, Opcode::multiply_constant)) return operation(Opcode::multiply_constant, {operand(a)}, -k);
  if (is(a, Opcode::divide_constant)) return operation(Opcode::divide_constant, {operand(a)}, -k);
  if (is(a, Opcode::constant_over)) return operation(Opcode::constant_over, {operand(a)}, -k);
  return operation(Opcode::negate, {a});
}

int Graph::multiply_constant(int a, const ExtendedConstant& k) {
  if (k == ExtendedConstant(1.0)) return a;
  if (k == ExtendedConstant(-1.0)) return negate(a);
  if (is(a, Opcode::negate)) return multiply_constant(operand(a), -k);
  return operation(Opcode::multiply_constant, {a}, k);
}

int Graph::multiply(int a, int b) {
  if (const auto k = constant_value(b)) return multiply_constant(a, *k);
  if (const auto k = constant_value(a)) return multiply_constant(b, *k);
  if (is(a, Opcode::negate))
    return is(b, Opcode::negate) ? multiply(operand(a), operand(b)) : negate(multiply(operand(a), b));
  if (is(b, Opcode::negate)) return negate(multiply(a, operand(b)));
  if (a == b) return operation(Opcode::square, {a});
  return operation(Opcode::multiply, {a, b});
}

int Graph::divide_constant(int a, const ExtendedConstant& k) {
  if (has_exact_reciprocal(k)) return multiply_constant(a, 1.0 / k.value);
  if (is(a, Opcode::negate)) return operation(Opcode::divide_constant, {operand(a)}, -k);
  return operation(Opcode::divide_constant, {a}, k);
}

int Graph::divide(int a, int b) {
  if (const auto k = constant_value(b)) return divide_constant(a, *k);
  if (is(b, Opcode::negate)) return negate(divide(a, operand(b)));
  if (const auto k = constant_value(a)) return operation(Opcode::constant_over, {b}, *k);
  if (is(a, Opcode::negate)) return negate(divide(operand(a), b));
  return operation(Opcode::divide, {a, b});
}

int Graph::integer_power(int a, int exponent) {
  // a^13 = a^8 a^4 a: the squares of squares whose bits are set
  int result = -1;
  for (int square = a;; square = multiply(square, square)) {
    if (exponent % 2 == 1) result = result < 0 ? square : multiply(result, square);
    exponent /= 2;
    if (exponent == 0) return result;
  }
}

int Graph::power(int a, int b) {
  const auto exponent = constant_value(b);
  if (!exponent) return operation(Opcode::power, {a, b});
  // Up to here a chain of products is as accurate as pow to a few units in the last place, and much faster.
  constexpr double kLargestExponent = 32.0;
  const double k = exponent->value;
  if (k == 0.0) return constant(1.0);  // also of not-a-number, as pow has it
  const double size = std::abs(k), whole = std::floor(size);
  const bool is_half = size - whole == 0.5;
  if (size > kLargestExponent || (size != whole && !is_half)) return operation(Opcode::power_constant, {a}, *exponent);
  int result = whole > 0.0 ? integer_power(a, static_cast<int>(whole)) : -1;
  if (is_half) result = result < 0 ? sqrt(a) : multiply(result, sqrt(a));
  return k > 0.0 ? result : divide(constant(1.0), result);
}

bool Graph::collect_squares(int index, std::vector<int>& terms) const {
  if (is(index, Opcode::square)) {
    terms.push_back(operand(index));
    return terms.size() <= 3;
  }
  return is(index, Opcode::add) && collect_squares(operand(index, 0), terms) &&
         collect_squares(operand(index, 1), terms);
}

int Graph::sqrt(int a) {
  std::vector<int> terms;
  if (!collect_squares(a, terms)) return operation(Opcode::sqrt, {a});
  while (terms.size() < 3) terms.push_back(constant(0.0));
  return norm(terms[0], terms[1], terms[2]);
}

int Graph::abs(int a) { return operation(Opcode::abs, {is(a, Opcode::negate) ? operand(a) : a}); }

int Graph::norm(int x, int y, int z) {
  std::array<int, 3> components{x, y, z};
  for (int& component : components) {
    if (is(component, Opcode::negate)) component = operand(component);
  }
  const int zero = constant(0.0);
  std::stable_partition(components.begin(), components.end(), [this](int c) { return !is_constant(c, 0.0); });
  for (int& component : components) component = is_constant(component, 0.0) ? zero : component;
  if (components[1] == zero) return abs(components[0]);
  return operation(Opcode::norm, components);
}

int Graph::where(int condition, int then, int otherwise) {
  if (const auto k = constant_value(condition)) return k->value != 0.0 ? then : otherwise;
  if (then == otherwise) return then;
  return operation(Opcode::where, {condition, then, otherwise});
}

int Graph::table(const std::shared_ptr<const LookupTable>& table, int x) {
  const auto known = ranges::find(tables_, table);
  const auto index = static_cast<int>(known - tables_.begin());
  if (known == tables_.end()) tables_.push_back(table);
  return operation(Opcode::table, {x, index});
}

int Graph::clock(double epoch) {
  const int node = add_constant(0, epoch);
  if (epoch != 0.0) clock_ = node;
  return node;
}

int Graph::compare(Opcode opcode, int a, int b) {
  if (const auto k = constant_value(b); k && a == clock_) return compare(opcode, 0, constant(*k + -node(a).constant));
  if (const auto k = constant_value(a); k && b == clock_) return compare(opcode, constant(*k + -node(b).constant), 0);
  return operation(opcode, {a, b});
}

int Graph::apply(Opcode opcode, int a, int b) { return operation(opcode, {a, b}); }

std::vector<bool> Graph::find_live(std::span<const int> outputs) const {
  std::vector<bool> live(nodes_.size(), false);
  for (const int output : outputs) live[static_cast<std::size_t>(output)] = true;
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    if (!live[i] || nodes_[i].kind != Node::Kind::operation) continue;
    for (int which = 0; which < operand_count(nodes_[i].opcode); ++which) {
      live[static_cast<std::size_t>(operand(static_cast<int>(i), which))] = true;
    }
  }
  return live;
}

int Graph::find_twin(const Node& node, const std::vector<bool>& live) const {
  const auto twins =
      ranges::find_if(kTwins, [&](const Twins& t) { return t.sine == node.opcode || t.cosine == node.opcode; });
  if (twins == std::end(kTwins)) return -1;
  const Opcode other = node.opcode == twins->sine ? twins->cosine : twins->sine;
  const auto found = known_.find({other, node.operands, bits(node.constant)});
  return found != known_.end() && live[static_cast<std::size_t>(found->second)] ? found->second : -1;
}

Instruction Graph::make_instruction(int index, int twin, const std::vector<std::int32_t>& slots) const {
  const auto slot = [&](int i) { return slots[static_cast<std::size_t>(i)]; };
  Instruction instruction;
  instruction.opcode = node(index).opcode;
  instruction.constant = node(index).constant;
  instruction.result = slot(index);
  const int count = operand_count(instruction.opcode);
  instruction.a = slot(operand(index));
  if (count > 1) instruction.b = slot(operand(index, 1));
  if (count > 2) instruction.c = slot(operand(index, 2));
  if (instruction.opcode == Opcode::table) instruction.b = operand(index, 1);
  if (twin >= 0) {
    const auto* twins = ranges::find_if(kTwins, [&](const Twins& t) { return is(index, t.sine) || is(twin, t.sine); });
    instruction.opcode = twins->both;
    instruction.b = slot(twin);
    if (!is(index, twins->sine)) std::swap(instruction.result, instruction.b);
  }
  return instruction;
}

std::vector<int> Graph::schedule(const std::vector<bool>& live) const {
  std::vector<int> depth(nodes_.size(), 0), order;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!live[i] || nodes_[i].kind != Node::Kind::operation) continue;
    for (int which = 0; which < operand_count(nodes_[i].opcode); ++which)
      depth[i] = std::max(depth[i], depth[static_cast<std::size_t>(operand(static_cast<int>(i), which))] + 1);
    order.push_back(static_cast<int>(i));
  }
  ranges::stable_sort(order, {}, [&](int i) { return std::pair(depth[static_cast<std::size_t>(i)], node(i).opcode); });
  return order;
}

Program Graph::build(std::span<const int> outputs) const {
  const std::vector<bool> live = find_live(outputs);
  Program program;
  program.input_count = input_count_;
  program.slot_count = input_count_;
  program.tables = tables_;
  std::vector<std::int32_t> slots(nodes_.size(), 0);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].kind == Node::Kind::input) slots[i] = static_cast<std::int32_t>(i);
    if (!live[i] || nodes_[i].kind != Node::Kind::constant) continue;
    slots[i] = program.slot_count++;
    program.constants.push_back({slots[i], nodes_[i].constant});
  }
  for (const int i : schedule(live)) {
    std::int32_t& slot = slots[static_cast<std::size_t>(i)];
    if (slot != 0) continue;  // a twin, computed already
    slot = program.slot_count++;
    const int twin = find_twin(node(i), live);
    if (twin >= 0) slots[static_cast<std::size_t>(twin)] = program.slot_count++;
    program.instructions.push_back(make_instruction(i, twin, slots));
  }
  for (const int output : outputs) program.outputs.push_back(slots[static_cast<std::size_t>(output)]);
  return program;
}

}  // namespace trajet::detail
