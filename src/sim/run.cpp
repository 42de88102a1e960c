#include "trajet/sim/run.hpp"

#include <chrono>
#include <new>

#include "run_loop.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {
namespace {

/// Wants to hear of nothing.
class NoObserver : public RunObserver {
 public:
  RunWishes wishes() const override { return {}; }
};

/// Lets the program give memory back, as it would have been asked to by `operator new`: Eigen allocates without that.
void ask_for_memory() {
  try {
    if (const std::new_handler handler = std::get_new_handler()) handler();
  } catch (const std::bad_alloc&) {  // it has none
  }
}

}  // namespace

class Run::State {
 public:
  State(const World& world, RunObserver* observer) : loop(world, observer != nullptr ? *observer : no_observer_) {}

 private:
  NoObserver no_observer_;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();

 public:
  double wall_seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  }
  RunLoop loop;
};

Run::Run(const World& world, RunObserver* observer) : state_(std::make_unique<State>(world, observer)) {}
Run::~Run() = default;
Run::Run(Run&&) noexcept = default;
Run& Run::operator=(Run&&) noexcept = default;

bool Run::step() {
  try {
    return state_->loop.step();
  } catch (const std::bad_alloc&) {
    ask_for_memory();
    state_->loop.run_out_of_memory();
    return false;
  }
}

double Run::next_time() const { return state_->loop.next_time(); }

RunResult Run::result() {
  RunResult result = state_->loop.result();
  result.statistics.wall_seconds = state_->wall_seconds();
  return result;
}

void check(const Scene& scene) { static_cast<void>(make_world(scene)); }

RunResult run(const Scene& scene, RunObserver* observer) { return run(make_world(scene), observer); }

RunResult run(const World& world, RunObserver* observer) {
  Run run(world, observer);
  while (run.step()) {
  }
  return run.result();
}

}  // namespace trajet
