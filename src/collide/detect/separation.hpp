#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>

#include "relative_motion.hpp"
#include "trajet/collide/detect/witness_axis.hpp"
#include "trajet/geom/convex_core.hpp"
#include "trajet/math/root_search.hpp"

namespace trajet::detail {

/// Where the separation along an axis ends, and the pair of vertices whose it is.
struct SeparationZero {
  double u = 0.0;
  double error = 0.0;  ///< half width, in u
  int a = -1;          ///< vertices; -1: the axis is that of a face, or of a fixed direction, which has one height
  int b = -1;
  bool at_begin = false;
  bool at_end = false;
  RootKind kind = RootKind::crossing;
  double rate = 0.0;       ///< of the separation by u, m
  double curvature = 0.0;  ///< m
};

/// The separation of two convex cores along an axis, over a window: everything of B less everything of A.
///
///     w s = base - h_A(a) - h_B(-b) - rounding w
///
/// with the support functions h of the cores and the axis times w > 0 in the frames of A and B, a and b: polynomials of
/// u, as base is.
class Separation {
 public:
  Separation(const ConvexCore& A, const ConvexCore& B, const RelativeMotion& motion, const WitnessAxis& axis);

  /// Whether more was cut off the polynomials than rounding makes: then the window is too long for this axis.
  bool is_coarse() const { return is_coarse_; }

  /// The first u from `begin` on at which the separation is not positive. One of zero at the begin that grows is left
  /// behind, as is one above -`begin_tolerance` (m). Of kind `unresolved` where that cannot be shown.
  std::optional<SeparationZero> first_zero(double begin, double begin_tolerance) const;

  /// Below this the separation at u cannot be told from zero, m.
  double resolution(double u) const { return 3.0 * (error_ + roundings_) / weight(u); }

  /// Whether the separation is zero within the tolerance from `begin` to the end, as far as the last first_zero saw.
  bool stays_at_zero() const { return stays_at_zero_; }

 private:
  static constexpr int kSize = WindowPolynomial::kSize;
  /// Bernstein coefficients on [begin, 1] of base, a, b and w; row k is the control vector k.
  using Controls = Eigen::Array<double, 8, kSize>;
  using Row = Eigen::Array<double, kSize, 1>;

  void take_in_a(const RelativeMotion& motion, const Vector3& n);
  void take_in_b(const RelativeMotion& motion, const Vector3& n);
  void take_edges(const RelativeMotion& motion, const WitnessAxis& axis);
  void take_points_in_a(const RelativeMotion& motion, const WitnessAxis& axis);
  void take_points_in_b(const RelativeMotion& motion, const WitnessAxis& axis);
  void take_errors();
  Controls controls(double begin) const;
  double weight(double u) const;
  void search(int i, int j, double begin, double begin_tolerance, double& end,
              std::optional<SeparationZero>& first) const;
  template <class Function>
  void search(const Function& function, double error, int i, int j, double begin, double begin_tolerance, double& end,
              std::optional<SeparationZero>& first) const;
  SeparationZero zero_at(const Root& root, const FunctionSample& sample, double error, int i, int j,
                         double begin) const;

  const ConvexCore& A_;
  const ConvexCore& B_;
  double rounding_;
  WindowPolynomial base_;
  WindowVector a_;      ///< the axis times w in A
  WindowVector b_;      ///< ... in B
  WindowPolynomial w_;  ///< where the axis's length is that of a unit vector
  bool has_a_ = true;   ///< else A's height along the axis is in base
  bool has_b_ = true;
  bool is_turning_ = false;  ///< w is |a|, else w_
  int skip_a_ = -1;          ///< a vertex that lies as far along the axis as another one, always
  int skip_b_ = -1;
  double error_ = 0.0;      ///< of base, a and b in w s
  double roundings_ = 0.0;  ///< ... of evaluating their sum
  double size_ = 0.0;       ///< the largest that w s and its parts can be
  int degree_ = 0;
  bool is_coarse_ = false;
  mutable bool stays_at_zero_ = false;
};

/// Of the edges, or other lines, to which an axis is orthogonal, each in the frame of its solid.
Vector3 line_of_a(const ConvexCore& A, const WitnessAxis& axis);
Vector3 line_of_b(const ConvexCore& B, const WitnessAxis& axis);

/// Unit, in A's frame, from A to B; zero where the features leave it open.
Vector3 axis_direction(const ConvexCore& A, const ConvexCore& B, const RelativePose& pose, const WitnessAxis& axis);

/// Along a unit vector of A's frame, m.
double separation_along(const ConvexCore& A, const ConvexCore& B, const RelativePose& pose, const Vector3& direction);

}  // namespace trajet::detail
