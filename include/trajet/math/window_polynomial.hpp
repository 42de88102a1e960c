#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "trajet/math/polynomial.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// A function of u, |u| <= 1, as a polynomial of limited degree and a bound of how far the function is from it.
///
/// Sums and products of such functions are such functions: what their polynomials are cut by and what rounding does is
/// added to the bound (docs/design/first_contact.md). So the motion of one solid as another sees it, a product of four
/// quaternions' components and a position, stays a polynomial whose roots can be searched.
class WindowPolynomial {
 public:
  /// Enough for a turn of a radian and a half to the last digit: (3/4)^16 / 16! = 5e-16.
  static constexpr int kMaxDegree = 15;
  static constexpr int kSize = kMaxDegree + 1;
  using Coefficients = Eigen::Array<double, kSize, 1>;

  /// Zero.
  WindowPolynomial() = default;
  /// sum_k coefficients[k] u^k. `error`: how far a function may be from it, of which `cut` is what was left out of
  /// higher degrees.
  WindowPolynomial(const Coefficients& coefficients, int degree, double error, double cut)
      : coefficients_(coefficients), degree_(degree), error_(error), cut_(cut) {
    trim();
  }
  static WindowPolynomial constant(double value) {
    Coefficients c = Coefficients::Zero();
    c[0] = value;
    return {c, 0, 0.0, 0.0};
  }

  int degree() const { return degree_; }
  /// Those above the degree are zero.
  const Coefficients& coefficients() const { return coefficients_; }
  /// As many as the degree asks for, at least `count`.
  std::span<const double> span(int count = 1) const {
    return {coefficients_.data(), static_cast<std::size_t>(std::max(degree_ + 1, count))};
  }
  /// Bound of the distance from the function, for all |u| <= 1.
  double error() const { return error_; }
  /// The part of `error` that a shorter window makes smaller: what cutting the degree has left out.
  double cut() const { return cut_; }
  /// sum |c_k|: no less than the polynomial's size.
  double norm() const { return norm_; }
  /// sum k |c_k|
  double slope() const { return slope_; }

  double operator()(double u) const {
    double sum = coefficients_[degree_];
    for (int k = degree_ - 1; k >= 0; --k) sum = sum * u + coefficients_[k];
    return sum;
  }

 private:
  void trim();

  Coefficients coefficients_ = Coefficients::Zero();
  int degree_ = 0;
  double error_ = 0.0;
  double cut_ = 0.0;
  double norm_ = 0.0;
  double slope_ = 0.0;
};

/// sum_i s_i p_i of numbers s_i.
class LinearSum {
 public:
  void add(double s, const WindowPolynomial& p) {
    if (s == 0.0) return;
    coefficients_ += s * p.coefficients();
    degree_ = std::max(degree_, p.degree());
    norm_ += std::abs(s) * p.norm();
    error_ += std::abs(s) * p.error();
    cut_ += std::abs(s) * p.cut();
    ++terms_;
  }
  WindowPolynomial value() const {
    // each term is rounded once as a product and once in every sum that follows
    return {coefficients_, degree_, error_ + (terms_ + 1) * kUnitRoundoff * norm_, cut_};
  }

 private:
  WindowPolynomial::Coefficients coefficients_ = WindowPolynomial::Coefficients::Zero();
  int degree_ = 0;
  int terms_ = 0;
  double norm_ = 0.0;
  double error_ = 0.0;
  double cut_ = 0.0;
};

/// sum_i +-a_i b_i, cut off above WindowPolynomial::kMaxDegree.
class ProductSum {
 public:
  void add(const WindowPolynomial& a, const WindowPolynomial& b, double sign = 1.0);
  WindowPolynomial value() const;

 private:
  WindowPolynomial::Coefficients coefficients_ = WindowPolynomial::Coefficients::Zero();
  int degree_ = 0;
  int terms_ = 0;
  double norms_ = 0.0;   // sum of |a| |b|
  double slopes_ = 0.0;  // sum of |a|' |b| + |a| |b|'
  double error_ = 0.0;
  double cut_ = 0.0;
};

WindowPolynomial operator*(const WindowPolynomial& a, const WindowPolynomial& b);

/// A vector that depends on time.
using WindowVector = std::array<WindowPolynomial, 3>;
/// Its rows.
using WindowMatrix = std::array<WindowVector, 3>;

WindowPolynomial dot(const WindowVector& a, const WindowVector& b);
WindowPolynomial dot(const Vector3& a, const WindowVector& b);
WindowVector operator*(const WindowPolynomial& s, const WindowVector& v);
WindowVector operator*(const WindowMatrix& m, const WindowVector& v);
WindowVector operator*(const WindowMatrix& m, const Vector3& v);
/// m^T v
WindowVector transposed_times(const WindowMatrix& m, const WindowVector& v);
WindowVector transposed_times(const WindowMatrix& m, const Vector3& v);
WindowVector cross(const WindowVector& a, const WindowVector& b);
WindowVector cross(const Vector3& a, const WindowVector& b);
/// s a + t b
WindowVector combined(double s, const WindowVector& a, double t, const WindowVector& b);

inline Vector3 value(const WindowVector& v, double u) { return {v[0](u), v[1](u), v[2](u)}; }

}  // namespace trajet
