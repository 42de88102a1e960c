#include "held_course_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "trajet/collide/sustain/stuck_law.hpp"
#include "trajet/portable.hpp"

namespace trajet {

namespace {

/// What ends a body's contacts, counted among all.
void add_ends(std::vector<ContactEndCondition> own, const std::vector<RestingContact>& contacts, int body,
              std::vector<ContactEndCondition>& ends) {
  std::vector<int> places;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (contacts[i].body == body) places.push_back(static_cast<int>(i));
  for (ContactEndCondition& end : own) {
    end.contact = places[static_cast<std::size_t>(end.contact)];
    ends.push_back(std::move(end));
  }
}

/// Whether a solid stands on a face of an obstacle at rest and does not slide: then nothing of it moves.
bool stands_still(const World& world, const std::vector<RestingContact>& contacts, int body) {
  return ranges::any_of(contacts, [&](const RestingContact& each) {
    return each.body == body && each.corners.size() > 2 && each.mode.slip.is_held() &&
           !world.obstacles[static_cast<std::size_t>(each.obstacle)].drive;
  });
}

}  // namespace

Support support_of(const std::vector<RestingContact>& contacts, int offset) {
  std::vector<Vector3> normals;
  for (const RestingContact& contact : contacts)
    if (contact.offset == offset) normals.push_back(contact.normal);
  return support(normals);
}

HeldCourseLaw::HeldCourseLaw(const World& world, int group)
    : world_(world), group_(group), free_(std::make_unique<ProgramSystem>(this->group().law)) {}

bool HeldCourseLaw::take(const std::vector<RestingContact>& contacts, std::vector<EventHold> holds) {
  const auto same = [](const RestingContact& a, const RestingContact& b) {
    const bool is_same = a.body == b.body && a.obstacle == b.obstacle && a.is_plain == b.is_plain && a.mode == b.mode &&
                         a.corners == b.corners;
    return is_same && a.unknowns == b.unknowns && a.stuck_at == b.stuck_at &&
           (!a.is_plain || (a.normal == b.normal && a.point == b.point));
  };
  const bool are_others = !ranges::equal(contacts_, contacts, same) ||
                          !ranges::equal(holds_, holds, {}, &EventHold::event, &EventHold::event);
  holds_ = std::move(holds);
  if (!are_others) return false;
  contacts_ = contacts;
  for (const int body : group().bodies) {
    const int offset = world_.bodies[static_cast<std::size_t>(body)].offset;
    const Support support = support_of(contacts_, offset);
    auto release = support.release.begin();
    for (RestingContact& contact : contacts_)
      if (contact.offset == offset) contact.release = *release++;
  }
  held_.reset();
  ends_.clear();
  slips_.clear();
  if (!contacts_.empty() || !holds_.empty())
    held_ = std::make_unique<ProgramSystem>(with(contacts_, holds_, &ends_, &slips_));
  return true;
}

std::vector<const World::Rotation*> HeldCourseLaw::turning_corners() const {
  std::vector<const World::Rotation*> turning;
  for (const RestingContact& contact : contacts_) {
    const auto& rotation = world_.bodies[static_cast<std::size_t>(contact.body)].rotation;
    if (contact.core && rotation) turning.push_back(&*rotation);
  }
  return turning;
}

std::vector<const World::Rotation*> HeldCourseLaw::pushed_rotations() const {
  std::vector<const World::Rotation*> pushed;
  for (const RestingContact& contact : contacts_) {
    const auto& rotation = world_.bodies[static_cast<std::size_t>(contact.body)].rotation;
    if (!contact.is_plain && rotation) pushed.push_back(&*rotation);
  }
  return pushed;
}

double HeldCourseLaw::time_of_slips(double t, const Eigen::VectorXd& q) const {
  double longest = std::numeric_limits<double>::infinity();
  for (const Program& slips : slips_) {
    std::vector<double> squares(slips.outputs.size());
    Evaluator<double> evaluate(slips);
    evaluate(t, q.data(), squares.data());
    for (std::size_t i = 0; i + 1 < squares.size(); i += 2)
      if (squares[i + 1] > 0.0) longest = std::min(longest, 0.5 * std::sqrt(squares[i] / squares[i + 1]));
  }
  return longest;
}

bool HeldCourseLaw::is_held(int event) const {
  return ranges::any_of(holds_, [event](const EventHold& hold) { return hold.event == event; });
}

Program HeldCourseLaw::with(const std::vector<RestingContact>& contacts, const std::vector<EventHold>& holds,
                            std::vector<ContactEndCondition>* ends, std::vector<Program>* slips) const {
  Program law = group().law;
  for (const int body : group().bodies) {
    if (const RestingContact* stuck = sticking_contact(contacts, body)) {
      law = *stuck_law(world_, law, *stuck);
      continue;
    }
    if (!are_plain(contacts, body)) {
      std::optional<ContactLaw> sustained = law_with_contacts(world_, law, contacts, body);
      if (!sustained) continue;
      law = std::move(sustained->law);
      // no rounding of forces moves it
      if (stands_still(world_, contacts, body)) law = *make_stuck_law(law, sustained_body(world_, body), {}, {});
      if (ends != nullptr) add_ends(std::move(sustained->ends), contacts, body, *ends);
      if (slips != nullptr && !sustained->slips.outputs.empty()) slips->push_back(std::move(sustained->slips));
      continue;
    }
    const int offset = world_.bodies[static_cast<std::size_t>(body)].offset;
    for (const Vector3& direction : support_of(contacts, offset).blocked) law = hold(law, offset, direction);
  }
  for (const EventHold& each : holds)
    law = hold_on_border(law, world_.events[static_cast<std::size_t>(each.event)].when, each.direction)->law;
  return law;
}

void HeldCourseLaw::keep_within(double first, double last) {
  free_->keep_within(first, last);
  if (held_) held_->keep_within(first, last);
}

}  // namespace trajet
