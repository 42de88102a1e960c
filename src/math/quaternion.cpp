#include "trajet/math/quaternion.hpp"

#include <Eigen/SVD>

namespace trajet {

Matrix3 nearest_rotation(const Matrix3& M) {
  const Eigen::JacobiSVD<Matrix3> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3 U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0.0) U.col(2) *= -1.0;
  return U * svd.matrixV().transpose();
}

}  // namespace trajet
