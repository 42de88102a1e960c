#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "trajet/math/force_inline.hpp"
#include "trajet/ode/runge_kutta_step.hpp"
#include "trajet/ode/segment.hpp"
#include "trajet/ode/step_control.hpp"
#include "trajet/ode/step_grid.hpp"
#include "trajet/ode/stepper.hpp"

namespace trajet {

/// What the steppers of explicit Runge-Kutta methods share: the state, the last step, its Segment.
///
/// `Method` is a tableau such as Rk4Tableau. `Rate` is callable as rate(t, q, dq): t double, q const State&, dq State&.
/// `Dim` is the dimension of the state: fixed, everything is on the stack and unrolled; Eigen::Dynamic, nothing is
/// allocated after the first start().
template <class Method, class Rate, int Dim>
class RungeKuttaBase {
 public:
  using State = Eigen::Matrix<double, Dim, 1>;
  static constexpr int kDimension = Dim;

  double time() const { return step_.t1(); }
  const State& state() const { return step_.end(); }
  const StepStatistics& statistics() const { return statistics_; }

  /// Replaces the state; the size of the next step stays.
  void amend(const State& q) { begin(time(), q); }

  /// The last step as polynomials, of the degree of the method's dense output. `error_bound` is the difference to the
  /// companion method plus rounding: for `dopri5` and `rk4` it over-estimates the error of the step, for `euler` it is
  /// its leading term, for `midpoint` a term of the same power of the step.
  TRAJET_FLATTEN void fill_segment(Segment<Dim>& segment) {
    evaluate_end();
    step_.fill(segment, rate_);
    statistics_.law_evaluations += Method::kTableau.kDenseStages;
  }

 protected:
  using Step = detail::RungeKuttaStep<Method, Dim>;

  explicit RungeKuttaBase(Rate rate) : rate_(std::move(rate)) {}

  void begin(double t, const State& q) {
    step_.start(t, q);
    end_is_evaluated_ = false;
  }

  /// The rate at the end of the step, unless it is known.
  TRAJET_INLINE void evaluate_end() {
    if (end_is_evaluated_) return;
    step_.evaluate_end(rate_);
    end_is_evaluated_ = true;
    ++statistics_.law_evaluations;
  }

  /// Back to the start of the step, whose rate is known.
  void undo_step() {
    step_.undo();
    end_is_evaluated_ = true;
  }

  Step step_;
  Rate rate_;
  bool end_is_evaluated_ = false;
  StepStatistics statistics_;
};

/// Any explicit Runge-Kutta method with steps that the user gives. A Stepper.
///
/// start() begins a new grid of equal steps at its time; see StepGrid.
template <class Method, class Rate, int Dim>
class FixedStepRungeKutta : public RungeKuttaBase<Method, Rate, Dim> {
  using Base = RungeKuttaBase<Method, Rate, Dim>;

 public:
  using typename Base::State;

  /// Reads `step` or `nodes`. Throws std::invalid_argument if both are missing or wrong.
  FixedStepRungeKutta(Rate rate, const StepOptions& options) : Base(std::move(rate)), grid_(options) {}

  void start(double t, const State& q) {
    this->begin(t, q);
    grid_.start(t);
  }

  TRAJET_FLATTEN StepStatus advance(double t_limit) {
    assert(t_limit != this->time());
    this->step_.begin_next();
    const double t1 = grid_.next(this->step_.t0(), t_limit);
    // The rate at the end waits until the next step, or a Segment, asks for it.
    if (this->end_is_evaluated_) {
      this->step_.template compute<false, false>(t1, this->rate_);
    } else {
      this->step_.template compute<true, false>(t1, this->rate_);
      ++this->statistics_.law_evaluations;
    }
    this->end_is_evaluated_ = false;
    this->statistics_.law_evaluations += Base::Step::kInnerEvaluations;
    if (!this->step_.end_is_finite()) {
      this->undo_step();
      return StepStatus::not_finite;
    }
    ++this->statistics_.steps;
    return StepStatus::ok;
  }

 private:
  StepGrid grid_;
};

/// An embedded pair of Runge-Kutta methods that chooses its steps so that every component's error per step stays within
/// atol + rtol |q_i|. A Stepper.
///
/// The first step is `StepOptions::step`, or chosen as [HairerNorsettWanner1993] II.4 describes. A step that a limit
/// cuts short does not shorten the following ones.
template <class Method, class Rate, int Dim>
class AdaptiveRungeKutta : public RungeKuttaBase<Method, Rate, Dim> {
  using Base = RungeKuttaBase<Method, Rate, Dim>;

 public:
  using typename Base::State;

  AdaptiveRungeKutta(Rate rate, const StepOptions& options) : Base(std::move(rate)), options_(options) {
    check_step_control(options);
  }

  void start(double t, const State& q) {
    this->begin(t, q);
    read_tolerances();
    controller_.reset();
    next_step_ = options_.step.value_or(0.0);
  }

  TRAJET_FLATTEN StepStatus advance(double t_limit) {
    assert(t_limit != this->time());
    t_limit = step_limit(this->time(), t_limit, options_.max_step);
    if (options_.component_atol != nullptr) read_tolerances();
    this->evaluate_end();
    if (next_step_ == 0.0) next_step_ = first_step(t_limit);
    this->step_.begin_next();
    const double t0 = this->step_.t0();
    const double direction = t_limit > t0 ? 1.0 : -1.0;
    const double distance = std::abs(t_limit - t0);
    double h = std::max(next_step_, smallest_step(t0));
    while (true) {
      const bool lands = h * kLandingStretch >= distance;
      this->step_.template compute<false, true>(lands ? t_limit : t0 + direction * h, this->rate_);
      this->statistics_.law_evaluations += Base::Step::kInnerEvaluations + 1;
      const double log_error = this->step_.log2_error_norm(atol_, options_.rtol);
      if (lands) h = distance;
      if (log_error <= 0.0) {
        const double proposed = h * controller_.accepted_log2(log_error);
        next_step_ = lands ? std::max(proposed, next_step_) : proposed;
        ++this->statistics_.steps;
        return StepStatus::ok;
      }
      const bool is_finite = log_error < Base::Step::kLog2NotFinite;
      h *= is_finite ? controller_.rejected_log2(log_error) : controller_.rejected(HUGE_VAL);
      ++this->statistics_.rejected_steps;
      if (!(h >= smallest_step(t0))) {
        this->undo_step();
        return is_finite ? StepStatus::step_too_small : StepStatus::not_finite;
      }
      next_step_ = h;
    }
  }

 private:
  static constexpr int kErrorPower = error_power<Method>();

  /// A first step (s) that by Euler's rule changes the state by a hundredth, smaller where the rate itself changes
  /// fast.
  [[gnu::noinline]] double first_step(double t_limit) {
    const double t = this->time();
    const double d0 = this->step_.state_norm(atol_, options_.rtol);
    const double d1 = this->step_.rate_norm(atol_, options_.rtol);
    if (!std::isfinite(d1)) return smallest_step(t);
    const double h0 = std::min(d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1, std::abs(t_limit - t));
    const double change = this->step_.rate_change_norm(t_limit > t ? h0 : -h0, this->rate_, atol_, options_.rtol);
    ++this->statistics_.law_evaluations;
    const double d2 = std::max(d1, change / h0);
    if (!std::isfinite(d2)) return h0;
    const double h1 =
        d2 > 1e-15 ? detail::rough_exp2(detail::rough_log2(0.01 / d2) / kErrorPower) : std::max(1e-6, 1e-3 * h0);
    return std::min(100.0 * h0, h1);
  }

  void read_tolerances() {
    atol_.fill(this->state().size(), [this](Eigen::Index i) {
      if constexpr (requires { this->rate_.component(i); }) i = this->rate_.component(i);
      return absolute_tolerance(options_, i);
    });
  }

  StepOptions options_;
  typename Base::Step::Vector atol_;
  StepController controller_{kErrorPower};
  double next_step_ = 0.0;  // s; 0: not chosen yet
};

/// The stepper of a tableau: fixed steps, or chosen ones where its companion is made for that.
template <class Method, class Rate, int Dim>
using RungeKutta = std::conditional_t<Method::kErrorControlled, AdaptiveRungeKutta<Method, Rate, Dim>,
                                      FixedStepRungeKutta<Method, Rate, Dim>>;

}  // namespace trajet
