#include "trajet/rigid/frame_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

namespace trajet {
namespace {

using Column = Eigen::Array<double, 4, 1>;
using Rows = Eigen::Matrix<double, 4, Eigen::Dynamic>;

/// |q|^2 and |q|^2 R_WB, polynomials of the quaternion.
void turn(const WindowPolynomial* q, WindowMatrix& N, WindowPolynomial& D) {
  std::array<std::array<WindowPolynomial, 4>, 4> s;  // q_i q_j, i <= j
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i; j < 4; ++j) s[i][j] = q[i] * q[j];
  const auto sum = [&](double ww, double xx, double yy, double zz) {
    LinearSum l;
    l.add(ww, s[0][0]), l.add(xx, s[1][1]), l.add(yy, s[2][2]), l.add(zz, s[3][3]);
    return l.value();
  };
  D = sum(1, 1, 1, 1);
  N[0][0] = sum(1, 1, -1, -1), N[1][1] = sum(1, -1, 1, -1), N[2][2] = sum(1, -1, -1, 1);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const WindowPolynomial& ij = s[std::min(i, j) + 1][std::max(i, j) + 1];
    for (const bool is_upper : {true, false}) {
      LinearSum l;
      l.add(2.0, ij), l.add(is_upper ? -2.0 : 2.0, s[0][k + 1]);
      (is_upper ? N[i][j] : N[j][i]) = l.value();
    }
  }
}

/// Four rows of coefficients of tau^k, tau = begin + half u, as polynomials of u.
std::array<WindowPolynomial, 4> on_window(const Rows& rows, double begin, double half) {
  std::array<WindowPolynomial, 4> component;
  const int degree = static_cast<int>(rows.cols()) - 1;
  if (degree == 0) {
    for (std::size_t i = 0; i < 4; ++i) component[i] = WindowPolynomial::constant(rows(static_cast<int>(i), 0));
    return component;
  }
  // p(begin + half u) by repeated synthetic division
  Eigen::Array<double, 4, Eigen::Dynamic, 0, 4, kMaxPolynomialDegree + 1> c = rows;
  // of all that coefficient j gives to others, no term passes more than 3j + 2 roundings
  const double far = std::abs(begin) + std::abs(half);
  Column magnitude = Column::Zero();
  for (int k = degree; k >= 0; --k) magnitude = magnitude * far + (3.0 * k + 3.0) * c.col(k).abs();
  for (int i = 0; i < degree; ++i)
    for (int k = degree - 1; k >= i; --k) c.col(k) += begin * c.col(k + 1);
  double power = 1.0;
  Column cut = Column::Zero();
  for (int k = 0; k <= degree; ++k) {
    c.col(k) *= power;
    power *= half;
    if (k > WindowPolynomial::kMaxDegree) cut += c.col(k).abs();
  }
  const int kept = std::min(degree, WindowPolynomial::kMaxDegree);
  for (int i = 0; i < 4; ++i) {
    WindowPolynomial::Coefficients row = WindowPolynomial::Coefficients::Zero();
    for (int k = 0; k <= kept; ++k) row[k] = c(i, k);
    component[static_cast<std::size_t>(i)] = {row, kept, kUnitRoundoff * magnitude[i] + cut[i], cut[i]};
  }
  return component;
}

/// Without the highest coefficients that are zero.
Rows shortened(Rows rows) {
  Eigen::Index size = rows.cols();
  while (size > 1 && rows.col(size - 1).isZero(0.0)) --size;
  return rows.leftCols(size);
}

/// The values at tau and their derivatives.
void evaluate(const Rows& rows, double tau, Column& x, Column& dx) {
  x = rows.col(rows.cols() - 1);
  dx = Column::Zero();
  for (Eigen::Index k = rows.cols() - 1; k-- > 0;) {
    dx = dx * tau + x;
    x = x * tau + rows.col(k).array();
  }
}

}  // namespace

FramePath::FramePath(double t0, double t1, const Coefficients& coefficients, const Values& error_bound)
    : t0_(t0), t1_(t1), error_bound_(error_bound) {
  if (coefficients.cols() == 0) throw std::domain_error("a path needs a coefficient");
  if (coefficients.cols() > kMaxPolynomialDegree + 1) throw std::length_error("path of too high a degree");
  Rows rows = Rows::Zero(4, coefficients.cols());
  rows.topRows<3>() = coefficients.topRows<3>();
  position_ = shortened(rows);
  orientation_ = shortened(coefficients.bottomRows<4>());
}

FramePath::Coefficients FramePath::coefficients() const {
  Coefficients c = Coefficients::Zero(7, std::max(position_.cols(), orientation_.cols()));
  c.topLeftCorner(3, position_.cols()) = position_.topRows<3>();
  c.bottomLeftCorner(4, orientation_.cols()) = orientation_;
  return c;
}

FramePath FramePath::at_rest(const Vector3& p_WB, const Quaternion& q_WB) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  FramePath path(0.0, 0.0, (Coefficients(7, 1) << p_WB, q_WB.w(), q_WB.x(), q_WB.y(), q_WB.z()).finished());
  path.t0_ = -kInfinity;
  path.t1_ = kInfinity;
  return path;
}

FramePose FramePath::pose(double t) const {
  const double tau = is_at_rest() ? 0.0 : t - t0_;
  Column p, v, x, dx;
  evaluate(position_, tau, p, v);
  evaluate(orientation_, tau, x, dx);
  FramePose pose;
  pose.p_WB = p.head<3>();
  pose.v_WB = v.head<3>();
  const Quaternion q(x[0], x[1], x[2], x[3]), dq(dx[0], dx[1], dx[2], dx[3]);
  const double norm2 = q.squaredNorm();
  pose.R_WB = rotation_matrix(q) / norm2;
  // dq/dt = 1/2 (0, w_WB_W) q, and what lengthens q is not in the vector part
  pose.w_WB_W = (dq * q.conjugate()).vec() * (2.0 / norm2);
  return pose;
}

Range FramePath::range(int i, double from, double to) const {
  const Eigen::VectorXd coefficients = i < 3 ? position_.row(i) : orientation_.row(i - 3);
  if (coefficients.size() == 1) return {coefficients[0], coefficients[0]};
  const std::span<const double> span(coefficients.data(), static_cast<std::size_t>(coefficients.size()));
  return BernsteinForm(span, from - t0_, to - t0_).value_range();
}

double FramePath::point_error(double reach) const {
  // a unit quaternion that is off by e turns by at most 2 e
  return error_bound_.head<3>().norm() + 2.0 * reach * error_bound_.tail<4>().norm();
}

FrameWindow::FrameWindow(const FramePath& path, double middle, double half) : p(position_window(path, middle, half)) {
  turn(on_window(path.orientation(), path.is_at_rest() ? 0.0 : middle - path.t0(), half).data(), N, D);
}

WindowVector position_window(const FramePath& path, double middle, double half) {
  const auto component = on_window(path.position(), path.is_at_rest() ? 0.0 : middle - path.t0(), half);
  return {component[0], component[1], component[2]};
}

}  // namespace trajet
