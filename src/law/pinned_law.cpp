#include "trajet/law/pinned_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "graph.hpp"
#include "law_directions.hpp"
#include "trajet/law/time_branches.hpp"

namespace trajet {
namespace {

constexpr std::int32_t kNone = -1;

/// Whether an instruction takes one of several branches by the value of a function.
bool chooses(Opcode opcode) {
  switch (opcode) {
    case Opcode::abs:
    case Opcode::sign:
    case Opcode::floor:
    case Opcode::table:
    case Opcode::less:
    case Opcode::less_equal:
    case Opcode::min:
    case Opcode::max:
      return true;
    default:
      return false;  // what compares for equality holds for an instant at most
  }
}

class PinnedLawBuilder {
 public:
  explicit PinnedLawBuilder(detail::DirectedLaw law)
      : law_(std::move(law.law)),
        directions_(std::move(law.directions)),
        time_slots_(find_time_slots(law_)),
        step_slots_(find_step_slots(law_)),
        now_in_(static_cast<std::size_t>(law_.slot_count)) {
    std::iota(now_in_.begin(), now_in_.end(), 0);
  }

  PinnedLaw build() {
    pinned_ = law_;
    pinned_.instructions.clear();
    for (const Instruction& instruction : law_.instructions) {
      if (is_choice(instruction)) {
        pin(instruction);
      } else {
        keep(instruction);
      }
    }
    for (std::int32_t& slot : pinned_.outputs) slot = now_in(slot);
    for (const detail::LawDirection& each : directions_) {
      PinnedLaw::Direction direction{{}, each.hold, each.unit};
      for (const std::int32_t slot : each.components) {
        direction.functions.push_back(static_cast<int>(function_slots_.size()));
        function_slots_.push_back(now_in(slot));
      }
      result_.directions.push_back(std::move(direction));
    }
    result_.functions = pinned_;
    result_.functions.outputs = function_slots_;
    drop_unused(result_.functions);
    result_.law = std::move(pinned_);
    drop_unused(result_.law);
    return std::move(result_);
  }

 private:
  /// The slots of what a border's function is the difference of; the second is kNone where there is one alone.
  using Key = std::pair<std::int32_t, std::int32_t>;

  std::int32_t& now_in(std::int32_t slot) { return now_in_[static_cast<std::size_t>(slot)]; }
  bool is_step(std::int32_t slot) const { return step_slots_[static_cast<std::size_t>(slot)]; }
  bool is_zero(std::int32_t slot) const {
    return std::any_of(law_.constants.begin(), law_.constants.end(),
                       [slot](const auto& each) { return each.slot == slot && each.value.value == 0.0; });
  }

  bool is_choice(const Instruction& i) const {
    if (!chooses(i.opcode) || branches_by_time(i, time_slots_)) return false;
    return !is_step(i.a) || (decides_by_difference(i.opcode) && !is_step(i.b));
  }

  std::int32_t add_constant() {
    pinned_.constants.push_back({pinned_.slot_count, {}});
    return pinned_.slot_count++;
  }
  std::int32_t emit(Opcode opcode, std::int32_t a, std::int32_t b, std::int32_t c = 0) {
    pinned_.instructions.push_back({.opcode = opcode, .result = pinned_.slot_count, .a = a, .b = b, .c = c});
    return pinned_.slot_count++;
  }

  void keep(Instruction i) {
    const int count = detail::operand_count(i.opcode);
    i.a = now_in(i.a);
    if (count > 1) i.b = now_in(i.b);
    if (count > 2) i.c = now_in(i.c);
    pinned_.instructions.push_back(i);
  }

  void pin(const Instruction& i) {
    double orientation = 1.0;
    PinnedLaw::Border& border = this->border(i, orientation);
    PinnedLaw::Pin pin{i.opcode, orientation, {}};
    const int count = i.opcode == Opcode::table ? 5 : 1;
    for (int k = 0; k < count; ++k) pin.slots.push_back(add_constant());
    const std::int32_t first = pin.slots.front();
    switch (i.opcode) {
      case Opcode::abs:
        now_in(i.result) = emit(Opcode::multiply, first, now_in(i.a));
        break;
      case Opcode::min:
      case Opcode::max:
        now_in(i.result) = emit(Opcode::where, first, now_in(i.a), now_in(i.b));
        break;
      case Opcode::table: {
        // ((c3 u + c2) u + c1) u + c0
        const std::int32_t u = emit(Opcode::subtract, now_in(i.a), first);
        std::int32_t sum = pin.slots[4];
        for (const std::size_t k : {3, 2, 1}) sum = emit(Opcode::add, emit(Opcode::multiply, sum, u), pin.slots[k]);
        now_in(i.result) = sum;
        break;
      }
      default:
        now_in(i.result) = first;
    }
    border.pins.push_back(std::move(pin));
  }

  /// The border of a choice, and how the choice's function lies to it.
  PinnedLaw::Border& border(const Instruction& i, double& orientation) {
    std::int32_t a = i.a, b = decides_by_difference(i.opcode) ? i.b : kNone;
    if (b != kNone && (is_zero(a) || (!is_zero(b) && b < a))) {
      std::swap(a, b);
      orientation = -1.0;
    }
    if (b != kNone && is_zero(b)) b = kNone;
    if (i.opcode != Opcode::floor && i.opcode != Opcode::table) {
      const auto [place, is_new] = by_sign_.try_emplace(Key(a, b), result_.borders.size());
      if (!is_new) return result_.borders[place->second];
    }
    const std::int32_t slot = b == kNone ? now_in(a) : emit(Opcode::subtract, now_in(a), now_in(b));
    PinnedLaw::Border border;
    border.function = static_cast<int>(function_slots_.size());
    border.is_floor = i.opcode == Opcode::floor;
    if (i.opcode == Opcode::table) border.table = law_.tables[static_cast<std::size_t>(i.b)];
    function_slots_.push_back(slot);
    result_.borders.push_back(std::move(border));
    return result_.borders.back();
  }

  static void drop_unused(Program& program) {
    std::vector<bool> is_used(static_cast<std::size_t>(program.slot_count), false);
    const auto used = [&](std::int32_t slot) { return is_used.begin() + slot; };
    for (const std::int32_t slot : program.outputs) *used(slot) = true;
    std::vector<Instruction> kept;
    for (auto i = program.instructions.rbegin(); i != program.instructions.rend(); ++i) {
      const bool is_pair = i->opcode == Opcode::sin_cos || i->opcode == Opcode::sinh_cosh;
      if (!*used(i->result) && !(is_pair && *used(i->b))) continue;
      const int count = detail::operand_count(i->opcode);
      *used(i->a) = true;
      if (count > 1) *used(i->b) = true;
      if (count > 2) *used(i->c) = true;
      kept.push_back(*i);
    }
    program.instructions.assign(kept.rbegin(), kept.rend());
  }

  Program law_;
  std::vector<detail::LawDirection> directions_;
  std::vector<bool> time_slots_, step_slots_;
  std::vector<std::int32_t> now_in_;  // where the pinned law has what was in a slot
  Program pinned_;
  std::vector<std::int32_t> function_slots_;
  std::map<Key, std::size_t> by_sign_;
  PinnedLaw result_;
};

}  // namespace

bool chooses_by_state(const Program& law) {
  const auto& all = law.instructions;
  const bool may_choose = std::any_of(
      all.begin(), all.end(), [](const Instruction& i) { return chooses(i.opcode) || i.opcode == Opcode::norm; });
  if (!may_choose) return false;
  const PinnedLaw pinned = pin_choices(law);
  return !pinned.borders.empty() || !pinned.directions.empty();
}

PinnedLaw pin_choices(const Program& law) { return PinnedLawBuilder(detail::open_directions(law)).build(); }

int first_output_of(const PinnedLaw& law, int border) {
  std::vector<bool> depends(static_cast<std::size_t>(law.law.slot_count), false);
  const auto at = [&](std::int32_t slot) { return depends.begin() + slot; };
  if (law.is_direction(border)) {
    for (const std::int32_t slot : law.direction(border).unit) *at(slot) = true;
  } else {
    for (const PinnedLaw::Pin& pin : law.borders[static_cast<std::size_t>(border)].pins)
      for (const std::int32_t slot : pin.slots) *at(slot) = true;
  }
  for (const Instruction& i : law.law.instructions) {
    const int count = detail::operand_count(i.opcode);
    *at(i.result) = *at(i.a) || (count > 1 && *at(i.b)) || (count > 2 && *at(i.c));
    if (i.opcode == Opcode::sin_cos || i.opcode == Opcode::sinh_cosh) *at(i.b) = *at(i.result);
  }
  const auto& outputs = law.law.outputs;
  const auto found = std::find_if(outputs.begin(), outputs.end(), [&](std::int32_t slot) { return *at(slot); });
  return found == outputs.end() ? -1 : static_cast<int>(found - outputs.begin());
}

BorderSide side_of(const PinnedLaw::Border& border, double value, double direction) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (border.is_by_sign()) return {value > 0.0 || (value == 0.0 && direction > 0.0) ? 1.0 : -1.0, 0.0, 0.0};
  if (border.is_floor) {
    double lower = std::floor(value);
    if (lower == value && direction < 0.0) lower -= 1.0;
    return {0.0, lower, lower + 1.0};
  }
  const LookupTable& table = *border.table;
  if (value < table.first() || (value == table.first() && direction < 0.0)) return {0.0, -kInfinity, table.first()};
  if (value > table.last() || (value == table.last() && direction > 0.0)) return {0.0, table.last(), kInfinity};
  int cell = table.find_cell(value);
  if (value == table.cell(cell).begin && direction < 0.0) --cell;
  return {0.0, table.cell(cell).begin, table.cell_end(cell)};
}

std::vector<double> pinned_values(const PinnedLaw::Border& border, const PinnedLaw::Pin& pin, const BorderSide& side) {
  const double sign = pin.orientation * side.sign;
  switch (pin.opcode) {
    case Opcode::less:
    case Opcode::less_equal:
    case Opcode::min:
      return {sign < 0.0 ? 1.0 : 0.0};
    case Opcode::max:
      return {sign > 0.0 ? 1.0 : 0.0};
    case Opcode::floor:
      return {side.lower};
    case Opcode::table: {
      const LookupTable& table = *border.table;
      const bool is_outside = std::isinf(side.lower) || std::isinf(side.upper);
      if (is_outside) return std::vector<double>(5, std::numeric_limits<double>::quiet_NaN());
      const LookupTable::Cell& cell = table.cell(table.find_cell(side.lower));
      return {cell.begin, cell.c0, cell.c1, cell.c2, cell.c3};
    }
    default:
      return {sign};
  }
}

}  // namespace trajet
