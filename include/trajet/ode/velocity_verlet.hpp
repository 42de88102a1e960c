#pragma once

#include <Eigen/Core>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trajet/ode/segment.hpp"
#include "trajet/ode/step_grid.hpp"
#include "trajet/ode/stepper.hpp"
#include "trajet/ode/structure.hpp"

namespace trajet {

/// The method of Störmer and Verlet in its velocity form, for dr/dt = v, dv/dt = a(r, t), with the steps that the user
/// gives, [HairerLubichWanner2006] I.1.4:
///
///     v_half = v0 + h/2 a(r0, t0)
///     r1     = r0 + h v_half
///     v1     = v_half + h/2 a(r1, t1)
///
/// Symmetric and, for a force that has a potential, symplectic; of order 2: on long runs the energy's error does not
/// grow. More generally for any system of two halves, dr/dt = f(v, t) and dv/dt = a(r, t), with f taken in the middle
/// of the step; where f is not just v, that costs two more evaluations a step. A Stepper.
template <class Rate, int Dim>
class VelocityVerletStepper {
 public:
  using State = Eigen::Matrix<double, Dim, 1>;
  static constexpr int kDimension = Dim;

  /// Reads `step` or `nodes`. Throws std::invalid_argument if both are missing or wrong, or for a law of another form.
  VelocityVerletStepper(Rate rate, const Structure& structure, const StepOptions& options)
      : rate_(std::move(rate)), grid_(options) {
    const PartsResult parts = find_parts(structure);
    if (parts.unsuitable)
      throw std::invalid_argument("the rate of component " + std::to_string(parts.unsuitable->component) + " " +
                                  parts.unsuitable->reason);
    for (int i = 0; i < structure.dimension(); ++i) {
      const bool is_position = parts.is_position[static_cast<std::size_t>(i)];
      (is_position ? positions_ : velocities_).push_back(i);
      if (is_position && structure[i].copy_of) copies_.push_back({i, *structure[i].copy_of});
    }
    for (State* state : {&start_rate_, &end_rate_, &half_rate_}) state->resize(structure.dimension());
  }

  void start(double t, const State& q) {
    t0_ = t1_ = t;
    q0_ = q1_ = q;
    evaluate(t, q, end_rate_);
    grid_.start(t);
  }

  StepStatus advance(double t_limit) {
    assert(t_limit != t1_);
    t0_ = t1_;
    q0_ = q1_;
    start_rate_ = end_rate_;
    t1_ = grid_.next(t0_, t_limit);
    const double h = t1_ - t0_;
    for (const int i : velocities_) q1_[i] += 0.5 * h * start_rate_[i];
    evaluate_drift(t0_ + 0.5 * h, half_rate_);
    for (const int i : positions_) q1_[i] += h * half_rate_[i];
    evaluate(t1_, q1_, end_rate_);
    for (const int i : velocities_) q1_[i] += 0.5 * h * end_rate_[i];
    evaluate_drift(t1_, end_rate_);
    if (!q1_.allFinite()) {
      t1_ = t0_;
      q1_ = q0_;
      end_rate_ = start_rate_;
      return StepStatus::not_finite;
    }
    ++statistics_.steps;
    return StepStatus::ok;
  }

  /// Writes the last step: the parabolas that start with the rates at its start and end in its end. `error_bound`
  /// compares them with the rates at the end and, one more evaluation of the law, in the middle.
  void fill_segment(Segment<Dim>& segment) {
    segment.resize(static_cast<int>(q0_.size()), 2);
    segment.set_interval(t0_, t1_);
    const double h = t1_ - t0_;
    segment.coefficients().col(0) = q0_;
    segment.coefficients().col(1) = start_rate_;
    // a(t) is linear between both ends; so is f(t) with the slope of its first half
    for (const int i : velocities_) segment.coefficients()(i, 2) = (end_rate_[i] - start_rate_[i]) / (2.0 * h);
    for (const int i : positions_) segment.coefficients()(i, 2) = (half_rate_[i] - start_rate_[i]) / h;

    const double t_middle = t0_ + 0.5 * h;
    State middle(q0_.size()), middle_rate(q0_.size());
    segment.evaluate(t_middle, middle);
    evaluate(t_middle, middle, middle_rate);
    State& bound = segment.error_bound();
    bound = std::numeric_limits<double>::epsilon() * (q0_.cwiseAbs() + q1_.cwiseAbs());
    // a parabola of height d over the straight line has the area 2/3 h d; a slope that turns by d at the end, h d / 3
    for (const int i : velocities_)
      bound[i] += 2.0 / 3.0 * std::abs(h * (middle_rate[i] - 0.5 * (start_rate_[i] + end_rate_[i])));
    for (const int i : positions_)
      bound[i] += 1.0 / 3.0 * std::abs(h * (end_rate_[i] - 2.0 * half_rate_[i] + start_rate_[i]));
  }

  double time() const { return t1_; }
  const State& state() const { return q1_; }
  const StepStatistics& statistics() const { return statistics_; }

 private:
  /// dr/dt = v: which component is which.
  struct Copy {
    int position;
    int velocity;
  };

  void evaluate(double t, const State& q, State& rate) {
    rate_(t, q, rate);
    ++statistics_.law_evaluations;
  }

  /// The rates of the positions from the velocities in q1_.
  void evaluate_drift(double t, State& rate) {
    if (copies_.size() != positions_.size()) evaluate(t, q1_, rate);
    for (const Copy& copy : copies_) rate[copy.position] = q1_[copy.velocity];
  }

  Rate rate_;
  StepGrid grid_;
  std::vector<int> positions_, velocities_;
  std::vector<Copy> copies_;
  double t0_ = 0.0, t1_ = 0.0;
  State q0_, q1_;
  State start_rate_, end_rate_;
  State half_rate_;  // of the positions, from the velocities in the middle of the last step
  StepStatistics statistics_;
};

/// The method as a type, for solve<VelocityVerlet>(law, …).
struct VelocityVerlet {
  template <int Dim, class Law>
  static auto make_stepper(Law law, int dimension, const StepOptions& options) {
    const Structure structure = structure_of(law, dimension);
    return VelocityVerletStepper<Law, Dim>(std::move(law), structure, options);
  }
};

}  // namespace trajet
