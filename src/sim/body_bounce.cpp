#include "body_bounce.hpp"

#include "body_state.hpp"
#include "impact_sides.hpp"
#include "trajet/collide/respond/frictional_impact.hpp"

namespace trajet {
namespace {

const World::Body& body_at(const World& world, int index) { return world.bodies[static_cast<std::size_t>(index)]; }

/// The states of two groups, one behind the other; of one group, its state.
class JointState {
 public:
  JointState(const Instant& first, const Instant& second) : is_one_(&first == &second), size_(first.q.size()) {}

  bool is_one() const { return is_one_; }
  Eigen::VectorXd of(const Eigen::VectorXd& first, const Eigen::VectorXd& second) const {
    if (is_one_) return first;
    Eigen::VectorXd joint(first.size() + second.size());
    joint << first, second;
    return joint;
  }
  Eigen::VectorXd first(const Eigen::VectorXd& joint) const { return joint.head(size_); }
  Eigen::VectorXd second(const Eigen::VectorXd& joint) const {
    return is_one_ ? joint : joint.tail(joint.size() - size_);
  }
  BodySlice second_slice(BodySlice slice) const {
    if (!is_one_) slice.first += static_cast<int>(size_);
    return slice;
  }

 private:
  bool is_one_;
  Eigen::Index size_;
};

/// Where the bodies touch, and along what, in states near that of the contact.
class TouchingPlace {
 public:
  TouchingPlace(const World& world, const Meeting& meeting, const Eigen::VectorXd& q, const BodySlice& slice_a,
                const BodySlice& slice_b)
      : a_(body_at(world, meeting.id.first)),
        b_(body_at(world, meeting.id.second)),
        slice_a_(slice_a),
        slice_b_(slice_b),
        are_round_(is_round(a_.solid) && is_round(b_.solid)),
        normal_(meeting.contact.normal) {
    if (are_round_) return;
    const auto& touched = *meeting.contact.touched;
    // a face has the normal, and what lies on it the point
    turns_with_a_ = touched.of_body == Feature::face && touched.of_obstacle != Feature::face;
    const Vector3& point = meeting.contact.point;
    const auto in_frame = [&](const World::Body& body, const BodySlice& slice, const Vector3& vector) {
      return Vector3(rotation_of(body, slice, q).transpose() * vector);
    };
    holder_ = turns_with_a_ ? in_frame(b_, slice_b_, point - Vector3(slice_b_.position(q)))
                            : in_frame(a_, slice_a_, point - Vector3(slice_a_.position(q)));
    const bool turns_with_b = touched.of_obstacle == Feature::face;
    normal_owner_ = turns_with_a_ ? &a_ : turns_with_b ? &b_ : nullptr;
    if (normal_owner_ != nullptr) normal_ = in_frame(*normal_owner_, turns_with_a_ ? slice_a_ : slice_b_, normal_);
  }

  Vector3 normal(const Eigen::VectorXd& q) const {
    if (are_round_) return (Vector3(slice_a_.position(q)) - Vector3(slice_b_.position(q))).normalized();
    if (normal_owner_ == nullptr) return normal_;
    return rotation_of(*normal_owner_, turns_with_a_ ? slice_a_ : slice_b_, q) * normal_;
  }
  Vector3 point(const Eigen::VectorXd& q) const {
    if (are_round_) return Vector3(slice_b_.position(q)) + bounding_radius(b_.solid) * normal(q);
    return turns_with_a_ ? Vector3(slice_b_.position(q)) + rotation_of(b_, slice_b_, q) * holder_
                         : Vector3(slice_a_.position(q)) + rotation_of(a_, slice_a_, q) * holder_;
  }

 private:
  const World::Body &a_, &b_;
  BodySlice slice_a_, slice_b_;
  bool are_round_;
  bool turns_with_a_ = false;
  Vector3 normal_;                    // in the frame of its owner; of none in the world
  Vector3 holder_ = Vector3::Zero();  // the point in the frame of the body that has it
  const World::Body* normal_owner_ = nullptr;
};

}  // namespace

GapMotion gap_motion(const World& world, const Meeting& meeting, const Eigen::VectorXd& q_first,
                     const Eigen::VectorXd& rate_first, const Eigen::VectorXd& q_second,
                     const Eigen::VectorXd& rate_second) {
  const World::Body &a = body_at(world, meeting.id.first), &b = body_at(world, meeting.id.second);
  const Vector3 &point = meeting.contact.point, &normal = meeting.contact.normal;
  if (is_round(a.solid) && is_round(b.solid)) {
    // of the centres: |d|'' = n . a + (v^2 - (n . v)^2) / |d|
    const Vector3 v = Vector3(a.slice().position(rate_first)) - Vector3(b.slice().position(rate_second));
    const Vector3 dv = Vector3(a.slice().velocity(rate_first)) - Vector3(b.slice().velocity(rate_second));
    const double speed = normal.dot(v);
    const double apart = bounding_radius(a.solid) + bounding_radius(b.solid);
    return {speed, normal.dot(dv) + (v - speed * normal).squaredNorm() / apart};
  }
  const MaterialMotion of_a = motion_at(a, q_first, rate_first, point),
                       of_b = motion_at(b, q_second, rate_second, point);
  return {normal.dot(of_a.velocity - of_b.velocity), normal.dot(of_a.acceleration - of_b.acceleration)};
}

double gap_error(const World& world, const Meeting& meeting, Course& first, Course& second) {
  const World::Body &a = body_at(world, meeting.id.first), &b = body_at(world, meeting.id.second);
  const double t = meeting.contact.time;
  const Vector3 &point = meeting.contact.point, &normal = meeting.contact.normal;
  const Eigen::VectorXd q_a = first.state(t), q_b = second.state(t);
  Eigen::VectorXd along_a = Eigen::VectorXd::Zero(q_a.size()), along_b = Eigen::VectorXd::Zero(q_b.size());
  add_gradient(a, a.slice(), q_a, point, normal, along_a);
  add_gradient(b, b.slice(), q_b, point, -normal, &first == &second ? along_a : along_b);
  const double own = first.error_bound_along(along_a, t);
  return &first == &second ? own : own + second.error_bound_along(along_b, t);
}

double bounce_bodies(const World& world, const Meeting& meeting, const Surface& surface, double restitution,
                     const Eigen::MatrixXd& errors_first, const Eigen::MatrixXd& errors_second, Instant& first,
                     Instant& second, Impact& impact) {
  const World::Body &a = body_at(world, meeting.id.first), &b = body_at(world, meeting.id.second);
  const JointState joint(first, second);
  const BodySlice slice_a = a.slice(), slice_b = joint.second_slice(b.slice());
  const ImpactFriction friction = friction_of(surface);
  const double mass_a = mass_in_meetings(world, meeting.id.first, first),
               mass_b = mass_in_meetings(world, meeting.id.second, second);
  const Eigen::VectorXd before = joint.of(first.before(), second.before());
  const Eigen::VectorXd rate = joint.of(first.rate(), second.rate());
  const TouchingPlace place(world, meeting, before, slice_a, slice_b);
  const Vector3 drift_a = Vector3(slice_a.position(rate)) - Vector3(slice_a.velocity(before));  // dr/dt - v
  const Vector3 drift_b = Vector3(slice_b.position(rate)) - Vector3(slice_b.velocity(before));

  // what becomes of states near these that are in the same contact, at a fixed time
  const auto respond = [&](const Eigen::VectorXd& q, Eigen::VectorXd& result) {
    const Vector3 point = place.point(q);
    const ImpactSide side_a = impact_side(a, slice_a, q, Vector3(slice_a.velocity(q)) + drift_a, mass_a, point);
    const ImpactSide side_b = impact_side(b, slice_b, q, Vector3(slice_b.velocity(q)) + drift_b, mass_b, point);
    const FrictionalImpact hit = frictional_impact(side_a, side_b, place.normal(q), restitution, friction);
    ImpactSide after_a = side_a, after_b = side_b;
    after_a.take(hit.impulse);
    after_b.take(-hit.impulse);
    result = q;
    put(a, slice_a, side_a, after_a, result);
    put(b, slice_b, side_b, after_b, result);
    return hit;
  };
  Eigen::VectorXd after;
  const FrictionalImpact hit = respond(before, after);
  impact.impulse = hit.impulse;
  first.q = joint.first(after);
  second.q = joint.second(after);
  impact.velocity_after = slice_a.velocity(after);
  impact.angular_velocity_after = angular_velocity(a, first.q);
  impact.partner->velocity_after = slice_b.velocity(after);
  impact.partner->angular_velocity_after = angular_velocity(b, second.q);

  Eigen::MatrixXd derivative = Eigen::MatrixXd::Identity(before.size(), before.size());
  Eigen::VectorXd moved, result;
  for (const BodySlice& slice : {slice_a, slice_b})
    for (int i = slice.first; i < slice.first + slice.size(); ++i) {
      const double part = small_part(before[i]);
      Eigen::VectorXd change = Eigen::VectorXd::Zero(before.size());
      for (const double sign : {1.0, -1.0}) {
        moved = before;
        moved[i] += sign * part;
        respond(moved, result);
        change += sign / (2.0 * part) * result;
      }
      derivative.col(i) = change;
    }
  // states near these have their contact at a time of their own: dt* = -dg / g'
  const double speed =
      gap_motion(world, meeting, first.before(), joint.first(rate), second.before(), joint.second(rate)).speed;
  if (speed < 0.0) {
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(before.size());
    add_gradient(a, slice_a, before, meeting.contact.point, meeting.contact.normal, gradient);
    add_gradient(b, slice_b, before, meeting.contact.point, -meeting.contact.normal, gradient);
    derivative += (derivative * rate - joint.of(first.rate(), second.rate())) * (-gradient.transpose() / speed);
  }
  if (joint.is_one()) {
    first.derivative = derivative;
    return hit.energy_gained;
  }
  const Eigen::Index n = first.q.size(), m = second.q.size();
  first.derivative = derivative.topLeftCorner(n, n);
  second.derivative = derivative.bottomRightCorner(m, m);
  first.further_errors = derivative.topRightCorner(n, m) * errors_second;
  second.further_errors = derivative.bottomLeftCorner(m, n) * errors_first;
  return hit.energy_gained;
}

}  // namespace trajet
