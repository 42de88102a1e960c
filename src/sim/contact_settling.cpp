#include "contact_settling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "body_state.hpp"
#include "solid_contact.hpp"
#include "sustained.hpp"
#include "trajet/collide/sustain/rest.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

/// A speed so small of those at a contact is none: far above rounding.
constexpr double kNone = 1e-12;

/// Of the places of corners.
constexpr double kRoundings = 16.0;

/// Whether a contact that would have to pull at that side does so as a whole.
bool departs(const ContactPoints& contact, int side) { return contact.is_one() || (contact.is_rim && side == 0); }

/// The points on which it goes on else.
std::vector<int> remaining(const ContactPoints& contact, int side) {
  return contact.is_rim ? std::vector<int>() : contact.remaining[static_cast<std::size_t>(side)];
}

}  // namespace

void narrow(RestingContact& contact, const std::vector<int>& remaining) {
  std::vector<int> corners;
  for (const int each : remaining) corners.push_back(contact.corners[static_cast<std::size_t>(each)]);
  ranges::sort(corners);
  contact.corners = std::move(corners);
}

void ContactSettling::leave_out(RestingContact& contact, const std::vector<int>& remaining) {
  tips_over_rim_ = tips_over_rim_ || contact.is_on_rim;
  if (!contact.is_on_rim) narrow(contact, remaining);
}

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
    const std::vector<int>& points = terms->contacts[i].points;
    Vector3 arm = Vector3::Zero();
    for (const int point : points) arm += terms->points[static_cast<std::size_t>(point)].arm;
    contact.normal = terms->points[static_cast<std::size_t>(points[0])].normal;
    contact.point = position + arm / static_cast<double>(points.size());
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
    const bool turns = body().rotation && body().inertia && bounding_radius(body().solid) > 0.0;
    // what turns about corners that slide does not go straight on but by symmetry, which nothing shows cheaply
    const bool is_of_corners = turns && contact.core && contact.corners.size() < 3;
    ContactQuestion question{.friction = sustained.friction,
                             .turns = turns,
                             .may_go_straight = contact.patch.is_flat() && !sustained.turns && !is_of_corners,
                             .is_of_corners = is_of_corners,
                             .before = contact.mode,
                             .speed = speed_scale(terms.points[static_cast<std::size_t>(terms.contacts[i].points[0])]),
                             .radius = bounding_radius(body().solid),
                             .time_scale = std::abs(world_.duration)};
    for (const EndedMode& each : ended)
      if (each.id == PairId{contact.body, contact.obstacle}) question.ended.push_back(each.end);
    questions.push_back(question);
  }
  return questions;
}

void ContactSettling::apply(const BodyTerms<double>& terms, const std::vector<ContactQuestion>& questions,
                            const std::vector<ContactMode>& modes, const std::vector<ContactUnknown>& unknowns) {
  std::vector<FrictionCoefficients> friction;
  for (const ContactQuestion& question : questions) friction.push_back(question.friction);
  const SustainedBody sustained = sustained_body(world_, body_);
  const auto add_impulses = [&](const BodyTerms<double>& of, double* changed) {
    auto impulses = contact_forces<double>(terms, modes, friction, unknowns, &of);
    for (std::size_t c = 0; restitution_ > 0.0 && c < impulses.size(); ++c)
      for (std::size_t i = 0; i < impulses[c].shares.size(); ++i) {
        const ContactTerms<double>& at = of.points[static_cast<std::size_t>(of.contacts[c].points[i])];
        const Vector3 more = restitution_ * impulses[c].shares[i] * at.normal;
        impulses[c].force += more;
        impulses[c].moment += at.arm.cross(more);
      }
    add_forces(sustained, of, impulses, instant_.q.data(), changed);
  };
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
    for (ContactTerms<double>& at : of_change.points) {
      at.slip = Vector3(change.segment<3>(body().offset + 3)) + turning.cross(at.arm);
      at.turning = turning;
    }
    Eigen::VectorXd changed = change;
    add_impulses(of_change, changed.data());
    change = changed;
  }
  add_impulses(terms, instant_.q.data());
}

bool ContactSettling::stop(const BodyTerms<double>& terms, const std::vector<ContactQuestion>& questions,
                           const std::vector<ContactMode>& modes, std::string& failure) {
  // what comes to the surface hits it; what is too slow for a flight that anybody could see is stopped
  bool hits = false;
  for (std::size_t c = 0; c < modes.size(); ++c) {
    const bool has_corners = contact(own()[c]).core != nullptr;
    const double scale = std::max({questions[c].speed, modes[c].slip.scale, questions[c].before.slip.scale});
    const std::vector<double> heights = heights_of(own()[c]);
    for (std::size_t i = 0; has_corners && i < heights.size(); ++i) {
      const ContactTerms<double>& at = terms.points[static_cast<std::size_t>(terms.contacts[c].points[i])];
      hits = hits || (std::abs(at.normal.dot(at.slip)) > kNone * scale && !is_slow(at, heights[i]));
    }
  }
  if (!hits) {
    std::vector<FrictionCoefficients> friction;
    for (const ContactQuestion& question : questions) friction.push_back(question.friction);
    apply(terms, questions, modes, independent_unknowns(terms, modes, friction));
    return true;
  }
  const ContactDecision decision = decide_contacts(terms, questions, modes, true);
  if (decision.pulling >= 0) {
    const auto pulling = static_cast<std::size_t>(decision.pulling);
    if (departs(terms.contacts[pulling], decision.pulled_side)) return true;
    leave_out(contact(own()[pulling]), remaining(terms.contacts[pulling], decision.pulled_side));
    return false;
  }
  failure = decision.failure;
  if (failure.empty()) apply(terms, questions, decision.modes, decision.unknowns);
  return true;
}

std::vector<double> ContactSettling::heights_of(int index) {
  const RestingContact& one = contact(index);
  if (!one.core) return {};
  const std::vector<double> all =
      heights_of_corners(world_, one, encounters_.frame(one.obstacle, instant_.time()), instant_.q);
  std::vector<double> heights;
  for (const int corner : one.corners) heights.push_back(all[static_cast<std::size_t>(corner)]);
  return heights;
}

bool ContactSettling::has_sunk() {
  constexpr double kSunk = 1e-6;  // of the size
  return ranges::any_of(own(), [&](int index) {
    const RestingContact& one = contact(index);
    if (!one.core) return false;
    const auto heights = heights_of_corners(world_, one, encounters_.frame(one.obstacle, instant_.time()), instant_.q);
    return ranges::any_of(heights, [&](double height) { return height < -kSunk * one.core->reach; });
  });
}

bool ContactSettling::is_slow(const ContactTerms<double>& at, double height) const {
  const double reach = instant_.q.segment<3>(body().offset).norm() + bounding_radius(body().solid);
  const double pull = -(at.normal.dot(at.slip_rate) + at.normal_rate.dot(at.slip));
  const double speed = at.normal.dot(at.slip);
  // a flight must clear what the corner has sunk by rounding
  constexpr double kClear = 4.0;
  return is_below_flight(speed, std::max(0.0, pull), kRoundings * kUnitRoundoff * reach) ||
         (height < 0.0 && speed * speed <= -2.0 * kClear * height * std::max(0.0, pull));
}

bool ContactSettling::are_closing(const BodyTerms<double>& terms) {
  const std::vector<int> own = this->own();
  for (std::size_t c = 0; c < own.size(); ++c) {
    if (!contact(own[c]).core) continue;
    const std::vector<double> heights = heights_of(own[c]);
    for (std::size_t i = 0; i < heights.size(); ++i) {
      const ContactTerms<double>& at = terms.points[static_cast<std::size_t>(terms.contacts[c].points[i])];
      if (at.normal.dot(at.slip) < -kNone * speed_scale(at) && !is_slow(at, heights[i])) return true;
    }
  }
  return false;
}

bool ContactSettling::keep_touching(const BodyTerms<double>& terms, int& gone) {
  const std::vector<int> own = this->own();
  for (std::size_t c = 0; c < own.size(); ++c) {
    if (!contact(own[c]).core) continue;
    std::vector<int> touching;
    const std::vector<double> heights = heights_of(own[c]);
    const std::vector<int>& points = terms.contacts[c].points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const ContactTerms<double>& at = terms.points[static_cast<std::size_t>(points[i])];
      const double speed = at.normal.dot(at.slip);
      const bool departs = speed > kNone * speed_scale(at) && !is_slow(at, heights[i]);
      if (!departs) touching.push_back(static_cast<int>(i));
    }
    if (touching.size() == points.size()) continue;
    if (touching.empty()) {
      gone = own[c];
      return false;
    }
    leave_out(contact(own[c]), touching);
  }
  return true;
}

bool ContactSettling::take_sinking(const BodyTerms<double>& terms, const std::vector<ContactForce<double>>& forces) {
  Vector3 acceleration = Vector3::Zero(), moment = Vector3::Zero();
  for (const ContactForce<double>& each : forces) {
    acceleration += terms.inverse_mass * each.force;
    moment += each.moment;
  }
  const Vector3 turning = terms.inverse_inertia * moment;
  // a corner that does not bear any more hardly moves: what the rounding of the time leaves of it takes none back
  constexpr double kTipped = 1e-6;
  const double least = (has_tipped_ ? kTipped : kNone) * acceleration.norm();
  bool has_any = false;
  for (const int index : own()) {
    RestingContact& one = contact(index);
    if (!one.core) continue;
    RestingContact all = one;
    all.corners = touching_corners(world_, one, encounters_.frame(one.obstacle, instant_.time()), instant_.q);
    if (all.corners.size() <= one.corners.size()) continue;
    const auto of_all = contact_terms(world_, instant_.course().group().law, {all}, body_, instant_.time(), instant_.q);
    const std::vector<double> heights =
        heights_of_corners(world_, all, encounters_.frame(one.obstacle, instant_.time()), instant_.q);
    for (std::size_t i = 0; of_all && i < all.corners.size(); ++i) {
      if (ranges::find(one.corners, all.corners[i]) != one.corners.end()) continue;
      const ContactTerms<double>& at = of_all->points[i];
      const double speed = at.normal.dot(at.slip), none = kNone * speed_scale(at);
      const double faster =
          at.normal.dot(at.slip_rate + acceleration + turning.cross(at.arm)) + at.normal_rate.dot(at.slip);
      const bool sinks =
          speed < -none ||
          ((speed <= none || is_slow(at, heights[static_cast<std::size_t>(all.corners[i])])) && faster < -least);
      if (!sinks) continue;
      one.corners.push_back(all.corners[i]);
      has_any = true;
    }
    ranges::sort(one.corners);
  }
  return has_any;
}

void ContactSettling::stand_still() {
  for (const int index : own()) {
    const RestingContact& contact = instant_.contacts[static_cast<std::size_t>(index)];
    const bool is_driven = world_.obstacles[static_cast<std::size_t>(contact.obstacle)].drive != nullptr;
    const bool is_still = contact.mode.slip.is_held() && !contact.core &&
                          (contact.mode.roll.is_held() || !body().rotation || bounding_radius(body().solid) == 0.0);
    if (is_still && !is_driven) instant_.q.segment<3>(body().offset + 3).setZero();
    // on a face nothing of a solid moves
    if (contact.mode.slip.is_held() && contact.corners.size() > 2 && !is_driven) {
      instant_.q.segment<3>(body().offset + 3).setZero();
      instant_.q.segment<3>(body().slice().angular_velocity_index()).setZero();
    }
  }
}

std::string ContactSettling::settle(const std::vector<EndedMode>& ended, const Release& release) {
  constexpr int kMostRounds = 50;
  has_tipped_ = ranges::any_of(ended, [](const EndedMode& each) { return each.end == ContactEnd::tips; });
  for (int round = 0; round < kMostRounds; ++round) {
    kinds_.clear();
    if (tips_over_rim_) return kTipsOverRim;
    const std::vector<int> own = this->own();
    if (own.empty()) return "";
    if (has_sunk()) return "a corner has sunk into the surface, where it was not seen to come";
    std::optional<BodyTerms<double>> terms = look();
    if (!terms) return "the way in which a table enters a velocity has no derivative";
    const std::vector<ContactQuestion> asked = questions(*terms, ended);
    std::string failure;
    if (!stop(*terms, asked, modes_by_velocity(*terms, asked), failure)) continue;
    if (!failure.empty()) return failure;
    const bool has_bounced = std::exchange(restitution_, 0.0) > 0.0;
    int gone = -1;
    if (!keep_touching(*(terms = look()), gone)) {
      release(gone);
      continue;
    }
    if (tips_over_rim_) continue;
    if (has_bounced) continue;  // what flies too low for a flight is stopped
    terms = look();
    // what others have bounced off may come back at once
    if (are_closing(*terms) && round < kMostRounds / 2) continue;
    const ContactDecision decision = decide_contacts(*terms, asked, modes_by_velocity(*terms, asked));
    if (decision.pulling >= 0) {
      const auto pulling = static_cast<std::size_t>(decision.pulling);
      if (departs(terms->contacts[pulling], decision.pulled_side)) {
        release(own[pulling]);
      } else {
        leave_out(contact(own[pulling]), remaining(terms->contacts[pulling], decision.pulled_side));
        has_tipped_ = true;
      }
      continue;
    }
    if (!decision.failure.empty()) return decision.failure;
    if (take_sinking(*terms, decision.forces)) continue;
    for (std::size_t i = 0; i < own.size(); ++i) {
      RestingContact& contact = instant_.contacts[static_cast<std::size_t>(own[i])];
      contact.mode = decision.modes[i];
      contact.unknowns.clear();
      for (const ContactUnknown& each : decision.unknowns)
        if (each.contact == static_cast<int>(i)) contact.unknowns.push_back(each);
      const auto point = static_cast<std::size_t>(terms->contacts[i].points[0]);
      const double force = terms->inverse_mass * decision.forces[i].force.norm();
      kinds_.push_back({{contact.body, contact.obstacle},
                        kind_of(contact, terms->points[point], rates_by(*terms, decision.forces)[point], force)});
    }
    stand_still();
    return "";
  }
  return "it cannot be decided which corners touch";
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
  if (contact.corners.size() > 2) return ImpactKind::rest;
  if (!body().rotation || radius == 0.0 || contact.mode.roll.is_held()) return ImpactKind::rest;
  const bool turns =
      radius * along(at.turning) > kNone * speed || radius * along(at.turning_rate + by_forces.turning) > kNone * force;
  return turns ? ImpactKind::roll : ImpactKind::rest;
}

}  // namespace trajet
