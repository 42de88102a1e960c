#pragma once

#include <Eigen/Core>
#include <array>
#include <cassert>
#include <span>
#include <stdexcept>

#include "trajet/math/bernstein.hpp"
#include "trajet/math/polynomial.hpp"
#include "trajet/ode/segment.hpp"

namespace trajet {

/// Chosen components of a Segment as polynomials in tau = t - t0, each in a row of its own, ready for root searches.
///
/// `Count` is their number, or Eigen::Dynamic. Nothing is allocated when it is fixed.
template <int Count>
class Path {
 public:
  using Values = Eigen::Matrix<double, Count, 1>;

  /// Components `indices[0]`, `indices[1]`, … of `segment`.
  /// Throws std::length_error where its degree is above kMaxPolynomialDegree.
  template <int Dim>
  Path(const Segment<Dim>& segment, std::span<const int> indices)
      : t0_(segment.t0()),
        t1_(segment.t1()),
        rows_(static_cast<Eigen::Index>(indices.size()), checked_degree(segment.degree()) + 1) {
    error_bound_.resize(rows_.rows());
    for (int i = 0; i < count(); ++i) {
      const int component = indices[static_cast<std::size_t>(i)];
      rows_.row(i) = segment.coefficients().row(component);
      error_bound_[i] = segment.error_bound()[component];
    }
  }

  /// `Count` components that follow each other, from `first` on: a position.
  template <int Dim>
  requires(Count != Eigen::Dynamic) Path(const Segment<Dim>& segment, int first)
      : Path(segment, std::span<const int>(consecutive(first))) {}

  int count() const { return static_cast<int>(rows_.rows()); }
  double t0() const { return t0_; }
  double t1() const { return t1_; }
  /// Coefficients of tau^0, tau^1, … of component `i`.
  std::span<const double> coefficients(int i) const {
    return {rows_.data() + i * rows_.cols(), static_cast<std::size_t>(rows_.cols())};
  }
  bool is_finite() const { return rows_.allFinite(); }
  int degree() const { return static_cast<int>(rows_.cols()) - 1; }
  /// What the step that made the Segment may have added to the error of each component.
  const Values& error_bound() const { return error_bound_; }

  /// The components' values at tau.
  Values value(double tau) const {
    Values values(count());
    for (int i = 0; i < count(); ++i) values[i] = evaluate_polynomial(coefficients(i), tau).jet.value;
    return values;
  }

  /// The components' rates at tau.
  Values rate(double tau) const {
    Values rates(count());
    for (int i = 0; i < count(); ++i) rates[i] = evaluate_polynomial(coefficients(i), tau).jet.rate;
    return rates;
  }

  /// Encloses component `i` for all tau between `from` and `to`.
  Range range(int i, double from, double to) const { return BernsteinForm(coefficients(i), from, to).value_range(); }

 private:
  static int checked_degree(int degree) {
    if (degree > kMaxPolynomialDegree) throw std::length_error("segment of too high a degree");
    return degree;
  }
  static std::array<int, Count == Eigen::Dynamic ? 0 : static_cast<std::size_t>(Count)> consecutive(int first) {
    std::array<int, static_cast<std::size_t>(Count)> indices;
    for (int& index : indices) index = first++;
    return indices;
  }

  double t0_;
  double t1_;
  Eigen::Matrix<double, Count, Eigen::Dynamic, Eigen::RowMajor, Count,
                Count == Eigen::Dynamic ? Eigen::Dynamic : kMaxPolynomialDegree + 1>
      rows_;
  Values error_bound_;
};

/// The path of a point in space.
using PointPath = Path<3>;

}  // namespace trajet
