#pragma once

#include <optional>

#include "trajet/geom/closest_features.hpp"
#include "trajet/rigid/frame_path.hpp"

namespace trajet::detail {

/// Two frames A and B over a window of time, t = middle + half u, and B as A sees it; all times the positive
/// D = |q_A|^2 |q_B|^2, so that it stays polynomial.
class RelativeMotion {
 public:
  RelativeMotion(const FramePath& a, const FramePath& b, double middle, double half);

  double middle() const { return middle_; }
  double half() const { return half_; }
  double time(double u) const { return middle_ + half_ * u; }

  const FrameWindow& a() const { return a_; }
  const FrameWindow& b() const { return b_; }
  /// p_WB - p_WA
  const WindowVector& apart() const { return apart_; }
  const WindowPolynomial& D() const { return D_; }
  /// D R_AB
  const WindowMatrix& M() const;
  /// D p_AB, in A
  const WindowVector& X() const;
  /// D p_AB, in B
  WindowVector Y() const;

  /// What a separation of points within `size` of the origins is off by, m, without what is cut.
  double rounding(double size) const;

 private:
  double middle_;
  double half_;
  FrameWindow a_;
  FrameWindow b_;
  WindowVector apart_;
  WindowPolynomial D_;
  mutable std::optional<WindowMatrix> M_;
  mutable std::optional<WindowVector> X_;
};

/// B's frame in A's at one time.
RelativePose relative_pose(const FramePose& a, const FramePose& b);

}  // namespace trajet::detail
