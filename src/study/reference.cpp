#include "trajet/study/reference.hpp"

#include <algorithm>
#include <limits>

#include "trajet/text/shortest_text.hpp"

namespace trajet {
namespace {

ReferenceError not_finite(const std::string& name, double clock, const SourceLocation& where) {
  return ReferenceError(where, "the closed form of '" + name + "' is not finite at t = " + shortest_text(clock) + " s");
}

Quaternion evaluate(const World::ClosedRotation::Orientation& closed_form, Evaluator<double>& evaluator, double t) {
  double values[9];
  Vector3 axis;
  evaluator(t, nullptr, values);
  switch (closed_form.form) {
    case World::ClosedRotation::Form::axis_angle:
      axis = {values[0], values[1], values[2]};
      return from_axis_angle<double>(axis / axis.stableNorm(), values[3]);  // a vector of length 0 is no axis
    case World::ClosedRotation::Form::quaternion:
      return Quaternion(values[0], values[1], values[2], values[3]).normalized();
    case World::ClosedRotation::Form::matrix:
      break;
  }
  return from_rotation_matrix(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values));
}

}  // namespace

ClosedFormReference::ClosedFormReference(const World& world) : epoch_(world.epoch), closed_forms_(world.exact) {
  for (const World::Group& group : world.groups) sizes_.push_back(group.start.size());
  for (const World::ClosedForm& closed_form : closed_forms_) evaluators_.emplace_back(closed_form.value);
  for (const World::ClosedRotation& closed_form : world.exact_rotations) {
    const World::Body& body = world.bodies[static_cast<std::size_t>(closed_form.body)];
    rotations_.push_back({body.group, *body.rotation, body.name, closed_form});
  }
  for (Rotation& rotation : rotations_) {
    const World::ClosedRotation& closed_form = rotation.closed_form;
    if (closed_form.orientation) rotation.orientation.emplace(closed_form.orientation->value);
    if (closed_form.angular_velocity) rotation.angular_velocity.emplace(closed_form.angular_velocity->value);
  }
}

void ClosedFormReference::Rotation::write(double t, double epoch, Eigen::VectorXd& q) {
  const OrientationLayout& layout = place.layout;
  Quaternion q_WB = Quaternion::Identity();
  if (orientation) {
    q_WB = evaluate(*closed_form.orientation, *orientation, t);
    if (!q_WB.coeffs().allFinite()) throw not_finite(body + ".orientation", epoch + t, closed_form.orientation->where);
    layout.put(q_WB, q.data() + place.offset);
  }
  if (!angular_velocity) return;
  Vector3 w;
  (*angular_velocity)(t, nullptr, w.data());
  const World::ClosedRotation::AngularVelocity& given = *closed_form.angular_velocity;
  if (!w.allFinite()) throw not_finite(body + (given.frame == Frame::world ? ".w" : ".w_body"), epoch + t, given.where);
  if (given.frame != layout.frame) w = rotate<double>(given.frame == Frame::body ? q_WB : q_WB.conjugate(), w);
  q.segment<3>(place.offset + layout.size()) = w;
}

void ClosedFormReference::state(int group, double t, Eigen::VectorXd& q) {
  q.setConstant(sizes_[static_cast<std::size_t>(group)], std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < closed_forms_.size(); ++i) {
    const World::ClosedForm& closed_form = closed_forms_[i];
    if (closed_form.group != group) continue;
    const auto size = static_cast<Eigen::Index>(closed_form.value.outputs.size());
    evaluators_[i](t, nullptr, q.data() + closed_form.offset);
    if (!q.segment(closed_form.offset, size).allFinite())
      throw not_finite(closed_form.name, epoch_ + t, closed_form.where);
  }
  for (Rotation& rotation : rotations_)
    if (rotation.group == group) rotation.write(t, epoch_, q);
}

void RecordedReference::begin(const World& world) {
  direction_ = world.direction();
  end_ = 0.0;
  starts_.clear();
  for (const World::Group& group : world.groups) starts_.push_back(group.start);
  pieces_.assign(world.groups.size(), {});
}

void RecordedReference::motion(const MotionPiece& piece) {
  pieces_[static_cast<std::size_t>(piece.group)].push_back({piece.to, piece.segment});
  if (piece.group == 0) end_ = piece.to;
}

void RecordedReference::state(int group, double t, Eigen::VectorXd& q) {
  const std::vector<Piece>& pieces = pieces_[static_cast<std::size_t>(group)];
  if (pieces.empty()) {
    q = starts_[static_cast<std::size_t>(group)];
    return;
  }
  const auto ends_by = [this](double time, const Piece& piece) { return direction_ * (piece.to - time) > 0.0; };
  auto found = std::upper_bound(pieces.begin(), pieces.end(), t, ends_by);
  if (found == pieces.end()) --found;
  found->segment.evaluate(t, q);
}

}  // namespace trajet
