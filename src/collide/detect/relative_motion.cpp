#include "relative_motion.hpp"

#include <algorithm>

namespace trajet::detail {

RelativeMotion::RelativeMotion(const FramePath& a, const FramePath& b, double middle, double half)
    : middle_(middle),
      half_(half),
      a_(a, middle, half),
      b_(b, middle, half),
      apart_(combined(1.0, b_.p, -1.0, a_.p)),
      D_(a_.D * b_.D) {}

const WindowMatrix& RelativeMotion::M() const {
  if (!M_) {
    M_.emplace();
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        ProductSum sum;
        for (std::size_t k = 0; k < 3; ++k) sum.add(a_.N[k][i], b_.N[k][j]);
        (*M_)[i][j] = sum.value();
      }
  }
  return *M_;
}

const WindowVector& RelativeMotion::X() const {
  if (!X_) X_ = b_.D * transposed_times(a_.N, apart_);
  return *X_;
}

WindowVector RelativeMotion::Y() const { return a_.D * transposed_times(b_.N, apart_); }

double RelativeMotion::rounding(double size) const {
  double p_error = 0.0, p_norm = 0.0;
  for (const WindowPolynomial& p : apart_) p_error += p.error() - p.cut(), p_norm += p.norm() + p.slope();
  // a product of two is off by what each is off by, and some ten roundings of its own in each of three terms
  constexpr double kRoundings = 30.0 * kUnitRoundoff;
  const double turn = a_.D.error() - a_.D.cut() + b_.D.error() - b_.D.cut() + kRoundings;
  return p_error + turn * (p_norm + size);
}

RelativePose relative_pose(const FramePose& a, const FramePose& b) {
  return {a.R_WB.transpose() * (b.p_WB - a.p_WB), a.R_WB.transpose() * b.R_WB};
}

}  // namespace trajet::detail
