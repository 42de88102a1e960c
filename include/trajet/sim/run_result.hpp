#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trajet/collide/detect/contact.hpp"
#include "trajet/math/vector.hpp"
#include "trajet/ode/stepper.hpp"
#include "trajet/scene/named_value.hpp"

namespace trajet {

enum class RunStatus {
  finished,     ///< reached the end time
  stopped,      ///< an obstacle or an event stopped it
  failed,       ///< the numbers failed: `failure` says where and why
  interrupted,  ///< asked to stop from outside
};

enum class ImpactKind {
  hit,    ///< touches and crosses, or bounces
  graze,  ///< touches without crossing
  rest,   ///< bouncing has ended: the body stays in contact
  slide,  ///< it stays in contact and slides, against friction
  roll,   ///< it stays in contact and rolls without slip
  leave,  ///< contact ends
  stick,  ///< it stays where it has hit, and moves as that does
};

/// A contact that lasts, in one way.
struct ContactSpan {
  double from = 0.0;           ///< s, of the scene's clock
  std::optional<double> to{};  ///< none: it lasts at the end of the run
  std::string body;
  std::string with;                    ///< an obstacle
  ImpactKind mode = ImpactKind::rest;  ///< rest, slide, roll or stick
};

/// The motion of the other body of an impact of two. World frame, SI units.
struct ImpactPartner {
  Vector3 velocity_before;
  Vector3 velocity_after;
  Vector3 angular_velocity_before = Vector3::Zero();
  Vector3 angular_velocity_after = Vector3::Zero();
};

/// A body met an obstacle or another body. World frame, SI units.
struct Impact {
  double time = 0.0;     ///< s, of the scene's clock
  double elapsed = 0.0;  ///< s since the start: with all digits where the clock has no room for them
  std::string body;
  std::string with;  ///< an obstacle or a body
  ImpactKind kind = ImpactKind::hit;
  Vector3 point;     ///< of contact, on what was met
  Vector3 normal;    ///< unit, of what was met at the point, towards the body's side before the impact
  Vector3 position;  ///< of the body's centre of mass
  Vector3 velocity_before;
  Vector3 velocity_after;
  Vector3 angular_velocity_before = Vector3::Zero();
  Vector3 angular_velocity_after = Vector3::Zero();
  Vector3 impulse;                           ///< on the body; per mass where it has none: m/s, else N s
  double time_error_bound = 0.0;             ///< s
  std::optional<TouchedFeatures> touched{};  ///< of a hit or a graze: what touched; `point` is in the middle
  std::optional<ImpactPartner> partner{};    ///< where a body was met
  std::optional<int> group{};                ///< one number for the impacts that were resolved together
};

/// A `when` crossed zero, or a law that switches at a zero of the state `sticks` there or `slips` off it.
struct EventRecord {
  double time = 0.0;     ///< s, of the scene's clock
  double elapsed = 0.0;  ///< s since the start
  std::string event;     ///< its name; `sticks` or `slips`
  int direction = 0;     ///< +1 rising, -1 falling: of what decides the law, where that sticks or slips
  std::string law{};     ///< that sticks or slips: "acceleration of body 'block'"
};

/// A contact of which it could not be decided whether it happens, or when.
struct UnresolvedContact {
  double time = 0.0;  ///< s, of the scene's clock: from where on nothing is known
  std::string body;
  std::string with;
  std::string why;
};

/// A named point of a body. World frame, SI units.
struct PointState {
  std::string point;
  Vector3 position;
  Vector3 velocity;
  Vector3 acceleration;
};

/// World frame W, body frame B, SI units.
struct BodyState {
  std::string body;
  Vector3 position;  ///< of the centre of mass
  Vector3 velocity;
  Vector3 acceleration;
  bool turns = false;                          ///< it has an angular velocity, which may be 0
  Quaternion orientation{1.0, 0.0, 0.0, 0.0};  ///< q_WB, as carried: unit, unless the way of carrying it lets it drift
  Matrix3 rotation_matrix = Matrix3::Identity();  ///< R_WB, as carried: it may stretch where the way lets it
  Vector3 angular_velocity = Vector3::Zero();
  std::vector<PointState> points;
  /// Estimated, m and m/s: how far position and velocity may be off. Of the final state only.
  std::optional<double> position_error_bound{}, velocity_error_bound{};
};

/// Of the two samples at the time of an impact, or of the end of a lasting contact, which one.
enum class SamplePhase { none, before, after };

/// Bodies and extra states at one time. An impact has two, of the body concerned: before and after it.
struct Sample {
  double time = 0.0;     ///< s, of the scene's clock
  double elapsed = 0.0;  ///< s since the start
  SamplePhase phase = SamplePhase::none;
  std::vector<BodyState> bodies;
  std::vector<NamedValue> states;
};

struct RunStatistics : StepStatistics {
  long contact_searches = 0;  ///< of one pair on a Segment or a part of one
  double wall_seconds = 0.0;
};

struct RunResult {
  std::string scene;  ///< file name
  std::string title;
  std::string method;  ///< canonical name
  RunStatus status = RunStatus::finished;
  std::string failure;      ///< where and why, if `status` is failed
  double start_time = 0.0;  ///< s, of the scene's clock
  double end_time = 0.0;
  double elapsed = 0.0;  ///< s from the start to the end; negative backward in time
  std::vector<NamedValue> parameters;
  std::vector<Impact> impacts;        ///< none where an observer has taken the records
  std::vector<EventRecord> events;    ///< likewise
  std::vector<ContactSpan> contacts;  ///< those that last, in the order of their beginnings
  /// If empty, no impact is missing between the start and the end.
  std::vector<UnresolvedContact> unresolved;
  Sample final;
  std::vector<std::string> warnings;
  RunStatistics statistics;
};

}  // namespace trajet
