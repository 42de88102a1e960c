#include "trajet/collide/respond/impact_group.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "trajet/math/complementarity.hpp"
#include "trajet/math/polynomial.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

using Real = Extended;
using RealVector = Vector3T<Real>;
using Column = Eigen::VectorX<Real>;
using Square = Eigen::MatrixX<Real>;

/// A speed so small, of the speeds of the group, is what rounding leaves of none.
constexpr double kNoSpeed = 64.0 * kUnitRoundoff;

/// The bodies and contacts of a group on their way through its rounds. More digits than double are carried, so that
/// what is symmetric, or alike in another order, is rounded alike.
class Group {
 public:
  Group(const std::vector<GroupBody>& bodies, const std::vector<GroupContact>& contacts)
      : bodies_(bodies),
        contacts_(contacts),
        compliance_(size(), size()),
        impulses_(Column::Zero(size())),
        frictions_(contacts.size(), RealVector::Zero()) {
    for (const GroupBody& body : bodies) {
      velocities_.push_back(body.velocity.cast<Real>());
      angular_velocities_.push_back(body.angular_velocity.cast<Real>());
    }
    for (const GroupContact& contact : contacts) {
      const RealVector normal = contact.normal.cast<Real>();
      levers_first_.push_back(contact.arm_first.cast<Real>().cross(normal));
      levers_second_.push_back(contact.arm_second.cast<Real>().cross(normal));
    }
    for (Eigen::Index i = 0; i < size(); ++i)
      for (Eigen::Index j = 0; j <= i; ++j) compliance_(i, j) = compliance_(j, i) = compliance(at(i), at(j));
  }

  Eigen::Index size() const { return static_cast<Eigen::Index>(contacts_.size()); }
  const Square& compliance() const { return compliance_; }
  const Column& impulses() const { return impulses_; }
  std::vector<Vector3> frictions() const {
    std::vector<Vector3> frictions;
    for (const RealVector& each : frictions_) frictions.emplace_back(each.cast<double>());
    return frictions;
  }

  /// At which the surfaces depart at each contact, m/s.
  Column speeds() const {
    Column speeds(size());
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const auto a = static_cast<std::size_t>(contacts_[i].first), b = static_cast<std::size_t>(contacts_[i].second);
      speeds[static_cast<Eigen::Index>(i)] = contacts_[i].normal.cast<Real>().dot(velocities_[a] - velocities_[b]) +
                                             levers_first_[i].dot(angular_velocities_[a]) -
                                             levers_second_[i].dot(angular_velocities_[b]);
    }
    return speeds;
  }

  /// m/s, by the fastest that was there so far.
  Real no_speed() {
    Real& scale = fastest_;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const auto a = static_cast<std::size_t>(contacts_[i].first), b = static_cast<std::size_t>(contacts_[i].second);
      scale = std::max(scale, velocities_[a].norm() + velocities_[b].norm() +
                                  angular_velocities_[a].norm() * Real(contacts_[i].arm_first.norm()) +
                                  angular_velocities_[b].norm() * Real(contacts_[i].arm_second.norm()));
    }
    return Real(kNoSpeed) * scale;
  }

  void push(const std::vector<int>& contacts, const Column& impulses) {
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const auto i = static_cast<std::size_t>(contacts[k]);
      const Real impulse = impulses[static_cast<Eigen::Index>(k)];
      impulses_[contacts[k]] += impulse;
      const RealVector along = impulse * contacts_[i].normal.cast<Real>();
      take(contacts_[i].first, along, impulse * levers_first_[i]);
      take(contacts_[i].second, -along, -impulse * levers_second_[i]);
    }
  }

  /// Of contacts that have pushed with those impulses: the impulses along the surfaces, no greater than friction lets
  /// them, that leave the least energy. It is convex in them, and each step makes it less, contact by contact.
  void rub(const std::vector<int>& contacts, const Column& impulses) {
    std::vector<RealVector> rubbed(contacts.size(), RealVector::Zero());
    const Real no_change = Real(4) * std::numeric_limits<Real>::epsilon() * fastest_;
    constexpr int kMostSweeps = 10'000;
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
      Real change = 0;
      for (std::size_t k = 0; k < contacts.size(); ++k) {
        const auto i = static_cast<std::size_t>(contacts[k]);
        const Real limit = Real(contacts_[i].friction) * impulses[static_cast<Eigen::Index>(k)];
        const Real compliance = compliance_along(i);
        if (!(limit > Real(0)) || !(compliance > Real(0))) continue;
        RealVector next = rubbed[k] - slip(i) / compliance;
        if (const Real size = next.norm(); size > limit) next *= limit / size;
        const RealVector more = next - rubbed[k];
        take(contacts_[i].first, more, contacts_[i].arm_first.cast<Real>().cross(more));
        take(contacts_[i].second, -more, -contacts_[i].arm_second.cast<Real>().cross(more));
        rubbed[k] = next;
        change = std::max(change, compliance * more.norm());
      }
      if (change <= no_change) break;
    }
    for (std::size_t k = 0; k < contacts.size(); ++k) frictions_[static_cast<std::size_t>(contacts[k])] += rubbed[k];
  }

  std::vector<GroupBody> bodies() const {
    std::vector<GroupBody> after = bodies_;
    for (std::size_t b = 0; b < after.size(); ++b) {
      after[b].velocity = velocities_[b].cast<double>();
      after[b].angular_velocity = angular_velocities_[b].cast<double>();
    }
    return after;
  }

 private:
  static std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

  /// How much the speed at contact i changes by an impulse of 1 N s at contact j.
  Real compliance(std::size_t i, std::size_t j) const {
    Real sum = 0;
    const auto add = [&](int body, int other, const RealVector& lever, const RealVector& other_lever, Real sign) {
      if (body != other) return;
      const GroupBody& moved = bodies_[static_cast<std::size_t>(body)];
      sum += sign * (Real(moved.inverse_mass) * contacts_[i].normal.cast<Real>().dot(contacts_[j].normal.cast<Real>()) +
                     lever.dot(moved.inverse_inertia.cast<Real>() * other_lever));
    };
    add(contacts_[i].first, contacts_[j].first, levers_first_[i], levers_first_[j], 1);
    add(contacts_[i].second, contacts_[j].second, levers_second_[i], levers_second_[j], 1);
    add(contacts_[i].first, contacts_[j].second, levers_first_[i], levers_second_[j], -1);
    add(contacts_[i].second, contacts_[j].first, levers_second_[i], levers_first_[j], -1);
    return sum;
  }

  /// At which the first body's point slips along the second's.
  RealVector slip(std::size_t i) const {
    const auto a = static_cast<std::size_t>(contacts_[i].first), b = static_cast<std::size_t>(contacts_[i].second);
    const RealVector relative =
        velocities_[a] + RealVector(angular_velocities_[a].cross(contacts_[i].arm_first.cast<Real>())) -
        velocities_[b] - RealVector(angular_velocities_[b].cross(contacts_[i].arm_second.cast<Real>()));
    const RealVector normal = contacts_[i].normal.cast<Real>();
    return relative - normal * normal.dot(relative);
  }

  /// How much slip changes by an impulse of 1 N s along the surface, at most: of points and balls in any direction.
  Real compliance_along(std::size_t i) const {
    Real sum = 0;
    const auto add = [&](int index, const Vector3& arm) {
      const GroupBody& body = bodies_[static_cast<std::size_t>(index)];
      sum += Real(body.inverse_mass) +
             Real(arm.squaredNorm()) * Real(body.inverse_inertia.cwiseAbs().rowwise().sum().maxCoeff());
    };
    add(contacts_[i].first, contacts_[i].arm_first);
    add(contacts_[i].second, contacts_[i].arm_second);
    return sum;
  }

  void take(int index, const RealVector& impulse, const RealVector& moment) {
    const auto b = static_cast<std::size_t>(index);
    velocities_[b] += Real(bodies_[b].inverse_mass) * impulse;
    angular_velocities_[b] += bodies_[b].inverse_inertia.cast<Real>() * moment;
  }

  const std::vector<GroupBody>& bodies_;
  const std::vector<GroupContact>& contacts_;
  Square compliance_;
  Column impulses_;                    // so far
  std::vector<RealVector> frictions_;  // likewise
  Real fastest_ = 0;                   // m/s
  std::vector<RealVector> velocities_, angular_velocities_;
  std::vector<RealVector> levers_first_, levers_second_;  // arm x normal
};

Square part_of(const Square& whole, const std::vector<int>& rows) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  Square part(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      part(i, j) = whole(rows[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(j)]);
  return part;
}

double restitution_at(const GroupContact& contact, Real speed) {
  return contact.restitution.at(std::max(0.0, -static_cast<double>(speed)));
}

}  // namespace

GroupResponse resolve_group(const std::vector<GroupBody>& bodies, const std::vector<GroupContact>& contacts,
                            Simultaneous rule) {
  Group group(bodies, contacts);
  GroupResponse response;
  response.approaches.assign(contacts.size(), 0.0);
  const auto finish = [&](GroupResponse::Status status) {
    response.status = status;
    response.after = group.bodies();
    response.impulses.assign(group.impulses().data(), group.impulses().data() + group.size());
    response.frictions = group.frictions();
    return response;
  };
  const bool is_plastic = std::all_of(contacts.begin(), contacts.end(),
                                      [](const GroupContact& contact) { return contact.restitution.is_constant(0.0); });
  // far more than a chain of elastic impacts at one instant has; where speed is lost there may be no end of them
  constexpr int kMostRounds = 1 << 14, kMostLossyRounds = 1024;
  int most_rounds = kMostRounds;
  for (int round = 0; round <= most_rounds; ++round) {
    const Column speeds = group.speeds();
    const Real no_speed = group.no_speed();
    // what nothing moves stays as it is
    const Column approaching = (group.compliance().diagonal().array() > Real(0)).select(speeds, Real(0));
    if (!(approaching.array() < -no_speed).any()) return finish(GroupResponse::Status::resolved);
    const bool is_projection = is_plastic || round == most_rounds;
    const Real most = is_projection ? speeds.maxCoeff() : rule == Simultaneous::group ? no_speed : -no_speed;
    std::vector<int> taking;
    for (Eigen::Index i = 0; i < group.size(); ++i)
      if (group.compliance()(i, i) > Real(0) && speeds[i] <= most) taking.push_back(static_cast<int>(i));
    // u+ + e u- = A lambda + (1 + e) u-
    Column asked(static_cast<Eigen::Index>(taking.size()));
    for (std::size_t k = 0; k < taking.size(); ++k) {
      const auto i = static_cast<std::size_t>(taking[k]);
      const Real speed = speeds[taking[k]];
      const double restitution = is_projection ? 0.0 : restitution_at(contacts[i], speed);
      if (!(restitution >= 0.0 && restitution <= 1.0)) {
        response.contact = taking[k];
        response.speed = std::max(0.0, -static_cast<double>(speed));
        return finish(GroupResponse::Status::impossible);
      }
      if (restitution < 1.0 || contacts[i].friction > 0.0)
        most_rounds = std::min(most_rounds, std::max(round + 1, kMostLossyRounds));
      asked[static_cast<Eigen::Index>(k)] = (Real(1) + Real(restitution)) * speed;
    }
    const auto impulses = solve_complementarity(part_of(group.compliance(), taking), asked, no_speed);
    if (!impulses) return finish(GroupResponse::Status::jammed);
    GroupRound& done = response.rounds.emplace_back();
    done.is_projection = is_projection;
    done.rubs = round < most_rounds;
    for (std::size_t k = 0; k < taking.size(); ++k) {
      if (!((*impulses)[static_cast<Eigen::Index>(k)] > Real(0))) continue;
      done.pushing.push_back(taking[k]);
      double& approach = response.approaches[static_cast<std::size_t>(taking[k])];
      if (approach == 0.0) approach = std::max(0.0, -static_cast<double>(speeds[taking[k]]));
    }
    group.push(taking, *impulses);
    if (done.rubs) group.rub(taking, *impulses);
    if (done.pushing.empty()) return finish(GroupResponse::Status::jammed);
  }
  return finish(GroupResponse::Status::resolved);
}

std::optional<std::vector<GroupBody>> repeat_rounds(const std::vector<GroupBody>& bodies,
                                                    const std::vector<GroupContact>& contacts,
                                                    const std::vector<GroupRound>& rounds) {
  Group group(bodies, contacts);
  for (const GroupRound& round : rounds) {
    const Column speeds = group.speeds();
    Column asked(static_cast<Eigen::Index>(round.pushing.size()));
    for (std::size_t k = 0; k < round.pushing.size(); ++k) {
      const Real speed = speeds[round.pushing[k]];
      const double restitution =
          round.is_projection ? 0.0 : restitution_at(contacts[static_cast<std::size_t>(round.pushing[k])], speed);
      asked[static_cast<Eigen::Index>(k)] = -(Real(1) + Real(restitution)) * speed;
    }
    const Column impulses = part_of(group.compliance(), round.pushing).colPivHouseholderQr().solve(asked);
    if (!impulses.allFinite()) return std::nullopt;
    group.no_speed();
    group.push(round.pushing, impulses);
    if (round.rubs) group.rub(round.pushing, impulses);
  }
  return group.bodies();
}

double kinetic_energy(const GroupBody& body) {
  double energy = body.inverse_mass > 0.0 ? 0.5 * body.velocity.squaredNorm() / body.inverse_mass : 0.0;
  if (body.inverse_inertia.diagonal().minCoeff() > 0.0)
    energy += 0.5 * body.angular_velocity.dot(body.inverse_inertia.inverse() * body.angular_velocity);
  return energy;
}

}  // namespace trajet
