#include <memory>

#include "problem_set.hpp"
#include "trajet/ode/solve.hpp"
#include "work_precision.hpp"

/// The smooth problems from a C++ lambda's law: everything inlined. By a stepper that is used again, and by solve(),
/// which makes one and keeps all Segments.
namespace trajet::bench {
namespace {

template <class Problem, class Method>
void add_law(const std::string& method, const StepOptions& options) {
  using Stepper = decltype(Method::template make_stepper<Problem::kDimension>(Problem{}, Problem::kDimension, options));
  auto stepper = std::make_shared<Stepper>(
      Method::template make_stepper<Problem::kDimension>(Problem{}, Problem::kDimension, options));
  add_case({Benchmark<Problem>::kName, Contender::law, method}, [stepper] {
    const auto result = integrate(*stepper, Problem::start_time(), Problem::start(), Problem::end_time());
    return result.status == IntegrationStatus::finished ? error_at_end<Problem>(stepper->state()) : kFailed;
  });
  SolveOptions all;
  static_cast<StepOptions&>(all) = options;
  add_case({Benchmark<Problem>::kName, Contender::solve, method}, [all] {
    const auto trajectory = solve<Method>(Problem{}, Problem::start_time(), Problem::start(), Problem::end_time(), all);
    return trajectory.status == IntegrationStatus::finished ? error_at_end<Problem>(trajectory.end()) : kFailed;
  });
}

template <class Problem>
void add_problem() {
  for (const double tolerance : kTolerances) {
    add_law<Problem, Taylor>(labelled("taylor", tolerance), {.rtol = tolerance, .atol = tolerance});
    const StepOptions options{.rtol = tolerance, .atol = tolerance, .step = kFirstStep};
    add_law<Problem, Dop853>(labelled("dop853", tolerance), options);
    if (tolerance >= 1e-8) add_law<Problem, Dopri5>(labelled("dopri5", tolerance), options);
  }
  for (const double tolerance : kExtendedTolerances)
    add_law<Problem, TaylorExtended>(labelled("taylor-ext", tolerance), {.rtol = tolerance, .atol = tolerance});
  for (const int steps : fixed_steps<Problem>())
    add_law<Problem, Rk4>(labelled("rk4", steps), {.step = (Problem::end_time() - Problem::start_time()) / steps});
}

}  // namespace

void add_laws() {
  for_each_problem([]<class Problem>() { add_problem<Problem>(); });
}

}  // namespace trajet::bench
