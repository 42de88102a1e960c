#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "trajet/ode/implicit_step.hpp"
#include "trajet/ode/segment.hpp"
#include "trajet/ode/step_control.hpp"
#include "trajet/ode/stepper.hpp"

namespace trajet {

/// An implicit one-step method that chooses its steps so that every component's error per step stays within
/// atol + rtol |q_i|. A Stepper.
///
/// `Method` has kOrder, kDenseOrder, kErrorPower (the estimate behaves as h^kErrorPower) and Step<Rate, Dim>, an
/// ImplicitStep with two more functions: `attempt(t1)` computes the step to t1 and returns its error over the
/// tolerance, not-a-number if the law is not finite, infinite if the equations of the step could not be solved;
/// `fill(segment)` writes it.
///
/// The first step is `StepOptions::step`, or the one that would suit Euler's rule. A step that a limit cuts short does
/// not shorten the following ones.
template <class Method, class Rate, int Dim>
class ImplicitStepper {
 public:
  using State = Eigen::Matrix<double, Dim, 1>;
  static constexpr int kDimension = Dim;

  ImplicitStepper(Rate rate, const StepOptions& options)
      : step_(std::move(rate), {options}), first_step_(options.step.value_or(0.0)), max_step_(options.max_step) {
    check_step_control(options);
  }

  void start(double t, const State& q) {
    step_.start(t, q);
    controller_.reset();
    next_step_ = first_step_;
  }

  /// Replaces the state; the size of the next step stays.
  void amend(const State& q) { step_.start(time(), q); }

  StepStatus advance(double t_limit) {
    assert(t_limit != time());
    const double t0 = time();
    t_limit = step_limit(t0, t_limit, max_step_);
    if (!step_.begin_next()) {
      step_.undo();
      return StepStatus::not_finite;
    }
    const double direction = t_limit > t0 ? 1.0 : -1.0;
    const double distance = std::abs(t_limit - t0);
    if (next_step_ == 0.0) next_step_ = std::min(step_.euler_step(), kLongestFirst * distance);
    double h = std::max(next_step_, smallest_step(t0));
    while (true) {
      const bool lands = h * kLandingStretch >= distance;
      const double error = step_.attempt(lands ? t_limit : t0 + direction * h);
      if (lands) h = distance;
      if (error <= 1.0) {
        const double proposed = h * controller_.accepted(error);
        next_step_ = lands ? std::max(proposed, next_step_) : proposed;
        ++step_.statistics().steps;
        return StepStatus::ok;
      }
      const double factor = controller_.rejected(error);
      h *= std::isinf(error) ? kUnsolved : factor;
      ++step_.statistics().rejected_steps;
      if (!(h >= smallest_step(t0))) {
        step_.undo();
        return std::isnan(error) ? StepStatus::not_finite : StepStatus::step_too_small;
      }
      next_step_ = h;
    }
  }

  void fill_segment(Segment<Dim>& segment) { step_.fill(segment); }

  double time() const { return step_.t1(); }
  const State& state() const { return step_.end(); }
  const StepStatistics& statistics() const { return step_.statistics(); }

 private:
  // The first step as a part of the way: a solution that starts as a straight line says nothing about what comes.
  static constexpr double kLongestFirst = 0.1;
  // By how much to shorten a step whose equations were not solved: usually Newton's iteration was not far from
  // converging.
  static constexpr double kUnsolved = 0.25;

  typename Method::template Step<Rate, Dim> step_;
  double first_step_;
  double max_step_;  // s
  StepController controller_{Method::kErrorPower};
  double next_step_ = 0.0;  // s; 0: not chosen yet
};

}  // namespace trajet
