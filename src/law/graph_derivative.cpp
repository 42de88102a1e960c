#include <cmath>
#include <limits>
#include <numbers>

#include "graph.hpp"

namespace trajet::detail {

std::optional<int> Graph::slope_of(const LookupTable& values, int x) {
  constexpr int kMostCells = 256;  // all are computed wherever x lies
  if (values.cell_count() > kMostCells) return std::nullopt;
  const int outside = constant(std::numeric_limits<double>::quiet_NaN());
  int slope = outside;
  for (int i = values.cell_count(); i-- > 0;) {
    // c1 + 2 c2 u + 3 c3 u^2
    const LookupTable::Cell& cell = values.cell(i);
    const int u = subtract(x, constant(cell.begin));
    const int bent = add(multiply(constant(3.0 * cell.c3), u), constant(2.0 * cell.c2));
    const int here = add(multiply(bent, u), constant(cell.c1));
    const bool is_last = i + 1 == values.cell_count();
    slope = where(compare(is_last ? Opcode::less_equal : Opcode::less, x, constant(values.cell_end(i))), here, slope);
  }
  return where(compare(Opcode::less, x, constant(values.first())), outside, slope);
}

std::optional<int> Graph::derivative(int index, std::span<const int> of_inputs) {
  const std::vector<bool> live = find_live(std::array{index});
  const int zero = constant(0.0);
  std::vector<int> rates(live.size(), zero);
  for (int i = 0; i <= index; ++i) {
    const auto place = static_cast<std::size_t>(i);
    const Node each = node(i);  // more nodes are added meanwhile
    if (!live[place] || each.kind == Node::Kind::constant) continue;
    if (each.kind == Node::Kind::input) {
      rates[place] = of_inputs[place];
      continue;
    }
    std::array<int, 3> of_operands{zero, zero, zero};
    bool is_constant = true;
    for (int k = 0; k < operand_count(each.opcode); ++k) {
      const auto which = static_cast<std::size_t>(k);
      of_operands[which] = rates[static_cast<std::size_t>(each.operands[which])];
      is_constant = is_constant && of_operands[which] == zero;
    }
    if (is_constant) continue;
    const std::optional<int> rate = derivative_of(i, of_operands);
    if (!rate) return std::nullopt;
    rates[place] = *rate;
  }
  return rates[static_cast<std::size_t>(index)];
}

std::optional<int> Graph::derivative_of(int r, const std::array<int, 3>& of_operands) {
  const Node each = node(r);
  const auto [a, b, c] = each.operands;
  const auto [da, db, dc] = of_operands;
  const int one = constant(1.0), zero = constant(0.0);
  const auto times = [&](int x, int y) { return is_constant(x, 0.0) || is_constant(y, 0.0) ? zero : multiply(x, y); };
  const auto over = [&](int x, int y) { return is_constant(x, 0.0) ? zero : divide(x, y); };
  const auto squared = [&](int x) { return multiply(x, x); };
  const auto k = [&](double value) { return constant(value); };
  switch (each.opcode) {
    case Opcode::add:
      return add(da, db);
    case Opcode::add_constant:
      return da;
    case Opcode::subtract:
      return subtract(da, db);
    case Opcode::constant_minus:
    case Opcode::negate:
      return negate(da);
    case Opcode::multiply:
      return add(times(da, b), times(a, db));
    case Opcode::multiply_constant:
      return multiply(da, constant(each.constant));
    case Opcode::divide:
      return over(subtract(da, times(r, db)), b);
    case Opcode::divide_constant:
      return divide(da, constant(each.constant));
    case Opcode::constant_over:
      return negate(over(times(r, da), a));
    case Opcode::square:
      return times(multiply(k(2.0), a), da);
    case Opcode::power:  // a^b = exp(b log a)
      return times(r, add(times(db, apply(Opcode::log, a)), over(times(b, da), a)));
    case Opcode::power_constant:
      return times(multiply(constant(each.constant), power(a, k(each.constant.value - 1.0))), da);
    case Opcode::sqrt:
      return over(da, multiply(k(2.0), r));
    case Opcode::cbrt:
      return over(da, multiply(k(3.0), squared(r)));
    case Opcode::exp:
      return times(r, da);
    case Opcode::log:
      return over(da, a);
    case Opcode::log10:
      return over(da, multiply(k(std::numbers::ln10), a));
    case Opcode::sin:
      return times(apply(Opcode::cos, a), da);
    case Opcode::cos:
      return negate(times(apply(Opcode::sin, a), da));
    case Opcode::tan:
      return times(add(one, squared(r)), da);
    case Opcode::asin:
      return over(da, sqrt(subtract(one, squared(a))));
    case Opcode::acos:
      return negate(over(da, sqrt(subtract(one, squared(a)))));
    case Opcode::atan:
      return over(da, add(one, squared(a)));
    case Opcode::atan2:  // the angle of (b, a)
      return over(subtract(times(b, da), times(a, db)), add(squared(a), squared(b)));
    case Opcode::sinh:
      return times(apply(Opcode::cosh, a), da);
    case Opcode::cosh:
      return times(apply(Opcode::sinh, a), da);
    case Opcode::tanh:
      return times(subtract(one, squared(r)), da);
    case Opcode::abs:
      return times(apply(Opcode::sign, a), da);
    case Opcode::sign:
    case Opcode::floor:
    case Opcode::less:
    case Opcode::less_equal:
    case Opcode::equal:
      return zero;
    case Opcode::min:
      return where(apply(Opcode::less, a, b), da, db);
    case Opcode::max:
      return where(apply(Opcode::less, a, b), db, da);
    case Opcode::where:
      return where(a, db, dc);
    case Opcode::norm:
      return over(add(add(times(a, da), times(b, db)), times(c, dc)), r);
    case Opcode::table: {
      const std::optional<int> slope = slope_of(*tables_[static_cast<std::size_t>(b)], a);
      return slope ? std::optional(times(*slope, da)) : std::nullopt;
    }
    case Opcode::sin_cos:
    case Opcode::sinh_cosh:  // of programs alone
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace trajet::detail
