#include "trajet/collide/sustain/contact_decision.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "contact_ways.hpp"
#include "slip_onset.hpp"

namespace trajet {
namespace {

using State = Resistance::State;
using namespace detail;

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
    is_gripped_anew_.assign(modes_.size(), false);
    if (impulses_ && !begin_slips()) return failed("friction neither holds the contact nor lets it slide");
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
    const auto take = [&](const Excess& excess) {
      if (excess.ratio > (largest ? largest->ratio : Excess().ratio)) largest = excess;
    };
    for (std::size_t c = 0; c < modes_.size(); ++c)
      for (const Way way : kWays) {
        if (way == Way::slip && !terms_.contacts[c].is_one()) {
          if (const auto ratio = slip_ratio(c)) take({c, way, *ratio});
          continue;
        }
        if (!resistance(modes_[c], way).is_held()) continue;
        const double force = part(way, forces_[c].force, forces_[c].torque, first_point(c).normal).norm();
        const double limit = coefficient(questions_[c], way) * forces_[c].normal;
        // what has begun to move does so, though rounding may still hold it
        const bool begins = questions_[c].has_ended(start_of(way)) && force > 0.0;
        take({c, way, begins ? kBegins : force > 0.0 ? force / limit : 0.0});
      }
    return largest;
  }

  /// Of several points, how much of what friction can do those have to do that are held.
  std::optional<double> slip_ratio(std::size_t c) const {
    const ContactMode& mode = modes_[c];
    const double coefficient = questions_[c].friction.slip;
    double ratio = 0.0;
    if (const int sticking = mode.sticking_point(); sticking >= 0) {
      const double friction = forces_[c].sticking.norm();
      ratio = friction > 0.0 ? friction / (coefficient * forces_[c].shares[static_cast<std::size_t>(sticking)]) : 0.0;
    } else if (mode.slip.is_held()) {
      for (const Vector3& each : held_friction(terms_, terms_.contacts[c], mode, forces_[c]))
        ratio = std::max(ratio, each.norm() / coefficient);
    } else {
      return std::nullopt;
    }
    constexpr double kAtLimit = 1e-6;
    const bool begins = questions_[c].has_ended(ContactEnd::slip_starts) && !impulses_;
    return begins && ratio > 1.0 - kAtLimit ? kBegins : ratio;
  }

  const ContactTerms<double>& first_point(std::size_t c) const {
    return terms_.points[static_cast<std::size_t>(terms_.contacts[c].points[0])];
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
    if (excess.way == Way::slip) return begin_slip(excess.contact);
    const std::size_t c = excess.contact;
    const ContactQuestion& question = questions_[c];
    Resistance& it = resistance(modes_[c], excess.way);
    const Vector3 motion = -part(excess.way, forces_[c].force, forces_[c].torque, first_point(c).normal);
    const double per_force = terms_.inverse_mass * forces_[c].force.norm();
    it.follows = false;
    if (!begin_along(it, excess.way, c, motion, per_force)) return false;
    it.follows = excess.way == Way::roll && (!question.may_go_straight || question.has_ended(ContactEnd::roll_bends));
    it.begins = it.follows;
    it.scale = scale_of_beginning(c, per_force) / std::max(question.radius, 1e-300);
    return true;
  }

  /// The scale of the speeds at a contact where something begins to move, m/s.
  double scale_of_beginning(std::size_t c, double per_force) const {
    constexpr double kScale = 1e-6;  // of the run's time
    return std::max(questions_[c].speed, kScale * per_force * questions_[c].time_scale);
  }

  /// Friction of an impact acts against the slip that it leaves.
  bool begin_slips() {
    for (std::size_t c = 0; c < modes_.size(); ++c) {
      if (!modes_[c].slip.is_moving()) continue;
      const double scale = modes_[c].slip.scale;
      modes_[c].slip = {.state = State::held, .scale = scale};
      if (!terms_.contacts[c].is_one()) modes_[c].points.assign(terms_.contacts[c].points.size(), {});
      solve();
      if (!begin_slip(c)) return false;
    }
    return true;
  }

  /// Lets points of a contact slide that do not hold, each against its own acceleration. Where only one of them holds,
  /// the others turn about it; where all do, it is their grips that were wrong.
  bool begin_slip(std::size_t c) {
    ContactMode& mode = modes_[c];
    const std::size_t count = terms_.contacts[c].points.size();
    const int sticking = mode.sticking_point();
    std::vector<std::size_t> still;
    for (std::size_t i = 0; i < count; ++i)
      if (sticking < 0 || static_cast<int>(i) == sticking) still.push_back(i);
    const SlipOnset onset = onset_of(c, still);
    if (!onset.is_found) return false;
    std::vector<Vector3> directions;
    for (const Eigen::Vector2d& rate : onset.rates)
      directions.push_back(
          (rate.x() * first_point(c).tangents[0] + rate.y() * first_point(c).tangents[1]).stableNormalized());
    if (sticking >= 0) {
      let_go(mode, c, directions[0]);
      return true;
    }
    if (onset.hold_all() && !is_gripped_anew_[c] && (count > 1 || impulses_)) {
      is_gripped_anew_[c] = true;
      for (std::size_t i = 0; i < mode.points.size(); ++i)
        mode.points[i].grip = onset.creep > 0.0 ? 1.0 / std::hypot(onset.rates[i].norm() / onset.creep, 1.0) : 1.0;
      return true;
    }
    const double per_force = terms_.inverse_mass * forces_[c].force.norm();
    Resistance& it = mode.slip;
    set_moving(it, Way::slip, directions[0], first_point(c).normal);
    it.scale = scale_of_beginning(c, per_force);
    constexpr double kSame = 1e-9;
    const bool is_straight = std::all_of(directions.begin(), directions.end(),
                                         [&](const Vector3& each) { return (each - directions[0]).norm() <= kSame; });
    // an impact's friction has the direction that was found, whatever follows
    const bool bends = !questions_[c].may_go_straight || questions_[c].has_ended(ContactEnd::slip_bends);
    it.follows = !is_straight || (bends && !impulses_);
    it.begins = it.follows;
    mode.points.clear();
    if (count == 1 && !(it.begins && questions_[c].is_of_corners)) return true;
    for (const Vector3& each : directions) mode.points.push_back({PointSlip::State::begins, each});
    const auto held = std::find(onset.holds.begin(), onset.holds.end(), true);
    if (!onset.hold_all() && held != onset.holds.end()) turn_about(mode, c, held - onset.holds.begin(), directions);
    return true;
  }

  /// The points turn about one that sticks, in those directions.
  void turn_about(ContactMode& mode, std::size_t c, std::ptrdiff_t center, const std::vector<Vector3>& directions) {
    const auto point = [&](std::size_t i) -> const ContactTerms<double>& {
      return terms_.points[static_cast<std::size_t>(terms_.contacts[c].points[i])];
    };
    double turning = 0.0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const Vector3 arm = point(i).arm - point(static_cast<std::size_t>(center)).arm;
      mode.points[i].state = PointSlip::State::turns;
      turning += point(i).normal.dot(arm.cross(directions[i]));
    }
    mode.points[static_cast<std::size_t>(center)].state = PointSlip::State::sticks;
    mode.slip.sign = std::copysign(1.0, turning);
    mode.slip.begins = false;
  }

  /// The point about which the others turn begins to slide in that direction.
  void let_go(ContactMode& mode, std::size_t c, const Vector3& direction) {
    const ContactPoints& contact = terms_.contacts[c];
    const std::vector<PointSlip> before = mode.points;
    std::vector<Vector3> turning;
    double speed = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      turning.push_back(slip_direction(terms_, contact, mode, i));
      const ContactTerms<double>& at = terms_.points[static_cast<std::size_t>(contact.points[i])];
      speed = std::max(speed, along_surface(at.slip, at.normal).norm());
    }
    mode.slip.begins = speed <= kBegun * mode.slip.scale;
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (before[i].state == PointSlip::State::sticks)
        mode.points[i] = {PointSlip::State::begins, direction};
      else if (mode.slip.begins)
        mode.points[i] = {PointSlip::State::begins, turning[i]};
      else
        mode.points[i] = {};
    }
  }

  /// How points of a contact begin to move that do not: all, or one of several.
  SlipOnset onset_of(std::size_t c, const std::vector<std::size_t>& still) const {
    const ContactPoints& contact = terms_.contacts[c];
    const bool is_one = still.size() == 1;
    std::vector<ContactMode> modes = modes_;
    if (contact.points.size() == still.size())
      modes[c].slip = {};
    else
      for (std::size_t i = 0; i < contact.points.size(); ++i)
        modes[c].points[i] = {PointSlip::State::begins, slip_direction(terms_, contact, modes_[c], i)};
    const std::vector<ContactUnknown> unknowns = independent_unknowns(terms_, modes, friction_);
    const auto free = contact_forces<double>(terms_, modes, friction_, unknowns, impulses_ ? &terms_ : nullptr);
    const std::vector<ContactRates> by_free = rates_by(terms_, free);
    const auto point = [&](std::size_t i) -> const ContactTerms<double>& {
      return terms_.points[static_cast<std::size_t>(contact.points[i])];
    };
    Vector3 middle = Vector3::Zero();
    for (const std::size_t i : still) middle += point(i).arm / static_cast<double>(still.size());
    const Vector3* tangents = first_point(c).tangents;
    const auto along = [&](const Vector3& v) { return Eigen::Vector2d(tangents[0].dot(v), tangents[1].dot(v)); };
    const Eigen::Index numbers = is_one ? 2 : 3;
    std::vector<OnsetPoint> points;
    for (const std::size_t i : still) {
      OnsetPoint& each = points.emplace_back();
      const auto rates = static_cast<std::size_t>(contact.points[i]);
      each.free = along((impulses_ ? point(i).slip : point(i).slip_rate) + by_free[rates].slip);
      each.normal = free[c].shares[i];
      each.share.leftCols(2).setIdentity();
      const Eigen::Vector2d arm = along(point(i).arm - middle);
      if (!is_one) each.share.col(2) << -arm.y(), arm.x();
    }
    for (Eigen::Index j = 0; j < numbers; ++j) {
      ContactForce<double> unit{0.0, Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), {}, Vector3::Zero()};
      if (j < 2) unit.force = tangents[j];
      unit.moment = j < 2 ? middle.cross(unit.force) : first_point(c).normal;
      const std::vector<ContactRates> by_unit = rates_by(terms_, {unit});
      BodyTerms<double> moved = terms_;
      for (std::size_t i = 0; i < moved.points.size(); ++i) {
        moved.points[i].slip = by_unit[i].slip;
        moved.points[i].turning = by_unit[i].turning;
      }
      const auto forces = contact_forces<double>(terms_, modes, friction_, unknowns, &moved);
      const std::vector<ContactRates> by_forces = rates_by(terms_, forces);
      for (std::size_t i = 0; i < still.size(); ++i) {
        const auto rates = static_cast<std::size_t>(contact.points[still[i]]);
        points[i].by_wrench.col(j) = along(by_unit[rates].slip + by_forces[rates].slip);
        points[i].normal_by_wrench[j] = forces[c].shares[still[i]];
      }
    }
    return find_onset(points, questions_[c].friction.slip);
  }

  static constexpr double kNoAcceleration = 1e-9;  // of what the forces give

  /// Lets a motion begin along the direction of its acceleration, which settles where both agree.
  bool begin_along(Resistance& it, Way way, std::size_t c, Vector3 motion, double per_force) {
    constexpr int kRounds = 50;
    constexpr double kSettled = 1e-15;
    constexpr double kRoundings = 16.0;  // of the forces, of which little may be left
    const double unit = std::max(questions_[c].radius, 1e-300);
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

  const BodyTerms<double>& terms_;
  const std::vector<ContactQuestion>& questions_;
  std::vector<FrictionCoefficients> friction_;
  bool impulses_;
  std::vector<ContactMode> modes_;
  std::vector<bool> is_gripped_anew_;  // of each contact
  std::vector<ContactUnknown> unknowns_;
  std::vector<ContactForce<double>> forces_;
};

}  // namespace

ContactDecision decide_contacts(const BodyTerms<double>& terms, const std::vector<ContactQuestion>& questions,
                                std::vector<ContactMode> modes, bool impulses) {
  return Decision(terms, questions, impulses).decide(std::move(modes));
}

}  // namespace trajet
