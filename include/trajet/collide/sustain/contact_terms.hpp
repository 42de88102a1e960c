#pragma once

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
  Vector3T<T> sticking;     ///< N: friction at the point that sticks while others slide
};

}  // namespace trajet
