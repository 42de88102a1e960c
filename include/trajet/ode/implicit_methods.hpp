#pragma once

#include <utility>

#include "trajet/ode/cvode.hpp"
#include "trajet/ode/differentiable_law.hpp"
#include "trajet/ode/gauss.hpp"
#include "trajet/ode/implicit_stepper.hpp"
#include "trajet/ode/rosenbrock.hpp"
#include "trajet/ode/solve.hpp"
#include "trajet/ode/tr_bdf2.hpp"
#include "trajet/ode/trapezoid.hpp"

namespace trajet {

/// Makes the steppers of an implicit method. A law's State is Eigen::Matrix<double, Dim, 1>.
template <class Method>
struct ImplicitMethod {
  using Formula = Method;
  template <int Dim, class Law>
  static auto make_stepper(Law law, int, const StepOptions& options) {
    using Rate = DifferentiableLaw<Law, Dim>;
    return ImplicitStepper<Method, Rate, Dim>(Rate(std::move(law)), options);
  }
};

/// Makes the steppers of a multistep method. Needs a library built with SUNDIALS (TRAJET_SUNDIALS).
template <MultistepFormula Formula>
struct MultistepMethod {
  template <int Dim, class Law>
  static auto make_stepper(Law law, int dimension, const StepOptions& options) {
    using Rate = DifferentiableLaw<Law, Dim>;
    return CvodeStepper<Rate, Dim>(Formula, Rate(std::move(law)), dimension, options);
  }
};

/// The implicit methods as types, for stiff problems: solve<Rodas5p>(law, …). The registry has the same for run time.
using Rosenbrock23 = ImplicitMethod<RosenbrockMethod<Rosenbrock23Tableau>>;
using TrBdf2 = ImplicitMethod<TrBdf2Formula>;
using Trapezoid = ImplicitMethod<TrapezoidFormula>;
using Rodas5p = ImplicitMethod<RosenbrockMethod<Rodas5pTableau>>;

struct Gauss6 {
  template <int Dim, class Law>
  static auto make_stepper(Law law, int, const StepOptions& options) {
    using Rate = DifferentiableLaw<Law, Dim>;
    return GaussStepper<Rate, Dim>(Rate(std::move(law)), options);
  }
};
using Adams = MultistepMethod<MultistepFormula::adams>;
using Bdf = MultistepMethod<MultistepFormula::bdf>;

}  // namespace trajet
