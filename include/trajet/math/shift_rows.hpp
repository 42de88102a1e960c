#pragma once

#include <Eigen/Core>

namespace trajet {

/// Replaces the polynomials p(tau) in the rows of a matrix by p(by + tau), by repeated synthetic division. Column k
/// holds the coefficients of tau^k.
template <class Derived>
void shift_rows(Eigen::MatrixBase<Derived>& coefficients, double by) {
  if (by == 0.0) return;
  for (Eigen::Index first = 0; first < coefficients.cols(); ++first)
    for (Eigen::Index k = coefficients.cols() - 2; k >= first; --k) coefficients.col(k) += by * coefficients.col(k + 1);
}
template <class Derived>
void shift_rows(Eigen::MatrixBase<Derived>&& coefficients, double by) {
  shift_rows(coefficients, by);
}

}  // namespace trajet
