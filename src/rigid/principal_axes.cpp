#include "trajet/rigid/principal_axes.hpp"

#include <Eigen/Eigenvalues>

namespace trajet {

PrincipalAxes principal_axes(const Matrix3& inertia) {
  if (inertia.isDiagonal(0.0)) return {inertia.diagonal(), Matrix3::Identity()};
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(inertia);
  Matrix3 R = solver.eigenvectors();
  if (R.determinant() < 0.0) R.col(2) *= -1.0;
  return {solver.eigenvalues(), R};
}

bool is_possible_inertia(const Matrix3& inertia) {
  const Vector3 moments = principal_axes(inertia).moments;
  constexpr double kMomentRounding = 1e-9;
  return moments.minCoeff() > 0.0 && moments.maxCoeff() <= 0.5 * (1.0 + kMomentRounding) * moments.sum();
}

Matrix3 shifted_inertia(const Matrix3& inertia, double mass, const Vector3& p) {
  // I + m (|p|^2 1 - p p^T)
  return inertia + mass * (p.squaredNorm() * Matrix3::Identity() - p * p.transpose());
}

}  // namespace trajet
