#include "trajet/collide/detect/frame_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "trajet/math/polynomial.hpp"
#include "trajet/math/shift_rows.hpp"

namespace trajet {
namespace {

/// Of a view of a thing that turns: what is beyond is made small by the length of the piece.
constexpr int kDegree = 24;
/// How much of what is cut may be left, in roundings of the lengths that meet.
constexpr double kCut = 4.0;

using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// Products of series up to a degree.
class PowerSeries {
 public:
  explicit PowerSeries(int degree) : c_(static_cast<std::size_t>(degree) + 1, 0.0) {}
  double& operator[](int k) { return c_[static_cast<std::size_t>(k)]; }
  double operator[](int k) const { return c_[static_cast<std::size_t>(k)]; }
  int degree() const { return static_cast<int>(c_.size()) - 1; }

  /// += factor a b
  void add_product(double factor, const PowerSeries& a, const PowerSeries& b) {
    for (int i = 0; i <= a.degree(); ++i)
      for (int j = 0; j <= b.degree() && i + j <= degree(); ++j) (*this)[i + j] += factor * a[i] * b[j];
  }

 private:
  std::vector<double> c_;
};

/// The matrix of a unit quaternion.
std::array<std::array<PowerSeries, 3>, 3> rotation(const Segment<7>& frame) {
  const int degree = frame.degree();
  std::array<PowerSeries, 4> q{PowerSeries(degree), PowerSeries(degree), PowerSeries(degree), PowerSeries(degree)};
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k <= degree; ++k) q[static_cast<std::size_t>(i)][k] = frame.coefficients()(3 + i, k);
  const auto& [w, x, y, z] = q;
  const int twice = 2 * degree;
  const auto sum = [&](const PowerSeries& a, const PowerSeries& b, double sign, const PowerSeries& c,
                       const PowerSeries& d) {
    PowerSeries s(twice);
    s.add_product(2.0, a, b);
    s.add_product(2.0 * sign, c, d);
    return s;
  };
  const auto diagonal = [&](const PowerSeries& a, const PowerSeries& b) {
    PowerSeries s = sum(a, a, 1.0, b, b);
    for (int k = 0; k <= twice; ++k) s[k] = -s[k];
    s[0] += 1.0;
    return s;
  };
  return {{{diagonal(y, z), sum(x, y, -1.0, w, z), sum(x, z, 1.0, w, y)},
           {sum(x, y, 1.0, w, z), diagonal(x, z), sum(y, z, -1.0, w, x)},
           {sum(x, z, -1.0, w, y), sum(y, z, 1.0, w, x), diagonal(x, y)}}};
}

}  // namespace

Segment<3> view_from(const Segment<7>& frame, bool turns, const Vector3& pivot, const Segment<>& motion, int offset) {
  const double t0 = frame.t0();
  Rows apart = Rows::Zero(3, std::max(motion.degree(), frame.degree()) + 1);
  Rows point = motion.coefficients().middleRows<3>(offset);
  shift_rows(point, t0 - motion.t0());
  const double reach = point.col(0).norm() + frame.coefficients().col(0).head<3>().norm() + pivot.norm();
  apart.leftCols(point.cols()) = point;
  apart.leftCols(frame.degree() + 1) -= frame.coefficients().topRows<3>();

  Segment<3> view;
  const Vector3 error = motion.error_bound().segment<3>(offset) + frame.error_bound().head<3>();
  if (!turns) {
    view.resize(3, static_cast<int>(apart.cols()) - 1);
    view.error_bound() = error;
    view.coefficients() = apart;
    view.coefficients().col(0) += pivot;
    view.set_interval(t0, frame.t1());
    return view;
  }

  const auto R = rotation(frame);
  std::array<PowerSeries, 3> d{PowerSeries(static_cast<int>(apart.cols()) - 1),
                               PowerSeries(static_cast<int>(apart.cols()) - 1),
                               PowerSeries(static_cast<int>(apart.cols()) - 1)};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < apart.cols(); ++k) d[static_cast<std::size_t>(i)][k] = apart(i, k);
  const int full = R[0][0].degree() + d[0].degree();
  const int degree = std::min(full, kDegree);
  Rows products = Rows::Zero(3, full + 1);
  for (std::size_t i = 0; i < 3; ++i) {
    PowerSeries x(full);
    for (std::size_t j = 0; j < 3; ++j) x.add_product(1.0, R[j][i], d[j]);
    for (int k = 0; k <= full; ++k) products(static_cast<Eigen::Index>(i), k) = x[k];
  }
  double duration = frame.t1() - t0;
  const auto cut = [&] {
    double sum = 0.0, power = std::pow(duration, degree + 1);
    for (int k = degree + 1; k <= full; ++k, power *= duration)
      sum += power * products.col(k).lpNorm<Eigen::Infinity>();
    return sum;
  };
  const auto size = [&] {
    double sum = reach, power = 1.0;
    for (int k = 0; k < apart.cols(); ++k, power *= duration) sum += power * apart.col(k).lpNorm<Eigen::Infinity>();
    return sum;
  };
  while (cut() > kCut * kUnitRoundoff * size()) duration *= 0.75;
  view.resize(3, degree);
  view.coefficients() = products.leftCols(degree + 1);
  view.coefficients().col(0) += pivot;
  view.error_bound().setConstant(error.norm() + cut() + frame.error_bound().tail<4>().norm() * apart.col(0).norm());
  view.set_interval(t0, duration < frame.t1() - t0 ? t0 + duration : frame.t1());
  return view;
}

}  // namespace trajet
