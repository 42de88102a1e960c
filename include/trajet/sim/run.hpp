#pragma once

#include <memory>

#include "trajet/scene/scene.hpp"
#include "trajet/sim/run_observer.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

/// Checks a scene completely without running it: names, dimensions, values. Throws InputError that points at the place.
void check(const Scene& scene);

/// A run that somebody else steps: a game loop, a page, a debugger. `run` below steps it to its end.
class Run {
 public:
  /// Both outlive the run; `observer` may be null.
  explicit Run(const World& world, RunObserver* observer = nullptr);
  ~Run();
  Run(Run&&) noexcept;
  Run& operator=(Run&&) noexcept;

  /// Handles what happens next: the end of a Segment, an event, an impact. False when the run is over.
  bool step();
  /// s; when what happens next happens. Nothing happens before. The end of the run when it is over.
  double next_time() const;
  /// Ends the run where it is and tells what has become of it. Once.
  RunResult result();

 private:
  class State;
  std::unique_ptr<State> state_;
};

/// Computes the motion of a scene. Throws InputError where the scene is wrong; numerical failure is a status of the
/// result.
RunResult run(const Scene& scene, RunObserver* observer = nullptr);
/// The same for a scene that has its numbers already.
RunResult run(const World& world, RunObserver* observer = nullptr);

}  // namespace trajet
