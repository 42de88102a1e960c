#include "trajet/collide/sustain/contact_decision.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace trajet {
namespace {

using State = Resistance::State;

/// A speed so small of those at the contact is none: far above rounding.
constexpr double kNoSpeed = 1e-12;

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
  Decision(const BodyTerms<double>& terms, const std::vector<ContactQuestion>& questions)
      : terms_(terms), questions_(questions), friction_(friction_of(questions)) {}

  ContactDecision decide(std::vector<ContactMode> modes) {
    modes_ = std::move(modes);
    const std::size_t most = 4 * modes_.size() + 4;
    for (std::size_t round = 0; round < most; ++round) {
      solve();
      if (has_no_answer()) return failed("friction and shape allow no motion in which they stay in contact (Painleve)");
      if (const int pulling = most_pulling(); pulling >= 0) return {modes_, unknowns_, forces_, pulling};
      const std::optional<Excess> excess = largest_excess();
      if (!excess) return {modes_, unknowns_, forces_};
      if (!begin_motion(*excess)) return failed("friction neither holds the contact nor lets it slide");
    }
    return failed("it cannot be decided which contacts slide");
  }

 private:
  ContactDecision failed(const std::string& why) const { return {modes_, unknowns_, forces_, -1, why}; }

  void solve() {
    unknowns_ = independent_unknowns(terms_, modes_, friction_);
    forces_ = contact_forces<double>(terms_, modes_, friction_, unknowns_);
  }

  /// Whether a push along the normal, with the friction that comes with it, does not push.
  bool has_no_answer() const {
    const detail::ContactSystem<double> system(terms_, modes_, friction_);
    return std::any_of(unknowns_.begin(), unknowns_.end(), [&](const ContactUnknown& x) {
      return x.kind == ContactUnknown::Kind::normal && system.response(x, system.wrench(x), x.contact) <= 0.0;
    });
  }

  int most_pulling() const {
    int pulling = -1;
    double most = 0.0;
    for (std::size_t c = 0; c < forces_.size(); ++c)
      if (forces_[c].normal < most) {
        pulling = static_cast<int>(c);
        most = forces_[c].normal;
      }
    return pulling;
  }

  std::optional<Excess> largest_excess() {
    std::optional<Excess> largest;
    for (std::size_t c = 0; c < modes_.size(); ++c)
      for (const Way way : kWays) {
        if (!resistance(modes_[c], way).is_held()) continue;
        const double force = part(way, forces_[c].force, forces_[c].torque, terms_.contacts[c].normal).norm();
        const double limit = coefficient(questions_[c], way) * forces_[c].normal;
        // what has begun to move does so, though rounding may still hold it
        const bool begins = questions_[c].has_ended(start_of(way)) && force > 0.0;
        const double ratio = begins ? kBegins : force > 0.0 ? force / limit : 0.0;
        if (ratio > (largest ? largest->ratio : Excess().ratio)) largest = Excess{c, way, ratio};
      }
    return largest;
  }

  /// The acceleration of what a resistance resists.
  Vector3 acceleration(std::size_t c, Way way) const {
    const ContactTerms<double>& at = terms_.contacts[c];
    const ContactRates by_forces = rates_by(terms_, forces_)[c];
    return part(way, at.slip_rate + by_forces.slip, at.turning_rate + by_forces.turning, at.normal);
  }

  /// Lets go what does not hold. Its direction is that of its acceleration, on which the friction along it depends.
  bool begin_motion(const Excess& excess) {
    const std::size_t c = excess.contact;
    const Vector3& normal = terms_.contacts[c].normal;
    const ContactQuestion& question = questions_[c];
    Resistance& it = resistance(modes_[c], excess.way);
    const bool is_slip = excess.way == Way::slip;
    it.follows =
        excess.way != Way::spin &&
        (!question.may_go_straight || question.has_ended(is_slip ? ContactEnd::slip_bends : ContactEnd::roll_bends));
    Vector3 motion = -part(excess.way, forces_[c].force, forces_[c].torque, normal);
    const double per_force = terms_.inverse_mass * forces_[c].force.norm();
    constexpr int kRounds = 200;
    constexpr double kSettled = 1e-15;
    constexpr double kNoAcceleration = 1e-9;  // of what the forces give
    const bool follows = it.follows;
    it.follows = false;
    for (int i = 0; i < kRounds; ++i) {
      const Vector3 direction = motion.normalized();
      set_moving(it, excess.way, motion, normal);
      solve();
      const Vector3 faster = acceleration(c, excess.way);
      // at the limit itself it hardly begins to move
      const double unit = is_slip ? 1.0 : std::max(question.radius, 1e-300);
      if (unit * faster.norm() <= kNoAcceleration * per_force) break;
      if (!(faster.dot(direction) > 0.0)) return false;
      motion = faster;
      if ((motion.normalized() - direction).norm() <= kSettled) break;
    }
    it.follows = follows;
    constexpr double kScale = 1e-6;  // of the run's time
    const double unit = is_slip ? 1.0 : std::max(question.radius, 1e-300);
    it.begins = it.follows;
    it.scale = std::max(question.speed / unit, kScale * per_force / unit * question.time_scale);
    return true;
  }

  const BodyTerms<double>& terms_;
  const std::vector<ContactQuestion>& questions_;
  std::vector<FrictionCoefficients> friction_;
  std::vector<ContactMode> modes_;
  std::vector<ContactUnknown> unknowns_;
  std::vector<ContactForce<double>> forces_;
};

}  // namespace

std::vector<ContactMode> modes_by_velocity(const BodyTerms<double>& terms,
                                           const std::vector<ContactQuestion>& questions) {
  std::vector<ContactMode> modes;
  for (std::size_t c = 0; c < questions.size(); ++c) {
    const ContactTerms<double>& at = terms.contacts[c];
    const ContactQuestion& question = questions[c];
    ContactMode mode;
    const auto set = [&](Way way, ContactEnd stops, bool bends, double unit) {
      if (!(coefficient(question, way) > 0.0)) return;
      Resistance& it = resistance(mode, way);
      ContactMode before = question.before;
      // what was held is so to the rounding of the speeds that it had then
      const Resistance& was = resistance(before, way);
      it.scale = std::max(question.speed / unit, was.scale);
      const Vector3 motion = part(way, at.slip, at.turning, at.normal);
      if (question.has_ended(stops) || motion.norm() <= kNoSpeed * it.scale) {
        it.state = State::held;
        return;
      }
      set_moving(it, way, motion, at.normal);
      it.follows = way != Way::spin && (!question.may_go_straight || bends || (was.is_moving() && was.follows));
      const Vector3 faster = way == Way::slip ? at.slip_rate : Vector3(at.normal.cross(at.slip_rate));
      it.begins = it.follows && motion.norm() < kBegun * it.scale && faster.dot(motion) > 0.0 && !(was.begins && bends);
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
                                std::vector<ContactMode> modes) {
  return Decision(terms, questions).decide(std::move(modes));
}

}  // namespace trajet
