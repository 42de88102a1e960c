#pragma once

#include <Eigen/Core>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "trajet/ode/runge_kutta_step.hpp"
#include "trajet/ode/segment.hpp"
#include "trajet/ode/step_control.hpp"
#include "trajet/ode/step_grid.hpp"
#include "trajet/ode/stepper.hpp"
#include "trajet/ode/taylor.hpp"

namespace trajet {

/// The course's series scheme: over each of the steps that the user gives, the Taylor polynomial of the
/// solution of an order that the user gives, with exact derivatives:
///
///     q(t) = sum_{k <= order} q^(k)(t_{n-1}) (t - t_{n-1})^k / k!
///
/// `Expansion` gives the coefficients: `LawExpansion` for a C++ law, `SystemExpansion` for a scene.
/// - Where the law takes another branch (a comparison, abs, …), a step is interrupted and goes on behind it to its
/// node.
/// - Where there is no power series (a speed that vanishes) or the branch stays undecided, the step is one of rk4.
/// A Stepper.
template <class Expansion>
class SeriesStepper {
 public:
  using State = typename Expansion::State;
  static constexpr int kDimension = State::RowsAtCompileTime;
  static constexpr int kDefaultOrder = 4;
  static constexpr int kMaxOrder = kMaxTaylorOrder - 1;  // the next term is the error bound

  /// Reads `order` and `step` or `nodes`. Throws std::invalid_argument for an order above kMaxOrder, or if the steps
  /// are missing or wrong.
  SeriesStepper(Expansion expansion, const StepOptions& options)
      : expansion_(std::move(expansion)), grid_(options), order_(options.order > 0 ? options.order : kDefaultOrder) {
    if (order_ > kMaxOrder)
      throw std::invalid_argument("the order of a series is at most " + std::to_string(kMaxOrder));
    series_.resize(expansion_.dimension(), order_ + 1);
  }

  void start(double t, const State& q) {
    t_ = t;
    q_ = q;
    node_.reset();
    grid_.start(t);
  }

  /// Replaces the state.
  void amend(const State& q) { q_ = q; }

  StepStatus advance(double t_limit) {
    assert(t_limit != t_);
    if (!node_) node_ = grid_.next(t_, t_limit);
    // a step that was interrupted goes on to its node, unless the limit has come nearer
    const double target = std::abs(*node_ - t_) <= std::abs(t_limit - t_) ? *node_ : t_limit;
    double duration = 0.0;
    for (int expansions = 0; expansions < kMaxBranchChanges; ++expansions) {
      expansion_.expand(t_, q_, order_ + 1, series_.coefficients().data());
      ++statistics_.law_evaluations;
      if (!series_.coefficients().allFinite()) return advance_by_runge_kutta(target);
      duration = expansion_.duration_until_branch(target - t_);
      // a branch that changes at once: expand again, behind it
      if (!(std::abs(duration) < smallest_step(t_))) break;
    }
    if (std::abs(duration) < smallest_step(t_) && duration != target - t_) return advance_by_runge_kutta(target);
    const double t1 = std::abs(duration) < std::abs(target - t_) ? t_ + duration : target;
    series_.set_interval(t_, t1);
    by_runge_kutta_ = false;
    State end(q_.size());
    evaluate_series(t1 - t_, end);
    return accept(t1, end);
  }

  /// Writes the last step. `error_bound` is the first term left out, and rounding.
  void fill_segment(Segment<kDimension>& segment) {
    if (by_runge_kutta_) {
      const auto rate = law();
      runge_kutta_.fill(segment, rate);
      return;
    }
    segment.resize(series_.dimension(), order_);
    segment.set_interval(series_.t0(), series_.t1());
    segment.coefficients() = series_.coefficients().leftCols(order_ + 1);
    const double h = std::abs(series_.duration());
    const double power = std::pow(h, order_ + 1);
    segment.error_bound() = power * series_.coefficients().col(order_ + 1).cwiseAbs() +
                            kStateRounding * (series_.coefficients().col(0).cwiseAbs() + q_.cwiseAbs());
  }

  double time() const { return t_; }
  const State& state() const { return q_; }
  const StepStatistics& statistics() const { return statistics_; }

 private:
  static constexpr double kStateRounding = std::numeric_limits<double>::epsilon();

  /// The law on plain numbers.
  auto law() const {
    return [this](double t, const State& q, State& dq) { expansion_.rate(t, q, dq); };
  }

  /// The terms up to the order, by Horner's rule.
  void evaluate_series(double tau, State& q) const {
    q = series_.coefficients().col(order_);
    for (int k = order_ - 1; k >= 0; --k) q = q * tau + series_.coefficients().col(k);
  }

  StepStatus accept(double t1, const State& end) {
    if (!end.allFinite()) return StepStatus::not_finite;
    t_ = t1;
    q_ = end;
    if (t_ == *node_) node_.reset();
    ++statistics_.steps;
    return StepStatus::ok;
  }

  StepStatus advance_by_runge_kutta(double t1) {
    const auto rate = law();
    runge_kutta_.start(t_, q_);
    runge_kutta_.evaluate_end(rate);
    runge_kutta_.begin_next();
    runge_kutta_.template compute<false, true>(t1, rate);
    statistics_.law_evaluations += RungeKutta4::kInnerEvaluations + 2;
    by_runge_kutta_ = true;
    return accept(t1, runge_kutta_.end());
  }

  using RungeKutta4 = detail::RungeKuttaStep<Rk4Tableau, kDimension>;

  Expansion expansion_;
  StepGrid grid_;
  int order_;
  std::optional<double> node_;  // the end of a step that is not there yet
  double t_ = 0.0;
  State q_;
  bool by_runge_kutta_ = false;
  Segment<kDimension> series_;  // the last step with one term more
  RungeKutta4 runge_kutta_;
  StepStatistics statistics_;
};

/// The method as a type, for solve<SeriesSteps>(law, …).
struct SeriesSteps {
  template <int Dim, class Law>
  static auto make_stepper(Law law, int dimension, const StepOptions& options) {
    using Expansion = LawExpansion<Law, Dim>;
    return SeriesStepper<Expansion>(Expansion(std::move(law), dimension), options);
  }
};

}  // namespace trajet
