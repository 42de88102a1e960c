#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "trajet/ode/implicit_step.hpp"
#include "trajet/ode/rosenbrock_tableau.hpp"

namespace trajet {

/// A Rosenbrock method for ImplicitStepper: one linear system a stage and no iteration. See RosenbrockTableau.
template <class Method>
struct RosenbrockMethod {
  static constexpr int kOrder = Method::kOrder;
  static constexpr int kDenseOrder = Method::kDenseOrder;
  static constexpr int kErrorPower = Method::kErrorPower;

  template <class Rate, int Dim>
  class Step : public detail::ImplicitStep<Rate, Dim> {
    using Base = detail::ImplicitStep<Rate, Dim>;

   public:
    using Base::Base;
    using typename Base::State;

    double attempt(double t1) {
      const double h = t1 - this->t0_;
      this->t1_ = t1;
      this->factor(kTableau.gamma * h);
      for (std::size_t i = 0; i < kStages; ++i) {
        const bool at_start = i == 0;
        if (!at_start) {
          stage_ = this->q0_;
          add(kTableau.a[i], i, stage_);
          this->evaluate(this->t0_ + kTableau.alpha[i] * h, stage_, this->g1_);
          if (!this->g1_.allFinite()) return std::numeric_limits<double>::quiet_NaN();
        }
        right_ = h * ((at_start ? this->g0_ : this->g1_) + (h * kTableau.gamma_sum[i]) * this->time_rate_);
        add(kTableau.c[i], i, right_);
        u_[i] = this->lu_.solve(kTableau.gamma * right_);
      }
      this->end_rate_is_known_ = Method::kLastStageIsEnd;
      this->q1_ = this->q0_;
      add(kTableau.m, kStages, this->q1_);
      this->error_.setZero(stage_.size());
      add(kTableau.e, kStages, this->error_);
      // without a finite solution the matrix was singular
      if (!this->q1_.allFinite() || !this->error_.allFinite()) return std::numeric_limits<double>::infinity();
      return this->error_norm();
    }

    void fill(Segment<Dim>& segment) const {
      this->begin_segment(segment, kTableau.kDegree);
      const double h = this->t1_ - this->t0_;
      // q1 - q0 - sum_{k>=2} c_k h^k = c_1 h: the polynomial ends in q1 whatever the rounding of the u_i, which are
      // larger
      State first = this->q1_ - this->q0_;
      double scale = 1.0 / h;  // h^-power
      for (int power = 2; power <= kTableau.kDegree; ++power) {
        scale /= h;
        State sum = State::Zero(first.size());
        for (std::size_t i = 0; i < kStages; ++i) sum += kTableau.dense[i][static_cast<std::size_t>(power - 1)] * u_[i];
        first -= sum;
        segment.coefficients().col(power) = scale * sum;
      }
      segment.coefficients().col(1) = first / h;
    }

   private:
    static constexpr auto& kTableau = Method::kTableau;
    static constexpr std::size_t kStages = static_cast<std::size_t>(kTableau.kStages);

    /// sum += sum_{j<count} weight_j u_j
    void add(const std::array<double, kStages>& weights, std::size_t count, State& sum) const {
      for (std::size_t j = 0; j < count; ++j)
        if (weights[j] != 0.0) sum += weights[j] * u_[j];
    }

    State stage_;
    State right_;
    std::array<State, kStages> u_;
  };
};

}  // namespace trajet
