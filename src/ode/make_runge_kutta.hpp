#pragma once

#include <memory>

#include "trajet/ode/stepper.hpp"
#include "trajet/ode/system.hpp"
#include "trajet/ode/tableau.hpp"
#include "trajet/ode/tableau_dop853.hpp"

namespace trajet::detail {

/// The stepper of an explicit Runge-Kutta method on a system, which must outlive it. A line in make_runge_kutta.cpp
/// compiles it for a tableau.
template <class Method>
std::unique_ptr<AnyStepper> make_runge_kutta(System& system, const StepOptions& options);

}  // namespace trajet::detail
