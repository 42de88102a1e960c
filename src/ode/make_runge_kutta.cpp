#include "make_runge_kutta.hpp"

#include "padded_runge_kutta.hpp"
#include "trajet/ode/runge_kutta.hpp"
#include "trajet/ode/system_rate.hpp"
#include "wrapped_stepper.hpp"

namespace trajet::detail {

template <class Method>
std::unique_ptr<AnyStepper> make_runge_kutta(System& system, const StepOptions& options) {
  constexpr int kSmall = 8;  // a point has six components
  if (system.dimension() <= kSmall) {
    return std::make_unique<WrappedStepper<PaddedRungeKutta<Method, kSmall>>>(system, options);
  }
  return std::make_unique<WrappedStepper<RungeKutta<Method, SystemRate, Eigen::Dynamic>>>(SystemRate(system), options);
}

template std::unique_ptr<AnyStepper> make_runge_kutta<EulerTableau>(System&, const StepOptions&);
template std::unique_ptr<AnyStepper> make_runge_kutta<MidpointTableau>(System&, const StepOptions&);
template std::unique_ptr<AnyStepper> make_runge_kutta<HeunTableau>(System&, const StepOptions&);
template std::unique_ptr<AnyStepper> make_runge_kutta<Rk4Tableau>(System&, const StepOptions&);
template std::unique_ptr<AnyStepper> make_runge_kutta<Rk4ThreeEighthsTableau>(System&, const StepOptions&);
template std::unique_ptr<AnyStepper> make_runge_kutta<Bs32Tableau>(System&, const StepOptions&);
template std::unique_ptr<AnyStepper> make_runge_kutta<Dopri5Tableau>(System&, const StepOptions&);
template std::unique_ptr<AnyStepper> make_runge_kutta<Dop853Tableau>(System&, const StepOptions&);

}  // namespace trajet::detail
