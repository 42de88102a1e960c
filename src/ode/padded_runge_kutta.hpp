#pragma once

#include <Eigen/Core>

#include "trajet/ode/runge_kutta.hpp"
#include "trajet/ode/system.hpp"

namespace trajet::detail {

/// A Runge-Kutta method on a System of at most `Dim` components, as a Stepper of run-time dimension. Inside, the state
/// has the fixed dimension `Dim` and stays in registers; the components behind those of the System are zero.
///
/// The rate of a scene's law costs little more than the sums over the stages at run-time dimension do: measured in
/// instructions, P1 of the benchmarks by dop853 takes half as many.
template <class Method, int Dim>
class PaddedRungeKutta {
 public:
  using State = Eigen::VectorXd;
  static constexpr int kDimension = Eigen::Dynamic;

  PaddedRungeKutta(System& system, const StepOptions& options)
      : dimension_(system.dimension()), stepper_(Rate{&system}, options), state_(dimension_) {}

  void start(double t, const State& q) { stepper_.start(t, padded(q)); }
  void amend(const State& q) { stepper_.amend(padded(q)); }
  StepStatus advance(double t_limit) {
    const StepStatus status = stepper_.advance(t_limit);
    state_ = stepper_.state().head(dimension_);
    return status;
  }
  void fill_segment(Segment<>& segment) {
    stepper_.fill_segment(segment_);
    segment.resize(dimension_, segment_.degree());
    segment.set_interval(segment_.t0(), segment_.t1());
    segment.coefficients() = segment_.coefficients().topRows(dimension_);
    segment.error_bound() = segment_.error_bound().head(dimension_);
  }

  double time() const { return stepper_.time(); }
  const State& state() const { return state_; }
  const StepStatistics& statistics() const { return stepper_.statistics(); }

 private:
  using Padded = Eigen::Matrix<double, Dim, 1>;

  struct Rate {
    System* system;
    void operator()(double t, const Padded& q, Padded& dq) const {
      dq.setZero();
      system->rate(t, q.data(), dq.data());
    }
  };

  Padded padded(const State& q) {
    state_ = q;
    Padded result = Padded::Zero();
    result.head(dimension_) = q;
    return result;
  }

  int dimension_;
  RungeKutta<Method, Rate, Dim> stepper_;
  State state_;
  Segment<Dim> segment_;
};

}  // namespace trajet::detail
