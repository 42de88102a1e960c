#include "trajet/ode/structure.hpp"

#include <algorithm>

#include "trajet/portable.hpp"

namespace trajet {
namespace {

constexpr int kUnknown = -1;

/// A component of a circle of dependences among those whose level is unknown, all of which depend on one such: one that
/// is not a mere copy of another if there is any, since dr/dt = v is nobody's fault.
int blame(const Structure& structure, const std::vector<int>& level) {
  const auto is_unknown = [&](int i) { return level[static_cast<std::size_t>(i)] == kUnknown; };
  const auto next = [&](int i) { return *ranges::find_if(structure[i].uses, is_unknown); };
  int component = 0;
  while (!is_unknown(component)) ++component;
  for (int i = 0; i < structure.dimension(); ++i) component = next(component);  // into the circle
  for (int i = 0; i < structure.dimension() && structure[component].copy_of; ++i) component = next(component);
  return component;
}

/// Components joined by dependences, coloured so that nobody depends on his own colour.
class TwoColouring {
 public:
  explicit TwoColouring(const Structure& structure)
      : neighbours_(structure.rates.size()), colours_(structure.rates.size(), kUnknown) {
    for (int i = 0; i < structure.dimension(); ++i) {
      for (const int j : structure[i].uses) {
        neighbours_[static_cast<std::size_t>(i)].push_back(j);
        neighbours_[static_cast<std::size_t>(j)].push_back(i);
      }
    }
  }

  int colour(int component) const { return colours_[static_cast<std::size_t>(component)]; }

  /// Colours all that is joined with `first`, which becomes a position. Returns a component that has a neighbour of its
  /// own colour, if there is one.
  std::optional<int> spread(int first) {
    std::vector<int> open = {first};
    colours_[static_cast<std::size_t>(first)] = 1;
    while (!open.empty()) {
      const int i = open.back();
      open.pop_back();
      for (const int j : neighbours_[static_cast<std::size_t>(i)]) {
        if (colour(j) == colour(i)) return i;
        if (colour(j) != kUnknown) continue;
        colours_[static_cast<std::size_t>(j)] = 1 - colour(i);
        open.push_back(j);
      }
    }
    return std::nullopt;
  }

 private:
  std::vector<std::vector<int>> neighbours_;
  std::vector<int> colours_;  // 1: position, 0: velocity
};

}  // namespace

LevelsResult find_levels(const Structure& structure) {
  LevelsResult result;
  std::vector<int> level(structure.rates.size(), kUnknown);
  for (std::size_t placed = 0; placed < level.size();) {
    std::vector<int> next;
    for (int i = 0; i < structure.dimension(); ++i) {
      const auto is_placed = [&](int j) { return level[static_cast<std::size_t>(j)] != kUnknown; };
      if (!is_placed(i) && ranges::all_of(structure[i].uses, is_placed)) next.push_back(i);
    }
    if (next.empty()) {
      result.unsuitable = {blame(structure, level), "depends on the motion that it causes, not on t alone"};
      return result;
    }
    for (const int i : next) level[static_cast<std::size_t>(i)] = static_cast<int>(result.levels.size());
    placed += next.size();
    result.levels.push_back(std::move(next));
  }
  return result;
}

PartsResult find_parts(const Structure& structure) {
  PartsResult result;
  TwoColouring colouring(structure);
  const auto place = [&](int i) {
    if (colouring.colour(i) != kUnknown || result.unsuitable) return;
    if (const auto clash = colouring.spread(i)) {
      // dr/dt = v is nobody's fault
      const int component = structure[*clash].copy_of.value_or(*clash);
      result.unsuitable = {component,
                           "depends on its own half of the state, as a force does that depends on v; the form "
                           "dr/dt = v, dv/dt = a(r, t) is needed"};
    }
  };
  // a rate that is another component is a velocity, and the component a position; elsewhere the first one of each part
  // is
  for (int i = 0; i < structure.dimension(); ++i)
    if (structure[i].copy_of) place(i);
  for (int i = 0; i < structure.dimension(); ++i) place(i);
  for (int i = 0; i < structure.dimension(); ++i) result.is_position.push_back(colouring.colour(i) == 1);
  return result;
}

}  // namespace trajet
