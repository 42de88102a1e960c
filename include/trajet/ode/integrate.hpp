#pragma once

#include <type_traits>

#include "trajet/ode/stepper.hpp"

namespace trajet {

enum class IntegrationStatus {
  finished,        ///< reached the end
  stopped,         ///< the sink asked for it
  step_too_small,  ///< see StepStatus
  not_finite,      ///< see StepStatus
  too_many_steps,  ///< `max_steps` were not enough
};

/// How far an integration came and why it ended there. The stepper holds the state at `time`.
struct IntegrationResult {
  IntegrationStatus status = IntegrationStatus::finished;
  double time = 0.0;
};

/// What a sink that returns anything returns.
enum class Flow { go_on, stop };

inline constexpr long kDefaultMaxSteps = 1'000'000;

/// Integrates from (t0, q0) to `t_end`, before or after t0, step by step. After every accepted step it calls
/// sink(stepper), which returns nothing or a Flow. The last step ends at `t_end` exactly; if t_end == t0 there is none.
template <Stepper S, class Sink>
IntegrationResult integrate(S& stepper, double t0, const typename S::State& q0, double t_end, long max_steps,
                            Sink&& sink) {
  stepper.start(t0, q0);
  for (long step = 0; stepper.time() != t_end; ++step) {
    if (step == max_steps) return {IntegrationStatus::too_many_steps, stepper.time()};
    switch (stepper.advance(t_end)) {
      case StepStatus::ok:
        break;
      case StepStatus::step_too_small:
        return {IntegrationStatus::step_too_small, stepper.time()};
      case StepStatus::not_finite:
        return {IntegrationStatus::not_finite, stepper.time()};
    }
    if constexpr (std::is_void_v<std::invoke_result_t<Sink&, S&>>) {
      sink(stepper);
    } else {
      if (sink(stepper) == Flow::stop) return {IntegrationStatus::stopped, stepper.time()};
    }
  }
  return {IntegrationStatus::finished, t_end};
}

/// The same for whoever only wants the end: the stepper holds it.
template <Stepper S>
IntegrationResult integrate(S& stepper, double t0, const typename S::State& q0, double t_end,
                            long max_steps = kDefaultMaxSteps) {
  return integrate(stepper, t0, q0, t_end, max_steps, [](const S&) {});
}

}  // namespace trajet
