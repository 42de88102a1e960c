#include "trajet/math/window_polynomial.hpp"

namespace trajet {

using Coefficients = WindowPolynomial::Coefficients;

namespace {

alignas(64) constexpr auto kPowers = [] {
  std::array<double, WindowPolynomial::kSize> k{};
  for (std::size_t i = 0; i < k.size(); ++i) k[i] = static_cast<double>(i);
  return k;
}();

}  // namespace

/// Leaves out the highest terms that are below rounding, and takes the sizes.
void WindowPolynomial::trim() {
  const Coefficients size = coefficients_.abs();
  norm_ = size.sum();
  const double negligible = 0.125 * kUnitRoundoff * norm_;
  double left_out = 0.0;
  while (degree_ > 0 && left_out + size[degree_] <= negligible) {
    left_out += size[degree_];
    coefficients_[degree_--] = 0.0;
  }
  error_ += left_out;
  slope_ = (Eigen::Map<const Coefficients>(kPowers.data()) * size).sum();
}

void ProductSum::add(const WindowPolynomial& a, const WindowPolynomial& b, double sign) {
  if (b.degree() < a.degree()) return add(b, a, sign);
  constexpr int kSize = WindowPolynomial::kSize;
  if (a.degree() == 0) {
    coefficients_ += (sign * a.coefficients()[0]) * b.coefficients();
  } else {
    // row i of the product is b, moved up by i; even and odd rows apart, so that sums need not wait for each other
    alignas(64) std::array<double, 2 * kSize> moved;
    Eigen::Map<Coefficients>(moved.data()).setZero();
    Eigen::Map<Coefficients>(moved.data() + kSize) = b.coefficients();
    const auto row = [&](int i) {
      return (sign * a.coefficients()[i]) * Eigen::Map<const Coefficients>(moved.data() + kSize - i);
    };
    Coefficients even = row(0), odd = row(1);
    int i = 2;
    for (; i < a.degree(); i += 2) {
      even += row(i);
      odd += row(i + 1);
    }
    if (i == a.degree()) even += row(i);
    coefficients_ += even + odd;
  }

  double dropped = 0.0;
  if (a.degree() + b.degree() > WindowPolynomial::kMaxDegree) {
    double tail = 0.0;  // sum of |b_j| from kSize - i on
    int j = b.degree() + 1;
    for (int i = 0; i <= a.degree(); ++i) {
      while (j > kSize - i) tail += std::abs(b.coefficients()[--j]);
      dropped += std::abs(a.coefficients()[i]) * tail;
    }
  }
  degree_ = std::max(degree_, std::min(WindowPolynomial::kMaxDegree, a.degree() + b.degree()));
  norms_ += a.norm() * b.norm();
  slopes_ += a.slope() * b.norm() + a.norm() * b.slope();
  error_ += dropped + a.norm() * b.error() + b.norm() * a.error() + a.error() * b.error();
  cut_ += dropped + a.norm() * b.cut() + b.norm() * a.cut();
  ++terms_;
}

WindowPolynomial ProductSum::value() const {
  // coefficient k is a sum of at most m (k + 1) products
  const double rounding = kUnitRoundoff * ((terms_ + 2) * norms_ + terms_ * slopes_);
  return {coefficients_, degree_, error_ + rounding, cut_};
}

WindowPolynomial operator*(const WindowPolynomial& a, const WindowPolynomial& b) {
  ProductSum sum;
  sum.add(a, b);
  return sum.value();
}

WindowPolynomial dot(const WindowVector& a, const WindowVector& b) {
  ProductSum sum;
  for (std::size_t i = 0; i < 3; ++i) sum.add(a[i], b[i]);
  return sum.value();
}

WindowPolynomial dot(const Vector3& a, const WindowVector& b) {
  LinearSum sum;
  for (std::size_t i = 0; i < 3; ++i) sum.add(a[static_cast<int>(i)], b[i]);
  return sum.value();
}

WindowVector operator*(const WindowPolynomial& s, const WindowVector& v) { return {s * v[0], s * v[1], s * v[2]}; }

WindowVector operator*(const WindowMatrix& m, const WindowVector& v) {
  return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}

WindowVector operator*(const WindowMatrix& m, const Vector3& v) { return {dot(v, m[0]), dot(v, m[1]), dot(v, m[2])}; }

WindowVector transposed_times(const WindowMatrix& m, const WindowVector& v) {
  WindowVector w;
  for (std::size_t i = 0; i < 3; ++i) {
    ProductSum sum;
    for (std::size_t j = 0; j < 3; ++j) sum.add(m[j][i], v[j]);
    w[i] = sum.value();
  }
  return w;
}

WindowVector transposed_times(const WindowMatrix& m, const Vector3& v) {
  WindowVector w;
  for (std::size_t i = 0; i < 3; ++i) {
    LinearSum sum;
    for (std::size_t j = 0; j < 3; ++j) sum.add(v[static_cast<int>(j)], m[j][i]);
    w[i] = sum.value();
  }
  return w;
}

WindowVector cross(const WindowVector& a, const WindowVector& b) {
  WindowVector c;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    ProductSum sum;
    sum.add(a[j], b[k]);
    sum.add(a[k], b[j], -1.0);
    c[i] = sum.value();
  }
  return c;
}

WindowVector cross(const Vector3& a, const WindowVector& b) {
  WindowVector c;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    LinearSum sum;
    sum.add(a[j], b[static_cast<std::size_t>(k)]);
    sum.add(-a[k], b[static_cast<std::size_t>(j)]);
    c[static_cast<std::size_t>(i)] = sum.value();
  }
  return c;
}

WindowVector combined(double s, const WindowVector& a, double t, const WindowVector& b) {
  WindowVector c;
  for (std::size_t i = 0; i < 3; ++i) {
    LinearSum sum;
    sum.add(s, a[i]);
    sum.add(t, b[i]);
    c[i] = sum.value();
  }
  return c;
}

}  // namespace trajet
