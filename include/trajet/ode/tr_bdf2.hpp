#pragma once

#include "trajet/ode/newton_step.hpp"

namespace trajet {

/// TR-BDF2 for ImplicitStepper, MATLAB's ode23tb: the trapezoidal rule to t0 + gamma h, the backward differentiation
/// formula of order 2 from there to the end, with one matrix for both, [HoseaShampine1996] §2:
///
///     q_gamma = q0 + d h (g0 + g_gamma)
///     q1      = q0 + h (w g0 + w g_gamma + d g1),   gamma = 2 - sqrt 2, d = gamma/2, w = sqrt 2 / 4
///     companion of order 3: q0 + h ((1 - w)/3 g0 + (3 w + 1)/3 g_gamma + d/3 g1)
///
/// Dense output: the cubic through q0, g0, q1, g1.
struct TrBdf2Formula {
  static constexpr int kOrder = 2;
  static constexpr int kDenseOrder = 2;  // the cubic is of order 3, its end is not
  static constexpr int kErrorPower = 3;

  static constexpr double kSqrt2 = 1.4142135623730951;
  static constexpr double kGamma = 2.0 - kSqrt2;
  static constexpr double kD = 0.5 * kGamma;
  static constexpr double kW = 0.25 * kSqrt2;

  template <class Rate, int Dim>
  class Step : public detail::NewtonStep<Rate, Dim> {
    using Base = detail::NewtonStep<Rate, Dim>;

   public:
    using Base::Base;
    using typename Base::State;

    double attempt(double t1) {
      using detail::StageStatus;
      const double h = t1 - this->t0_;
      this->t1_ = t1;
      this->factor(kD * h);
      known_ = this->q0_ + kD * h * this->g0_;
      q_gamma_ = this->q0_ + kGamma * h * this->g0_;
      g_gamma_.resize(known_.size());
      StageStatus status = this->solve_stage(this->t0_ + kGamma * h, kD * h, known_, q_gamma_, g_gamma_);
      if (status != StageStatus::solved) return Base::as_error(status);
      known_ = this->q0_ + kW * h * (this->g0_ + g_gamma_);
      this->q1_ = q_gamma_ + (1.0 - kGamma) * h * g_gamma_;
      status = this->solve_stage(t1, kD * h, known_, this->q1_, this->g1_);
      if (status != StageStatus::solved) return Base::as_error(status);
      this->end_rate_is_known_ = true;
      this->error_ = h * ((kW - (1.0 - kW) / 3.0) * this->g0_ + (kW - (3.0 * kW + 1.0) / 3.0) * g_gamma_ +
                          (kD - kD / 3.0) * this->g1_);
      this->filter_error();
      return this->error_norm();
    }

    void fill(Segment<Dim>& segment) const { this->fill_hermite(segment); }

   private:
    State known_;
    State q_gamma_;
    State g_gamma_;
  };
};

}  // namespace trajet
