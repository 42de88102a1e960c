#include "trajet/scene/driven_frame.hpp"

#include <algorithm>
#include <cmath>

#include "trajet/math/number.hpp"

namespace trajet {
namespace {

using Coefficients = Segment<7>::Coefficients;

/// How long the polynomials in some rows hold to rounding: until their last two terms are below that of their others.
double duration_of(const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  const auto size = [&](Eigen::Index k) { return rows.col(k).cwiseAbs().maxCoeff(); };
  const Eigen::Index last = rows.cols() - 1;
  double duration = std::numeric_limits<double>::infinity();
  for (const Eigen::Index k : {last - 1, last}) {
    if (!(size(k) > 0.0)) continue;
    double longest = 0.0;
    for (Eigen::Index j = 0; j < last - 1; ++j)
      longest = std::max(longest, std::pow(kUnitRoundoff * size(j) / size(k), 1.0 / static_cast<double>(k - j)));
    duration = std::min(duration, longest);
  }
  return duration;
}

}  // namespace

// The rate of a state that the pose itself is: the series of the pose are those of the state, differentiated.
DrivenFrame::DrivenFrame(const World::Drive& drive) : drive_(drive), expansion_(drive.pose), switches_(drive.pose) {
  expansion_.leave_branches_by_time();
}

Segment<7> DrivenFrame::piece(double t, double until) {
  const TimeSwitches::Piece stretch =
      switches_.empty() ? TimeSwitches::Piece{t, until, until, false} : switches_.piece(t, until);
  Eigen::Matrix<double, 7, kOrder + 2> integrated;
  const Eigen::Matrix<double, 7, 1> nothing = Eigen::Matrix<double, 7, 1>::Zero();
  expansion_.expand(stretch.first, nothing.data(), kOrder + 1, integrated.data());
  Segment<7> piece;
  piece.resize(7, kOrder);
  Coefficients& coefficients = piece.coefficients();
  for (int k = 0; k <= kOrder; ++k) coefficients.col(k) = (k + 1.0) * integrated.col(k + 1);
  double duration = stretch.end - stretch.first;
  duration = std::min(duration, duration_of(coefficients.topRows<3>()));
  if (drive_.turns) duration = std::min(duration, duration_of(coefficients.bottomRows<4>()));
  int degree = kOrder;
  while (degree > 0 && coefficients.col(degree).isZero(0.0)) --degree;
  coefficients.conservativeResize(7, degree + 1);
  const double end = stretch.first + duration;
  piece.set_interval(stretch.first, end < stretch.end ? end : stretch.end);
  constexpr double kRoundings = 4.0;
  piece.error_bound() = kRoundings * kUnitRoundoff * coefficients.col(0).cwiseAbs();
  return piece;
}

FrameMotion DrivenFrame::at(double t) {
  const Segment<7> motion = piece(t, t + 1.0);
  const auto coefficient = [&](int k) -> Eigen::Matrix<double, 7, 1> {
    if (k > motion.degree()) return Eigen::Matrix<double, 7, 1>::Zero();
    return motion.coefficients().col(k);
  };
  const auto place = [&](int k) -> Vector3 { return coefficient(k).head<3>(); };
  const auto turn = [&](int k) -> Quaternion {
    const Eigen::Vector4d q = coefficient(k).tail<4>();
    return {q[0], q[1], q[2], q[3]};
  };
  FrameMotion result{.pivot = drive_.pivot, .p = place(0), .v = place(1), .acceleration = 2.0 * place(2)};
  if (!drive_.turns) return result;
  // w = 2 dq/dt q*, and its rate 2 d2q/dt2 q*
  const Quaternion back = turn(0).conjugate();
  result.R = rotation_matrix(turn(0));
  result.w = 2.0 * (turn(1) * back).vec();
  result.w_rate = 2.0 * 2.0 * (turn(2) * back).vec();
  return result;
}

}  // namespace trajet
