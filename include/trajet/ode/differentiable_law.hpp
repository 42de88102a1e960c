#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <utility>

#include "trajet/math/dual.hpp"

namespace trajet {

/// A law with its exact Jacobian, by dual numbers: the rate of implicit methods.
///
/// `law(t, q, dq)` is generic in its number type, see solve(). `Dim` is the dimension of the state or Eigen::Dynamic.
template <class Law, int Dim>
class DifferentiableLaw {
 public:
  using State = Eigen::Matrix<double, Dim, 1>;
  using Jacobian = Eigen::Matrix<double, Dim, Dim>;

  explicit DifferentiableLaw(Law law) : law_(std::move(law)) {}

  void operator()(double t, const State& q, State& dq) const { law_(t, q, dq); }

  /// dg_dq(i, j) = d g_i / d q_j and dg_dt(i) = d g_i / dt at (t, q); both have their sizes already.
  void jacobian(double t, const State& q, Jacobian& dg_dq, State& dg_dt) const {
    const int dimension = static_cast<int>(q.size());
    DualState x(dimension), rate(dimension);
    // direction j < dimension is q_j, direction `dimension` is time
    for (int first = 0; first <= dimension; first += kDirections) {
      const int end = std::min(first + kDirections, dimension + 1);
      for (int j = 0; j < dimension; ++j)
        x[j] = j >= first && j < end ? Number::variable(q[j], j - first) : Number(q[j]);
      law_(dimension < end ? Number::variable(t, dimension - first) : Number(t), x, rate);
      for (int j = first; j < end; ++j)
        for (int i = 0; i < dimension; ++i) (j < dimension ? dg_dq(i, j) : dg_dt[i]) = rate[i].derivative(j - first);
    }
  }

 private:
  // All directions at once while they are few; more than eight doubles a number only move data about.
  static constexpr int kDirections = Dim == Eigen::Dynamic ? 8 : std::min(Dim + 1, 8);
  using Number = Dual<kDirections>;
  using DualState = Eigen::Matrix<Number, Dim, 1>;

  Law law_;
};

}  // namespace trajet
