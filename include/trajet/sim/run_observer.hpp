#pragma once

#include "trajet/ode/segment.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

struct World;

/// How one group of bodies and states moved from one time to another.
struct MotionPiece {
  int group;                 ///< in World::groups: what the components of the Segment are
  const Segment<>& segment;  ///< is the motion between `from` and `to`, which lie on it
  double from;               ///< s since the start, as all times of the Segment
  double to;                 ///< s; before `from` in a run backward in time
  bool begins_anew;  ///< the state or the law may have jumped at `from`: the start, a bounce, an event that set it
  bool ends_step;    ///< a step of the method ends at `to`; else an impact, an event or the run's end cut it
};

/// What an observer wants to hear of: nothing else is computed for it.
struct RunWishes {
  bool motion = false;
  bool samples = false;
  /// Impacts and events are left to the observer: the RunResult holds none of them, and a run with many needs no memory
  /// for them.
  bool takes_records = false;
};

/// Receives a run while it goes on. Every function has a default that does nothing.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  /// Asked once, before all else.
  virtual RunWishes wishes() const { return {.motion = true, .samples = true}; }
  /// Once, before the motion: what is going to move. The World lives as long as the run.
  virtual void begin(const World&) {}
  /// All of the motion, on the Segments that were searched for impacts. The pieces of a group join without gaps in
  /// time. They are what is reported: samples, impacts and the final state are read from them.
  virtual void motion(const MotionPiece&) {}
  /// In order of time: all bodies at the start, at each multiple of the sample spacing and at the end; the body
  /// concerned before and after each impact.
  virtual void sample(const Sample&) {}
  /// Each impact and each event as it happens, in the order of the report.
  virtual void impact(const Impact&) {}
  virtual void event(const EventRecord&) {}
  /// Asked between steps and samples: true ends the run as `interrupted`. `time` is how far the run has come, by the
  /// scene's clock. Where memory is about to end, it may throw std::bad_alloc: the run then ends as `failed`.
  virtual bool interrupted(double time) { return time != time; }
};

}  // namespace trajet
