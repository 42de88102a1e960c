#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "trajet/ode/segment.hpp"
#include "trajet/ode/stepper.hpp"

namespace trajet::detail {

/// The per-component tolerance atol + rtol |q|, and what it measures: the largest component of a vector over it.
struct Tolerance {
  StepOptions options;

  double of(Eigen::Index component, double q) const {
    return absolute_tolerance(options, component) + options.rtol * std::abs(q);
  }

  /// Not-a-number if any component of `vector` is.
  template <class Vector, class State>
  double norm(const Vector& vector, const State& q) const {
    double largest = 0.0;
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      const double x = std::abs(vector[i]) / of(i, q[i]);
      if (!(x <= largest)) largest = x;
      if (std::isnan(largest)) break;
    }
    return largest;
  }
};

/// What the steps of all implicit methods with a linear algebra of their own have in common: the ends of the step, the
/// rate and the exact Jacobian at its start, and the factors of I - c J.
///
/// `Rate` is a rate with a Jacobian: DifferentiableLaw or SystemRate.
template <class Rate, int Dim>
class ImplicitStep {
 public:
  using State = Eigen::Matrix<double, Dim, 1>;

  explicit ImplicitStep(Rate rate, Tolerance tolerance) : rate_(std::move(rate)), tolerance_(std::move(tolerance)) {}

  double t0() const { return t0_; }
  double t1() const { return t1_; }
  const State& end() const { return q1_; }
  const StepStatistics& statistics() const { return statistics_; }
  StepStatistics& statistics() { return statistics_; }

  /// A step of no length at (t, q).
  void start(double t, const State& q) {
    t0_ = t1_ = t;
    q0_ = q1_ = q;
    const Eigen::Index n = q.size();
    error_.setZero(n);
    g0_.setZero(n);
    g1_.setZero(n);
    time_rate_.setZero(n);
    jacobian_.setZero(n, n);
    matrix_.setZero(n, n);
    end_rate_is_known_ = false;
  }

  /// Makes the end of the last step the start of the next one, with the rate and the Jacobian there.
  /// False if they are not finite.
  bool begin_next() {
    t0_ = t1_;
    q0_ = q1_;
    if (end_rate_is_known_) {
      g0_ = g1_;
    } else {
      evaluate(t0_, q0_, g0_);
    }
    rate_.jacobian(t0_, q0_, jacobian_, time_rate_);
    ++statistics_.law_evaluations;
    return g0_.allFinite() && jacobian_.allFinite() && time_rate_.allFinite();
  }

  /// Back to the start of the step.
  void undo() {
    t1_ = t0_;
    q1_ = q0_;
    g1_ = g0_;
    end_rate_is_known_ = true;
  }

  /// The longest step (s) for which Euler's rule would meet the tolerance: h^2 |q''| / 2 = 1 in its norm, where
  /// q'' = J g + dg/dt. Infinite where the solution is a straight line so far.
  double euler_step() const {
    const State second = jacobian_ * g0_ + time_rate_;
    return std::sqrt(2.0 / tolerance_.norm(second, q0_));
  }

 protected:
  void evaluate(double t, const State& q, State& g) {
    rate_(t, q, g);
    ++statistics_.law_evaluations;
  }

  /// Factors I - c J.
  void factor(double c) {
    matrix_ = -c * jacobian_;
    matrix_.diagonal().array() += 1.0;
    lu_.compute(matrix_);
  }

  /// The error estimate over the tolerance at the larger end.
  double error_norm() const { return tolerance_.norm(error_, q0_.cwiseAbs().cwiseMax(q1_.cwiseAbs()).eval()); }

  /// Gives `segment` this step's interval and start, and as bound the error estimate with rounding. The coefficients up
  /// to `degree` are left to the caller.
  void begin_segment(Segment<Dim>& segment, int degree) const {
    segment.resize(static_cast<int>(q1_.size()), degree);
    segment.set_interval(t0_, t1_);
    segment.coefficients().col(0) = q0_;
    // the state and the polynomial's value near it are rounded twice each
    segment.error_bound() =
        error_.cwiseAbs() + std::numeric_limits<double>::epsilon() * (q0_.cwiseAbs() + q1_.cwiseAbs());
  }

  /// The cubic through q0, q1 with the rates g0, g1.
  void fill_hermite(Segment<Dim>& segment) const {
    begin_segment(segment, 3);
    const double h = t1_ - t0_;
    const State chord = (q1_ - q0_) / h;
    segment.coefficients().col(1) = g0_;
    segment.coefficients().col(2) = (3.0 * chord - 2.0 * g0_ - g1_) / h;
    segment.coefficients().col(3) = (g0_ + g1_ - 2.0 * chord) / (h * h);
  }

  Rate rate_;
  Tolerance tolerance_;
  double t0_ = 0.0;
  double t1_ = 0.0;
  State q0_, q1_;
  State g0_, g1_;  // the rates at both ends
  State error_;    // of the step, as estimated
  State time_rate_;
  Eigen::Matrix<double, Dim, Dim> jacobian_;
  Eigen::Matrix<double, Dim, Dim> matrix_;
  Eigen::PartialPivLU<Eigen::Matrix<double, Dim, Dim>> lu_;
  bool end_rate_is_known_ = false;
  StepStatistics statistics_;
};

}  // namespace trajet::detail
