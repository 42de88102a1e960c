#include "trajet/law/sliding_law.hpp"

#include <numeric>
#include <utility>
#include <vector>

#include "graph.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

using Nodes = std::vector<int>;

class SlidingLawBuilder {
 public:
  SlidingLawBuilder(const PinnedLaw& pinned, std::span<const BorderSide> sides, std::span<const SlidingBorder> sliding)
      : pinned_(pinned),
        sides_(sides.begin(), sides.end()),
        sliding_(sliding.begin(), sliding.end()),
        graph_(pinned.law.input_count) {}

  std::optional<SlidingLaw> build() {
    collect_unknowns();
    for (const Unknown& each : unknowns_) put(each, false);
    const Nodes below = graph_.insert(with_sides(pinned_.law));
    std::vector<Nodes> above;  // one unknown at a time
    for (const Unknown& each : unknowns_) {
      put(each, true);
      above.push_back(graph_.insert(with_sides(pinned_.law)));
      put(each, false);
    }
    const Nodes functions = graph_.insert(with_sides(pinned_.functions));

    // function_j along the motion: change_j + sum_k effect_jk share_k = 0
    std::vector<Nodes> effects;
    Nodes changes;
    for (const Unknown& each : unknowns_) {
      const auto place = static_cast<std::size_t>(each.function);
      const std::optional<int> change = along(functions[place], below);
      if (!change) return std::nullopt;
      changes.push_back(*change);
      effects.emplace_back();
      for (const Nodes& rates : above) {
        const std::optional<int> other = along(functions[place], rates);
        if (!other) return std::nullopt;
        effects.back().push_back(difference(*other, *change));
      }
    }
    const Nodes solution = solve(effects, changes);
    Nodes rates = below;
    for (std::size_t i = 0; i < rates.size(); ++i)
      for (std::size_t k = 0; k < unknowns_.size(); ++k)
        rates[i] = graph_.add(rates[i], product(solution[k], difference(above[k][i], below[i])));
    // a component of the state that is held itself does not change, not by rounding either
    for (const Unknown& each : unknowns_)
      if (const int node = functions[static_cast<std::size_t>(each.function)];
          pinned_.is_direction(each.along->border) && node > 0 && node < pinned_.law.input_count)
        rates[static_cast<std::size_t>(node) - 1] = graph_.constant(0.0);
    SlidingLaw result{
        graph_.build(rates), graph_.build(shares(solution)), {}, graph_.build(holds(solution, changes, effects))};
    if (unknowns_.size() > 1) result.residuals = graph_.build(residuals(below, above));
    return result;
  }

 private:
  /// The share of a border, or a component of a direction.
  struct Unknown {
    const SlidingBorder* along;
    int function;
    std::int32_t slot;  // of the component
  };

  void collect_unknowns() {
    for (const SlidingBorder& each : sliding_) {
      if (!pinned_.is_direction(each.border)) {
        unknowns_.push_back({&each, pinned_.borders[static_cast<std::size_t>(each.border)].function, 0});
        continue;
      }
      const PinnedLaw::Direction& direction = pinned_.direction(each.border);
      held_.push_back(direction.hold);
      for (std::size_t k = 0; k < direction.unit.size(); ++k)
        unknowns_.push_back({&each, direction.functions[k], direction.unit[k]});
    }
  }

  void put(const Unknown& each, bool is_above) {
    if (pinned_.is_direction(each.along->border)) {
      unit_ = is_above ? each.slot : 0;
      return;
    }
    const auto place = static_cast<std::size_t>(each.along->border);
    sides_[place] = side_of(pinned_.borders[place], each.along->at, is_above ? 1.0 : -1.0);
  }

  Program with_sides(Program program) const {
    std::vector<std::pair<std::int32_t, double>> pins;
    for (std::size_t i = 0; i < sides_.size(); ++i)
      for (const PinnedLaw::Pin& pin : pinned_.borders[i].pins) {
        const std::vector<double> values = pinned_values(pinned_.borders[i], pin, sides_[i]);
        for (std::size_t k = 0; k < values.size(); ++k) pins.emplace_back(pin.slots[k], values[k]);
      }
    if (unit_ != 0) pins.emplace_back(unit_, 1.0);
    for (Program::Constant& constant : program.constants)
      for (const auto& [slot, value] : pins)
        if (constant.slot == slot) constant.value = value;
    hold_directions(program);
    return program;
  }

  /// What is read in place of a direction stands where that was: the direction itself is not computed.
  void hold_directions(Program& program) const {
    std::vector<std::int32_t> stands_for(static_cast<std::size_t>(program.slot_count));
    std::iota(stands_for.begin(), stands_for.end(), 0);
    const auto now = [&](std::int32_t slot) { return stands_for[static_cast<std::size_t>(slot)]; };
    for (Instruction& i : program.instructions) {
      const bool is_held = i.opcode == Opcode::where && ranges::find(held_, i.a) != held_.end();
      const int count = detail::operand_count(i.opcode);
      i.a = now(i.a);
      if (count > 1) i.b = now(i.b);
      if (count > 2) i.c = now(i.c);
      if (is_held) stands_for[static_cast<std::size_t>(i.result)] = i.b;
    }
    for (std::int32_t& slot : program.outputs) slot = now(slot);
  }

  /// How fast a function changes where the state does at these rates.
  std::optional<int> along(int function, const Nodes& rates) {
    Nodes of_inputs{graph_.constant(1.0)};
    of_inputs.insert(of_inputs.end(), rates.begin(), rates.end());
    return graph_.derivative(function, of_inputs);
  }

  int difference(int a, int b) { return a == b ? graph_.constant(0.0) : graph_.subtract(a, b); }
  int product(int a, int b) {
    const bool is_zero = graph_.is_constant(a, 0.0) || graph_.is_constant(b, 0.0);
    return is_zero ? graph_.constant(0.0) : graph_.multiply(a, b);
  }

  /// The solution x of A x + b = 0 by elimination. Each border's own effect, on the diagonal, is what holds it.
  Nodes solve(std::vector<Nodes> a, Nodes b) {
    const std::size_t n = b.size();
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = k + 1; i < n; ++i) {
        if (graph_.is_constant(a[i][k], 0.0)) continue;
        const int factor = graph_.divide(a[i][k], a[k][k]);
        for (std::size_t j = k; j < n; ++j) a[i][j] = difference(a[i][j], product(factor, a[k][j]));
        b[i] = difference(b[i], product(factor, b[k]));
      }
    Nodes x(n);
    for (std::size_t i = n; i-- > 0;) {
      int sum = b[i];
      for (std::size_t j = i + 1; j < n; ++j) sum = graph_.add(sum, product(a[i][j], x[j]));
      x[i] = graph_.negate(graph_.divide(sum, a[i][i]));
    }
    return x;
  }

  bool is_component(std::size_t k) const { return pinned_.is_direction(unknowns_[k].along->border); }

  Nodes shares(const Nodes& solution) {
    Nodes result;
    for (std::size_t k = 0; k < unknowns_.size();) {
      if (!is_component(k)) {
        result.push_back(solution[k++]);
        continue;
      }
      int sum = graph_.constant(1.0);
      for (const SlidingBorder* direction = unknowns_[k].along; k < unknowns_.size() && unknowns_[k].along == direction;
           ++k)
        sum = graph_.add(sum, graph_.multiply(solution[k], solution[k]));
      result.push_back(graph_.multiply(graph_.constant(0.5), sum));
    }
    return result;
  }

  Nodes holds(const Nodes& solution, const Nodes& changes, const std::vector<Nodes>& effects) {
    Nodes result;
    for (std::size_t k = 0; k < unknowns_.size();) {
      if (!is_component(k)) {
        ++k;
        continue;
      }
      const std::size_t first = k;
      int sum = graph_.constant(0.0);
      for (; k < unknowns_.size() && unknowns_[k].along == unknowns_[first].along; ++k) {
        result.push_back(solution[k]);
        sum = graph_.add(sum, effects[k][k]);
      }
      for (std::size_t i = first; i < k; ++i) result.push_back(changes[i]);
      result.push_back(sum);
    }
    return result;
  }

  /// A law is made of the components of a direction by sums: nothing is left out.
  Nodes residuals(const Nodes& below, const std::vector<Nodes>& above) {
    for (const Unknown& each : unknowns_)
      if (!pinned_.is_direction(each.along->border)) put(each, true);
    Nodes rest = graph_.insert(with_sides(pinned_.law));
    for (std::size_t i = 0; i < rest.size(); ++i) {
      rest[i] = difference(rest[i], below[i]);
      for (std::size_t k = 0; k < above.size(); ++k)
        if (!is_component(k)) rest[i] = graph_.subtract(rest[i], difference(above[k][i], below[i]));
    }
    return rest;
  }

  const PinnedLaw& pinned_;
  std::vector<BorderSide> sides_;
  std::vector<SlidingBorder> sliding_;
  std::vector<Unknown> unknowns_;
  std::vector<std::int32_t> held_;  // constants of directions that are held
  std::int32_t unit_ = 0;           // that of the component which is 1
  detail::Graph graph_;
};

}  // namespace

std::optional<SlidingLaw> make_sliding_law(const PinnedLaw& pinned, std::span<const BorderSide> sides,
                                           std::span<const SlidingBorder> sliding) {
  return SlidingLawBuilder(pinned, sides, sliding).build();
}

}  // namespace trajet
