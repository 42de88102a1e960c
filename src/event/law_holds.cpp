#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "trajet/event/law_branches.hpp"
#include "trajet/portable.hpp"

// Directions that a law reads, x / |x|, where x vanishes: dry friction that holds what it has stopped.

namespace trajet {
namespace {

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

bool LawBranches::is_near_zero(int direction) const {
  return ranges::all_of(direction_of(direction).functions,
                        [this](int each) { return zero_in(values_[static_cast<std::size_t>(each)][0]); });
}

Eigen::VectorXd LawBranches::vector_of(int direction, double t, const double* q) {
  for (std::size_t i = 0; i < state_.size(); ++i) state_[i] = IntervalJet(Interval(q[i]));
  functions_(IntervalJet(Interval(t)), state_.data(), values_.data());
  const std::vector<int>& functions = direction_of(direction).functions;
  Eigen::VectorXd x(index(functions.size()));
  for (std::size_t k = 0; k < functions.size(); ++k)
    x[index(k)] = median(values_[static_cast<std::size_t>(functions[k])][0]);
  return x;
}

Eigen::MatrixXd LawBranches::derivative_of(int direction, double t, const double* q) {
  const Eigen::MatrixXd all = function_derivatives(t, q);
  const std::vector<int>& functions = direction_of(direction).functions;
  Eigen::MatrixXd rows(index(functions.size()), all.cols());
  for (std::size_t k = 0; k < functions.size(); ++k) rows.row(index(k)) = all.row(functions[k]);
  return rows;
}

Eigen::VectorXd LawBranches::change_to(int direction, const Eigen::VectorXd& value, double t, const double* q) {
  const Eigen::MatrixXd by_state = derivative_of(direction, t, q).leftCols(index(state_.size()));
  return by_state.completeOrthogonalDecomposition().solve(value - vector_of(direction, t, q));
}

std::optional<LawBranches::Approach> LawBranches::approach(double t, const double* q, double direction,
                                                           const Eigen::VectorXd& error) {
  std::optional<Approach> first;
  for (int k = 0; k < static_cast<int>(pinned_.directions.size()); ++k) {
    const int each = k + static_cast<int>(pinned_.borders.size());
    if (repels_[static_cast<std::size_t>(k)] ||
        ranges::find(sliding(), each, &SlidingBorder::border) != sliding().end())
      continue;
    const Eigen::VectorXd x = vector_of(each, t, q);
    law_(t, q, rate_.data());
    const Eigen::MatrixXd derivative = derivative_of(each, t, q);
    const Eigen::Map<const Eigen::VectorXd> rate(rate_.data(), index(rate_.size()));
    const Eigen::VectorXd change = derivative.leftCols(rate.size()) * rate + derivative.col(rate.size());
    // |x|' = x . x' / |x|
    const double size = x.norm(), closing = -direction * x.dot(change) / size;
    if (!(closing > 0.0)) continue;
    const double duration = size / closing;
    evaluate_values(t, q);
    constexpr double kErrors = 16.0;
    constexpr double kFewTimes = 128.0;  // roundings of the time: no step is as short
    const double off = (derivative.leftCols(rate.size()).cwiseAbs() * error).norm();
    const bool is_there =
        is_near_zero(each) || duration < kFewTimes * kUnitRoundoff * std::abs(t) || size < kErrors * off;
    if (!first || duration < first->duration) first = Approach{each, duration, is_there};
  }
  return first;
}

LawBranches::Finding LawBranches::hold_directions(std::vector<Near>& near, double t, const double* q, double direction,
                                                  const End* passed, const std::vector<SlidingBorder>& slid) {
  std::vector<SlidingBorder> along;
  for (int k = 0; k < static_cast<int>(pinned_.directions.size()); ++k) {
    const int each = k + static_cast<int>(pinned_.borders.size());
    evaluate_values(t, q);
    const bool is_passed = passed != nullptr && passed->border == each;
    const bool was_held = ranges::find(slid, each, &SlidingBorder::border) != slid.end();
    if (is_passed || was_held || is_near_zero(each)) along.push_back({each, 0.0});
  }
  while (!along.empty()) {
    auto law = make_sliding_law(pinned_, sides_, along);
    if (!law) break;
    sliding_ = std::make_unique<Sliding>(along, std::move(*law));
    std::vector<double> found(sliding_->law.holds.outputs.size());
    sliding_->holds(t, q, found.data());
    displacement_.setZero();
    std::size_t first = 0, released = along.size();
    for (std::size_t k = 0; k < along.size() && released == along.size(); ++k) {
      const int each = along[k].border;
      const auto size = direction_of(each).functions.size();
      const Eigen::Map<const Eigen::VectorXd> unit(&found[first], index(size)),
          change(&found[first + size], index(size));
      const double effect = direction * found[first + 2 * size];
      first += 2 * size + 1;
      repels_[static_cast<std::size_t>(each) - pinned_.borders.size()] = !(effect < 0.0);
      const bool lets_go = passed != nullptr && passed->border == each && passed->is_slip;
      if (effect < 0.0 && unit.norm() <= 1.0 && !lets_go) {
        // what is held is at zero, not near it
        displacement_ += change_to(each, Eigen::VectorXd::Zero(index(size)), t, q);
        continue;
      }
      released = k;
      // what drives its vector away from zero does not say where it begins
      if (!(effect < 0.0) || !(unit.norm() > 0.0) || !unit.allFinite()) continue;
      // no more than its speed rounds to at the end, and not so near that it counts as zero again
      constexpr double kRoundings = 64.0;
      evaluate_values(t, q);
      double far = kRoundings * kUnitRoundoff * change.norm() * std::max(std::abs(t), horizon_);
      for (const int function : direction_of(each).functions)
        far = std::max(far, 4.0 * width(values_[static_cast<std::size_t>(function)][0]));
      displacement_ = change_to(each, far * unit.normalized(), t, q);
      sliding_.reset();
      return Finding::moved;
    }
    if (released == along.size()) return slide_along(std::move(along), near, t, q, direction);
    along.erase(along.begin() + static_cast<std::ptrdiff_t>(released));
  }
  sliding_.reset();
  return Finding::decided;
}

}  // namespace trajet
