#include "contact_builder.hpp"

#include <array>
#include <cmath>

#include "trajet/rigid/kinematics.hpp"

namespace trajet::detail {
namespace {

/// A direction far from that one.
Vector3 direction_across(const Vector3& normal) {
  int least = 0;
  normal.cwiseAbs().minCoeff(&least);
  return normal.cross(Vector3::Unit(least)).normalized();
}

}  // namespace

ContactBuilder::ContactBuilder(ProgramBuilder& builder, const Program& law, const SustainedBody& body,
                               const std::vector<SustainedContact>& contacts)
    : builder_(builder), body_(body), contacts_(contacts) {
  of_inputs_.push_back(builder.constant_node({1.0}));
  for (std::size_t i = 0; i < law.outputs.size(); ++i)
    of_inputs_.push_back(builder.output_of_base(static_cast<int>(i)));
  position_ = inputs(1 + body.offset);
  for (int i = 0; i < 3; ++i) velocity_[i] = {builder, of_inputs_[static_cast<std::size_t>(1 + body.offset + i)]};
  terms_.inverse_mass = ProgramNumber(1.0);
  if (body.mass) terms_.inverse_mass = ProgramNumber(1.0) / ProgramNumber(builder, builder.insert(*body.mass).front());
  terms_.inverse_inertia.setConstant(ProgramNumber(0.0));
  w_.setConstant(ProgramNumber(0.0));
  R_WB_ = body.R_WB.cast<ProgramNumber>();
  if (body.layout) {
    std::vector<ProgramNumber> numbers;
    for (int i = 0; i < body.layout->size(); ++i) numbers.emplace_back(builder, 1 + body.rotation_offset + i);
    R_WB_ = body.layout->rotation(numbers.data());
    const Vector w = inputs(1 + body.rotation_offset + body.layout->size());
    w_ = body.layout->frame == trajet::Frame::world ? w : Vector(R_WB_ * w);
    if (body.inertia) {
      const double first = (*body.inertia)(0, 0);
      if (*body.inertia == first * Matrix3::Identity()) {
        for (int i = 0; i < 3; ++i) terms_.inverse_inertia(i, i) = ProgramNumber(1.0 / first);
      } else {
        terms_.inverse_inertia = R_WB_ * body.inertia->inverse().cast<ProgramNumber>() * R_WB_.transpose();
      }
    }
  }
  terms_.contacts = contact_points(contacts);
  for (const SustainedContact& contact : contacts) add_contact(contact);
}

ContactBuilder::Vector ContactBuilder::inputs(int first) {
  return {ProgramNumber(builder_, first), ProgramNumber(builder_, first + 1), ProgramNumber(builder_, first + 2)};
}

ProgramNumber ContactBuilder::rate_of(const ProgramNumber& number) {
  const std::optional<int> rate = builder_.derivative(number.node(builder_), of_inputs_);
  has_derivatives_ = has_derivatives_ && rate.has_value();
  return rate ? ProgramNumber(builder_, *rate) : ProgramNumber(0.0);
}

ContactBuilder::Vector ContactBuilder::rate_of(const Vector& vector) {
  return {rate_of(vector[0]), rate_of(vector[1]), rate_of(vector[2])};
}

ContactBuilder::Frame ContactBuilder::frame_of(const SustainedContact& contact) {
  if (!contact.pose) return {contact.pivot.cast<ProgramNumber>(), Matrix3::Identity().cast<ProgramNumber>()};
  const std::vector<int> pose = builder_.insert(*contact.pose);
  const auto number = [&](std::size_t i) { return ProgramNumber(builder_, pose[i]); };
  const QuaternionT<ProgramNumber> q(number(3), number(4), number(5), number(6));
  return {{number(0), number(1), number(2)}, rotation_matrix(q)};
}

ContactBuilder::Vector ContactBuilder::seen_by(const SustainedContact& contact, const Frame& frame,
                                               const Vector& place) const {
  if (!contact.pose) return place;
  return contact.pivot.cast<ProgramNumber>() + frame.R.transpose() * (place - frame.place);
}

ContactBuilder::Vector ContactBuilder::arm_of(const SupportCorner& corner, const Vector& normal) const {
  Vector arm = normal * ProgramNumber(-corner.rounding);
  if (corner.is_ball()) return arm;
  Vector p_B = corner.p_B.cast<ProgramNumber>();
  if (corner.is_spread()) {
    // the point of {E y} farthest down: E E^T m / |E^T m|, m the direction down in the body
    const Matrix E = corner.spread.cast<ProgramNumber>();
    const Vector down = R_WB_.transpose() * Vector(-normal);
    const Vector pulled = E.transpose() * down;
    p_B += E * pulled * (ProgramNumber(1.0) / sqrt(pulled.dot(pulled)));
  }
  return arm + R_WB_ * p_B;
}

void ContactBuilder::add_contact(const SustainedContact& contact) {
  const Frame frame = frame_of(contact);
  const Vector normal_at_start = normal_of<ProgramNumber>(contact.patch, seen_by(contact, frame, position_));
  ContactTerms<ProgramNumber> at;
  at.normal = contact.pose ? Vector(frame.R * normal_at_start) : normal_at_start;
  at.normal_rate = rate_of(at.normal);
  const Vector3 across = direction_across(contact.patch.axis);
  if (contact.patch.is_flat()) {
    at.tangents[0] = frame.R * across.cast<ProgramNumber>();
    at.tangents[1] = frame.R * contact.patch.axis.cross(across).cast<ProgramNumber>();
  } else {
    const Vector first = at.normal.cross(Vector(frame.R * across.cast<ProgramNumber>()));
    at.tangents[0] = first * (ProgramNumber(1.0) / sqrt(first.dot(first)));
    at.tangents[1] = at.normal.cross(at.tangents[0]);
  }
  for (int i = 0; i < 2; ++i) at.tangent_rates[i] = rate_of(at.tangents[i]);
  Vector place_rate, surface_turning;
  place_rate.setConstant(ProgramNumber(0.0));
  surface_turning.setConstant(ProgramNumber(0.0));
  if (contact.pose) {
    // of what is fixed in the obstacle: v = v_D + w_D x (p - p_D), w_D~ = dR/dt R^T
    Matrix R_rate;
    for (int i = 0; i < 9; ++i) R_rate(i / 3, i % 3) = rate_of(frame.R(i / 3, i % 3));
    const Matrix w_cross = R_rate * frame.R.transpose();
    surface_turning = {w_cross(2, 1), w_cross(0, 2), w_cross(1, 0)};
    place_rate = rate_of(frame.place);
  }
  at.turning = w_ - surface_turning;
  at.turning_rate = rate_of(at.turning);
  for (const SupportCorner& corner : contact.corners) {
    at.arm = arm_of(corner, at.normal);
    Vector surface_velocity = place_rate;
    if (contact.pose) surface_velocity += surface_turning.cross(Vector(position_ + at.arm - frame.place));
    at.slip = velocity_ + w_.cross(at.arm) - surface_velocity;
    at.slip_rate = rate_of(at.slip);
    terms_.points.push_back(at);
  }
}

ProgramNumber ContactBuilder::height(std::size_t index, const SupportCorner& corner) {
  const SustainedContact& contact = contacts_[index];
  const Frame frame = frame_of(contact);
  const Vector3& axis = contact.patch.axis;
  const Vector normal = contact.pose ? Vector(frame.R * axis.cast<ProgramNumber>()) : axis.cast<ProgramNumber>().eval();
  const Vector place = seen_by(contact, frame, position_ + arm_of(corner, normal));
  return axis.cast<ProgramNumber>().dot(place) - ProgramNumber(axis.dot(contact.patch.center));
}

std::vector<int> ContactBuilder::rates_with(const std::vector<ContactForce<ProgramNumber>>& forces) {
  std::vector<ProgramNumber> rates;
  for (std::size_t i = 1; i < of_inputs_.size(); ++i) rates.emplace_back(builder_, of_inputs_[i]);
  Vector force, moment;
  force.setConstant(ProgramNumber(0.0));
  moment.setConstant(ProgramNumber(0.0));
  for (const ContactForce<ProgramNumber>& each : forces) {
    force += each.force;
    moment += each.moment;
  }
  const auto add = [&](int first, const Vector& change) {
    for (int i = 0; i < 3; ++i) rates[static_cast<std::size_t>(first + i)] += change[i];
  };
  add(body_.offset + 3, force * terms_.inverse_mass);
  if (body_.layout && body_.inertia) {
    Vector turning = terms_.inverse_inertia * moment;
    if (body_.layout->frame == trajet::Frame::body) turning = Vector(R_WB_.transpose() * turning);
    add(body_.rotation_offset + body_.layout->size(), turning);
  }
  std::vector<int> nodes;
  for (const ProgramNumber& rate : rates) nodes.push_back(rate.node(builder_));
  return nodes;
}

std::vector<ProgramNumber> ContactBuilder::past_edges(std::size_t index) {
  const SustainedContact& contact = contacts_[index];
  const Frame frame = frame_of(contact);
  std::vector<ProgramNumber> past;
  const auto add = [&](const Vector& place) {
    for (const FaceEdge& edge : contact.patch.edges)
      past.push_back(edge.direction.cast<ProgramNumber>().dot(place) - ProgramNumber(edge.limit));
    const auto beyond = [&](const FaceRim& rim, double sign) {
      const Vector arm = place - rim.center.cast<ProgramNumber>();
      const ProgramNumber height = rim.normal.cast<ProgramNumber>().dot(arm);
      past.push_back(ProgramNumber(sign) * (arm.dot(arm) - height * height - ProgramNumber(rim.radius * rim.radius)));
    };
    if (contact.patch.outer_rim) beyond(*contact.patch.outer_rim, 1.0);
    if (contact.patch.inner_rim) beyond(*contact.patch.inner_rim, -1.0);
  };
  if (contact.corners.front().is_ball()) {
    add(seen_by(contact, frame, position_));
  } else {
    std::size_t first = 0;
    for (std::size_t i = 0; i < index; ++i) first += contacts_[i].corners.size();
    for (std::size_t i = 0; i < contact.corners.size(); ++i)
      add(seen_by(contact, frame, position_ + terms_.points[first + i].arm));
  }
  return past;
}

}  // namespace trajet::detail
