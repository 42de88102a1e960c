#pragma once

#include <Eigen/Core>

#include "trajet/math/bernstein.hpp"
#include "trajet/math/quaternion.hpp"
#include "trajet/math/vector.hpp"
#include "trajet/math/window_polynomial.hpp"

namespace trajet {

/// A frame B in the world at one time, and how it moves. SI units.
struct FramePose {
  Vector3 p_WB = Vector3::Zero();
  Matrix3 R_WB = Matrix3::Identity();
  Vector3 v_WB = Vector3::Zero();
  Vector3 w_WB_W = Vector3::Zero();

  Vector3 point(const Vector3& p_B) const { return p_WB + R_WB * p_B; }
  /// Of the point fixed in B that is at p_W now.
  Vector3 velocity_at(const Vector3& p_W) const { return v_WB + w_WB_W.cross(p_W - p_WB); }
};

/// Where the frame B of a thing is over a span of time, whatever moves it: position and orientation as polynomials in
/// tau = t - t0.
///
/// The orientation is R_WB = N(q) / |q|^2 of a quaternion (w, x, y, z) that need not be a unit one, so that whatever
/// polynomials are given, the motion is rigid.
class FramePath {
 public:
  /// Rows x y z, m, and w x y z; column k holds the coefficients of tau^k.
  using Coefficients = Eigen::Matrix<double, 7, Eigen::Dynamic>;
  using Values = Eigen::Matrix<double, 7, 1>;

  /// `error_bound`: how far each component may be off, as a Segment says. t1 may be less than t0. Throws
  /// std::length_error for a degree above kMaxPolynomialDegree, std::domain_error for no coefficient at all.
  FramePath(double t0, double t1, const Coefficients& coefficients, const Values& error_bound = Values::Zero());
  /// A frame that stays where it is, at all times.
  static FramePath at_rest(const Vector3& p_WB, const Quaternion& q_WB);

  double t0() const { return t0_; }
  double t1() const { return t1_; }
  bool is_at_rest() const { return position_.cols() == 1 && orientation_.cols() == 1; }
  FramePose pose(double t) const;
  /// Encloses component i between two times.
  Range range(int i, double from, double to) const;
  /// Bound of the distance by which the path is off at a point that is at most `reach` (m) from B's origin, m.
  double point_error(double reach) const;

  /// Rows of x y z; a fourth one is zero.  // (4 x degree+1)
  const Eigen::Matrix<double, 4, Eigen::Dynamic>& position() const { return position_; }
  /// Rows w x y z.  // (4 x degree+1)
  const Eigen::Matrix<double, 4, Eigen::Dynamic>& orientation() const { return orientation_; }
  /// As they were given.  // (7 x degree+1)
  Coefficients coefficients() const;

 private:
  double t0_;
  double t1_;
  Eigen::Matrix<double, 4, Eigen::Dynamic> position_;
  Eigen::Matrix<double, 4, Eigen::Dynamic> orientation_;
  Values error_bound_;
};

/// A FramePath over a window of time, t = middle + half u for |u| <= 1; all that a pair of solids needs of one of them.
/// A negative `half` runs backward in time.
struct FrameWindow {
  FrameWindow(const FramePath& path, double middle, double half);

  WindowVector p{};      ///< p_WB
  WindowMatrix N{};      ///< D R_WB
  WindowPolynomial D{};  ///< |q|^2
};

/// p_WB alone over such a window, which may be longer than one in which the orientation keeps its digits.
WindowVector position_window(const FramePath& path, double middle, double half);

}  // namespace trajet
