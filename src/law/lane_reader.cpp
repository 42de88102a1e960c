#include "lane_reader.hpp"

#include <cmath>

#include "trajet/portable.hpp"

namespace trajet::detail {
namespace {

using Kind = BlockInstruction::Kind;

bool is_sum(Opcode opcode) {
  return opcode == Opcode::add || opcode == Opcode::subtract || opcode == Opcode::add_constant ||
         opcode == Opcode::constant_minus;
}
bool is_multiple(Opcode opcode) {
  return opcode == Opcode::multiply_constant || opcode == Opcode::negate || opcode == Opcode::divide_constant;
}
bool is_product(Opcode opcode) { return opcode == Opcode::multiply || opcode == Opcode::square; }
bool is_quotient(Opcode opcode) { return opcode == Opcode::divide || opcode == Opcode::constant_over; }

bool is_power_of_two(double x) {
  int exponent = 0;
  return std::abs(std::frexp(x, &exponent)) == 0.5 && std::isnormal(1.0 / x);
}

/// f(lane, slot) of the lanes that are not spare.
template <class F>
void for_each_lane(const Lanes& lanes, F&& f) {
  for (std::size_t lane = 0; lane < lanes.size(); ++lane)
    if (lanes[lane] >= 0) f(lane, lanes[lane]);
}

template <class F>
bool all_lanes(const Lanes& lanes, F&& f) {
  return ranges::all_of(lanes, [&](int slot) { return slot < 0 || f(slot); });
}

}  // namespace

LaneReader::LaneReader(const Program& program)
    : program_(program),
      producer_(static_cast<std::size_t>(program.slot_count), -1),
      is_constant_(static_cast<std::size_t>(program.slot_count), false),
      values_(static_cast<std::size_t>(program.slot_count), 0.0) {
  for (const Program::Constant& constant : program.constants) {
    is_constant_[static_cast<std::size_t>(constant.slot)] = true;
    values_[static_cast<std::size_t>(constant.slot)] = constant.value.value;
  }
  for (std::size_t i = 0; i < program.instructions.size(); ++i) {
    const Instruction& each = program.instructions[i];
    producer_[static_cast<std::size_t>(each.result)] = static_cast<int>(i);
    if (each.opcode == Opcode::sin_cos || each.opcode == Opcode::sinh_cosh)
      producer_[static_cast<std::size_t>(each.b)] = static_cast<int>(i);
  }
}

Lanes LaneReader::inputs(int first, int count) const {
  Lanes lanes{-1, -1, -1, -1};
  for (int i = 0; i < count; ++i) lanes[static_cast<std::size_t>(i)] = 1 + first + i;
  return lanes;
}

Lanes LaneReader::outputs(int first, int count) const {
  Lanes lanes{-1, -1, -1, -1};
  for (int i = 0; i < count; ++i)
    lanes[static_cast<std::size_t>(i)] = program_.outputs[static_cast<std::size_t>(first + i)];
  return lanes;
}

Lanes LaneReader::spread(Lanes lanes) {
  if (count_distinct(lanes) == 1) lanes.fill(*ranges::max_element(lanes));
  return lanes;
}

int LaneReader::count_distinct(const Lanes& lanes) {
  int count = 0;
  for (auto lane = lanes.begin(); lane != lanes.end(); ++lane)
    if (*lane >= 0 && std::find(lanes.begin(), lane, *lane) == lane) ++count;
  return count;
}

bool LaneReader::has_negative(const Lanes& lanes) {
  return ranges::any_of(lanes, [](int slot) { return is_negative(slot); });
}

bool LaneReader::is_constant(int slot) const {
  if (is_negative(slot)) return false;
  return slot >= program_.slot_count || is_constant_[static_cast<std::size_t>(slot)];
}

bool LaneReader::are_constant(const Lanes& lanes) const {
  return all_lanes(lanes, [this](int slot) { return is_constant(slot); });
}

std::array<double, 4> LaneReader::values(const Lanes& lanes) const {
  std::array<double, 4> values{};
  for_each_lane(lanes, [&](std::size_t lane, int slot) { values[lane] = values_[static_cast<std::size_t>(slot)]; });
  return values;
}

std::array<int, 4> LaneReader::constant_slots(const Lanes& lanes) const {
  std::array<int, 4> slots{-1, -1, -1, -1};
  for_each_lane(lanes, [&](std::size_t lane, int slot) {
    if (slot < program_.slot_count) slots[lane] = slot;
  });
  return slots;
}

bool LaneReader::are_neighbouring_inputs(const Lanes& lanes) const {
  bool result = true;
  for_each_lane(lanes, [&](std::size_t lane, int slot) {
    if (slot < 1 || slot >= program_.input_count || slot != lanes[0] + static_cast<int>(lane)) result = false;
  });
  return result;
}

const Instruction* LaneReader::instruction(int slot) const {
  if (slot < 0 || slot >= program_.slot_count || producer(slot) < 0) return nullptr;
  return &program_.instructions[static_cast<std::size_t>(producer(slot))];
}

int LaneReader::literal(double value) {
  values_.push_back(value);
  return static_cast<int>(values_.size()) - 1;
}

int LaneReader::kind_of(int slot) const {
  if (is_constant(slot)) return -1;
  const Instruction* i = instruction(slot);
  if (i == nullptr) return -2;
  const Opcode opcode = i->opcode;
  const Opcode kind = is_sum(opcode)        ? Opcode::add
                      : is_multiple(opcode) ? Opcode::multiply_constant
                      : is_product(opcode)  ? Opcode::multiply
                      : is_quotient(opcode) ? Opcode::divide
                                            : opcode;
  return static_cast<int>(kind);
}

double LaneReader::likeness(int a, int b) const {
  if (a == b) return 3.0;
  if (is_negative(a)) return likeness_of_negative(a - kNegative, b);
  if (is_negative(b)) return likeness_of_negative(b - kNegative, a);
  // of one kind, the nearer ones: components of one vector lie beside each other
  return kind_of(a) == kind_of(b) ? 1.0 + 1.0 / (1.0 + std::abs(a - b)) : 0.0;
}

double LaneReader::likeness_of_negative(int slot, int other) const {
  if (is_negative(other)) return likeness(slot, other - kNegative);
  const Instruction* i = instruction(other);
  if (i == nullptr) return 0.0;
  // beside c - y it is -0 - slot
  if (i->opcode == Opcode::constant_minus || i->opcode == Opcode::negate) return 1.0 + 0.3 * likeness(slot, i->a);
  if (i->opcode == Opcode::subtract) return 1.0 + 0.3 * likeness(slot, i->b);
  return is_multiple(i->opcode) ? 0.8 : 0.0;
}

void LaneReader::align(Operation& operation, const Lanes& swappable) const {
  Lanes &a = operation.a, &b = operation.b;
  std::size_t model = 0;
  for (std::size_t lane = 0; lane < 4; ++lane)
    if (a[lane] >= 0 && swappable[lane] == 0) model = lane;
  for_each_lane(a, [&](std::size_t lane, int) {
    if (lane == model || swappable[lane] != 1) return;
    const double kept = likeness(a[lane], a[model]) + likeness(b[lane], b[model]);
    const double swapped = likeness(b[lane], a[model]) + likeness(a[lane], b[model]);
    if (swapped > kept) std::swap(a[lane], b[lane]);
  });
}

auto LaneReader::operation(const Lanes& lanes) -> std::optional<Operation> {
  const auto any_lane = [&](bool (*is)(Opcode)) {
    return ranges::any_of(lanes, [&](int slot) {
      const Instruction* i = instruction(slot);
      return i != nullptr && is(i->opcode);
    });
  };
  std::optional<Operation> result;
  if (any_lane(is_sum)) {
    result = sum(lanes);
  } else if (any_lane(is_multiple) || has_negative(lanes)) {
    result = multiple(lanes);
  } else if (any_lane(is_product)) {
    result = product(lanes);
  } else if (any_lane(is_quotient)) {
    result = quotient(lanes);
  }
  if (!result) return std::nullopt;
  // a lane that is itself an operand takes part for the others' sake
  Lanes replaced = lanes;
  for (std::size_t lane = 0; lane < 4; ++lane)
    if (lanes[lane] == result->a[lane]) replaced[lane] = -1;
  result->replaced = count_distinct(replaced);
  return result;
}

bool LaneReader::collect_terms(int slot, std::vector<int>& terms) const {
  const Instruction* i = instruction(slot);
  if (i == nullptr) return false;
  if (is_product(i->opcode) || i->opcode == Opcode::multiply_constant) {
    terms.push_back(slot);
    return terms.size() <= 3;
  }
  if (i->opcode != Opcode::add) return false;
  const bool is_second = instruction(i->b) != nullptr && instruction(i->b)->opcode == Opcode::add;
  return collect_terms(is_second ? i->b : i->a, terms) && collect_terms(is_second ? i->a : i->b, terms);
}

auto LaneReader::reduction(int slot) -> std::optional<Operation> {
  const Instruction* i = instruction(slot);
  if (i == nullptr) return std::nullopt;
  if (i->opcode == Opcode::norm) return Operation{.kind = Kind::norm, .a = {i->a, i->b, i->c, -1}};
  std::vector<int> terms;
  if (i->opcode != Opcode::add || !collect_terms(slot, terms) || terms.size() != 3) return std::nullopt;
  Operation result{.kind = Kind::dot};
  Lanes swappable{-1, -1, -1, -1};
  for (std::size_t lane = 0; lane < terms.size(); ++lane) {
    const Instruction& term = *instruction(terms[lane]);
    result.a[lane] = term.a;
    result.b[lane] = term.opcode == Opcode::square              ? term.a
                     : term.opcode == Opcode::multiply_constant ? literal(term.constant.value)
                                                                : term.b;
    swappable[lane] = term.opcode == Opcode::multiply_constant ? 0 : 1;
  }
  align(result, swappable);
  return result;
}

auto LaneReader::product(const Lanes& lanes) -> std::optional<Operation> {
  Operation result{.kind = Kind::multiply};
  if (!all_lanes(lanes,
                 [this](int slot) { return instruction(slot) != nullptr && is_product(instruction(slot)->opcode); }))
    return std::nullopt;
  Lanes swappable{-1, -1, -1, -1};
  for_each_lane(lanes, [&](std::size_t lane, int slot) {
    const Instruction& i = *instruction(slot);
    result.a[lane] = i.a;
    result.b[lane] = i.opcode == Opcode::square ? i.a : i.b;
    swappable[lane] = 1;
  });
  align(result, swappable);
  if (result.a == result.b) result.kind = Kind::square;
  return result;
}

auto LaneReader::quotient(const Lanes& lanes) -> std::optional<Operation> {
  Operation result{.kind = Kind::divide};
  if (!all_lanes(lanes,
                 [this](int slot) { return instruction(slot) != nullptr && is_quotient(instruction(slot)->opcode); }))
    return std::nullopt;
  for_each_lane(lanes, [&](std::size_t lane, int slot) {
    const Instruction& i = *instruction(slot);
    const bool is_over = i.opcode == Opcode::constant_over;
    result.a[lane] = is_over ? literal(i.constant.value) : i.a;
    result.b[lane] = is_over ? i.a : i.b;
  });
  return result;
}

auto LaneReader::ways_to_sum(int slot) -> std::vector<Sum> {
  const double zero = -0.0;  // which changes no number that it is added to
  if (is_negative(slot)) return {{literal(zero), slot - kNegative, -1.0}};
  const Instruction* i = instruction(slot);
  if (i != nullptr) {
    const int a = i->a, b = i->b;
    switch (i->opcode) {
      case Opcode::add:
        return {{a, b, 1.0}, {b, a, 1.0}};
      case Opcode::subtract:
        return {{a, b, -1.0}, {negative_of(b), a, 1.0}};
      case Opcode::add_constant:
        return {{a, literal(i->constant.value), 1.0}};
      case Opcode::constant_minus:
        return {{literal(i->constant.value), a, -1.0}, {negative_of(a), literal(i->constant.value), 1.0}};
      case Opcode::negate: {
        const Instruction* of = instruction(a);
        if (of == nullptr || of->opcode != Opcode::add) return {{literal(zero), a, -1.0}};
        // -(p + q) = -p - q
        return {{literal(zero), a, -1.0}, {negative_of(of->a), of->b, -1.0}, {negative_of(of->b), of->a, -1.0}};
      }
      default:
        break;
    }
  }
  return {{slot, literal(zero), 1.0}};
}

auto LaneReader::sum(const Lanes& lanes) -> std::optional<Operation> {
  std::array<std::vector<Sum>, 4> ways;
  for_each_lane(lanes, [&](std::size_t lane, int slot) { ways[lane] = ways_to_sum(slot); });
  // the ways that are most like one of them
  Operation result{.kind = Kind::add};
  double most = -1.0;
  for (const std::vector<Sum>& models : ways)
    for (const Sum& model : models) {
      Operation each{.kind = Kind::add};
      double total = 0.0;
      for_each_lane(lanes, [&](std::size_t lane, int) {
        double nearest = -1.0;
        for (const Sum& way : ways[lane]) {
          const double like = likeness(way.a, model.a) + likeness(way.b, model.b);
          if (like <= nearest) continue;
          nearest = like;
          each.a[lane] = way.a;
          each.b[lane] = way.b;
          each.constant.lanes[static_cast<int>(lane)] = way.sign;
        }
        total += nearest;
      });
      if (total > most) {
        most = total;
        result = each;
      }
    }
  return result;
}

auto LaneReader::multiple(const Lanes& lanes) -> std::optional<Operation> {
  Operation result{.kind = Kind::multiply_constant};
  const bool divides = ranges::any_of(lanes, [this](int slot) {
    return instruction(slot) != nullptr && instruction(slot)->opcode == Opcode::divide_constant;
  });
  if (divides) result.kind = Kind::divide_constant;
  std::array<double, 4> factors{1.0, 1.0, 1.0, 1.0};
  bool is_exact = true;
  for_each_lane(lanes, [&](std::size_t lane, int slot) {
    const Instruction* i = instruction(slot);
    result.a[lane] = is_negative(slot) ? slot - kNegative : slot;
    if (is_negative(slot)) factors[lane] = -1.0;
    if (i == nullptr || !is_multiple(i->opcode)) return;
    result.a[lane] = i->a;
    factors[lane] = i->opcode == Opcode::negate ? -1.0 : i->constant.value;
    if (!divides || i->opcode != Opcode::multiply_constant) return;
    // a quotient beside the others, if that changes no bit
    is_exact = is_exact && is_power_of_two(factors[lane]);
    factors[lane] = 1.0 / factors[lane];
  });
  if (!is_exact) return std::nullopt;
  result.constant = Block4(factors[0], factors[1], factors[2], factors[3]);
  return result;
}

}  // namespace trajet::detail
