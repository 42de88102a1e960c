#pragma once

#include <memory>
#include <string>
#include <vector>

#include "trajet/scene/world.hpp"
#include "trajet/sim/run_observer.hpp"

namespace trajet {

/// The largest or the smallest value of a formula over a motion.
struct Extreme {
  Expression formula;
  bool is_largest = true;
};
using ExtremeList = std::vector<Extreme>;

/// A World together with the programs of formulas over its motion.
struct ObservedWorld {
  World world;
  struct Observed {
    int group = 0;
    Program value{};  ///< of t, elapsed, and the group's state; one output
  };
  std::vector<Observed> observed{};
};

/// As make_world, with the formulas of extremes. Bodies that one formula joins are integrated together, as by an event.
/// Throws InputError.
ObservedWorld make_observed_world(Scene scene, const ExtremeList& extremes);

/// Follows a run and finds the extremes of its motion: to rounding, whatever the steps, at jumps too.
class FlightExtremes : public RunObserver {
 public:
  /// Both outlive it.
  FlightExtremes(const ObservedWorld& world, const ExtremeList& extremes);
  ~FlightExtremes() override;

  RunWishes wishes() const override { return {.motion = true}; }
  void motion(const MotionPiece& piece) override;
  /// Not a number where the formula had no value.
  std::vector<double> values() const;

 private:
  class Watch;
  std::vector<std::unique_ptr<Watch>> watches_;
};

}  // namespace trajet
