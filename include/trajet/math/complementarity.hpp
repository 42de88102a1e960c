#pragma once

#include <Eigen/Core>
#include <optional>

#include "trajet/portable.hpp"

namespace trajet {

/// The linear complementarity problem of a positive semidefinite, symmetric matrix: x >= 0, w = q + A x >= 0 and
/// x . w = 0, which is where x . A x / 2 + q . x is least. If A is singular, x need not be the only solution; w is.
///
/// An active set of independent columns grows by the component at which w is most negative, and gives back what would
/// become negative [LawsonHanson1995, p. 161]; a column that it gives already takes the place of one of it. Either
/// makes the value x . A x / 2 + q . x less, so that each set is come to once, and there is an end. There is no
/// solution only if some d >= 0 has A d = 0 and q . d < 0: then the value has no least. Where A = N^T M N, and q_i =
/// c_i (N^T v)_i with c_i > 0, there is none such if all q_i < 0, or all c_i are one: N d = 0, hence d . N^T v = 0.
///
/// Components are scaled by the diagonal of A, on which no component of what is sought may be zero.
///
/// \param tolerance  of w, in the unit of q: so much below zero is rounding
/// Nothing if there is no solution.
std::optional<Eigen::VectorX<Extended>> solve_complementarity(const Eigen::MatrixX<Extended>& A,
                                                              const Eigen::VectorX<Extended>& q, Extended tolerance);

}  // namespace trajet
