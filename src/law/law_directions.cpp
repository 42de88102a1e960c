#include "law_directions.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "graph.hpp"
#include "trajet/law/time_branches.hpp"
#include "trajet/portable.hpp"

namespace trajet::detail {
namespace {

using Slots = std::vector<bool>;

std::vector<bool>::reference at(Slots& slots, std::int32_t slot) { return slots[static_cast<std::size_t>(slot)]; }

/// Calls `visit` with each slot that an instruction reads.
template <class Visitor>
void visit_operands(const Instruction& i, Visitor&& visit) {
  const int count = operand_count(i.opcode);
  visit(i.a);
  if (count > 1) visit(i.b);
  if (count > 2) visit(i.c);
}

bool is_pair(Opcode opcode) { return opcode == Opcode::sin_cos || opcode == Opcode::sinh_cosh; }

/// Opens one direction of a law.
class DirectionOpener {
 public:
  DirectionOpener(const Program& law, const Instruction& norm, std::vector<std::int32_t> components)
      : law_(law), norm_(norm.result), opened_(law) {
    direction_.components = std::move(components);
    direction_.hold = add_constant();
    for (const std::int32_t component : direction_.components) {
      direction_.unit.push_back(add_constant());
      linear_.emplace(component, direction_.unit.back());
    }
  }

  /// None where the law does not make its rates of it, or those of the vector itself do not change with it.
  std::optional<LawDirection> open() {
    opened_.instructions.clear();
    for (const Instruction& each : law_.instructions) go_through(each);
    if (ratios_.empty() || !reacts()) return std::nullopt;
    return direction_;
  }
  Program& opened() { return opened_; }

 private:
  std::int32_t add_constant(const ExtendedConstant& value = {}) {
    opened_.constants.push_back({opened_.slot_count, value});
    return opened_.slot_count++;
  }
  std::int32_t emit(Instruction i) {
    i.result = opened_.slot_count++;
    opened_.instructions.push_back(i);
    return i.result;
  }
  static std::optional<std::int32_t> find(const std::map<std::int32_t, std::int32_t>& among, std::int32_t slot) {
    const auto found = among.find(slot);
    return found == among.end() ? std::nullopt : std::optional(found->second);
  }

  void go_through(const Instruction& i) {
    if (const auto held = held_ratio(i)) {
      Instruction computed = i;
      const std::int32_t moving = emit(computed);
      opened_.instructions.push_back(
          {.opcode = Opcode::where, .result = i.result, .a = direction_.hold, .b = *held, .c = moving});
      ratios_.push_back(i.result);
      return;
    }
    opened_.instructions.push_back(i);
    follow(i, linear_);
    follow(i, over_norm_);
    if (i.opcode == Opcode::divide && i.b == norm_) over_norm_.emplace(i.result, i.a);
    if (i.opcode == Opcode::constant_over && i.a == norm_) over_norm_.emplace(i.result, add_constant(i.constant));
  }

  /// What a multiple of x_i / |x| is with the component of `unit` in place of that.
  std::optional<std::int32_t> held_ratio(const Instruction& i) {
    if (i.opcode == Opcode::divide && i.b == norm_) return find(linear_, i.a);
    if (i.opcode != Opcode::multiply) return std::nullopt;
    for (const auto& [over, other] : {std::pair(i.a, i.b), std::pair(i.b, i.a)}) {
      const auto factor = find(over_norm_, over), component = find(linear_, other);
      if (factor && component) return emit({.opcode = Opcode::multiply, .a = *factor, .b = *component});
    }
    return std::nullopt;
  }

  /// `stands_for`: of what is proportional to something, the same with another thing in its place.
  void follow(const Instruction& i, std::map<std::int32_t, std::int32_t>& stands_for) {
    const auto a = find(stands_for, i.a);
    const auto put = [&](Instruction other) { stands_for.emplace(i.result, emit(other)); };
    Instruction same = i;
    switch (i.opcode) {
      case Opcode::negate:
      case Opcode::multiply_constant:
      case Opcode::divide_constant:
        if (!a) return;
        same.a = *a;
        return put(same);
      case Opcode::divide:
        if (!a || i.b == norm_) return;
        same.a = *a;
        return put(same);
      case Opcode::multiply: {
        const auto b = find(stands_for, i.b);
        if (!a && !b) return;
        (a ? same.a : same.b) = a ? *a : *b;
        return put(same);
      }
      case Opcode::add:
      case Opcode::subtract: {
        const auto b = find(stands_for, i.b);
        if (!a || !b) return;
        same.a = *a;
        same.b = *b;
        return put(same);
      }
      default:
        return;
    }
  }

  /// Whether a rate of something that the vector is made of is made of its direction.
  bool reacts() const {
    const auto size = static_cast<std::size_t>(law_.slot_count);
    Slots reads(size, false), depends(size, false);
    for (const std::int32_t slot : direction_.components) at(reads, slot) = true;
    for (auto i = law_.instructions.rbegin(); i != law_.instructions.rend(); ++i)
      if (at(reads, i->result) || (is_pair(i->opcode) && at(reads, i->b)))
        visit_operands(*i, [&](std::int32_t slot) { at(reads, slot) = true; });
    for (const std::int32_t slot : ratios_) at(depends, slot) = true;
    for (const Instruction& i : law_.instructions) {
      visit_operands(i, [&](std::int32_t slot) {
        if (at(depends, slot)) at(depends, i.result) = true;
      });
      if (is_pair(i.opcode) && at(depends, i.result)) at(depends, i.b) = true;
    }
    for (std::size_t k = 0; k < law_.outputs.size(); ++k)
      if (at(depends, law_.outputs[k]) && at(reads, static_cast<std::int32_t>(k + 1))) return true;
    return false;
  }

  const Program& law_;
  std::int32_t norm_;
  Program opened_;
  LawDirection direction_;
  std::map<std::int32_t, std::int32_t> linear_;     // of what is proportional to a component
  std::map<std::int32_t, std::int32_t> over_norm_;  // of what is proportional to 1 / |x|, without that
  std::vector<std::int32_t> ratios_;
};

}  // namespace

DirectedLaw open_directions(const Program& law) {
  DirectedLaw result{law, {}};
  const Slots time_slots = find_time_slots(law);
  const auto is_zero = [&](std::int32_t slot) {
    return ranges::any_of(
        law.constants, [slot](const Program::Constant& each) { return each.slot == slot && each.value.value == 0.0; });
  };
  for (const Instruction& each : law.instructions) {
    if (each.opcode != Opcode::norm) continue;
    std::vector<std::int32_t> components;
    for (const std::int32_t slot : {each.a, each.b, each.c})
      if (!is_zero(slot)) components.push_back(slot);
    if (ranges::all_of(components, [&](std::int32_t s) { return time_slots[static_cast<std::size_t>(s)]; })) continue;
    DirectionOpener opener(result.law, each, std::move(components));
    if (const auto direction = opener.open()) {
      result.directions.push_back(*direction);
      result.law = std::move(opener.opened());
    }
  }
  return result;
}

}  // namespace trajet::detail
