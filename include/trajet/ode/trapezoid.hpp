#pragma once

#include "trajet/ode/newton_step.hpp"

namespace trajet {

/// The trapezoidal rule for ImplicitStepper, MATLAB's ode23t:
///
///     q1 = q0 + h/2 (g0 + g1),   g1 = g(t1, q1)
///
/// Its error is h^3/12 q'''. The exact second derivative at the start, q'' = J g0 + dg/dt, gives the third without a
/// third point: h^2/2 q''' = g1 - g0 - h q''. Dense output: the cubic through q0, g0, q1, g1, [ShampineReichelt1997]
/// §3.3.
struct TrapezoidFormula {
  static constexpr int kOrder = 2;
  static constexpr int kDenseOrder = 2;  // the cubic is of order 3, its end is not
  static constexpr int kErrorPower = 3;

  template <class Rate, int Dim>
  class Step : public detail::NewtonStep<Rate, Dim> {
    using Base = detail::NewtonStep<Rate, Dim>;

   public:
    using Base::Base;
    using typename Base::State;

    double attempt(double t1) {
      const double h = t1 - this->t0_;
      this->t1_ = t1;
      this->factor(0.5 * h);
      known_ = this->q0_ + 0.5 * h * this->g0_;
      this->q1_ = this->q0_ + h * this->g0_;
      const detail::StageStatus status = this->solve_stage(t1, 0.5 * h, known_, this->q1_, this->g1_);
      if (status != detail::StageStatus::solved) return Base::as_error(status);
      this->end_rate_is_known_ = true;
      const State second = this->jacobian_ * this->g0_ + this->time_rate_;
      this->error_ = h / 6.0 * (this->g1_ - this->g0_ - h * second);
      // Where h J is large, h q'' is larger than the rates by as much: one filter for it, one for the rates.
      this->filter_error();
      this->filter_error();
      return this->error_norm();
    }

    void fill(Segment<Dim>& segment) const { this->fill_hermite(segment); }

   private:
    State known_;
  };
};

}  // namespace trajet
