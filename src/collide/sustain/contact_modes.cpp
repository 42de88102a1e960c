#include <algorithm>
#include <cmath>

#include "contact_ways.hpp"
#include "trajet/collide/sustain/contact_decision.hpp"

namespace trajet {
namespace {

using State = Resistance::State;
using namespace detail;

/// A speed so small of those at the contact is none: far above rounding.
constexpr double kNoSpeed = 1e-12;
/// And so small a difference between the points of a contact none of their directions.
constexpr double kStraight = 1e-13;

/// How each of several points of a contact slides or is held, by its velocity.
void set_points(ContactMode& mode, const BodyTerms<double>& terms, const ContactPoints& contact,
                const ContactQuestion& question) {
  const ContactMode& before = question.before;
  const std::size_t count = contact.points.size();
  const auto point = [&](std::size_t i) -> const ContactTerms<double>& {
    return terms.points[static_cast<std::size_t>(contact.points[i])];
  };
  if (mode.slip.is_held()) {
    const bool was_held = before.slip.is_held() && before.points.size() == count;
    mode.points = was_held ? before.points : std::vector<PointSlip>(count);
    return;
  }
  if (!mode.slip.is_moving() || !mode.slip.follows) return;
  mode.points.assign(count, {});
  if (contact.is_rim) return;
  double squares = 0.0;
  std::vector<std::size_t> still;
  for (std::size_t i = 0; i < count; ++i) squares += along_surface(point(i).slip, point(i).normal).squaredNorm();
  // where a watch has found that one stops, the rounding of the time leaves it a speed
  const double rounding = question.has_ended(ContactEnd::one_stops) ? 2.0 : 1.0;
  const double slow = rounding * std::hypot(kOneStops * std::sqrt(squares), kHasDied * mode.slip.scale);
  for (std::size_t i = 0; i < count; ++i)
    if (along_surface(point(i).slip, point(i).normal).norm() <= slow) still.push_back(i);
  // where two stop, all do
  constexpr double kHardly = 1e2;
  if (still.size() > 1 && std::sqrt(squares) <= kHardly * kHasDied * mode.slip.scale) {
    mode.slip = {.state = State::held, .scale = mode.slip.scale};
    return;
  }
  if (still.size() != 1) return;
  for (std::size_t i = 0; i < count; ++i)
    mode.points[i].state = i == still[0] ? PointSlip::State::sticks : PointSlip::State::turns;
  mode.slip.sign = std::copysign(1.0, point(0).normal.dot(point(0).turning));
}

}  // namespace

std::vector<ContactMode> modes_by_velocity(const BodyTerms<double>& terms,
                                           const std::vector<ContactQuestion>& questions) {
  std::vector<ContactMode> modes;
  for (std::size_t c = 0; c < questions.size(); ++c) {
    const ContactPoints& contact = terms.contacts[c];
    const ContactTerms<double>& at = terms.points[static_cast<std::size_t>(contact.points[0])];
    const ContactQuestion& question = questions[c];
    ContactMode mode;
    // of several points the middle, and how far the others are from it
    Vector3 slip = Vector3::Zero();
    double spread = 0.0;
    for (const int i : contact.points) slip += terms.points[static_cast<std::size_t>(i)].slip;
    slip /= static_cast<double>(contact.points.size());
    for (const int i : contact.points)
      spread = std::max(spread, along_surface(terms.points[static_cast<std::size_t>(i)].slip - slip, at.normal).norm());
    const auto set = [&](Way way, ContactEnd stops, bool bends, double unit) {
      if (!(coefficient(question, way) > 0.0)) return;
      Resistance& it = resistance(mode, way);
      ContactMode before = question.before;
      // what was held is so to the rounding of the speeds that it had then
      const Resistance& was = resistance(before, way);
      it.scale = std::max(question.speed / unit, was.scale);
      const Vector3 motion = part(way, slip, at.turning, at.normal);
      const double aside = way == Way::slip ? spread : 0.0;
      if (question.has_ended(stops) || motion.norm() + aside <= kNoSpeed * it.scale) {
        it.state = State::held;
        return;
      }
      set_moving(it, way, motion.norm() > 0.0 ? motion : at.tangents[0], at.normal);
      it.follows = way != Way::spin && (!question.may_go_straight || bends || (was.is_moving() && was.follows) ||
                                        aside > kStraight * it.scale);
      const Vector3 faster = way == Way::slip ? at.slip_rate : Vector3(at.normal.cross(at.slip_rate));
      it.begins = contact.is_one() && !question.is_of_corners && it.follows && motion.norm() < kBegun * it.scale &&
                  faster.dot(motion) > 0.0 && !(was.begins && bends);
    };
    const double radius = std::max(question.radius, 1e-300);
    set(Way::slip, ContactEnd::slip_stops, question.has_ended(ContactEnd::slip_bends), 1.0);
    set(Way::roll, ContactEnd::roll_stops, question.has_ended(ContactEnd::roll_bends), radius);
    set(Way::spin, ContactEnd::spin_stops, false, radius);
    if (!contact.is_one()) set_points(mode, terms, contact, question);
    modes.push_back(mode);
  }
  return modes;
}

}  // namespace trajet
