#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "trajet/ode/law_expansion.hpp"
#include "trajet/ode/runge_kutta.hpp"
#include "trajet/ode/segment.hpp"
#include "trajet/ode/series_sums.hpp"
#include "trajet/ode/step_control.hpp"
#include "trajet/ode/stepper.hpp"
#include "trajet/ode/system.hpp"
#include "trajet/portable.hpp"

namespace trajet {

/// The highest order of the series method.
inline constexpr int kMaxTaylorOrder = ReplayTape<double>::kMaxOrder;

/// The order of a power series that meets a relative tolerance at the least cost.
///
/// The step is h = rho tolerance^(1/p) for a radius of convergence rho, [JorbaZou2005] §3.2. Were the cost of a step
/// p^2, the best order would be -ln(tolerance) / 2; were it p, twice that. Most of a step's time goes by in chains of
/// dependent operations, as long as p, the rest in sums of length p: measured on laws of 10 to 50 operations, compiled
/// and interpreted, the least time lies at 3 - 0.6 ln(tolerance), from 1e-4 to 1e-15.
inline int taylor_order(double rtol) {
  const double tolerance = std::clamp(rtol, std::numeric_limits<double>::epsilon() / 2, 1e-2);
  return std::min(kMaxTaylorOrder, static_cast<int>(std::ceil(3.0 - 0.6 * std::log(tolerance))));
}

/// The series method: each step is the Taylor polynomial of the solution, with exact derivatives, as long as its last
/// terms allow. The course's method for known derivatives, for any law and any order.
///
/// `Expansion` gives the coefficients (`LawExpansion` for a C++ law, `SystemExpansion` for a scene). The step h is the
/// largest for which the last two terms are within the tolerance of every component, [JorbaZou2005] §3.2 (3-8) with the
/// tolerances of each component:
///
///     max_i |c_i[k]| h^k / (atol + rtol |q_i|) <= 1   for k = order - 1 and order
///
/// - Where the solutions are polynomials (constant acceleration), the step is the whole run and exact.
/// - Where the law takes another branch (a comparison, abs, …), the step ends there.
/// - Where there is no power series (a speed that vanishes on a curve), a step of Dormand and Prince's method leads
/// past.
/// - An expansion in extended precision carries the state in it from step to step: what a problem makes of rounding is
///   less by the ratio of the precisions.
template <class Expansion>
class TaylorStepper {
 public:
  using State = typename Expansion::State;
  using Number = typename Expansion::Number;  // of the coefficients and of the state between steps
  static constexpr int kDimension = State::RowsAtCompileTime;
  static constexpr bool kIsExtended = !std::is_same_v<Number, double>;

  /// Reads `rtol`, `atol`, `order` and `step`. Throws std::invalid_argument for wrong tolerances, or for an order above
  /// kMaxTaylorOrder.
  TaylorStepper(Expansion expansion, const StepOptions& options)
      : expansion_(std::move(expansion)),
        options_(options),
        order_(options.order > 0 ? options.order : taylor_order(options.rtol > 0.0 ? options.rtol : options.atol)),
        degree_(expansion_.polynomial_degree()),
        exact_(degree_ >= 0 && degree_ <= kMaxTaylorOrder) {
    check_step_control(options);
    if (order_ > kMaxTaylorOrder)
      throw std::invalid_argument("the order of a series is at most " + std::to_string(kMaxTaylorOrder));
    order_ = exact_ ? std::max(degree_, 1) : std::clamp(order_, 2, kMaxTaylorOrder);
    inverse_order_ = 1.0 / order_;
    inverse_order_less_one_ = 1.0 / (order_ - 1);
    segment_.resize(expansion_.dimension(), order_);
    if constexpr (kIsExtended) series_.resize(expansion_.dimension(), order_ + 1);
  }

  void start(double t, const State& q) {
    t_ = start_time_ = t;
    set_state(q);
    previous_step_ = 0.0;
  }

  /// Starts from a state in the precision of the coefficients.
  void start_extended(double t, const Eigen::Matrix<Number, kDimension, 1>& q) requires(kIsExtended) {
    start(t, State(q.template cast<double>()));
    q_ = q;
  }

  /// The state `tau` behind the start of the last step, in the precision of the coefficients; none if it was made
  /// without a series.
  std::optional<Eigen::Matrix<Number, kDimension, 1>> extended_state(Number tau) const requires(kIsExtended) {
    if (by_runge_kutta_) return std::nullopt;
    NumberState q = series_.col(order_);
    for (int k = order_ - 1; k >= 0; --k) q = q * tau + series_.col(k);
    return q;
  }

  StepStatus advance(double t_limit) {
    const double longest_blind = kBlindStep * std::abs(t_limit - start_time_);
    t_limit = step_limit(t_, t_limit, options_.max_step);
    const double remaining = t_limit - t_;
    double step = 0.0;
    for (int expansions = 0; expansions < kMaxBranchChanges; ++expansions) {
      expansion_.expand(t_, q_, order_, series().data());
      if constexpr (kIsExtended) segment_.coefficients() = series_.template cast<double>();
      ++statistics_.law_evaluations;
      step = exact_ ? whole_way(remaining)
                    : std::copysign(step_within_tolerance(std::abs(remaining), longest_blind), remaining);
      step = expansion_.duration_until_branch(step);
      // a branch that changes at once: expand again, behind it
      if (!(std::abs(step) < smallest_step(t_))) break;
    }
    const bool too_short = !(std::abs(step) >= std::max(smallest_step(t_), kShortStep * previous_step_));
    if (too_short && step != remaining) return advance_by_runge_kutta(t_limit, step);
    return accept(t_limit, step);
  }

  /// Writes the last step.
  void fill_segment(Segment<kDimension>& segment) {
    if (by_runge_kutta_) {
      runge_kutta_->fill_segment(segment);
      return;
    }
    segment = segment_;
    // the last term bounds the first one left out; each of the others is rounded, in the precision of the state
    constexpr double kEpsilon = static_cast<double>(std::numeric_limits<Number>::epsilon());
    const double h = std::abs(segment_.duration());
    detail::bound_errors(segment_.coefficients(), h, exact_ ? 0.0 : 1.0, 2.0 * kEpsilon, segment.error_bound());
  }

  /// Replaces the state.
  void amend(const State& q) { set_state(q); }

  double time() const { return t_; }
  const State& state() const {
    if constexpr (kIsExtended) {
      return rounded_;
    } else {
      return q_;
    }
  }
  const StepStatistics& statistics() const { return statistics_; }

 private:
  using NumberState = Eigen::Matrix<Number, kDimension, 1>;
  using Series = Eigen::Matrix<Number, kDimension, Eigen::Dynamic, Segment<kDimension>::Coefficients::Options>;

  /// The law on plain numbers, for the steps without a series.
  struct Rate {
    const Expansion* expansion;
    void operator()(double t, const State& q, State& dq) const { expansion->rate(t, q, dq); }
  };
  using Fallback = AdaptiveRungeKutta<Dopri5Tableau, Rate, kDimension>;

  /// A step this much shorter than the last one is compared with what Runge-Kutta can do: near a singular point of the
  /// series, not of the solution, that is more.
  static constexpr double kShortStep = 1e-3;
  /// The longest step, as a part of the way, of a series whose last terms are zero though the solution is no
  /// polynomial: what is to come may be too small to be seen from here.
  static constexpr double kBlindStep = 1.0 / 64.0;
  static constexpr double kLogZero = -1023.0;  // what rough_log2 makes of zero

  /// The step of a polynomial: all that remains, unless there is none because the law is not finite here.
  double whole_way(double remaining) const {
    return segment_.coefficients().allFinite() ? remaining : std::numeric_limits<double>::quiet_NaN();
  }

  /// `remaining`, `longest_blind` > 0, s: no step is longer, nor one of a series that does not tell.
  double step_within_tolerance(double remaining, double longest_blind) {
    const detail::TermSizes sizes = detail::term_sizes(segment_.coefficients(), options_);
    if (!sizes.is_finite) return std::numeric_limits<double>::quiet_NaN();
    // h = min over the last two orders k of e_k^(-1/k), where e_k is the weighted coefficient
    const double log_last = detail::rough_log2(sizes.last);
    const double log_last_but_one = detail::rough_log2(sizes.last_but_one);
    double log_step = -std::max(log_last * inverse_order_, log_last_but_one * inverse_order_less_one_);
    // exp(-0.7 / (p - 1)) halves the last terms, so that those left out add up to less than the tolerance too
    log_step -= 0.7 * std::numbers::log2e * inverse_order_less_one_;
    // Terms that matter must fall with their order. If those of the middle are below the tolerance, so that the last
    // ones have risen to it, what follows rises further, as before a pulse: then no step beyond the radius of
    // convergence, rho = (e_m / e_p)^(1 / (p - m)).
    const int middle = order_ / 2;
    const double log_middle = detail::rough_log2(sizes.middle);
    if (log_middle + middle * log_step < 0.0)
      log_step = std::min(log_step, (log_middle - std::max(log_last, log_last_but_one)) / (order_ - middle));
    double step = detail::rough_exp2(std::clamp(log_step, -900.0, 900.0));
    if (step > remaining && log_last <= kLogZero && log_last_but_one <= kLogZero) step = longest_blind;
    if (options_.step && previous_step_ == 0.0) step = std::min(step, *options_.step);
    return std::min(step, remaining);
  }

  template <class Vector>
  void set_state(const Vector& q) {
    q_ = q.template cast<Number>();
    remainder_ = NumberState::Zero(q.size());
    if constexpr (kIsExtended) rounded_ = q;
  }

  /// The coefficients of the last expansion, in its numbers.
  auto& series() {
    if constexpr (kIsExtended) {
      return series_;
    } else {
      return segment_.coefficients();
    }
  }

  /// q(t0 + tau), where what rounding takes from the sum of q and its change waits for the next step: over many steps
  /// the state's own rounding does not add up, only that of its changes. Returns whether it is finite.
  bool move_state(double tau) {
    const bool is_finite = detail::sum_series<Number>(series(), tau, q_, remainder_);
    if constexpr (kIsExtended) rounded_ = q_.template cast<double>();
    return is_finite;
  }

  StepStatus accept(double t_limit, double step) {
    const double t0 = t_;
    t_ = step == t_limit - t0 ? t_limit : t0 + step;
    segment_.set_interval(t0, t_);
    if (!move_state(t_ - t0)) {
      t_ = t0;
      set_state(State(segment_.coefficients().col(0)));
      return StepStatus::not_finite;
    }
    // a step cut short by the limit says nothing about the next one
    previous_step_ = t_ == t_limit ? std::max(previous_step_, std::abs(step)) : std::abs(step);
    by_runge_kutta_ = false;
    ++statistics_.steps;
    return StepStatus::ok;
  }

  /// One step of Dormand and Prince's method, or the series' own `step` where that is the longer one.
  StepStatus advance_by_runge_kutta(double t_limit, double step) {
    if (!runge_kutta_)
      runge_kutta_.emplace(
          Rate{&expansion_},
          StepOptions{.rtol = options_.rtol, .atol = options_.atol, .component_atol = options_.component_atol});
    const StepStatistics before = runge_kutta_->statistics();
    runge_kutta_->start(t_, state());
    const StepStatus status = runge_kutta_->advance(t_limit);
    statistics_.law_evaluations += runge_kutta_->statistics().law_evaluations - before.law_evaluations;
    statistics_.rejected_steps += runge_kutta_->statistics().rejected_steps - before.rejected_steps;
    const bool series_is_longer = std::abs(step) >= std::abs(runge_kutta_->time() - t_);
    if (std::abs(step) >= smallest_step(t_) && (status != StepStatus::ok || series_is_longer))
      return accept(t_limit, step);
    if (status != StepStatus::ok) return status;
    previous_step_ = std::abs(runge_kutta_->time() - t_);
    t_ = runge_kutta_->time();
    set_state(runge_kutta_->state());
    by_runge_kutta_ = true;
    ++statistics_.steps;
    return StepStatus::ok;
  }

  Expansion expansion_;
  StepOptions options_;
  int order_;
  int degree_;
  bool exact_;  // the solutions are polynomials of degree order_
  double inverse_order_;
  double inverse_order_less_one_;
  bool by_runge_kutta_ = false;
  double t_ = 0.0;
  double start_time_ = 0.0;
  double previous_step_ = 0.0;  // s, >= 0; 0: none yet
  NumberState q_;
  NumberState remainder_;  // the state is q_ + remainder_
  State rounded_;          // q_ in double, where that is another type
  Series series_;          // the coefficients of segment_, likewise
  Segment<kDimension> segment_;
  std::optional<Fallback> runge_kutta_;
  StepStatistics statistics_;
};

/// The expansion of a run-time System, in coefficients of type T, double or Extended.
template <class T = double>
class SystemExpansion {
 public:
  using Number = T;
  using State = Eigen::VectorXd;
  using NumberState = Eigen::VectorX<T>;

  explicit SystemExpansion(System& system) : system_(&system) {}
  int dimension() const { return system_->dimension(); }
  void rate(double t, const State& q, State& dq) const { system_->rate(t, q.data(), dq.data()); }
  void expand(double t, const NumberState& q, int order, T* coefficients) {
    system_->expand(t, q.data(), order, coefficients);
  }
  double duration_until_branch(double duration) { return system_->duration_until_branch(duration); }
  int polynomial_degree() const { return system_->polynomial_degree(); }

 private:
  System* system_;
};

}  // namespace trajet
