#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <queue>
#include <string>
#include <vector>

#include "motion.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

/// Runs a World: integrate, find the first incident, respond, go on from there. Nothing else in trajet joins the three.
///
/// The motions of a World advance on their own, each by its own Segments. The simulation handles incidents in the order
/// of time over all motions, so that at each of them every motion's current Segment covers that time.
class Simulation {
 public:
  Simulation(const World& world, RunObserver& observer);

  RunResult run();

 private:
  void handle(int motion, const Incident& incident);
  void handle_event(int motion, const Incident& incident);
  void handle_contact(int motion, const Incident& incident);
  void handle_leave(int motion, const Incident& incident);
  void bounce(int motion, const Incident& incident, Impact impact);
  /// Whether a contact is the last one still, from which the body moves away by its law; then the motion goes on.
  bool goes_on_from_contact(int motion, const Incident& incident, const Impact& impact);

  /// Whether a body that has bounced will not fly any more, and for how long it still would.
  struct RestingTime {
    bool rests = false;
    double duration = 0.0;  ///< s
  };
  /// `is_hidden`: the flight to come does not show in the Segments.
  RestingTime resting_time(const Motion& motion, const Motion::Pair& pair, const Impact& impact,
                           const Eigen::VectorXd& q, bool is_hidden) const;
  /// A contact that has ended, and what is known of its pair after the next restart.
  struct Released {
    int pair;
    ContactMemory memory;
  };
  /// After an impact of a resting body that gave it state `q`: ends the rests from or into which it moves now, and
  /// takes out of its velocity what the others do not let pass.
  std::vector<Released> release_by_speed(Motion& motion, const World::Body& body, double t, Eigen::VectorXd& q);
  /// Ends the rests that would have to pull at the body.
  void release_by_force(Motion& motion, const World::Body& body, double t, const Eigen::VectorXd& q,
                        std::vector<Released>& released);
  /// Ends the rests that an event's `set`, from state `before` to `q`, has broken.
  std::vector<Released> release_after_set(Motion& motion, double t, const Eigen::VectorXd& before, Eigen::VectorXd& q);
  Released release(Motion& motion, int resting, double t, const Eigen::VectorXd& q);
  void end_rest(Motion& motion, int resting, double t);
  /// Reports the rests whose time has come.
  void record_rests_until(double time);
  /// Where a body slides off a face and another one goes on from there without a step, its rest on that one begins.
  std::optional<Released> rest_on_continuation(Motion& motion, const RestingContact& contact, double t,
                                               const Eigen::VectorXd& q);
  /// A contact that begins or ends without an impulse.
  Impact steady_contact(const Motion& motion, const RestingContact& contact, ImpactKind kind, double t,
                        const Eigen::VectorXd& q) const;
  void record_leave(const Motion& motion, const RestingContact& contact, double t, const Eigen::VectorXd& q);

  void advance(int motion);
  void record(const Impact& impact);
  /// Says that an impact of another pair may have been first as well.
  void warn_of_tie(const Impact& impact, const std::string& body, const std::string& with);
  /// The same for impacts that will not be handled, or handled otherwise, because `impact` was.
  void warn_of_hidden_ties(const Motion& motion, const Motion::Pair& handled, const Impact& impact);
  /// The other pairs of the same body whose contact cannot be told in time from that of pair `handled`.
  std::vector<int> met_at_once(const Motion& motion, int handled) const;
  /// Of a pair's contact and those at the same instant the one to handle first: a bounce, so that what else was touched
  /// counts once, on whichever side of it the body is then.
  int bounce_at_once(const Motion& motion, int handled) const;
  /// Of the contacts at the instant of a bounce those from which the body, then with dq/dt = `rate`, moves away
  /// already: it was there, and does not bounce again. Adds what is known of their pairs; returns whether one stops the
  /// run.
  bool take_turned_away(const Motion& motion, int handled, const Impact& impact, const Eigen::VectorXd& before,
                        const Eigen::VectorXd& rate, std::vector<Released>& known);
  void fail(double time, const std::string& reason);
  /// A motion whose state runs to infinity just at the end of the run has none there.
  void fail_if_blown_up();
  /// Ends the run at a time: the observer has asked for it.
  void interrupt(double time);
  /// The impact as it stands before the response.
  Impact describe(const Motion& motion, const Incident& incident, const Eigen::VectorXd& q) const;
  double mass(const World::Body& body, double t, const Eigen::VectorXd& q) const;

  /// Writes the regular samples behind the last one, up to `time`; may end the run in between.
  void sample_until(double time);
  void write_sample(double time);
  Sample sample_at(double time) const;

  Motion& motion(int index) { return *motions_[static_cast<std::size_t>(index)]; }
  const World::Body& body_of(const Motion::Pair& pair) const {
    return world_.bodies[static_cast<std::size_t>(pair.body)];
  }
  const World::Obstacle& obstacle_of(const Motion::Pair& pair) const {
    return world_.obstacles[static_cast<std::size_t>(pair.obstacle)];
  }

  /// A motion whose next incident is at `time`, or, before it first advances, the start.
  struct Pending {
    double order;  ///< (time - start) in the direction of the run
    int motion;
    bool operator>(const Pending& other) const {
      return order != other.order ? order > other.order : motion > other.motion;
    }
  };
  void enqueue(int motion);

  const World& world_;
  RunObserver& observer_;
  double direction_;
  std::vector<std::unique_ptr<Motion>> motions_;
  std::priority_queue<Pending, std::vector<Pending>, std::greater<>> queue_;
  RunResult result_;
  bool running_ = true;
  long step_count_ = 0;
  long next_sample_ = 0;
  double last_sample_ = std::numeric_limits<double>::quiet_NaN();
  /// How many impacts a body had at its last instant of impact.
  struct Impacts {
    double time = std::numeric_limits<double>::quiet_NaN();
    int count = 0;
  };
  std::vector<Impacts> last_impacts_;  // of each body
  /// A body that rests already; its last flights, which nobody can tell from contact, would be over at `time`.
  struct ComingRest {
    double time;
    const Motion* motion;
    int pair;
    double time_error_bound;
  };
  std::vector<ComingRest> coming_rests_;
};

}  // namespace trajet
