#pragma once

#include <Eigen/Core>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "trajet/ode/levelled_rate.hpp"
#include "trajet/ode/segment.hpp"
#include "trajet/ode/step_grid.hpp"
#include "trajet/ode/stepper.hpp"

namespace trajet {

/// Which of the course's two formulas gives the position.
enum class PositionFormula {
  linear,     ///< the velocity is linear within the step
  quadratic,  ///< the velocity is the quadratic that it is by its own formula
};

/// The course's scheme for accelerations of time alone whose derivatives are not known, with the steps that
/// the user gives. In the step from t_{n-1} to t_n the acceleration counts as linear:
///
///     k_n  = (a_n - a_{n-1}) / h
///     v(t) = v_{n-1} + a_{n-1} (t - t_{n-1}) + k_n (t - t_{n-1})^2 / 2
///
/// and the position follows from the velocity by either formula:
///
///     linear:     r(t) = r_{n-1} + v_{n-1} (t - t_{n-1}) + l_n (t - t_{n-1})^2 / 2,   l_n = (v_n - v_{n-1}) / h
///     quadratic:  r(t) = r_{n-1} + v_{n-1} (t - t_{n-1}) + a_{n-1} (t - t_{n-1})^2 / 2 + k_n (t - t_{n-1})^3 / 6
///
/// Here for any system whose rates are known beforehand level by level (see Levels): a rate of level 0 is taken for
/// v's, one of a further level for r's. A rate that is not a mere copy is interpolated at the ends of the step, and,
/// for the second formula, at its middle. A Stepper.
template <class Rate, int Dim>
class DifferenceStepper {
 public:
  using State = Eigen::Matrix<double, Dim, 1>;
  static constexpr int kDimension = Dim;

  /// Reads `step` or `nodes`. Throws std::invalid_argument if both are missing or wrong, or for a law that depends on
  /// its own solution.
  DifferenceStepper(Rate rate, Structure structure, PositionFormula formula, const StepOptions& options)
      : rate_(std::move(rate), std::move(structure)), formula_(formula), grid_(options) {
    for (State* state : {&start_rate_, &end_rate_, &middle_, &middle_rate_}) state->resize(rate_.dimension());
    segment_.resize(rate_.dimension(), kDegree);
  }

  void start(double t, const State& q) {
    t_ = t;
    q_ = q;
    for (const auto& level : rate_.levels()) statistics_.law_evaluations += rate_.evaluate(level, t, q, end_rate_);
    grid_.start(t);
  }

  StepStatus advance(double t_limit) {
    assert(t_limit != t_);
    const double t0 = t_;
    t_ = grid_.next(t0, t_limit);
    start_rate_ = end_rate_;
    segment_.set_interval(t0, t_);
    segment_.coefficients().col(0) = q_;
    for (std::size_t level = 0; level < rate_.levels().size(); ++level) advance_level(level);
    if (!q_.allFinite()) {
      t_ = t0;
      q_ = segment_.coefficients().col(0);
      end_rate_ = start_rate_;
      return StepStatus::not_finite;
    }
    ++statistics_.steps;
    return StepStatus::ok;
  }

  /// Writes the last step. `error_bound` comes from how far the rate in the middle of the step is off the straight
  /// line: one more evaluation of the law.
  void fill_segment(Segment<Dim>& segment) {
    segment = segment_;
    const double h = std::abs(segment_.duration());
    State& bound = segment.error_bound();
    bound.setZero();
    State shifted_rate = end_rate_;
    for (std::size_t level = 0; level < rate_.levels().size(); ++level) {
      const auto& components = rate_.levels()[level];
      if (is_linear(level)) evaluate_middle(components);
      if (level > 0) statistics_.law_evaluations += rate_.evaluate(components, t_, q_ + bound, shifted_rate);
      for (const int i : components) {
        // a parabola over the straight line has 2/3 of its height times h as area
        const double height = std::abs(middle_rate_[i] - 0.5 * (start_rate_[i] + end_rate_[i]));
        const double own = is_linear(level) ? 2.0 / 3.0 * h * height : 0.0;
        const double from_below = h * std::abs(shifted_rate[i] - end_rate_[i]);
        const double rounding =
            std::numeric_limits<double>::epsilon() * (std::abs(segment.coefficients()(i, 0)) + std::abs(q_[i]));
        bound[i] = own + from_below + rounding;
      }
    }
  }

  double time() const { return t_; }
  const State& state() const { return q_; }
  const StepStatistics& statistics() const { return statistics_; }

 private:
  static constexpr int kDegree = 3;

  /// Whether the rates of a level count as linear within the step.
  bool is_linear(std::size_t level) const { return level == 0 || formula_ == PositionFormula::linear; }

  /// The polynomials and the end values of a level, whose lower levels are done.
  void advance_level(std::size_t level) {
    const auto& components = rate_.levels()[level];
    const double h = segment_.duration();
    statistics_.law_evaluations += rate_.evaluate(components, t_, q_, end_rate_);
    if (!is_linear(level)) evaluate_middle(components);
    for (const int i : components) {
      // g(t) = g0 + slope tau + curvature tau^2, tau = t - t0
      const double slope_of_chord = (end_rate_[i] - start_rate_[i]) / h;
      double curvature = 0.0;
      if (!is_linear(level)) curvature = 2.0 * (start_rate_[i] - 2.0 * middle_rate_[i] + end_rate_[i]) / (h * h);
      const double slope = slope_of_chord - curvature * h;
      auto coefficients = segment_.coefficients().row(i);
      coefficients[1] = start_rate_[i];
      coefficients[2] = slope / 2.0;
      coefficients[3] = curvature / 3.0;
      q_[i] = segment_.value(i, t_);
      middle_[i] = segment_.value(i, middle_time());
    }
  }

  /// The rates of a level in the middle of the step, from the polynomials of the levels below.
  void evaluate_middle(const std::vector<int>& components) {
    statistics_.law_evaluations += rate_.evaluate(components, middle_time(), middle_, middle_rate_);
  }
  double middle_time() const { return segment_.t0() + 0.5 * segment_.duration(); }

  detail::LevelledRate<Rate, Dim> rate_;
  PositionFormula formula_;
  StepGrid grid_;
  double t_ = 0.0;
  State q_;
  State start_rate_, end_rate_;  // of the last step
  State middle_, middle_rate_;   // in its middle
  Segment<Dim> segment_;
  StepStatistics statistics_;
};

/// The methods as types, for solve<DifferenceLinear>(law, …).
template <PositionFormula Formula>
struct DifferenceMethod {
  template <int Dim, class Law>
  static auto make_stepper(Law law, int dimension, const StepOptions& options) {
    Structure structure = structure_of(law, dimension);
    return DifferenceStepper<Law, Dim>(std::move(law), std::move(structure), Formula, options);
  }
};
using DifferenceLinear = DifferenceMethod<PositionFormula::linear>;
using DifferenceQuadratic = DifferenceMethod<PositionFormula::quadratic>;

}  // namespace trajet
