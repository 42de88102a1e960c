#pragma once

#include <cmath>
#include <limits>

#include "trajet/ode/implicit_step.hpp"

namespace trajet::detail {

/// What became of the equations of an implicit stage.
enum class StageStatus {
  solved,
  not_finite,    ///< the law
  not_converged  ///< the iteration, or the matrix is singular
};

/// An ImplicitStep with stages that Newton's iteration solves.
template <class Rate, int Dim>
class NewtonStep : public ImplicitStep<Rate, Dim> {
  using Base = ImplicitStep<Rate, Dim>;

 public:
  using Base::Base;
  using typename Base::State;

 protected:
  /// Solves q = known + c g(t, q) from the guess that `q` holds; then g = (q - known) / c is the rate at q. I - c J
  /// must be factored.
  ///
  /// Simplified Newton iteration with the Jacobian at the start of the step, ended as [HairerWanner1996] IV.8 (8.10)
  /// has it: when what is left to correct, by the rate of convergence seen so far, is a hundredth of the tolerance, or
  /// rounding.
  StageStatus solve_stage(double t, double c, const State& known, State& q, State& g) {
    double previous = 0.0;
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
      this->evaluate(t, q, g);
      if (!g.allFinite()) return StageStatus::not_finite;
      residual_ = known + c * g - q;
      correction_ = this->lu_.solve(residual_);
      if (!correction_.allFinite()) return StageStatus::not_converged;
      q += correction_;
      const double size = correction_norm(q);
      const double rate = iteration == 0 ? kAssumedRate : size / previous;
      const double left = rate < 1.0 ? size * rate / (1.0 - rate) : size;
      if (left <= kSolved || size <= kSolved) {
        g = (q - known) / c;
        return StageStatus::solved;
      }
      // what the remaining iterations can still gain
      if (iteration > 0 && (rate >= 1.0 || left * std::pow(rate, kMaxIterations - 2 - iteration) > kSolved)) break;
      previous = size;
    }
    return StageStatus::not_converged;
  }

  /// As an error: what ImplicitStepper makes of it.
  static double as_error(StageStatus status) {
    return status == StageStatus::not_finite ? std::numeric_limits<double>::quiet_NaN()
                                             : std::numeric_limits<double>::infinity();
  }

  /// The estimate with its stiff components damped, as the solution's are, by the factored matrix:
  /// [HoseaShampine1996] §2.
  void filter_error() { this->error_ = this->lu_.solve(this->error_).eval(); }

 private:
  static constexpr int kMaxIterations = 10;
  static constexpr double kSolved = 0.01;      // of the tolerance: the error estimate must not notice
  static constexpr double kAssumedRate = 0.5;  // of convergence, of an iteration that has taken one step
  // Rounding of the residual, as a part of the state: a tolerance below a hundred times of it cannot be solved to a
  // hundredth.
  static constexpr double kFinestTolerance = 400.0 * std::numeric_limits<double>::epsilon();

  /// The largest component of the correction over its tolerance, none of which is taken finer than rounding allows.
  double correction_norm(const State& q) const {
    double largest = 0.0;
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      const double scale = std::max(std::abs(q[i]), std::abs(this->q0_[i]));
      largest = std::max(largest,
                         std::abs(correction_[i]) / std::max(this->tolerance_.of(i, scale), kFinestTolerance * scale));
    }
    return largest;
  }

  State residual_;
  State correction_;
};

}  // namespace trajet::detail
