#pragma once

#include <Eigen/Core>

#include "trajet/ode/segment.hpp"
#include "trajet/rigid/orientation.hpp"

namespace trajet {

/// The way in the world of a point fixed in a solid, over one Segment: three rational functions of tau = t - t0 with
/// one denominator,
///
///     p(tau) = numerator(tau) / denominator(tau) = r(tau) + q(tau) (0, p_B) q(tau)* / |q(tau)|^2
///
/// for the centre of mass r and the quaternion q of the Segment, polynomials of its degree d. The numerator has degree
/// 3 d, the denominator |q|^2 degree 2 d. It is positive: the quaternion of a step stays near a unit one. The quotient
/// is a rotation whatever the length of q, so that the way is as smooth as the Segments are, across their joints too.
///
/// - `matrix`: p = r + R p_B, a polynomial of degree d, as the numbers have it; the denominator is 1.
/// - `rotation-vector`: the quaternion is the exponential of a polynomial, expanded until what is left is rounding.
///   The degree is then larger by as much as the step is long.
/// - `exact`: the Segment of the numbers; the closed form itself is no polynomial.
class BodyPointPath {
 public:
  using Coefficients = Eigen::Matrix3Xd;

  /// `position` and `orientation`: where the state holds the centre of mass, m, and the numbers of the layout. p_B in
  /// the body's frame, m.
  BodyPointPath(const Segment<>& segment, int position, int orientation, const OrientationLayout& layout,
                const Vector3& p_B);

  double t0() const { return t0_; }
  double t1() const { return t1_; }
  /// Coefficients of tau^0, tau^1, ….  // (3 x n), m
  const Coefficients& numerator() const { return numerator_; }
  const Eigen::VectorXd& denominator() const { return denominator_; }  // (n)

  /// World frame, m; tau in s.
  Vector3 position(double tau) const;
  /// m/s
  Vector3 velocity(double tau) const;

 private:
  double t0_, t1_;
  Coefficients numerator_;
  Eigen::VectorXd denominator_;
};

}  // namespace trajet
