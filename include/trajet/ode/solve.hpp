#pragma once

#include <Eigen/Core>
#include <utility>

#include "trajet/ode/integrate.hpp"
#include "trajet/ode/law_expansion.hpp"
#include "trajet/ode/runge_kutta.hpp"
#include "trajet/ode/tableau_dop853.hpp"
#include "trajet/ode/taylor.hpp"
#include "trajet/ode/trajectory.hpp"
#include "trajet/portable.hpp"

namespace trajet {

/// Makes the steppers of a Runge-Kutta method. A law's State is Eigen::Matrix<double, Dim, 1>.
template <class Method>
struct RungeKuttaMethod {
  template <int Dim, class Law>
  static auto make_stepper(Law law, int, const StepOptions& options) {
    return RungeKutta<Method, Law, Dim>(std::move(law), options);
  }
};

/// The methods as types, for a choice at compile time: solve<Rk4>(law, …). The registry has the same for run time.
using Euler = RungeKuttaMethod<EulerTableau>;
using Midpoint = RungeKuttaMethod<MidpointTableau>;
using Heun = RungeKuttaMethod<HeunTableau>;
using Rk4 = RungeKuttaMethod<Rk4Tableau>;
using Rk4ThreeEighths = RungeKuttaMethod<Rk4ThreeEighthsTableau>;
using Bs32 = RungeKuttaMethod<Bs32Tableau>;
using Dopri5 = RungeKuttaMethod<Dopri5Tableau>;
using Dop853 = RungeKuttaMethod<Dop853Tableau>;
template <class Number>
struct TaylorMethod {
  template <int Dim, class Law>
  static auto make_stepper(Law law, int dimension, const StepOptions& options) {
    using Expansion = LawExpansion<Law, Dim, Number>;
    return TaylorStepper<Expansion>(Expansion(std::move(law), dimension), options);
  }
};
using Taylor = TaylorMethod<double>;
using TaylorExtended = TaylorMethod<Extended>;

/// What solve() needs beside the problem.
struct SolveOptions : StepOptions {
  long max_steps = kDefaultMaxSteps;
};

/// Solves dq/dt = law(t, q) from q(t0) = q0 to `t_end`, before or after t0, and returns q as a function of time.
///
/// `law(t, q, dq)` writes the rate into dq. It is a generic lambda: t is a scalar, q and dq are Eigen vectors of any
/// number type; the Runge-Kutta methods call it with double, the Taylor method with power series. What fails
/// numerically is told by the Trajectory's status; wrong options throw std::invalid_argument.
template <class Method = Taylor, class Law, class Vector>
auto solve(Law law, double t0, const Eigen::MatrixBase<Vector>& q0, double t_end, const SolveOptions& options = {}) {
  constexpr int kDim = Vector::RowsAtCompileTime;
  auto stepper = Method::template make_stepper<kDim>(std::move(law), static_cast<int>(q0.rows()), options);
  Trajectory<kDim> trajectory;
  trajectory.start_time = t0;
  trajectory.start = q0;
  Segment<kDim> segment;
  const auto keep = [&](auto& s) {
    s.fill_segment(segment);
    trajectory.segments.push_back(segment);
  };
  trajectory.status = integrate(stepper, t0, trajectory.start, t_end, options.max_steps, keep).status;
  trajectory.statistics = stepper.statistics();
  if constexpr (requires { stepper.warnings(); }) trajectory.warnings = stepper.warnings();
  return trajectory;
}

}  // namespace trajet
