#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "trajet/collide/sustain/contact_mode.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// How a body moves at a point of one of its contacts, against the surface. World frame, SI units; rates are without
/// the forces of contacts.
template <class T>
struct ContactTerms {
  Vector3T<T> normal, normal_rate;  ///< unit, towards the body
  Vector3T<T> tangents[2];          ///< unit, orthogonal to it and to each other
  Vector3T<T> tangent_rates[2];
  Vector3T<T> arm;                    ///< from the centre of mass to the point
  Vector3T<T> slip, slip_rate;        ///< velocity of the body's material there against the surface's
  Vector3T<T> turning, turning_rate;  ///< angular velocity against the surface's
};

/// The points of one contact: one, or the corners of an edge or a face on a flat surface. Of three and more the force
/// is spread as a linear function of the place, which has three numbers.
struct ContactPoints {
  std::vector<int> points{};  ///< in BodyTerms::points
  Eigen::MatrixXd shares{};   ///< of each number of the force, what each point bears  // (numbers x points)
  double spread = 0.0;        ///< m: how far the points are from their middle, on average
  /// What each side bears of the points' forces: of one point its force, of two each one's, of more the moment about an
  /// edge of their hull. Where it vanishes, the contact goes on on the points that `remaining` has.  // (sides x
  /// points)
  Eigen::MatrixXd sides{};
  std::vector<std::vector<int>> remaining{};  ///< counted in `points`
  /// The points are spread evenly on the rim of a round face: `sides` has their two coordinates in units of its radius,
  /// and what it bears is within the rim where their moment is less than the whole force (`load_within_rim`).
  bool is_rim = false;

  bool is_one() const { return points.size() == 1; }
};

/// A body with all its contacts.
template <class T>
struct BodyTerms {
  T inverse_mass{};                        ///< 1/kg
  Eigen::Matrix<T, 3, 3> inverse_inertia;  ///< 1/(kg m^2), about the centre of mass, world frame
  std::vector<ContactTerms<T>> points;
  std::vector<ContactPoints> contacts{};
};

/// What the sides of a contact bear.
template <class T>
std::vector<T> loads_of_sides(const ContactPoints& contact, const std::vector<T>& shares) {
  std::vector<T> loads;
  for (Eigen::Index side = 0; side < contact.sides.rows(); ++side) {
    T load(0.0);
    for (std::size_t i = 0; i < shares.size(); ++i)
      load += T(contact.sides(side, static_cast<Eigen::Index>(i))) * shares[i];
    loads.push_back(load);
  }
  return loads;
}

/// Of the rim of a round face, positive where what it bears is within it: N^2 - m^2, m the moment about its middle over
/// the radius.
template <class T>
T load_within_rim(const ContactPoints& contact, const std::vector<T>& shares) {
  T whole(0.0);
  for (const T& share : shares) whole += share;
  const std::vector<T> moment = loads_of_sides(contact, shares);
  return whole * whole - moment[0] * moment[0] - moment[1] * moment[1];
}

/// What a contact does to the body. World frame.
template <class T>
struct ContactForce {
  T normal{};               ///< the part of `force` along the normal, N
  Vector3T<T> force;        ///< N
  Vector3T<T> moment;       ///< N m, about the centre of mass
  Vector3T<T> torque;       ///< N m: of it, what resists rolling and spinning, or turning of a face
  std::vector<T> shares{};  ///< N: the normal forces of its points
};

/// One number of the forces that keep a motion at zero: a force or a torque along a direction, and what it keeps at
/// zero, the motion along that direction.
struct ContactUnknown {
  enum class Kind {
    normal,   ///< along the normal, with the friction of what moves; `axis` is the number of the force
    force,    ///< along an axis of the world: of one point without slip
    hold,     ///< along a tangent, in the middle of several points without slip
    tangent,  ///< a torque along a tangent
    turn,     ///< a torque along an axis of the world: of a contact without any turning
    spin,     ///< a torque about the normal
  };
  int contact = 0;
  Kind kind = Kind::normal;
  int axis = 0;
  int order = 0;  ///< of the elimination
  bool operator==(const ContactUnknown&) const = default;
};

/// All of them for contacts that last so.
std::vector<ContactUnknown> contact_unknowns(const std::vector<ContactPoints>& contacts,
                                             const std::vector<ContactMode>& modes);

/// Of the unknowns those that do not follow from others, in an order in which they can be eliminated: decided where the
/// body is now.
std::vector<ContactUnknown> independent_unknowns(const BodyTerms<double>& terms, const std::vector<ContactMode>& modes,
                                                 const std::vector<FrictionCoefficients>& friction);

namespace detail {

template <class T>
Vector3T<T> unit_axis(int i) {
  Vector3T<T> axis(T(0.0), T(0.0), T(0.0));
  axis[i] = T(1.0);
  return axis;
}

/// The direction of a motion that is resisted.
template <class T>
Vector3T<T> direction_of(const Resistance& resistance, const Vector3T<T>& motion, const Vector3T<T>& free_rate,
                         const Vector3T<T>& normal) {
  using std::sqrt;
  if (!resistance.follows) return resistance.direction.cast<T>();
  const Vector3T<T>& leading = resistance.begins ? free_rate : motion;
  const Vector3T<T> along = leading - normal * normal.dot(leading);
  return along * (T(1.0) / sqrt(along.dot(along)));
}

/// A force and its moment about the centre of mass, N and N m; the part of the moment that is a torque of the surface.
template <class T>
struct Wrench {
  Vector3T<T> force, moment, torque;
};

template <class T>
class ContactSystem {
 public:
  using Kind = ContactUnknown::Kind;

  ContactSystem(const BodyTerms<T>& terms, const std::vector<ContactMode>& modes,
                const std::vector<FrictionCoefficients>& friction)
      : terms_(terms), modes_(modes), friction_(friction) {}

  /// What a unit of an unknown does.
  Wrench<T> wrench(const ContactUnknown& x) const {
    const ContactMode& mode = modes_[static_cast<std::size_t>(x.contact)];
    const FrictionCoefficients& mu = friction_[static_cast<std::size_t>(x.contact)];
    const ContactPoints& contact = contact_of(x);
    Wrench<T> w{zero(), zero(), zero()};
    const auto push = [&](const Vector3T<T>& force, const ContactTerms<T>& at) {
      w.force += force;
      w.moment += at.arm.cross(force);
    };
    switch (x.kind) {
      case Kind::normal:
        for (std::size_t i = 0; i < contact.points.size(); ++i) {
          const ContactTerms<T>& at = point(contact, i);
          const T share(contact.shares(x.axis, static_cast<Eigen::Index>(i)));
          Vector3T<T> force = at.normal;
          if (mode.slip.is_moving()) force -= direction_of(mode.slip, at.slip, at.slip_rate, at.normal) * T(mu.slip);
          push(force * share, at);
        }
        if (contact.is_one()) w.torque = torque_per_normal(point(contact, 0), mode, mu);
        break;
      case Kind::force:
        push(unit_axis<T>(x.axis), point(contact, 0));
        w.torque = torque_per_normal(point(contact, 0), mode, mu) * point(contact, 0).normal[x.axis];
        break;
      case Kind::hold:
        for (std::size_t i = 0; i < contact.points.size(); ++i)
          push(point(contact, i).tangents[x.axis] * T(1.0 / static_cast<double>(contact.points.size())),
               point(contact, i));
        break;
      case Kind::tangent:
        w.torque = point(contact, 0).tangents[x.axis];
        break;
      case Kind::turn:
        w.torque = unit_axis<T>(x.axis);
        break;
      case Kind::spin:
        w.torque = point(contact, 0).normal;
        break;
    }
    w.moment += w.torque;
    return w;
  }

  /// How fast what an unknown keeps at zero changes by a wrench.
  T response(const ContactUnknown& row, const Wrench<T>& wrench) const {
    const Vector3T<T> turning = terms_.inverse_inertia * wrench.moment;
    const Vector3T<T> acceleration = wrench.force * terms_.inverse_mass;
    return along(
        row, [&](const ContactTerms<T>& at) { return Vector3T<T>(acceleration + turning.cross(at.arm)); },
        [&](const ContactTerms<T>&) { return turning; });
  }

  /// How fast that changes without contacts, and its value now.
  T free_rate(const ContactUnknown& row) const {
    const T rate = along(
        row, [](const ContactTerms<T>& at) { return at.slip_rate; },
        [](const ContactTerms<T>& at) { return at.turning_rate; });
    return rate + turned(row);
  }
  T value(const ContactUnknown& row) const {
    return along(
        row, [](const ContactTerms<T>& at) { return at.slip; }, [](const ContactTerms<T>& at) { return at.turning; });
  }

  const ContactTerms<T>& point(const ContactPoints& contact, std::size_t i) const {
    return terms_.points[static_cast<std::size_t>(contact.points[i])];
  }

 private:
  static Vector3T<T> zero() { return {T(0.0), T(0.0), T(0.0)}; }
  const ContactPoints& contact_of(const ContactUnknown& x) const {
    return terms_.contacts[static_cast<std::size_t>(x.contact)];
  }

  /// What an unknown keeps at zero, of motions of the points or of the body's turning.
  template <class OfSlip, class OfTurning>
  T along(const ContactUnknown& row, const OfSlip& slip, const OfTurning& turning) const {
    const ContactPoints& contact = contact_of(row);
    const ContactTerms<T>& first = point(contact, 0);
    T sum(0.0);
    switch (row.kind) {
      case Kind::normal:
        for (std::size_t i = 0; i < contact.points.size(); ++i) {
          const ContactTerms<T>& at = point(contact, i);
          sum += T(contact.shares(row.axis, static_cast<Eigen::Index>(i))) * at.normal.dot(slip(at));
        }
        return sum;
      case Kind::force:
        return slip(first)[row.axis];
      case Kind::hold:
        for (std::size_t i = 0; i < contact.points.size(); ++i) {
          const ContactTerms<T>& at = point(contact, i);
          sum += at.tangents[row.axis].dot(slip(at));
        }
        return sum * T(1.0 / static_cast<double>(contact.points.size()));
      case Kind::tangent:
        return first.tangents[row.axis].dot(turning(first));
      case Kind::turn:
        return turning(first)[row.axis];
      case Kind::spin:
        break;
    }
    return first.normal.dot(turning(first));
  }

  /// How fast what an unknown keeps at zero changes because its direction turns.
  T turned(const ContactUnknown& row) const {
    const ContactPoints& contact = contact_of(row);
    const ContactTerms<T>& first = point(contact, 0);
    T sum(0.0);
    switch (row.kind) {
      case Kind::normal:
        for (std::size_t i = 0; i < contact.points.size(); ++i) {
          const ContactTerms<T>& at = point(contact, i);
          sum += T(contact.shares(row.axis, static_cast<Eigen::Index>(i))) * at.normal_rate.dot(at.slip);
        }
        return sum;
      case Kind::hold:
        for (std::size_t i = 0; i < contact.points.size(); ++i) {
          const ContactTerms<T>& at = point(contact, i);
          sum += at.tangent_rates[row.axis].dot(at.slip);
        }
        return sum * T(1.0 / static_cast<double>(contact.points.size()));
      case Kind::tangent:
        return first.tangent_rates[row.axis].dot(first.turning);
      case Kind::spin:
        return first.normal_rate.dot(first.turning);
      case Kind::force:
      case Kind::turn:
        break;
    }
    return sum;
  }

  static Vector3T<T> torque_per_normal(const ContactTerms<T>& at, const ContactMode& mode,
                                       const FrictionCoefficients& mu) {
    Vector3T<T> torque = zero();
    if (mode.roll.is_moving())
      torque -= direction_of(mode.roll, at.turning, at.normal.cross(at.slip_rate).eval(), at.normal) * T(mu.roll);
    if (mode.spin.is_moving()) torque -= at.normal * T(mode.spin.sign * mu.spin);
    return torque;
  }

  const BodyTerms<T>& terms_;
  const std::vector<ContactMode>& modes_;
  const std::vector<FrictionCoefficients>& friction_;
};

}  // namespace detail

/// How the motions at the points of a body's contacts change with forces there.
struct ContactRates {
  Vector3 slip, turning;
};
/// With accelerations by forces, or changes by impulses; of each point.
std::vector<ContactRates> rates_by(const BodyTerms<double>& terms, const std::vector<ContactForce<double>>& forces);

/// The forces with which contacts last: those that keep at zero what does not move, with the friction of what does.
///
/// \param unknowns  independent, in the order of elimination
/// \param stopped   if not null: impulses, N s, instead, that bring to zero what these have of slip and turning;
/// friction
///                  acts along the motions of `terms`
template <class T>
std::vector<ContactForce<T>> contact_forces(const BodyTerms<T>& terms, const std::vector<ContactMode>& modes,
                                            const std::vector<FrictionCoefficients>& friction,
                                            const std::vector<ContactUnknown>& unknowns,
                                            const BodyTerms<T>* stopped = nullptr) {
  const detail::ContactSystem<T> system(terms, modes, friction);
  const auto n = static_cast<Eigen::Index>(unknowns.size());
  std::vector<detail::Wrench<T>> wrenches;
  for (const ContactUnknown& x : unknowns) wrenches.push_back(system.wrench(x));
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> a(n, n + 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ContactUnknown& row = unknowns[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < n; ++j) a(i, j) = system.response(row, wrenches[static_cast<std::size_t>(j)]);
    a(i, n) =
        -(stopped != nullptr ? detail::ContactSystem<T>(*stopped, modes, friction).value(row) : system.free_rate(row));
  }
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index i = k + 1; i < n; ++i) {
      const T factor = a(i, k) / a(k, k);
      for (Eigen::Index j = k + 1; j <= n; ++j) a(i, j) = a(i, j) - factor * a(k, j);
    }
  Eigen::Matrix<T, Eigen::Dynamic, 1> x(n);
  for (Eigen::Index k = n; k-- > 0;) {
    T sum = a(k, n);
    for (Eigen::Index j = k + 1; j < n; ++j) sum = sum - a(k, j) * x[j];
    x[k] = sum / a(k, k);
  }
  const Vector3T<T> zero(T(0.0), T(0.0), T(0.0));
  std::vector<ContactForce<T>> forces(modes.size(), {T(0.0), zero, zero, zero});
  for (std::size_t c = 0; c < forces.size(); ++c) forces[c].shares.assign(terms.contacts[c].points.size(), T(0.0));
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    ContactForce<T>& at = forces[static_cast<std::size_t>(unknowns[i].contact)];
    const T& amount = x[static_cast<Eigen::Index>(i)];
    at.force += wrenches[i].force * amount;
    at.moment += wrenches[i].moment * amount;
    at.torque += wrenches[i].torque * amount;
    if (unknowns[i].kind != ContactUnknown::Kind::normal) continue;
    const ContactPoints& contact = terms.contacts[static_cast<std::size_t>(unknowns[i].contact)];
    for (std::size_t k = 0; k < at.shares.size(); ++k)
      at.shares[k] += T(contact.shares(unknowns[i].axis, static_cast<Eigen::Index>(k))) * amount;
  }
  for (std::size_t c = 0; c < forces.size(); ++c) {
    forces[c].normal = system.point(terms.contacts[c], 0).normal.dot(forces[c].force);
    if (terms.contacts[c].is_one()) forces[c].shares[0] = forces[c].normal;
  }
  return forces;
}

}  // namespace trajet
