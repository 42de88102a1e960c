#include "make_runge_kutta.hpp"

#include <vector>

#include "padded_runge_kutta.hpp"
#include "trajet/ode/runge_kutta.hpp"
#include "trajet/ode/system_rate.hpp"
#include "trajet/portable.hpp"
#include "wrapped_stepper.hpp"

namespace trajet::detail {

template <class Method>
std::unique_ptr<AnyStepper> make_runge_kutta(System& system, const StepOptions& options) {
  constexpr int kPoint = 8, kSolid = 16;  // r, v; and orientation, angular velocity, in blocks of four
  const std::vector<int> lanes = system.block_border().lanes;
  const int width = lanes.empty() ? system.dimension() : 1 + *ranges::max_element(lanes);
  if (width <= kPoint) return std::make_unique<WrappedStepper<PaddedRungeKutta<Method, kPoint>>>(system, options);
  if (width <= kSolid) return std::make_unique<WrappedStepper<PaddedRungeKutta<Method, kSolid>>>(system, options);
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
