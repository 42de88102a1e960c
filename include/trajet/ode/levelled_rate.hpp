#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

#include "trajet/ode/structure.hpp"
#include "trajet/portable.hpp"

namespace trajet::detail {

/// The rates of a law level by level (see Levels), for the methods that integrate known functions of t.
template <class Rate, int Dim>
class LevelledRate {
 public:
  using State = Eigen::Matrix<double, Dim, 1>;

  /// Throws std::invalid_argument for a law that has no levels.
  LevelledRate(Rate rate, Structure structure) : rate_(std::move(rate)), structure_(std::move(structure)) {
    LevelsResult result = find_levels(structure_);
    if (result.unsuitable)
      throw std::invalid_argument("the rate of component " + std::to_string(result.unsuitable->component) + " " +
                                  result.unsuitable->reason);
    levels_ = std::move(result.levels);
    scratch_.resize(structure_.dimension());
  }

  const Levels& levels() const { return levels_; }
  int dimension() const { return structure_.dimension(); }

  /// Writes the rates of one level at (t, q) into dq; of q the components of the levels below count. Copies cost no
  /// evaluation of the law. Returns how many there were.
  long evaluate(const std::vector<int>& level, double t, const State& q, State& dq) {
    const auto is_copy = [this](int i) { return structure_[i].copy_of.has_value(); };
    const bool needs_law = !ranges::all_of(level, is_copy);
    if (needs_law) rate_(t, q, scratch_);
    for (const int i : level) dq[i] = is_copy(i) ? q[*structure_[i].copy_of] : scratch_[i];
    return needs_law ? 1 : 0;
  }

 private:
  Rate rate_;
  Structure structure_;
  Levels levels_;
  State scratch_;
};

}  // namespace trajet::detail
