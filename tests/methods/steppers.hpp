#pragma once

#include <gtest/gtest.h>

#include "trajet/ode/runge_kutta.hpp"
#include "trajet/ode/solve.hpp"

namespace trajet {

/// A tableau run with fixed steps, also one that usually chooses its own.
template <class Method>
struct FixedSteps {
  using Tableau = Method;
  template <int Dim, class Law>
  static auto make_stepper(Law law, int, const StepOptions& options) {
    return FixedStepRungeKutta<Method, Law, Dim>(std::move(law), options);
  }
};

using FixedStepMethods = testing::Types<FixedSteps<EulerTableau>, FixedSteps<MidpointTableau>, FixedSteps<HeunTableau>,
                                        FixedSteps<Rk4Tableau>, FixedSteps<Rk4ThreeEighthsTableau>,
                                        FixedSteps<Bs32Tableau>, FixedSteps<Dopri5Tableau>>;

/// Solves a named problem over its own time.
template <class Method, class Problem>
auto solve_problem(const Problem& problem, const SolveOptions& options) {
  return solve<Method>(problem, Problem::start_time(), Problem::start(), Problem::end_time(), options);
}

}  // namespace trajet
