#include "contact_settling.hpp"

#include <cmath>

#include "body_state.hpp"
#include "sustained.hpp"

namespace trajet {
namespace {

/// A speed so small of those at a contact is none: far above rounding.
constexpr double kNone = 1e-12;

}  // namespace

std::vector<int> ContactSettling::own() const {
  std::vector<int> own;
  for (std::size_t i = 0; i < instant_.contacts.size(); ++i)
    if (instant_.contacts[i].body == body_) own.push_back(static_cast<int>(i));
  return own;
}

std::optional<BodyTerms<double>> ContactSettling::look() {
  auto terms =
      contact_terms(world_, instant_.course().group().law, instant_.contacts, body_, instant_.time(), instant_.q);
  if (!terms) return std::nullopt;
  const std::vector<int> own = this->own();
  const Vector3 position = instant_.q.segment<3>(body().offset);
  for (std::size_t i = 0; i < own.size(); ++i) {
    RestingContact& contact = instant_.contacts[static_cast<std::size_t>(own[i])];
    if (contact.is_plain) continue;
    contact.normal = terms->contacts[i].normal;
    contact.point = position + terms->contacts[i].arm;
  }
  return terms;
}

double ContactSettling::speed_scale(const ContactTerms<double>& at) const {
  const double turning = body().rotation ? angular_velocity(body(), instant_.q).norm() : 0.0;
  return instant_.q.segment<3>(body().offset + 3).norm() + bounding_radius(body().solid) * turning + at.slip.norm();
}

std::vector<ContactQuestion> ContactSettling::questions(const BodyTerms<double>& terms,
                                                        const std::vector<EndedMode>& ended) const {
  std::vector<ContactQuestion> questions;
  const std::vector<int> own = this->own();
  for (std::size_t i = 0; i < own.size(); ++i) {
    const RestingContact& contact = instant_.contacts[static_cast<std::size_t>(own[i])];
    const SustainedContact sustained = sustained_contact(world_, contact);
    ContactQuestion question{.friction = sustained.friction,
                             .turns = body().rotation && body().inertia && bounding_radius(body().solid) > 0.0,
                             .may_go_straight = contact.patch.is_flat() && !sustained.turns,
                             .before = contact.mode,
                             .speed = speed_scale(terms.contacts[i]),
                             .radius = bounding_radius(body().solid),
                             .time_scale = std::abs(world_.duration)};
    for (const EndedMode& each : ended)
      if (each.id == PairId{contact.body, contact.obstacle}) question.ended.push_back(each.end);
    questions.push_back(question);
  }
  return questions;
}

void ContactSettling::stop_held(const BodyTerms<double>& terms, const std::vector<ContactQuestion>& questions,
                                const std::vector<ContactMode>& modes) {
  std::vector<FrictionCoefficients> friction;
  for (const ContactQuestion& question : questions) friction.push_back(question.friction);
  const std::vector<ContactUnknown> unknowns = independent_unknowns(terms, modes, friction);
  const SustainedBody sustained = sustained_body(world_, body_);
  // the same of errors of the state, each a column: by what they are of the velocities
  const Matrix3 R = body().rotation ? body().rotation->layout.rotation(instant_.q.data() + body().rotation->offset)
                                    : Matrix3(Matrix3::Identity());
  for (Eigen::Index column = 0; column < instant_.derivative.cols(); ++column) {
    auto change = instant_.derivative.col(column);
    BodyTerms<double> of_change = terms;
    Vector3 turning = Vector3::Zero();
    if (body().rotation) {
      turning = change.segment<3>(body().slice().angular_velocity_index());
      if (body().rotation->layout.frame == Frame::body) turning = R * turning;
    }
    for (ContactTerms<double>& at : of_change.contacts) {
      at.slip = Vector3(change.segment<3>(body().offset + 3)) + turning.cross(at.arm);
      at.turning = turning;
    }
    Eigen::VectorXd changed = change;
    add_forces(sustained, of_change, contact_forces<double>(of_change, modes, friction, unknowns, true),
               instant_.q.data(), changed.data());
    change = changed;
  }
  add_forces(sustained, terms, contact_forces<double>(terms, modes, friction, unknowns, true), instant_.q.data(),
             instant_.q.data());
}

void ContactSettling::stand_still() {
  for (const int index : own()) {
    const RestingContact& contact = instant_.contacts[static_cast<std::size_t>(index)];
    const bool is_driven = world_.obstacles[static_cast<std::size_t>(contact.obstacle)].drive != nullptr;
    const bool is_still = contact.mode.slip.is_held() &&
                          (contact.mode.roll.is_held() || !body().rotation || bounding_radius(body().solid) == 0.0);
    if (is_still && !is_driven) instant_.q.segment<3>(body().offset + 3).setZero();
  }
}

std::string ContactSettling::settle(const std::vector<EndedMode>& ended, const Release& release) {
  while (true) {
    kinds_.clear();
    const std::vector<int> own = this->own();
    if (own.empty()) return "";
    std::optional<BodyTerms<double>> terms = look();
    if (!terms) return "the way in which a table enters a velocity has no derivative";
    const std::vector<ContactQuestion> asked = questions(*terms, ended);
    const std::vector<ContactMode> modes = modes_by_velocity(*terms, asked);
    stop_held(*terms, asked, modes);
    terms = look();
    const ContactDecision decision = decide_contacts(*terms, asked, modes);
    if (decision.pulling >= 0) {
      release(own[static_cast<std::size_t>(decision.pulling)]);
      continue;
    }
    if (!decision.failure.empty()) return decision.failure;
    for (std::size_t i = 0; i < own.size(); ++i) {
      RestingContact& contact = instant_.contacts[static_cast<std::size_t>(own[i])];
      contact.mode = decision.modes[i];
      contact.unknowns.clear();
      for (const ContactUnknown& each : decision.unknowns)
        if (each.contact == static_cast<int>(i)) contact.unknowns.push_back(each);
      const double force = terms->inverse_mass * decision.forces[i].force.norm();
      kinds_.push_back({{contact.body, contact.obstacle},
                        kind_of(contact, terms->contacts[i], rates_by(*terms, decision.forces)[i], force)});
    }
    stand_still();
    return "";
  }
}

ImpactKind ContactSettling::kind_of(const RestingContact& contact, const ContactTerms<double>& at,
                                    const ContactRates& by_forces, double force) const {
  const double speed = speed_scale(at);
  const auto along = [&](const Vector3& v) { return (v - v.dot(at.normal) * at.normal).norm(); };
  if (contact.mode.slip.is_moving()) return ImpactKind::slide;
  if (!contact.mode.slip.is_held()) {
    const bool slides = along(at.slip) > kNone * speed || along(at.slip_rate + by_forces.slip) > kNone * force;
    return slides ? ImpactKind::slide : ImpactKind::rest;
  }
  const double radius = bounding_radius(body().solid);
  if (!body().rotation || radius == 0.0 || contact.mode.roll.is_held()) return ImpactKind::rest;
  const bool turns =
      radius * along(at.turning) > kNone * speed || radius * along(at.turning_rate + by_forces.turning) > kNone * force;
  return turns ? ImpactKind::roll : ImpactKind::rest;
}

}  // namespace trajet
