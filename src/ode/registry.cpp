#include "trajet/ode/registry.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "make_runge_kutta.hpp"
#include "trajet/ode/cvode.hpp"
#include "trajet/ode/difference.hpp"
#include "trajet/ode/gauss.hpp"
#include "trajet/ode/implicit_stepper.hpp"
#include "trajet/ode/quadrature.hpp"
#include "trajet/ode/rk4_doubling.hpp"
#include "trajet/ode/rosenbrock.hpp"
#include "trajet/ode/series_steps.hpp"
#include "trajet/ode/system_rate.hpp"
#include "trajet/ode/taylor.hpp"
#include "trajet/ode/tr_bdf2.hpp"
#include "trajet/ode/trapezoid.hpp"
#include "trajet/ode/velocity_verlet.hpp"
#include "trajet/portable.hpp"
#include "wrapped_stepper.hpp"

namespace trajet {
namespace {

using detail::WrappedStepper;

template <class Method>
std::unique_ptr<AnyStepper> make_implicit(System& system, const StepOptions& options) {
  using S = ImplicitStepper<Method, SystemRate, Eigen::Dynamic>;
  return std::make_unique<WrappedStepper<S>>(S(SystemRate(system), options));
}

std::unique_ptr<AnyStepper> make_gauss(System& system, const StepOptions& options) {
  using S = GaussStepper<SystemRate, Eigen::Dynamic>;
  return std::make_unique<WrappedStepper<S>>(S(SystemRate(system), options));
}

#ifdef TRAJET_WITH_SUNDIALS
template <MultistepFormula Formula>
std::unique_ptr<AnyStepper> make_multistep(System& system, const StepOptions& options) {
  using S = CvodeStepper<SystemRate, Eigen::Dynamic>;
  return std::make_unique<WrappedStepper<S>>(S(Formula, SystemRate(system), system.dimension(), options));
}
#endif

template <class Number>
std::unique_ptr<AnyStepper> make_taylor(System& system, const StepOptions& options) {
  using S = TaylorStepper<SystemExpansion<Number>>;
  return std::make_unique<WrappedStepper<S>>(S(SystemExpansion<Number>(system), options));
}

std::unique_ptr<AnyStepper> make_series(System& system, const StepOptions& options) {
  using S = SeriesStepper<SystemExpansion<>>;
  return std::make_unique<WrappedStepper<S>>(S(SystemExpansion<>(system), options));
}

std::unique_ptr<AnyStepper> make_doubling(System& system, const StepOptions& options) {
  using S = Rk4DoublingStepper<SystemRate, Eigen::Dynamic>;
  return std::make_unique<WrappedStepper<S>>(S(SystemRate(system), options));
}

std::unique_ptr<AnyStepper> make_verlet(System& system, const StepOptions& options) {
  using S = VelocityVerletStepper<SystemRate, Eigen::Dynamic>;
  return std::make_unique<WrappedStepper<S>>(S(SystemRate(system), system.structure(), options));
}

template <PositionFormula Formula>
std::unique_ptr<AnyStepper> make_difference(System& system, const StepOptions& options) {
  using S = DifferenceStepper<SystemRate, Eigen::Dynamic>;
  return std::make_unique<WrappedStepper<S>>(S(SystemRate(system), system.structure(), Formula, options));
}

std::unique_ptr<AnyStepper> make_quadrature(System& system, const StepOptions& options) {
  using S = QuadratureStepper<SystemRate, Eigen::Dynamic>;
  return std::make_unique<WrappedStepper<S>>(S(SystemRate(system), system.structure(), options));
}

std::optional<Unsuitable> unless_of_time(const Structure& structure) { return find_levels(structure).unsuitable; }
std::optional<Unsuitable> unless_of_two_halves(const Structure& structure) { return find_parts(structure).unsuitable; }

using Aliases = std::vector<std::string_view>;

template <class Method>
MethodInfo runge_kutta(std::string_view name, Aliases aliases, std::string_view known_as, std::string_view summary) {
  const StepControl control = Method::kErrorControlled ? StepControl::adaptive : StepControl::fixed;
  return {name,    std::move(aliases), Method::kOrder, Method::kDenseOrder,
          control, known_as,           summary,        detail::make_runge_kutta<Method>};
}

template <class Method>
MethodInfo implicit(std::string_view name, Aliases aliases, std::string_view known_as, std::string_view summary) {
  return {name,    std::move(aliases),   Method::kOrder, Method::kDenseOrder, StepControl::adaptive, known_as,
          summary, make_implicit<Method>};
}

MethodInfo gauss(std::string_view name, Aliases aliases, std::string_view known_as, std::string_view summary) {
  return {name, std::move(aliases), 6, 3, StepControl::fixed, known_as, summary, make_gauss};
}

#ifdef TRAJET_WITH_SUNDIALS
template <MultistepFormula Formula>
MethodInfo multistep(std::string_view name, Aliases aliases, std::string_view known_as, std::string_view summary) {
  return {name, std::move(aliases), 0, 0, StepControl::adaptive, known_as, summary, make_multistep<Formula>};
}
#endif

MethodInfo extended(MethodInfo method) {
  method.carries_extended = true;
  return method;
}

/// A line of the table of any family.
MethodInfo row(std::string_view name, Aliases aliases, int order, int dense_order, StepControl control,
               std::string_view known_as, std::string_view summary, decltype(MethodInfo::make) make, int max_order = 0,
               decltype(MethodInfo::find_unsuitable) find_unsuitable = nullptr) {
  return {name, std::move(aliases), order, dense_order, control, known_as, summary, make, max_order, find_unsuitable};
}

bool equals_without_case(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return ranges::equal(a, b, {}, lower, lower);
}

}  // namespace

std::span<const MethodInfo> methods() {
  constexpr int kSeriesOrder = SeriesStepper<SystemExpansion<>>::kDefaultOrder;
  static const std::vector<MethodInfo> table = {
      runge_kutta<EulerTableau>("euler", {"SEDEuler0"}, "notes: Euler", "the rate at the start of the step"),
      runge_kutta<MidpointTableau>("midpoint", {"rk2"}, "notes: Runge-Kutta 2", "the rate at its middle"),
      runge_kutta<HeunTableau>("heun", {}, "notes: Runge-Kutta 2", "the mean of the rates at its ends"),
      runge_kutta<Rk4Tableau>("rk4", {"SEDRK4t0"}, "notes: Runge-Kutta 4", "Kutta's classical method"),
      runge_kutta<Rk4ThreeEighthsTableau>("rk4-3/8", {}, "Kutta's 3/8 rule",
                                          "smaller errors than the classical method"),
      runge_kutta<Bs32Tableau>("bs32", {"ode23", "RK23"}, "MATLAB: ode23, SciPy: RK23",
                               "Bogacki and Shampine's pair 3(2)"),
      runge_kutta<Dopri5Tableau>("dopri5", {"ode45", "RK45"}, "MATLAB: ode45, SciPy: RK45",
                                 "Dormand and Prince's pair 5(4)"),
      runge_kutta<Dop853Tableau>("dop853", {}, "SciPy: DOP853", "Dormand and Prince's method 8(5,3)"),
      row("series", {}, kSeriesOrder, kSeriesOrder, StepControl::fixed, "notes: series of a chosen order",
          "exact derivatives; [method] order", make_series, SeriesStepper<SystemExpansion<>>::kMaxOrder),
      row("taylor", {}, 0, 0, StepControl::adaptive, "notes: Taylor series",
          "exact derivatives; order chosen from the tolerance", make_taylor<double>, kMaxTaylorOrder),
      extended(row("taylor-extended", {}, 0, 0, StepControl::adaptive, "",
                   "taylor in extended precision: for motions that amplify rounding", make_taylor<Extended>,
                   kMaxTaylorOrder)),
      gauss("gauss6", {}, "", "Gauss collocation, symplectic: long runs keep their energy"),
#ifdef TRAJET_WITH_SUNDIALS
      multistep<MultistepFormula::adams>("adams", {"ode113"}, "MATLAB: ode113",
                                         "Adams, orders 1 to 12, SUNDIALS CVODE"),
      multistep<MultistepFormula::bdf>("bdf", {"ode15s"}, "MATLAB: ode15s",
                                       "stiff: backward differentiation, orders 1 to 5, SUNDIALS CVODE"),
#endif
      implicit<RosenbrockMethod<Rosenbrock23Tableau>>("rosenbrock23", {"ode23s"}, "MATLAB: ode23s",
                                                      "stiff: Shampine and Reichelt's Rosenbrock pair 2(3)"),
      implicit<TrapezoidFormula>("trapezoid", {"ode23t"}, "MATLAB: ode23t", "stiff: trapezoidal rule, no damping"),
      implicit<TrBdf2Formula>("tr-bdf2", {"ode23tb"}, "MATLAB: ode23tb", "stiff: trapezoidal rule, then BDF2"),
      implicit<RosenbrockMethod<Rodas5pTableau>>("rodas5p", {}, "", "stiff: Steinebach's Rosenbrock pair 5(4)"),
      row("rk4-doubling", {"SEDRK4c"}, 5, 4, StepControl::subdivided, "notes: Runge-Kutta with error control",
          "steps halved until they agree, then extrapolated", make_doubling),
      row("velocity-verlet", {"verlet", "leapfrog"}, 2, 2, StepControl::fixed, "Störmer and Verlet",
          "symplectic, for dr/dt = v, dv/dt = a(r, t)", make_verlet, 0, unless_of_two_halves),
      row("difference-linear", {}, 2, 2, StepControl::fixed, "notes: first position formula",
          "laws of t alone: a(t), then v(t) linear within the step", make_difference<PositionFormula::linear>, 0,
          unless_of_time),
      row("difference-quadratic", {}, 2, 2, StepControl::fixed, "notes: second position formula",
          "laws of t alone: a(t) linear, v(t) quadratic within the step", make_difference<PositionFormula::quadratic>,
          0, unless_of_time),
      row("quadrature", {}, 0, 0, StepControl::adaptive, "notes: direct integration",
          "laws of t alone: Gauss and Kronrod's rule", make_quadrature, 0, unless_of_time),
  };
  return table;
}

const MethodInfo* find_method(std::string_view name) {
  const auto is_name = [name](std::string_view other) { return equals_without_case(other, name); };
  const auto goes_by = [&](const MethodInfo& method) {
    return is_name(method.name) || ranges::any_of(method.aliases, is_name);
  };
  const auto found = ranges::find_if(methods(), goes_by);
  return found == methods().end() ? nullptr : &*found;
}

const MethodInfo* find_nearest_method(std::string_view foreign_name) {
  struct StandIn {
    std::string_view foreign;
    std::string_view ours;
  };
  constexpr StandIn kStandIns[] = {{"Radau", "rodas5p"}, {"LSODA", "bdf"}, {"ode78", "dop853"}, {"ode89", "dop853"}};
  for (const StandIn& stand_in : kStandIns)
    if (equals_without_case(stand_in.foreign, foreign_name)) return find_method(stand_in.ours);
  return nullptr;
}

}  // namespace trajet
