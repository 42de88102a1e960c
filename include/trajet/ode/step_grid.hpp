#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "trajet/ode/step_control.hpp"
#include "trajet/ode/stepper.hpp"

namespace trajet {

/// The times at which the steps of a fixed-step method end.
///
/// With `StepOptions::step`, node k is start + k * step: nothing accumulates. With `StepOptions::nodes`, the nodes are
/// given. A limit between two nodes interrupts the step there and the next one goes on to the same node. A limit nearer
/// to a node than 1e-9 of a step replaces it, so that rounding makes no tiny steps. Behind the last given node, one
/// step leads to the limit. What is longer than `StepOptions::max_step` before the first given node and behind the last
/// is divided.
class StepGrid {
 public:
  /// Throws std::invalid_argument without a step and nodes, or if the step is not positive, the nodes are not
  /// monotonic, or a step is longer than `max_step`.
  explicit StepGrid(const StepOptions& options)
      : step_(options.step.value_or(0.0)), max_step_(options.max_step), nodes_(options.nodes) {
    if (nodes_.empty() && !options.step) throw std::invalid_argument("a fixed-step method needs `step` or `nodes`");
    if (nodes_.empty() && !(step_ > 0.0 && std::isfinite(step_)))
      throw std::invalid_argument("`step` must be positive and finite");
    if (nodes_.size() > 1 && nodes_.front() > nodes_.back()) std::reverse(nodes_.begin(), nodes_.end());
    for (std::size_t i = 1; i < nodes_.size(); ++i)
      if (!(nodes_[i] > nodes_[i - 1])) throw std::invalid_argument("`nodes` must increase or decrease throughout");
    const auto is_too_long = [this](double step) { return step > (1.0 + kMerge) * max_step_; };
    bool has_long_step = nodes_.empty() && is_too_long(step_);
    for (std::size_t i = 1; i < nodes_.size(); ++i) has_long_step |= is_too_long(nodes_[i] - nodes_[i - 1]);
    if (has_long_step) throw std::invalid_argument("a fixed step must not be longer than `max_step`");
  }

  /// Begins a new grid at `t`. Given nodes stay where they are.
  void start(double t) {
    start_ = t;
    count_ = 0.0;
    direction_ = 0.0;
  }

  /// The end of the step from `t` towards `t_limit`, which differs from `t`.
  double next(double t, double t_limit) {
    const double direction = t_limit > t ? 1.0 : -1.0;
    if (nodes_.empty()) return next_equal(t, t_limit, direction);
    return next_given(t, step_limit(t, t_limit, max_step_), direction);
  }

 private:
  static constexpr double kMerge = 1e-9;  // of a step; far above the rounding of k * step, far below any meaning

  double next_equal(double t, double t_limit, double direction) {
    if (direction != direction_) {
      start(t);
      direction_ = direction;
    }
    const double node = start_ + (count_ + 1.0) * (direction * step_);
    const double beyond = (t_limit - node) * direction;  // how far the limit lies behind the node
    if (beyond < -kMerge * step_) return t_limit;
    count_ += 1.0;
    return beyond <= kMerge * step_ ? t_limit : node;
  }

  double next_given(double t, double t_limit, double direction) const {
    const auto behind = static_cast<std::ptrdiff_t>(std::upper_bound(nodes_.begin(), nodes_.end(), t) - nodes_.begin());
    const auto up_to = static_cast<std::ptrdiff_t>(std::lower_bound(nodes_.begin(), nodes_.end(), t) - nodes_.begin());
    const std::ptrdiff_t step = direction > 0.0 ? 1 : -1;
    const auto last = static_cast<std::ptrdiff_t>(nodes_.size()) - 1;
    std::ptrdiff_t i = direction > 0.0 ? behind : up_to - 1;  // the first node ahead
    const auto node = [this](std::ptrdiff_t k) { return nodes_[static_cast<std::size_t>(k)]; };
    // A node that a merged limit has just replaced is passed.
    const bool has_next = i >= 0 && i <= last && i + step >= 0 && i + step <= last;
    if (has_next && std::abs(node(i) - t) < kMerge * std::abs(node(i + step) - t)) i += step;
    if (i < 0 || i > last) return t_limit;
    const double beyond = (t_limit - node(i)) * direction;
    return beyond <= kMerge * std::abs(node(i) - t) ? t_limit : node(i);
  }

  double step_;
  double max_step_;  // s
  std::vector<double> nodes_;
  double start_ = 0.0;
  double count_ = 0.0;  // nodes reached since the start; a double, because it is only multiplied
  double direction_ = 0.0;
};

}  // namespace trajet
