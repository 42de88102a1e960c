#include "trajet/law/sliding_law.hpp"

#include <utility>
#include <vector>

#include "graph.hpp"

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
    for (const SlidingBorder& each : sliding_) put(each, -1.0);
    const Nodes below = graph_.insert(with_sides(pinned_.law));
    std::vector<Nodes> above;  // one border at a time
    for (const SlidingBorder& each : sliding_) {
      put(each, 1.0);
      above.push_back(graph_.insert(with_sides(pinned_.law)));
      put(each, -1.0);
    }
    const Nodes functions = graph_.insert(with_sides(pinned_.functions));

    // function_j along the motion: change_j + sum_k effect_jk share_k = 0
    std::vector<Nodes> effects;
    Nodes changes;
    for (const SlidingBorder& each : sliding_) {
      const auto place = static_cast<std::size_t>(pinned_.borders[static_cast<std::size_t>(each.border)].function);
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
    const Nodes shares = solve(std::move(effects), std::move(changes));
    Nodes rates = below;
    for (std::size_t i = 0; i < rates.size(); ++i)
      for (std::size_t k = 0; k < sliding_.size(); ++k)
        rates[i] = graph_.add(rates[i], product(shares[k], difference(above[k][i], below[i])));
    SlidingLaw result{graph_.build(rates), graph_.build(shares), {}};
    if (sliding_.size() > 1) result.residuals = graph_.build(residuals(below, above));
    return result;
  }

 private:
  void put(const SlidingBorder& each, double side) {
    const auto place = static_cast<std::size_t>(each.border);
    sides_[place] = side_of(pinned_.borders[place], each.at, side);
  }

  Program with_sides(Program program) const {
    std::vector<std::pair<std::int32_t, double>> pins;
    for (std::size_t i = 0; i < sides_.size(); ++i)
      for (const PinnedLaw::Pin& pin : pinned_.borders[i].pins) {
        const std::vector<double> values = pinned_values(pinned_.borders[i], pin, sides_[i]);
        for (std::size_t k = 0; k < values.size(); ++k) pins.emplace_back(pin.slots[k], values[k]);
      }
    for (Program::Constant& constant : program.constants)
      for (const auto& [slot, value] : pins)
        if (constant.slot == slot) constant.value = value;
    return program;
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

  Nodes residuals(const Nodes& below, const std::vector<Nodes>& above) {
    for (const SlidingBorder& each : sliding_) put(each, 1.0);
    Nodes rest = graph_.insert(with_sides(pinned_.law));
    for (std::size_t i = 0; i < rest.size(); ++i) {
      rest[i] = difference(rest[i], below[i]);
      for (const Nodes& each : above) rest[i] = graph_.subtract(rest[i], difference(each[i], below[i]));
    }
    return rest;
  }

  const PinnedLaw& pinned_;
  std::vector<BorderSide> sides_;
  std::vector<SlidingBorder> sliding_;
  detail::Graph graph_;
};

}  // namespace

std::optional<SlidingLaw> make_sliding_law(const PinnedLaw& pinned, std::span<const BorderSide> sides,
                                           std::span<const SlidingBorder> sliding) {
  return SlidingLawBuilder(pinned, sides, sliding).build();
}

}  // namespace trajet
