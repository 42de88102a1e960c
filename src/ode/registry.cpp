#include "trajet/ode/registry.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "trajet/ode/cvode.hpp"
#include "trajet/ode/gauss.hpp"
#include "trajet/ode/implicit_stepper.hpp"
#include "trajet/ode/rosenbrock.hpp"
#include "trajet/ode/runge_kutta.hpp"
#include "trajet/ode/system_rate.hpp"
#include "trajet/ode/tableau_dop853.hpp"
#include "trajet/ode/taylor.hpp"
#include "trajet/ode/tr_bdf2.hpp"
#include "trajet/ode/trapezoid.hpp"

namespace trajet {
namespace {

/// Any Stepper of run-time dimension behind the interface.
template <Stepper S>
class WrappedStepper final : public AnyStepper {
 public:
  explicit WrappedStepper(S stepper) : stepper_(std::move(stepper)) {}

  void start(double t, const State& q) override { stepper_.start(t, q); }
  StepStatus advance(double t_limit) override { return stepper_.advance(t_limit); }
  void fill_segment(Segment<>& segment) override { stepper_.fill_segment(segment); }
  double time() const override { return stepper_.time(); }
  const State& state() const override { return stepper_.state(); }
  const StepStatistics& statistics() const override { return stepper_.statistics(); }
  bool amend(const State& q) override {
    constexpr bool kCanAmend = requires { stepper_.amend(q); };
    if constexpr (kCanAmend) stepper_.amend(q);
    return kCanAmend;
  }

 private:
  S stepper_;
};

template <class Method>
std::unique_ptr<AnyStepper> make_runge_kutta(System& system, const StepOptions& options) {
  using S = RungeKutta<Method, SystemRate, Eigen::Dynamic>;
  return std::make_unique<WrappedStepper<S>>(S(SystemRate(system), options));
}

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

std::unique_ptr<AnyStepper> make_taylor(System& system, const StepOptions& options) {
  using S = TaylorStepper<SystemExpansion>;
  return std::make_unique<WrappedStepper<S>>(S(SystemExpansion(system), options));
}

using Aliases = std::vector<std::string_view>;

template <class Method>
MethodInfo runge_kutta(std::string_view name, Aliases aliases, std::string_view known_as, std::string_view summary) {
  const StepControl control = Method::kErrorControlled ? StepControl::adaptive : StepControl::fixed;
  return {name,    std::move(aliases), Method::kOrder, Method::kDenseOrder,
          control, known_as,           summary,        make_runge_kutta<Method>};
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

MethodInfo series(std::string_view name, Aliases aliases, std::string_view known_as, std::string_view summary) {
  return {name, std::move(aliases), 0, 0, StepControl::adaptive, known_as, summary, make_taylor};
}

}  // namespace

std::span<const MethodInfo> methods() {
  static const std::array table = {
      runge_kutta<EulerTableau>("euler", {}, "course: Euler, SEDEuler0 (F32)", "the rate at the start of the step"),
      runge_kutta<MidpointTableau>("midpoint", {"rk2"}, "course: Runge-Kutta 2 (F29)", "the rate at its middle"),
      runge_kutta<Rk4Tableau>("rk4", {}, "course: Runge-Kutta 4, SEDRK4t0 (F38)", "Kutta's classical method"),
      runge_kutta<Dopri5Tableau>("dopri5", {"ode45"}, "MATLAB: ode45 (F59)", "Dormand and Prince's pair 5(4)"),
      runge_kutta<Dop853Tableau>("dop853", {}, "", "Dormand and Prince's method 8(5,3)"),
      gauss("gauss6", {}, "", "Gauss collocation, symplectic: long runs keep their energy"),
#ifdef TRAJET_WITH_SUNDIALS
      multistep<MultistepFormula::adams>("adams", {"ode113"}, "MATLAB: ode113 (F59)",
                                         "Adams, orders 1 to 12, SUNDIALS CVODE"),
      multistep<MultistepFormula::bdf>("bdf", {"ode15s"}, "MATLAB: ode15s (F59)",
                                       "stiff: backward differentiation, orders 1 to 5, SUNDIALS CVODE"),
#endif
      implicit<RosenbrockMethod<Rosenbrock23Tableau>>("rosenbrock23", {"ode23s"}, "MATLAB: ode23s (F59)",
                                                      "stiff: Shampine and Reichelt's Rosenbrock pair 2(3)"),
      implicit<TrapezoidFormula>("trapezoid", {"ode23t"}, "MATLAB: ode23t (F59)",
                                 "stiff: trapezoidal rule, no damping"),
      implicit<TrBdf2Formula>("tr-bdf2", {"ode23tb"}, "MATLAB: ode23tb (F59)", "stiff: trapezoidal rule, then BDF2"),
      implicit<RosenbrockMethod<Rodas5pTableau>>("rodas5p", {}, "", "stiff: Steinebach's Rosenbrock pair 5(4)"),
      series("taylor", {"series"}, "course: Taylor series (F10)", "exact derivatives; order chosen from the tolerance"),
  };
  return table;
}

const MethodInfo* find_method(std::string_view name) {
  const auto goes_by = [name](const MethodInfo& method) {
    return method.name == name || std::ranges::find(method.aliases, name) != method.aliases.end();
  };
  const auto found = std::ranges::find_if(methods(), goes_by);
  return found == methods().end() ? nullptr : &*found;
}

}  // namespace trajet
