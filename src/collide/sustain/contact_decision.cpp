#include "trajet/collide/sustain/contact_decision.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace trajet {
namespace {

using State = Resistance::State;

/// A speed so small of those at the contact is none: far above rounding.
constexpr double kNoSpeed = 1e-12;
/// And so small a difference between the points of a contact none of their directions.
constexpr double kStraight = 1e-13;

Vector3 along_surface(const Vector3& v, const Vector3& normal) { return v - v.dot(normal) * normal; }

/// The three ways in which a contact resists, as one.
enum class Way { slip, roll, spin };
constexpr Way kWays[] = {Way::slip, Way::roll, Way::spin};

Resistance& resistance(ContactMode& mode, Way way) {
  return way == Way::slip ? mode.slip : way == Way::roll ? mode.roll : mode.spin;
}

/// What a motion, or a force against it, is in that way.
Vector3 part(Way way, const Vector3& of_slip, const Vector3& of_turning, const Vector3& normal) {
  if (way == Way::slip) return along_surface(of_slip, normal);
  return way == Way::roll ? along_surface(of_turning, normal) : Vector3(of_turning.dot(normal) * normal);
}

ContactEnd start_of(Way way) {
  return way == Way::slip   ? ContactEnd::slip_starts
         : way == Way::roll ? ContactEnd::roll_starts
                            : ContactEnd::spin_starts;
}

double coefficient(const ContactQuestion& question, Way way) {
  if (way == Way::slip) return question.friction.slip;
  if (!question.turns) return 0.0;
  return way == Way::roll ? question.friction.roll : question.friction.spin;
}

/// Lets a motion begin, or go on, with that velocity or acceleration.
void set_moving(Resistance& it, Way way, const Vector3& motion, const Vector3& normal) {
  it.state = State::moving;
  it.direction = motion.normalized();
  it.sign = way == Way::spin ? std::copysign(1.0, motion.dot(normal)) : 0.0;
}

std::vector<FrictionCoefficients> friction_of(const std::vector<ContactQuestion>& questions) {
  std::vector<FrictionCoefficients> friction;
  for (const ContactQuestion& question : questions) friction.push_back(question.friction);
  return friction;
}

constexpr double kBegins = 1e300;

/// A resistance that holds, and how much more than its limit it would have to.
struct Excess {
  std::size_t contact = 0;
  Way way = Way::slip;
  double ratio = 1.0 + 1e-12;  // the limit itself holds, to rounding
};

class Decision {
 public:
  Decision(const BodyTerms<double>& terms, const std::vector<ContactQuestion>& questions, bool impulses)
      : terms_(terms), questions_(questions), friction_(friction_of(questions)), impulses_(impulses) {}

  ContactDecision decide(std::vector<ContactMode> modes) {
    modes_ = std::move(modes);
    const std::size_t most = 4 * modes_.size() + 4;
    for (std::size_t round = 0; round < most; ++round) {
      solve();
      if (has_no_answer()) return failed("friction and shape allow no motion in which they stay in contact (Painleve)");
      if (const auto [pulling, side] = most_pulling(); pulling >= 0) return {modes_, unknowns_, forces_, pulling, side};
      const std::optional<Excess> excess = largest_excess();
      if (!excess) return {modes_, unknowns_, forces_};
      if (!begin_motion(*excess)) return failed("friction neither holds the contact nor lets it slide");
    }
    return failed("it cannot be decided which contacts slide");
  }

 private:
  ContactDecision failed(const std::string& why) const { return {modes_, unknowns_, forces_, -1, 0, why}; }

  void solve() {
    unknowns_ = independent_unknowns(terms_, modes_, friction_);
    forces_ = contact_forces<double>(terms_, modes_, friction_, unknowns_, impulses_ ? &terms_ : nullptr);
  }

  /// Whether a push along the normal, with the friction that comes with it, does not push.
  bool has_no_answer() const {
    const detail::ContactSystem<double> system(terms_, modes_, friction_);
    return std::any_of(unknowns_.begin(), unknowns_.end(), [&](const ContactUnknown& x) {
      return x.kind == ContactUnknown::Kind::normal && system.response(x, system.wrench(x)) <= 0.0;
    });
  }

  /// The contact and its side that would have to pull most.
  std::pair<int, int> most_pulling() const {
    std::pair<int, int> pulling{-1, 0};
    double most = 0.0;
    for (std::size_t c = 0; c < forces_.size(); ++c) {
      const ContactPoints& contact = terms_.contacts[c];
      // of two or more, so small a part of what they bear is rounding of the places
      constexpr double kRounding = 1e-12;
      const double scale = contact.is_one() ? 0.0 : kRounding * contact.sides.cwiseAbs().maxCoeff() * forces_[c].normal;
      std::vector<double> loads = loads_of_sides(contact, forces_[c].shares);
      if (contact.is_rim) loads = {forces_[c].normal, forces_[c].normal - std::hypot(loads[0], loads[1])};
      for (std::size_t side = 0; side < loads.size(); ++side) {
        if (loads[side] >= std::min(most, -scale)) continue;
        pulling = {static_cast<int>(c), static_cast<int>(side)};
        most = loads[side];
      }
    }
    return pulling;
  }

  std::optional<Excess> largest_excess() {
    std::optional<Excess> largest;
    for (std::size_t c = 0; c < modes_.size(); ++c)
      for (const Way way : kWays) {
        if (!resistance(modes_[c], way).is_held()) continue;
        const double force = resisting(c, way);
        const double limit = coefficient(questions_[c], way) * forces_[c].normal;
        // what has begun to move does so, though rounding may still hold it
        const bool begins = questions_[c].has_ended(start_of(way)) && force > 0.0;
        const double ratio = begins ? kBegins : force > 0.0 ? force / limit : 0.0;
        if (ratio > (largest ? largest->ratio : Excess().ratio)) largest = Excess{c, way, ratio};
      }
    return largest;
  }

  const ContactTerms<double>& first_point(std::size_t c) const {
    return terms_.points[static_cast<std::size_t>(terms_.contacts[c].points[0])];
  }

  /// How strongly what is held is held; of several points slip is held by a force and a torque.
  double resisting(std::size_t c, Way way) const {
    const Vector3& normal = first_point(c).normal;
    const double force = part(way, forces_[c].force, forces_[c].torque, normal).norm();
    if (terms_.contacts[c].is_one()) return force;
    return std::hypot(force, forces_[c].torque.dot(normal) / terms_.contacts[c].spread);
  }

  /// The acceleration of what a resistance resists; of several points that of their middle.
  Vector3 acceleration(std::size_t c, Way way) const {
    const std::vector<ContactRates> by_forces = rates_by(terms_, forces_);
    Vector3 slip = Vector3::Zero(), turning = Vector3::Zero();
    for (const int i : terms_.contacts[c].points) {
      const ContactTerms<double>& at = terms_.points[static_cast<std::size_t>(i)];
      slip += (impulses_ ? at.slip : at.slip_rate) + by_forces[static_cast<std::size_t>(i)].slip;
      turning += (impulses_ ? at.turning : at.turning_rate) + by_forces[static_cast<std::size_t>(i)].turning;
    }
    const double count = static_cast<double>(terms_.contacts[c].points.size());
    return part(way, slip / count, turning / count, first_point(c).normal);
  }

  /// Lets go what does not hold. Its direction is that of its acceleration, on which the friction along it depends.
  bool begin_motion(const Excess& excess) {
    const std::size_t c = excess.contact;
    const Vector3& normal = first_point(c).normal;
    const ContactQuestion& question = questions_[c];
    Resistance& it = resistance(modes_[c], excess.way);
    const bool is_slip = excess.way == Way::slip;
    Vector3 motion = -part(excess.way, forces_[c].force, forces_[c].torque, normal);
    constexpr double kTwist = 1e-9;
    const bool twists = !terms_.contacts[c].is_one() &&
                        std::abs(forces_[c].torque.dot(normal)) > kTwist * terms_.contacts[c].spread * motion.norm();
    it.follows =
        excess.way != Way::spin && (!question.may_go_straight || twists ||
                                    question.has_ended(is_slip ? ContactEnd::slip_bends : ContactEnd::roll_bends));
    if (twists) {
      set_moving(it, excess.way, motion.norm() > 0.0 ? motion : first_point(c).tangents[0], normal);
      it.begins = true;
      it.scale = question.speed;
      return true;
    }
    const double per_force = terms_.inverse_mass * forces_[c].force.norm();
    const bool follows = it.follows;
    it.follows = false;
    const bool has_begun = excess.way == Way::slip ? find_direction(it, c, motion, per_force)
                                                   : begin_along(it, excess.way, c, motion, per_force);
    if (!has_begun) return false;
    it.follows = follows;
    motion = it.direction;
    constexpr double kScale = 1e-6;  // of the run's time
    const double unit = is_slip ? 1.0 : std::max(question.radius, 1e-300);
    it.begins = it.follows;
    it.scale = std::max(question.speed / unit, kScale * per_force / unit * question.time_scale);
    return true;
  }

  static constexpr double kNoAcceleration = 1e-9;  // of what the forces give

  /// Lets a motion begin along the direction of its acceleration, which settles where both agree.
  bool begin_along(Resistance& it, Way way, std::size_t c, Vector3 motion, double per_force) {
    constexpr int kRounds = 50;
    constexpr double kSettled = 1e-15;
    constexpr double kRoundings = 16.0;  // of the forces, of which little may be left
    const double unit = way == Way::slip ? 1.0 : std::max(questions_[c].radius, 1e-300);
    for (int i = 0; i < kRounds; ++i) {
      const Vector3 direction = motion.normalized();
      set_moving(it, way, motion, first_point(c).normal);
      solve();
      const Vector3 faster = acceleration(c, way);
      // at the limit itself it hardly begins to move
      if (unit * faster.norm() <= kNoAcceleration * per_force) return true;
      if (!(faster.dot(direction) > 0.0)) return false;
      motion = faster;
      const double rounding = std::max(1.0, kRoundings * per_force / (unit * faster.norm()));
      if ((motion.normalized() - direction).norm() <= kSettled * rounding) return true;
    }
    return false;
  }

  /// The same of slip, where a body's inertia may turn the acceleration far from the direction of the force: all
  /// directions are looked at for one in which both agree.
  bool find_direction(Resistance& it, std::size_t c, const Vector3& motion, double per_force) {
    if (begin_along(it, Way::slip, c, motion, per_force)) return true;
    const Vector3 normal = first_point(c).normal, x = motion.normalized(), y = normal.cross(x);
    const auto aside = [&](double angle) {
      set_moving(it, Way::slip, std::cos(angle) * x + std::sin(angle) * y, normal);
      solve();
      const Vector3 faster = acceleration(c, Way::slip);
      return std::pair(it.direction.cross(faster).dot(normal), it.direction.dot(faster));
    };
    constexpr int kDirections = 64, kHalvings = 60;
    constexpr double kTurn = 6.283185307179586;
    double before = 0.0;
    auto at_before = aside(before);
    for (int i = 1; i <= kDirections; ++i) {
      const double angle = kTurn * i / kDirections;
      const auto at = aside(angle);
      if (at_before.first * at.first <= 0.0 && at.second > 0.0 && at_before.second > 0.0) {
        double low = before, high = angle;
        for (int k = 0; k < kHalvings; ++k) {
          const double middle = 0.5 * (low + high);
          (aside(middle).first * at_before.first > 0.0 ? low : high) = middle;
        }
        return aside(low).second > 0.0;
      }
      before = angle;
      at_before = at;
    }
    return false;
  }

  const BodyTerms<double>& terms_;
  const std::vector<ContactQuestion>& questions_;
  std::vector<FrictionCoefficients> friction_;
  bool impulses_;
  std::vector<ContactMode> modes_;
  std::vector<ContactUnknown> unknowns_;
  std::vector<ContactForce<double>> forces_;
};

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
      it.begins =
          it.follows && motion.norm() + aside < kBegun * it.scale && faster.dot(motion) > 0.0 && !(was.begins && bends);
    };
    const double radius = std::max(question.radius, 1e-300);
    set(Way::slip, ContactEnd::slip_stops, question.has_ended(ContactEnd::slip_bends), 1.0);
    set(Way::roll, ContactEnd::roll_stops, question.has_ended(ContactEnd::roll_bends), radius);
    set(Way::spin, ContactEnd::spin_stops, false, radius);
    modes.push_back(mode);
  }
  return modes;
}

ContactDecision decide_contacts(const BodyTerms<double>& terms, const std::vector<ContactQuestion>& questions,
                                std::vector<ContactMode> modes, bool impulses) {
  return Decision(terms, questions, impulses).decide(std::move(modes));
}

}  // namespace trajet
