#include <array>
#include <boost/numeric/odeint.hpp>
#include <functional>
#include <memory>

#include "../problem_set.hpp"
#include "../work_precision.hpp"

/// Boost.odeint, which inlines the law as we do.
namespace trajet::bench {
namespace {

namespace odeint = boost::numeric::odeint;

template <class Problem>
using State = std::array<double, static_cast<std::size_t>(Problem::kDimension)>;

template <class Problem>
State<Problem> start() {
  State<Problem> q;
  Eigen::Map<typename Problem::State>(q.data()) = Problem::start();
  return q;
}

template <class Problem>
constexpr auto law() {
  return [](const State<Problem>& q, State<Problem>& dq, double t) { Problem{}(t, q, dq); };
}

template <class Problem, class MakeStepper>
void add_adaptive(const char* method, double tolerance, MakeStepper make_stepper) {
  // made once, as ours are: Bulirsch and Stoer's has tables
  auto stepper = std::make_shared<decltype(make_stepper(tolerance))>(make_stepper(tolerance));
  add_case({Benchmark<Problem>::kName, Contender::odeint, labelled(method, tolerance)}, [stepper] {
    State<Problem> q = start<Problem>();
    if constexpr (requires { stepper->reset(); }) stepper->reset();  // else it remembers nothing from run to run
    odeint::integrate_adaptive(std::ref(*stepper), law<Problem>(), q, Problem::start_time(), Problem::end_time(),
                               kFirstStep);
    return error_at_end<Problem>(q);
  });
}

template <class Problem>
void add_problem() {
  for (const double tolerance : kTolerances) {
    add_adaptive<Problem>("rkf78", tolerance, [](double tol) {
      return odeint::make_controlled<odeint::runge_kutta_fehlberg78<State<Problem>>>(tol, tol);
    });
    add_adaptive<Problem>("b-stoer", tolerance,
                          [](double tol) { return odeint::bulirsch_stoer<State<Problem>>(tol, tol); });
    if (tolerance >= 1e-8)
      add_adaptive<Problem>("dopri5", tolerance, [](double tol) {
        return odeint::make_controlled<odeint::runge_kutta_dopri5<State<Problem>>>(tol, tol);
      });
  }
  for (const int steps : fixed_steps<Problem>())
    add_case({Benchmark<Problem>::kName, Contender::odeint, labelled("rk4", steps)}, [steps] {
      State<Problem> q = start<Problem>();
      const double step = (Problem::end_time() - Problem::start_time()) / steps;
      odeint::integrate_n_steps(odeint::runge_kutta4<State<Problem>>(), law<Problem>(), q, Problem::start_time(), step,
                                static_cast<std::size_t>(steps));
      return error_at_end<Problem>(q);
    });
}

}  // namespace

void add_odeint() {
  for_each_problem([]<class Problem>() { add_problem<Problem>(); });
}

}  // namespace trajet::bench
