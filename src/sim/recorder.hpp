#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "course.hpp"
#include "instant.hpp"
#include "time_limit.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/sim/run_observer.hpp"

namespace trajet {

/// What a run leaves behind: its result, and what its observer wants to hear on the way. It only reads.
///
/// The times that it is told are elapsed since the start, s; reports have the scene's too.
class Recorder {
 public:
  using Courses = std::vector<std::unique_ptr<Course>>;

  /// All outlive the recorder.
  Recorder(const World& world, const Courses& courses, RunObserver& observer);

  /// Whether the observer wants the run to end, or its time is over.
  bool is_interrupted(double time) { return observer_.interrupted(world_.epoch + time) || is_out_of_time(); }
  bool is_out_of_time() const { return time_limit_.is_over(); }

  /// The regular samples behind the last one, up to `time`. False if the run is interrupted; then `time` is how far it
  /// has come.
  bool sample_until(double& time);
  /// From now on observers hear of no motion: there is no memory to keep it.
  void hand_on_no_more();
  /// A sample of all bodies, or of one before or after something happens to it.
  void sample(double time);
  void sample(double time, int body, SamplePhase phase);
  /// The motion of a course on its current Segment up to time t.
  void motion(Course& course, double t);

  void impact(Impact impact);
  /// Impacts at one instant that were resolved together: several have a number in common.
  void impacts(std::vector<Impact> group);
  /// From that time on a body is in contact with an obstacle in that way; or not any more.
  void contact(double time, PairId id, ImpactKind mode);
  void contact_ends(double time, PairId id);
  void event(double time, const std::string& name, int direction, const std::string& law = {});
  /// Whether the two meet, or when, cannot be decided from that time on.
  void unresolved(double time, const std::string& body, const std::string& with, const std::string& why);
  /// Impacts of two pairs may each have been first.
  void warn_of_tie(const Impact& impact, const std::string& body, const std::string& with);
  /// Newton's law of impact has given energy to the bodies, J.
  void warn_of_gain(const Impact& impact, double energy);
  void warn(const std::string& text);

  /// How far the run has come, and what has become of it.
  double end_time() const { return result_.elapsed; }
  /// Of the end so far and the last sample, the later: samples run ahead of what happens next.
  double reached_time() const;
  void set_end_time(double time) { result_.elapsed = time; }
  RunStatus status() const { return result_.status; }
  void end(RunStatus status, const std::string& failure = {});

  /// Once, when the run is over.
  RunResult result();

 private:
  void keep(Impact impact);
  /// Gives an impact the time of the scene's clock, whose digits its bound counts too.
  void put_on_clock(Impact& impact) const;
  Sample sample_at(double time, std::optional<int> body, SamplePhase phase) const;
  void bound_final_errors();

  const World& world_;
  const Courses& courses_;
  RunObserver& observer_;
  RunWishes wishes_;
  TimeLimit time_limit_;
  double direction_;
  RunResult result_;
  int tie_count_ = 0;
  int gain_count_ = 0;
  int group_count_ = 0;
  long next_sample_ = 0;
  std::optional<double> last_sample_;  // s, of all bodies
  std::optional<Impact> last_impact_;
  std::map<std::pair<int, int>, std::size_t> open_contacts_;  // of body and obstacle, in result_.contacts
};

}  // namespace trajet
