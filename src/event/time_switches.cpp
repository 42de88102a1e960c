#include "trajet/event/time_switches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "trajet/event/composed_function.hpp"
#include "trajet/event/path.hpp"
#include "trajet/law/time_branches.hpp"

namespace trajet {

TimeSwitches::TimeSwitches(const Program& law)
    : no_state_(static_cast<std::size_t>(law.input_count)), no_state_enclosed_(no_state_.size()) {
  const std::vector<bool> of_time = find_time_slots(law);
  // what is constant but for jumps switches where they do
  const std::vector<bool> of_steps = find_step_slots(law);
  const auto has = [](const std::vector<bool>& slots, std::int32_t slot) {
    return slots[static_cast<std::size_t>(slot)];
  };
  Program time_program = law;
  std::erase_if(time_program.instructions, [&](const Instruction& i) { return !has(of_time, i.result); });
  for (const Instruction& i : time_program.instructions) {
    may_jump_ = may_jump_ || jumps(i.opcode);
    const bool has_difference = decides_by_difference(i.opcode);
    const bool is_step = has(of_steps, i.a) && (!has_difference || has(of_steps, i.b));
    if (is_step || !branches_by_time(i, of_time)) continue;
    Function function{.program = time_program};
    function.program.outputs = {i.a};
    if (has_difference) {
      const std::int32_t slot = function.program.slot_count++;
      function.program.instructions.push_back({.opcode = Opcode::subtract, .result = slot, .a = i.a, .b = i.b});
      function.program.outputs = {slot};
    }
    if (i.opcode == Opcode::table) function.table = law.tables[static_cast<std::size_t>(i.b)].get();
    function.is_floor = i.opcode == Opcode::floor;
    functions_.push_back(std::move(function));
  }
}

std::vector<double> TimeSwitches::Function::borders(double value) const {
  if (is_floor) return {std::floor(value), std::floor(value) + 1.0};
  if (table == nullptr) return {0.0};
  if (!table->contains(value)) return {table->first(), table->last()};
  const int cell = table->find_cell(value);
  return {table->cell(cell).begin, table->cell_end(cell)};
}

void TimeSwitches::search(const Function& function, double border, double from, Piece& piece) {
  Segment<> nothing;
  nothing.resize(0, 0);
  nothing.set_interval(0.0, 0.0);
  const Path<Eigen::Dynamic> path(nothing, std::span<const int>());
  Evaluator<IntervalJet> enclosures(function.program);
  const auto distance = [&](const IntervalJet& t, const auto&) {
    IntervalJet result;
    enclosures(t, no_state_enclosed_.data(), &result);
    return result - IntervalJet(Interval(border));
  };
  const double direction = piece.end < from ? -1.0 : 1.0;
  visit_roots(ComposedFunction(path, distance, from, piece.end, 0.0, true), [&](const Root& root) {
    // a function that is zero for a while has switched before by what makes it so
    constexpr double kWide = 1e-6;
    if (root.kind == RootKind::undefined || root.error_bound > kWide * std::abs(piece.end - from)) return true;
    const double margin =
        root.error_bound + 4.0 * kUnitRoundoff * std::abs(root.time) + std::numeric_limits<double>::min();
    if (direction * (root.time - from) <= margin) {
      const double behind = root.time + direction * margin;
      if (direction * (behind - piece.first) > 0.0) piece.first = behind;
      return true;
    }
    if (direction * (piece.end - root.time) < 0.0) return false;
    piece.end = root.time;
    piece.last = root.time - direction * margin;
    piece.is_switch = true;
    return false;
  });
}

TimeSwitches::Piece TimeSwitches::piece(double from, double to) {
  // a switch at `from` is found there but for some roundings
  const double rounding = 16.0 * kUnitRoundoff * std::abs(from) + std::numeric_limits<double>::min();
  const double behind = to < from ? std::max(from - rounding, to) : std::min(from + rounding, to);
  Piece piece{behind, to, to, false};
  if (behind == to) return piece;
  for (const Function& function : functions_) {
    Evaluator<double> value(function.program);
    double at_begin = 0.0;
    value(behind, no_state_.data(), &at_begin);
    for (const double border : function.borders(at_begin)) search(function, border, behind, piece);
  }
  return piece;
}

}  // namespace trajet
