#pragma once

#include <cstddef>
#include <vector>

#include "trajet/collide/sustain/contact_mode.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// How a body moves at one of its contacts, against the surface. World frame, SI units; rates are without the forces of
/// contacts.
template <class T>
struct ContactTerms {
  Vector3T<T> normal, normal_rate;  ///< unit, towards the body
  Vector3T<T> tangents[2];          ///< unit, orthogonal to it and to each other
  Vector3T<T> tangent_rates[2];
  Vector3T<T> arm;                    ///< from the centre of mass to the contact
  Vector3T<T> slip, slip_rate;        ///< velocity of the body's point of contact against the surface's
  Vector3T<T> turning, turning_rate;  ///< angular velocity against the surface's
};

/// A body with all its contacts.
template <class T>
struct BodyTerms {
  T inverse_mass{};                        ///< 1/kg
  Eigen::Matrix<T, 3, 3> inverse_inertia;  ///< 1/(kg m^2), about the centre of mass, world frame
  std::vector<ContactTerms<T>> contacts;
};

/// What a contact does to the body.
template <class T>
struct ContactForce {
  T normal{};                 ///< the part of `force` along the normal, N
  Vector3T<T> force, torque;  ///< N at the contact; N m besides its moment
};

/// One number of the forces that keep a motion at zero: a force or a torque along a direction, and what it keeps at
/// zero, the motion along that direction.
struct ContactUnknown {
  enum class Kind {
    normal,   ///< along the normal, with the friction of what moves
    force,    ///< along an axis of the world: of a contact without slip
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
std::vector<ContactUnknown> contact_unknowns(const std::vector<ContactMode>& modes);

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

/// A force and a torque at one contact.
template <class T>
struct Wrench {
  Vector3T<T> force, torque;
};

template <class T>
class ContactSystem {
 public:
  ContactSystem(const BodyTerms<T>& terms, const std::vector<ContactMode>& modes,
                const std::vector<FrictionCoefficients>& friction)
      : terms_(terms), modes_(modes), friction_(friction) {}

  /// What a unit of an unknown does.
  Wrench<T> wrench(const ContactUnknown& x) const {
    const ContactTerms<T>& at = contact(x);
    const ContactMode& mode = modes_[static_cast<std::size_t>(x.contact)];
    const FrictionCoefficients& mu = friction_[static_cast<std::size_t>(x.contact)];
    Wrench<T> w{zero(), zero()};
    switch (x.kind) {
      case ContactUnknown::Kind::normal:
        w.force = at.normal;
        if (mode.slip.is_moving()) w.force -= direction_of(mode.slip, at.slip, at.slip_rate, at.normal) * T(mu.slip);
        w.torque = torque_per_normal(at, mode, mu);
        break;
      case ContactUnknown::Kind::force:
        w.force = unit_axis<T>(x.axis);
        w.torque = torque_per_normal(at, mode, mu) * at.normal[x.axis];
        break;
      case ContactUnknown::Kind::tangent:
        w.torque = at.tangents[x.axis];
        break;
      case ContactUnknown::Kind::turn:
        w.torque = unit_axis<T>(x.axis);
        break;
      case ContactUnknown::Kind::spin:
        w.torque = at.normal;
        break;
    }
    return w;
  }

  /// How fast what an unknown keeps at zero changes by a wrench at another contact.
  T response(const ContactUnknown& row, const Wrench<T>& wrench, int contact_of_wrench) const {
    const Vector3T<T>& arm = terms_.contacts[static_cast<std::size_t>(contact_of_wrench)].arm;
    const Vector3T<T> torque = arm.cross(wrench.force) + wrench.torque;
    const Vector3T<T> turning = terms_.inverse_inertia * torque;
    if (!is_of_force(row)) return axis_of(row).dot(turning);
    const Vector3T<T> acceleration = wrench.force * terms_.inverse_mass + turning.cross(contact(row).arm);
    return axis_of(row).dot(acceleration);
  }

  /// How fast that changes without contacts, and its value now.
  T free_rate(const ContactUnknown& row) const {
    const ContactTerms<T>& at = contact(row);
    switch (row.kind) {
      case ContactUnknown::Kind::normal:
        return at.normal.dot(at.slip_rate) + at.normal_rate.dot(at.slip);
      case ContactUnknown::Kind::force:
        return at.slip_rate[row.axis];
      case ContactUnknown::Kind::tangent:
        return at.tangents[row.axis].dot(at.turning_rate) + at.tangent_rates[row.axis].dot(at.turning);
      case ContactUnknown::Kind::turn:
        return at.turning_rate[row.axis];
      case ContactUnknown::Kind::spin:
        return at.normal.dot(at.turning_rate) + at.normal_rate.dot(at.turning);
    }
    return T(0.0);
  }
  T value(const ContactUnknown& row) const {
    return axis_of(row).dot(is_of_force(row) ? contact(row).slip : contact(row).turning);
  }

 private:
  static Vector3T<T> zero() { return {T(0.0), T(0.0), T(0.0)}; }
  static bool is_of_force(const ContactUnknown& x) {
    return x.kind == ContactUnknown::Kind::normal || x.kind == ContactUnknown::Kind::force;
  }
  const ContactTerms<T>& contact(const ContactUnknown& x) const {
    return terms_.contacts[static_cast<std::size_t>(x.contact)];
  }
  Vector3T<T> axis_of(const ContactUnknown& x) const {
    switch (x.kind) {
      case ContactUnknown::Kind::tangent:
        return contact(x).tangents[x.axis];
      case ContactUnknown::Kind::force:
      case ContactUnknown::Kind::turn:
        return unit_axis<T>(x.axis);
      case ContactUnknown::Kind::normal:
      case ContactUnknown::Kind::spin:
        break;
    }
    return contact(x).normal;
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

/// How the motions at a body's contacts change with forces there.
struct ContactRates {
  Vector3 slip, turning;
};
/// With accelerations by forces, or changes by impulses.
std::vector<ContactRates> rates_by(const BodyTerms<double>& terms, const std::vector<ContactForce<double>>& forces);

/// The forces with which contacts last: those that keep at zero what does not move, with the friction of what does.
///
/// \param unknowns  independent, in the order of elimination
/// \param impulses  what keeps the velocities at zero that are not, N s, instead of the accelerations, N
template <class T>
std::vector<ContactForce<T>> contact_forces(const BodyTerms<T>& terms, const std::vector<ContactMode>& modes,
                                            const std::vector<FrictionCoefficients>& friction,
                                            const std::vector<ContactUnknown>& unknowns, bool impulses = false) {
  const detail::ContactSystem<T> system(terms, modes, friction);
  const auto n = static_cast<Eigen::Index>(unknowns.size());
  std::vector<detail::Wrench<T>> wrenches;
  for (const ContactUnknown& x : unknowns) wrenches.push_back(system.wrench(x));
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> a(n, n + 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ContactUnknown& row = unknowns[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto column = static_cast<std::size_t>(j);
      a(i, j) = system.response(row, wrenches[column], unknowns[column].contact);
    }
    a(i, n) = -(impulses ? system.value(row) : system.free_rate(row));
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
  std::vector<ContactForce<T>> forces(modes.size(), {T(0.0), zero, zero});
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    ContactForce<T>& at = forces[static_cast<std::size_t>(unknowns[i].contact)];
    at.force += wrenches[i].force * x[static_cast<Eigen::Index>(i)];
    at.torque += wrenches[i].torque * x[static_cast<Eigen::Index>(i)];
  }
  for (std::size_t c = 0; c < forces.size(); ++c) forces[c].normal = terms.contacts[c].normal.dot(forces[c].force);
  return forces;
}

}  // namespace trajet
