#include <memory>

#include "problem_set.hpp"
#include "trajet/ode/registry.hpp"
#include "trajet/scene/program_system.hpp"
#include "trajet/scene/world.hpp"
#include "work_precision.hpp"

/// The smooth problems as scenes: the law is text, compiled to a program that an interpreter runs.
namespace trajet::bench {
namespace {

/// A scene's group, compiled once.
struct CompiledScene {
  World world;
  std::unique_ptr<ProgramSystem> system;
  std::unique_ptr<AnyStepper> stepper;
  Eigen::VectorXd start;
};

template <class Problem>
void add_scene(const char* name, const std::string& method, const StepOptions& options) {
  auto compiled = std::make_shared<CompiledScene>();
  compiled->world = make_world(Benchmark<Problem>::scene());
  const World::Group& group = compiled->world.groups.front();
  compiled->start = group.start;
  compiled->system = std::make_unique<ProgramSystem>(group.law);
  compiled->stepper = find_method(name)->make(*compiled->system, options);
  add_case({Benchmark<Problem>::kName, Contender::scene, method}, [compiled] {
    AnyStepper& stepper = *compiled->stepper;
    stepper.start(Problem::start_time(), compiled->start);
    while (stepper.time() != Problem::end_time())
      if (stepper.advance(Problem::end_time()) != StepStatus::ok) return kFailed;
    return error_at_end<Problem>(Benchmark<Problem>::from_scene(stepper.state()));
  });
}

template <class Problem>
void add_problem() {
  for (const double tolerance : kTolerances) {
    add_scene<Problem>("taylor", labelled("taylor", tolerance), {.rtol = tolerance, .atol = tolerance});
    const StepOptions options{.rtol = tolerance, .atol = tolerance, .step = kFirstStep};
    add_scene<Problem>("dop853", labelled("dop853", tolerance), options);
    if (tolerance >= 1e-8) add_scene<Problem>("dopri5", labelled("dopri5", tolerance), options);
  }
  for (const double tolerance : kExtendedTolerances)
    add_scene<Problem>("taylor-extended", labelled("taylor-ext", tolerance), {.rtol = tolerance, .atol = tolerance});
  for (const int steps : fixed_steps<Problem>())
    add_scene<Problem>("rk4", labelled("rk4", steps), {.step = (Problem::end_time() - Problem::start_time()) / steps});
}

}  // namespace

void add_scenes() {
  for_each_problem([]<class Problem>() { add_problem<Problem>(); });
}

}  // namespace trajet::bench
