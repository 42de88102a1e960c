#pragma once

#include <Eigen/Core>
#include <optional>

#include "trajet/portable.hpp"

namespace trajet {

/// The linear complementarity problem of a positive semidefinite, symmetric matrix: x >= 0, w = q + A x >= 0 and
/// x . w = 0, which is where x . A x / 2 + q . x is least. If A is singular, x need not be the only solution; w is.
///
/// An active set grows by the component at which w is most negative and gives back what would become negative
/// [LawsonHanson1995, p. 161], so that each set is tried once. Components are scaled by the diagonal of A, on which no
/// component of what is sought may be zero.
///
/// \param tolerance  of w, in the unit of q: so much below zero is rounding
/// Nothing if there is no solution: q asks for what no A x gives.
std::optional<Eigen::VectorX<Extended>> solve_complementarity(const Eigen::MatrixX<Extended>& A,
                                                              const Eigen::VectorX<Extended>& q, Extended tolerance);

}  // namespace trajet
