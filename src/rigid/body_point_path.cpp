#include "trajet/rigid/body_point_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace trajet {
namespace {

/// Coefficients of tau^0, tau^1, …
using Polynomial = Eigen::VectorXd;
using QuaternionPolynomial = std::array<Polynomial, 4>;  // w, x, y, z

Polynomial times(const Polynomial& a, const Polynomial& b) {
  Polynomial product = Polynomial::Zero(a.size() + b.size() - 1);
  for (Eigen::Index i = 0; i < a.size(); ++i) product.segment(i, b.size()) += a[i] * b;
  return product;
}

Polynomial sum(const Polynomial& a, const Polynomial& b) {
  Polynomial total = Polynomial::Zero(std::max(a.size(), b.size()));
  total.head(a.size()) += a;
  total.head(b.size()) += b;
  return total;
}

Polynomial constant(double value) { return Polynomial::Constant(1, value); }

/// Without the highest terms that add up to less than rounding over |tau| <= h, where the polynomial is of size 1.
Polynomial trimmed(const Polynomial& p, double h) {
  Eigen::Index size = p.size();
  double left_out = 0.0;
  while (size > 1) {
    left_out += std::abs(p[size - 1]) * std::pow(h, static_cast<double>(size - 1));
    if (left_out > 0.25 * std::numeric_limits<double>::epsilon()) break;
    --size;
  }
  return p.head(size);
}

/// a b, by Hamilton's rule.
QuaternionPolynomial product(const QuaternionPolynomial& a, const QuaternionPolynomial& b) {
  constexpr int kFactor[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};  // of b beside a_j in row i
  constexpr double kSign[4][4] = {{1, -1, -1, -1}, {1, 1, 1, -1}, {1, -1, 1, 1}, {1, 1, -1, 1}};
  QuaternionPolynomial result;
  for (std::size_t i = 0; i < 4; ++i) {
    result[i] = constant(0.0);
    for (std::size_t j = 0; j < 4; ++j)
      result[i] = sum(result[i], kSign[i][j] * times(a[j], b[static_cast<std::size_t>(kFactor[i][j])]));
  }
  return result;
}

Polynomial component(const Segment<>& segment, int index) { return segment.coefficients().row(index).transpose(); }

/// The exponential of the vector (u / 2), as small_rotation has it.
QuaternionPolynomial small_rotation(const std::array<Polynomial, 3>& u, double h) {
  Polynomial square = constant(0.0);
  for (const Polynomial& part : u) square = sum(square, times(part, part));
  const auto series = [&](const auto& c) {
    Polynomial value = constant(c.back());
    for (std::size_t k = c.size() - 1; k-- > 0;) value = trimmed(sum(times(value, square), constant(c[k])), h);
    return value;
  };
  const Polynomial half_sinc = 0.5 * series(detail::kHalfSinc);
  QuaternionPolynomial result{series(detail::kHalfCosine)};
  for (std::size_t i = 0; i < 3; ++i) result[i + 1] = trimmed(times(half_sinc, u[i]), h);
  return result;
}

QuaternionPolynomial quaternion(const Segment<>& segment, int first, const OrientationLayout& layout) {
  QuaternionPolynomial q;
  for (int i = 0; i < 4; ++i) q[static_cast<std::size_t>(i)] = component(segment, first + i);
  if (layout.way != OrientationWay::rotation_vector) return q;
  const QuaternionPolynomial step =
      small_rotation({component(segment, first + 4), component(segment, first + 5), component(segment, first + 6)},
                     std::abs(segment.duration()));
  for (Polynomial& part : q) part = trimmed(part, std::abs(segment.duration()));  // constant over the step
  return layout.frame == Frame::world ? product(step, q) : product(q, step);
}

double value(const Eigen::Ref<const Eigen::RowVectorXd>& coefficients, double tau) {
  double sum = 0.0;
  for (Eigen::Index k = coefficients.size(); k-- > 0;) sum = sum * tau + coefficients[k];
  return sum;
}

double rate(const Eigen::Ref<const Eigen::RowVectorXd>& coefficients, double tau) {
  double sum = 0.0;
  for (Eigen::Index k = coefficients.size(); k-- > 1;) sum = sum * tau + static_cast<double>(k) * coefficients[k];
  return sum;
}

}  // namespace

BodyPointPath::BodyPointPath(const Segment<>& segment, int position, int orientation, const OrientationLayout& layout,
                             const Vector3& p_B)
    : t0_(segment.t0()), t1_(segment.t1()), denominator_(constant(1.0)) {
  std::array<Polynomial, 3> swing;
  if (layout.way == OrientationWay::matrix) {
    for (int i = 0; i < 3; ++i) {
      Polynomial& row = swing[static_cast<std::size_t>(i)] = constant(0.0);
      for (int j = 0; j < 3; ++j) row = sum(row, p_B[j] * component(segment, orientation + 3 * i + j));
    }
  } else {
    const QuaternionPolynomial q = quaternion(segment, orientation, layout);
    const QuaternionPolynomial conjugate{q[0], -q[1], -q[2], -q[3]};
    const QuaternionPolynomial point{constant(0.0), constant(p_B.x()), constant(p_B.y()), constant(p_B.z())};
    const QuaternionPolynomial turned = product(product(q, point), conjugate);
    std::copy_n(turned.begin() + 1, 3, swing.begin());
    denominator_ = product(q, conjugate)[0];
  }
  std::array<Polynomial, 3> rows;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    rows[k] = sum(times(component(segment, position + i), denominator_), swing[k]);
  }
  numerator_.resize(3, rows[0].size());
  for (int i = 0; i < 3; ++i) numerator_.row(i) = rows[static_cast<std::size_t>(i)].transpose();
}

Vector3 BodyPointPath::position(double tau) const {
  const double d = value(denominator_.transpose(), tau);
  return Vector3(value(numerator_.row(0), tau), value(numerator_.row(1), tau), value(numerator_.row(2), tau)) / d;
}

Vector3 BodyPointPath::velocity(double tau) const {
  // (n / d)' = (n' - p d') / d
  const double d = value(denominator_.transpose(), tau), d_rate = rate(denominator_.transpose(), tau);
  const Vector3 n_rate(rate(numerator_.row(0), tau), rate(numerator_.row(1), tau), rate(numerator_.row(2), tau));
  return (n_rate - d_rate * position(tau)) / d;
}

}  // namespace trajet
