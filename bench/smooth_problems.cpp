#include <Eigen/Core>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "problems/drag.hpp"
#include "problems/free_kick.hpp"
#include "trajet/ode/solve.hpp"
#include "trajet/sim/program_system.hpp"
#include "trajet/sim/world.hpp"
#include "work_precision.hpp"

/// P1 and P2: from a C++ law, from a scene, and with Boost.odeint, at many tolerances and steps.
namespace trajet::bench {
namespace {

namespace odeint = boost::numeric::odeint;

std::string labelled(const char* method, double setting) {
  char text[64];
  std::snprintf(text, sizeof text, "%s:%.0e", method, setting);
  return text;
}

std::string labelled(const char* method, int steps) { return method + std::string(":") + std::to_string(steps); }

template <class State>
double largest_error(const State& q, const Eigen::Matrix<double, 6, 1>& reference) {
  double error = 0.0;
  for (int i = 0; i < 6; ++i) error = std::max(error, std::abs(q[static_cast<std::size_t>(i)] - reference[i]));
  return error;
}

/// A problem with the same law as text, for a scene. States and reference ends are (v, r).
struct SceneProblem {
  const char* acceleration;
  Eigen::Matrix<double, 6, 1> reference_end;
};

template <class Problem>
Eigen::Matrix<double, 6, 1> reference_end() {
  if constexpr (requires { Problem::reference_end(); })
    return Problem::reference_end();
  else
    return Problem::exact(Problem::end_time());
}

constexpr double kTolerances[] = {1e0,  1e-1,  1e-2,  1e-3,  1e-4,  1e-5,  1e-6,  1e-7, 1e-8,
                                  1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15, 1e-16};
constexpr int kSteps[] = {5, 10, 20, 40, 80, 160, 320, 640, 1280};

template <class Problem, class Method>
void add_law(const char* problem, const std::string& method, const StepOptions& options) {
  auto stepper = std::make_shared<decltype(Method::template make_stepper<6>(Problem{}, 6, options))>(
      Method::template make_stepper<6>(Problem{}, 6, options));
  add_case({problem, Contender::law, method}, [stepper] {
    integrate(*stepper, Problem::start_time(), Problem::start(), Problem::end_time());
    return largest_error(stepper->state(), reference_end<Problem>());
  });
}

// The first step (s) of every embedded pair: odeint's must be told one, so ours are told the same.
constexpr double kFirstStep = 0.1;

template <class Problem>
void add_laws(const char* problem) {
  for (const double tolerance : kTolerances) {
    add_law<Problem, Taylor>(problem, labelled("taylor", tolerance), {.rtol = tolerance, .atol = tolerance});
    const StepOptions options{.rtol = tolerance, .atol = tolerance, .step = kFirstStep};
    add_law<Problem, Dop853>(problem, labelled("dop853", tolerance), options);
    if (tolerance >= 1e-13) add_law<Problem, Dopri5>(problem, labelled("dopri5", tolerance), options);
  }
  for (const int steps : kSteps)
    add_law<Problem, Rk4>(problem, labelled("rk4", steps),
                          {.step = (Problem::end_time() - Problem::start_time()) / steps});
}

/// A scene's group, compiled once. Its state is (r, v).
struct CompiledScene {
  World world;
  std::unique_ptr<ProgramSystem> system;
  std::unique_ptr<AnyStepper> stepper;
  Eigen::VectorXd start;
};

template <class Problem>
void add_scene(const char* problem, const char* acceleration, const char* name, const std::string& method,
               const StepOptions& options) {
  Scene scene;
  const Eigen::Matrix<double, 6, 1> start = Problem::start();
  BodyDefinition body;
  body.name = "particle";
  body.position = Vector3(start.tail<3>());
  body.velocity = Vector3(start.head<3>());
  body.acceleration = Expression(acceleration);
  scene.bodies = {body};
  scene.time.end = Expression(Problem::end_time());
  auto compiled = std::make_shared<CompiledScene>();
  compiled->world = make_world(scene);
  const World::Group& group = compiled->world.groups.front();
  compiled->start = group.start;
  compiled->system = std::make_unique<ProgramSystem>(group.law);
  compiled->stepper = find_method(name)->make(*compiled->system, options);
  add_case({problem, Contender::scene, method}, [compiled] {
    AnyStepper& stepper = *compiled->stepper;
    stepper.start(Problem::start_time(), compiled->start);
    while (stepper.time() != Problem::end_time())
      if (stepper.advance(Problem::end_time()) != StepStatus::ok) return HUGE_VAL;
    Eigen::Matrix<double, 6, 1> velocity_first;
    velocity_first << stepper.state().tail<3>(), stepper.state().head<3>();
    return largest_error(velocity_first, reference_end<Problem>());
  });
}

template <class Problem>
void add_scenes(const char* problem, const char* acceleration) {
  for (const double tolerance : kTolerances) {
    add_scene<Problem>(problem, acceleration, "taylor", labelled("taylor", tolerance),
                       {.rtol = tolerance, .atol = tolerance});
    const StepOptions options{.rtol = tolerance, .atol = tolerance, .step = kFirstStep};
    add_scene<Problem>(problem, acceleration, "dop853", labelled("dop853", tolerance), options);
    if (tolerance >= 1e-13) add_scene<Problem>(problem, acceleration, "dopri5", labelled("dopri5", tolerance), options);
  }
  for (const int steps : kSteps)
    add_scene<Problem>(problem, acceleration, "rk4", labelled("rk4", steps),
                       {.step = (Problem::end_time() - Problem::start_time()) / steps});
}

using OdeintState = std::array<double, 6>;

template <class Problem>
OdeintState odeint_start() {
  OdeintState q;
  Eigen::Map<Eigen::Matrix<double, 6, 1>>(q.data()) = Problem::start();
  return q;
}

template <class Problem>
void odeint_law(const OdeintState& q, OdeintState& dq, double t) {
  Problem{}(t, q, dq);
}

template <class Problem, class MakeStepper>
void add_odeint_adaptive(const char* problem, const char* method, double tolerance, MakeStepper make_stepper) {
  add_case({problem, Contender::odeint, labelled(method, tolerance)}, [=] {
    OdeintState q = odeint_start<Problem>();
    const auto law = [](const OdeintState& x, OdeintState& dx, double t) { odeint_law<Problem>(x, dx, t); };
    odeint::integrate_adaptive(make_stepper(tolerance), law, q, Problem::start_time(), Problem::end_time(), kFirstStep);
    return largest_error(q, reference_end<Problem>());
  });
}

template <class Problem>
void add_odeint(const char* problem) {
  for (const double tolerance : kTolerances) {
    add_odeint_adaptive<Problem>(problem, "dopri5", tolerance, [](double tol) {
      return odeint::make_controlled<odeint::runge_kutta_dopri5<OdeintState>>(tol, tol);
    });
    add_odeint_adaptive<Problem>(problem, "rkf78", tolerance, [](double tol) {
      return odeint::make_controlled<odeint::runge_kutta_fehlberg78<OdeintState>>(tol, tol);
    });
    add_odeint_adaptive<Problem>(problem, "b-stoer", tolerance,
                                 [](double tol) { return odeint::bulirsch_stoer<OdeintState>(tol, tol); });
  }
  for (const int steps : kSteps)
    add_case({problem, Contender::odeint, labelled("rk4", steps)}, [steps] {
      OdeintState q = odeint_start<Problem>();
      const double step = (Problem::end_time() - Problem::start_time()) / steps;
      const auto law = [](const OdeintState& x, OdeintState& dx, double t) { odeint_law<Problem>(x, dx, t); };
      odeint::integrate_n_steps(odeint::runge_kutta4<OdeintState>(), law, q, Problem::start_time(), step,
                                static_cast<std::size_t>(steps));
      return largest_error(q, reference_end<Problem>());
    });
}

}  // namespace

void add_smooth_problems() {
  using problems::Drag, problems::FreeKick;
  add_laws<Drag>("P1 drag");
  add_scenes<Drag>("P1 drag", "[-vx*vx/2, -vy*vy, -vz*vz/3]");
  add_odeint<Drag>("P1 drag");
  add_laws<FreeKick>("P2 free kick");
  add_scenes<FreeKick>("P2 free kick", "[0, 0, -9.81] - 0.0126*norm(v)*v + cross([0, 0, 0.3], v)");
  add_odeint<FreeKick>("P2 free kick");
}

}  // namespace trajet::bench
