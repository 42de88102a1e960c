#pragma once

#include <Eigen/Core>
#include <cassert>

namespace trajet {

/// The highest degree in time that a Segment of fixed dimension can hold without allocation.
inline constexpr int kMaxSegmentDegree = 32;

/// The motion over one accepted step: every component of the state as a polynomial in time.
///
/// q_i(t) = sum_k coefficients(i, k) (t - t0)^k for t between t0 and t1. Integrators write Segments; impacts, samples,
/// plots and reports only read them. Segments of a run partition time: each one stands for [t0, t1).
///
/// `Dim` is the dimension of the state, or Eigen::Dynamic.
template <int Dim = Eigen::Dynamic>
class Segment {
 public:
  using State = Eigen::Matrix<double, Dim, 1>;
  // Eigen calls a single row row-major; in memory it is the same.
  using Coefficients = Eigen::Matrix<double, Dim, Eigen::Dynamic, Dim == 1 ? Eigen::RowMajor : Eigen::ColMajor, Dim,
                                     Dim == Eigen::Dynamic ? Eigen::Dynamic : kMaxSegmentDegree + 1>;

  /// Makes room for a polynomial of `degree` in `dimension` components. Allocates only when the size changes.
  void resize(int dimension, int degree) {
    coefficients_.resize(dimension, degree + 1);
    error_bound_.resize(dimension);
  }

  void set_interval(double t0, double t1) {
    t0_ = t0;
    t1_ = t1;
  }

  double t0() const { return t0_; }
  /// May be less than t0: an integration can run backward.
  double t1() const { return t1_; }
  double duration() const { return t1_ - t0_; }
  int dimension() const { return static_cast<int>(coefficients_.rows()); }
  int degree() const { return static_cast<int>(coefficients_.cols()) - 1; }

  /// Column k holds the coefficients of (t - t0)^k.  // (dimension x degree+1)
  Coefficients& coefficients() { return coefficients_; }
  const Coefficients& coefficients() const { return coefficients_; }

  /// Estimated bound of the error that this step adds to each component, in the component's unit.
  State& error_bound() { return error_bound_; }
  const State& error_bound() const { return error_bound_; }

  /// Component `i` at time `t`.
  double value(int i, double t) const {
    const double tau = t - t0_;
    double sum = coefficients_(i, degree());
    for (int k = degree() - 1; k >= 0; --k) sum = sum * tau + coefficients_(i, k);
    return sum;
  }

  /// Time derivative of component `i` at time `t`.
  double derivative(int i, double t) const {
    const double tau = t - t0_;
    double sum = 0.0;
    for (int k = degree(); k >= 1; --k) sum = sum * tau + k * coefficients_(i, k);
    return sum;
  }

  /// The whole state at time `t`, into `q`.
  template <class Vector>
  void evaluate(double t, Vector& q) const {
    const double tau = t - t0_;
    q = coefficients_.col(degree());
    for (int k = degree() - 1; k >= 0; --k) q = q * tau + coefficients_.col(k);
  }

  State state(double t) const {
    State q(dimension());
    evaluate(t, q);
    return q;
  }

 private:
  double t0_ = 0.0;
  double t1_ = 0.0;
  Coefficients coefficients_;
  State error_bound_;
};

}  // namespace trajet
