#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
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

  double time() const { return step_.t1; }
  const State& state() const { return step_.q1; }
  const StepStatistics& statistics() const { return statistics_; }

  /// The last step as polynomials, of the degree of the method's dense output. `error_bound` is the difference to the
  /// companion method plus rounding: for `dopri5` and `rk4` it over-estimates the error of the step, for `euler` it is
  /// its leading term, for `midpoint` a term of the same power of the step.
  void fill_segment(Segment<Dim>& segment) {
    evaluate_end_rate();
    segment.resize(static_cast<int>(step_.q1.size()), kDegree);
    segment.set_interval(step_.t0, step_.t1);
    const double per_h = 1.0 / step_.duration();
    detail::for_each_component<Dim>(
        step_.q1.size(), [&](Eigen::Index i) __attribute__((always_inline)) {
          segment.coefficients()(i, 0) = step_.q0[i];
          fill_powers(segment, i, per_h, std::make_index_sequence<kDegree>{});
          const double magnitude = std::max(std::abs(step_.q0[i]), std::abs(step_.q1[i]));
          segment.error_bound()[i] = std::abs(step_.error(i)) + kRounding * magnitude;
        });
  }

 protected:
  using Step = detail::RungeKuttaStep<Method, Dim>;
  static constexpr int kDegree = Method::kTableau.kDenseDegree;
  // q1 is rounded twice, and so are the polynomials' values near it.
  static constexpr double kRounding = 2.0 * std::numeric_limits<double>::epsilon();

  explicit RungeKuttaBase(Rate rate) : rate_(std::move(rate)) {}

  void begin(double t, const State& q) {
    step_.t0 = step_.t1 = t;
    step_.q0 = step_.q1 = step_.q_stage = q;
    for (State& k : step_.k) k.resize(q.size());
    end_rate_known_ = false;
  }

  void evaluate_end_rate() {
    if (end_rate_known_) return;
    evaluate(step_.t1, step_.q1, step_.k[Step::kLast]);
    end_rate_known_ = true;
  }

  /// Prepares the step from the current state, lets attempt(step) compute it with its first `Computed` stages, and
  /// keeps it if that returns `ok`.
  template <std::size_t Computed, class Attempt>
  TRAJET_INLINE StepStatus advance_by(Attempt&& attempt) {
    if constexpr (detail::kIsUnrolled<Dim>) {
      // A local step stays in registers; the kept one is written once, at the end.
      Step step;
      step.t0 = step_.t1;
      detail::copy_state<Dim>(step_.q1, step.q0);
      if (end_rate_known_) {
        detail::copy_state<Dim>(step_.k[Step::kLast], step.k[0]);
      } else {
        evaluate(step.t0, step.q0, step.k[0]);
      }
      const StepStatus status = attempt(step);
      if (status == StepStatus::ok) keep(step, std::make_index_sequence<Computed>{});
      return status;
    } else {
      rotate();
      if (!end_rate_known_) evaluate(step_.t0, step_.q0, step_.k[0]);
      const StepStatus status = attempt(step_);
      if (status != StepStatus::ok) rotate();
      return status;
    }
  }

  TRAJET_INLINE void evaluate(double t, const State& q, State& dq) {
    rate_(t, q, dq);
    ++statistics_.law_evaluations;
  }

  Rate rate_;
  Step step_;
  bool end_rate_known_ = false;
  StepStatistics statistics_;

 private:
  template <std::size_t... J>
  TRAJET_INLINE void keep(const Step& step, std::index_sequence<J...>) {
    step_.t0 = step.t0;
    step_.t1 = step.t1;
    detail::copy_state<Dim>(step.q0, step_.q0);
    detail::copy_state<Dim>(step.q1, step_.q1);
    (detail::copy_state<Dim>(step.k[J], step_.k[J]), ...);
  }

  /// Makes the end of the step its start, and the other way round.
  void rotate() {
    std::swap(step_.t0, step_.t1);
    step_.q0.swap(step_.q1);
    step_.k[0].swap(step_.k[Step::kLast]);
  }

  template <std::size_t... P>
  void fill_powers(Segment<Dim>& segment, Eigen::Index i, double per_h, std::index_sequence<P...>) const {
    double scale = 1.0;  // h^(1 - power)
    ((segment.coefficients()(i, P + 1) =
          step_.template weighted<typename Step::template DenseWeights<P + 1>>(0.0, scale, i),
      scale *= per_h),
     ...);
  }
};

/// Any explicit Runge-Kutta method with steps that the user gives. A Stepper.
///
/// start() begins a new grid of equal steps at its time; see StepGrid.
template <class Method, class Rate, int Dim>
class FixedStepRungeKutta : public RungeKuttaBase<Method, Rate, Dim> {
  using Base = RungeKuttaBase<Method, Rate, Dim>;
  using Step = typename Base::Step;

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
    // The last stage waits until the next step or a Segment asks for it.
    return this->template advance_by<Step::kStages - 1>([&](Step & step) __attribute__((always_inline)) {
      step.t1 = grid_.next(step.t0, t_limit);
      step.compute(this->rate_);
      this->statistics_.law_evaluations += static_cast<long>(Step::kStages) - 2;
      // 0 * q is 0, or not a number where q is infinite or not a number.
      double zero = 0.0;
      detail::for_each_component<Dim>(
          step.q1.size(), [&](Eigen::Index i) __attribute__((always_inline)) { zero += 0.0 * step.q1[i]; });
      if (zero != 0.0) return StepStatus::not_finite;
      this->end_rate_known_ = false;
      ++this->statistics_.steps;
      return StepStatus::ok;
    });
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
  using Step = typename Base::Step;

 public:
  using typename Base::State;

  AdaptiveRungeKutta(Rate rate, const StepOptions& options)
      : Base(std::move(rate)), rtol_(options.rtol), atol_(options.atol), first_step_(options.step.value_or(0.0)) {}

  void start(double t, const State& q) {
    this->begin(t, q);
    controller_.reset();
    next_step_ = first_step_;
  }

  TRAJET_FLATTEN StepStatus advance(double t_limit) {
    assert(t_limit != this->time());
    if (next_step_ == 0.0) next_step_ = first_step(t_limit);
    return this->template advance_by<Step::kStages>([&](Step & step) __attribute__((always_inline)) {
      const double direction = t_limit > step.t0 ? 1.0 : -1.0;
      const double distance = std::abs(t_limit - step.t0);
      double h = std::max(next_step_, smallest_step(step.t0));
      while (true) {
        const bool lands = h * kStretch >= distance;
        step.t1 = lands ? t_limit : step.t0 + direction * h;
        step.compute(this->rate_);
        this->rate_(step.t1, step.q1, step.k[Step::kLast]);
        this->statistics_.law_evaluations += static_cast<long>(Step::kStages) - 1;
        const double error = error_norm(step);
        if (lands) h = distance;
        if (error <= 1.0) {
          const double proposed = h * controller_.accepted(error);
          next_step_ = lands ? std::max(proposed, next_step_) : proposed;
          this->end_rate_known_ = true;
          ++this->statistics_.steps;
          return StepStatus::ok;
        }
        h *= controller_.rejected(error);
        ++this->statistics_.rejected_steps;
        if (!(h >= smallest_step(step.t0)))
          return std::isfinite(error) ? StepStatus::step_too_small : StepStatus::not_finite;
        next_step_ = h;
      }
    });
  }

 private:
  // The estimate is the error of the companion of lower order: it behaves as h^(order + 1).
  static constexpr int kErrorPower = std::min(Method::kOrder, Method::kCompanionOrder) + 1;
  // A limit this little farther than the step is reached in one: the alternative is a tiny last step.
  static constexpr double kStretch = 1.01;

  /// The largest component of the error over its tolerance; not a number where any is infinite or not a number.
  TRAJET_INLINE double error_norm(const Step& step) const {
    double norm = 0.0;
    double zero = 0.0;
    detail::for_each_component<Dim>(
        step.q1.size(), [&](Eigen::Index i) __attribute__((always_inline)) {
          const double ratio =
              std::abs(step.error(i)) / tolerance(std::max(std::abs(step.q0[i]), std::abs(step.q1[i])));
          norm = std::max(norm, ratio);
          zero += 0.0 * ratio;
        });
    return norm + zero;
  }

  double tolerance(double magnitude) const { return atol_ + rtol_ * magnitude; }

  /// A first step (s) that by Euler's rule changes the state by a hundredth, smaller where the rate itself changes
  /// fast.
  [[gnu::noinline]] double first_step(double t_limit) {
    this->evaluate_end_rate();
    const double t = this->step_.t1;
    const State& q = this->step_.q1;
    const State& rate = this->step_.k[Step::kLast];
    State& q_euler = this->step_.q_stage;
    State& rate_euler = this->step_.k[0];
    double d0 = 0.0;
    double d1 = 0.0;
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      const double scale = tolerance(std::abs(q[i]));
      d0 = std::max(d0, std::abs(q[i]) / scale);
      d1 = std::max(d1, std::abs(rate[i]) / scale);
    }
    const double h0 = std::min(d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1, std::abs(t_limit - t));
    const double signed_h0 = t_limit > t ? h0 : -h0;
    q_euler = q + signed_h0 * rate;
    this->evaluate(t + signed_h0, q_euler, rate_euler);
    double d2 = d1;
    for (Eigen::Index i = 0; i < q.size(); ++i)
      d2 = std::max(d2, std::abs(rate_euler[i] - rate[i]) / (h0 * tolerance(std::abs(q[i]))));
    if (!std::isfinite(d2)) return h0;
    const double h1 =
        d2 > 1e-15 ? detail::rough_exp2(detail::rough_log2(0.01 / d2) / kErrorPower) : std::max(1e-6, 1e-3 * h0);
    return std::min(100.0 * h0, h1);
  }

  double rtol_;
  double atol_;
  double first_step_;
  StepController controller_{kErrorPower};
  double next_step_ = 0.0;  // s; 0: not chosen yet
};

/// The stepper of a tableau: fixed steps, or chosen ones where its companion is made for that.
template <class Method, class Rate, int Dim>
using RungeKutta = std::conditional_t<Method::kErrorControlled, AdaptiveRungeKutta<Method, Rate, Dim>,
                                      FixedStepRungeKutta<Method, Rate, Dim>>;

}  // namespace trajet
