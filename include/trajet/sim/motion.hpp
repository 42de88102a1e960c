#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trajet/scene/scene.hpp"
#include "trajet/sim/motion_record.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

struct World;
class BodyMotion;
class StateMotion;

/// The motion of a scene as a function of time: what a run has found, and where everything was in between.
///
/// Times are those of the scene's clock, s, from `start_time()` to `end_time()` (which is the earlier one in a run
/// backward in time), single or many, in any order. What lies outside throws std::out_of_range; a name that the scene
/// does not have throws std::invalid_argument, with the nearest one. World frame W, SI units.
///
/// Where the motion jumps, at an impact or an event that sets something, the answer is the one behind the jump, as the
/// run goes on from there: `impacts()` have both sides. The answers are read from the run's own Segments, nothing is
/// integrated again; at `end_time()` they are those of `final()`. With a start of the clock far from 0 a time has fewer
/// digits than the motion.
///
/// A name is looked up at each question: loops over many times ask a handle, `body("ball")`, or hand all times over at
/// once. Copies share what they hold, which never changes: any number of threads may read it.
class [[nodiscard]] Motion {
 public:
  /// `record` has heard all of a run, of which `result` is the result.
  Motion(MotionRecord record, RunResult result);

  RunStatus status() const { return result().status; }
  /// Whether the run has come to its end or to what was to stop it.
  bool ok() const { return status() == RunStatus::finished || status() == RunStatus::stopped; }
  const std::vector<Impact>& impacts() const& { return result().impacts; }
  const std::vector<EventRecord>& events() const& { return result().events; }
  const std::vector<ContactSpan>& contacts() const& { return result().contacts; }
  const std::vector<std::string>& warnings() const& { return result().warnings; }
  /// All bodies and extra states at the end, with what their error may be.
  const Sample& final() const& { return result().final; }
  // Of a motion that is gone behind the expression, copies: `for (… : compute_motion(scene).impacts())` is safe.
  std::vector<Impact> impacts() && { return result().impacts; }
  std::vector<EventRecord> events() && { return result().events; }
  std::vector<ContactSpan> contacts() && { return result().contacts; }
  std::vector<std::string> warnings() && { return result().warnings; }
  Sample final() && { return result().final; }
  double start_time() const { return result().start_time; }
  double end_time() const { return result().end_time; }
  /// All that a report has.
  const RunResult& result() const;
  /// What moved, and the Segments of its way.
  const MotionRecord& record() const;
  const World& world() const { return record().world(); }

  /// The motion of a body, to ask it often.
  BodyMotion body(std::string_view name) const;
  /// The same of an extra state.
  StateMotion extra_state(std::string_view name) const;

  /// p_WB of a body's centre of mass, m.
  Vector3 position(std::string_view body, double t) const;
  /// v_WB, m/s.
  Vector3 velocity(std::string_view body, double t) const;
  /// q_WB: (w, x, y, z), unit unless the way of carrying orientations lets it drift.
  Quaternion orientation(std::string_view body, double t) const;
  /// w_WB in the world's frame, rad/s; 0 of what does not turn.
  Vector3 angular_velocity(std::string_view body, double t) const;
  /// All that a report says of a body, its named points too. Accelerations are the derivatives of the Segments.
  BodyState state(std::string_view body, double t) const;
  /// An extra state, in its unit.
  double value(std::string_view extra_state, double t) const;
  /// Everything.
  Sample state(double t) const;

  // The same at many times: column i belongs to times[i].
  Eigen::Matrix3Xd position(std::string_view body, std::span<const double> times) const;
  Eigen::Matrix3Xd velocity(std::string_view body, std::span<const double> times) const;
  Eigen::Matrix4Xd orientation(std::string_view body, std::span<const double> times) const;
  Eigen::Matrix3Xd angular_velocity(std::string_view body, std::span<const double> times) const;
  Eigen::VectorXd value(std::string_view extra_state, std::span<const double> times) const;

 private:
  friend class BodyMotion;
  friend class StateMotion;
  struct Data;
  std::shared_ptr<const Data> data_;
};

/// One body of a Motion: a handle for loops. It keeps the motion alive.
class BodyMotion {
 public:
  const std::string& name() const;

  // As those of Motion.
  Vector3 position(double t) const;
  Vector3 velocity(double t) const;
  Quaternion orientation(double t) const;
  Vector3 angular_velocity(double t) const;
  BodyState state(double t) const;

  // The same into memory of the caller: column i belongs to times[i], and there are as many.
  void position(std::span<const double> times, Eigen::Ref<Eigen::Matrix3Xd> p_WB) const;
  void velocity(std::span<const double> times, Eigen::Ref<Eigen::Matrix3Xd> v_WB) const;
  void orientation(std::span<const double> times, Eigen::Ref<Eigen::Matrix4Xd> q_WB) const;
  void angular_velocity(std::span<const double> times, Eigen::Ref<Eigen::Matrix3Xd> w_WB) const;

 private:
  friend class Motion;
  BodyMotion(std::shared_ptr<const Motion::Data> data, int body) : data_(std::move(data)), body_(body) {}

  std::shared_ptr<const Motion::Data> data_;
  int body_;  // in World::bodies
};

/// One extra state of a Motion, likewise.
class StateMotion {
 public:
  const std::string& name() const;
  double value(double t) const;
  void value(std::span<const double> times, Eigen::Ref<Eigen::VectorXd> values) const;

 private:
  friend class Motion;
  StateMotion(std::shared_ptr<const Motion::Data> data, int state) : data_(std::move(data)), state_(state) {}

  std::shared_ptr<const Motion::Data> data_;
  int state_;  // in World::states
};

/// Computes the motion of a scene and keeps all of it. Throws InputError where the scene is wrong; numerical failure is
/// a status of the motion. An observer hears of the run beside it; where it takes the records, the motion has none.
Motion compute_motion(const Scene& scene, RunObserver* observer = nullptr);
/// The same for a scene that has its numbers already.
Motion compute_motion(const World& world, RunObserver* observer = nullptr);

/// What has become of a motion, in lines for people: its status, where it ends, its impacts and events.
std::string to_string(const Motion& motion);

}  // namespace trajet
