#include "aim_model.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <vector>

namespace trajet {
namespace {

constexpr double kRankShare = 1e-7;  // of the largest singular value: smaller ones are rounding

Eigen::JacobiSVD<Eigen::MatrixXd> decomposed(const Eigen::MatrixXd& slope) {
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(slope, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(kRankShare);
  return svd;
}

}  // namespace

MissFrame::MissFrame(const Vector3& direction) : direction_(direction) {
  // along the axes of the world as far as possible: a planar problem has one component that is 0
  Eigen::Index axis = 0;
  direction.cwiseAbs().minCoeff(&axis);
  const Vector3 first = direction.cross(Vector3::Unit(axis)).normalized();
  across_ << first, direction.cross(first);
}

Eigen::Vector2d MissFrame::operator()(const Passage& passage) const {
  // the rotation that takes a to b by the shortest way: x cos + k x x + k (k.x) / (1 + cos), k = a x b, cos = a.b
  const double cosine = passage.direction.dot(direction_);
  const Vector3 k = passage.direction.cross(direction_), &d = passage.residual;
  constexpr double kOpposite = -0.99;
  if (cosine < kOpposite) return across_.transpose() * d;
  const Vector3 turned = cosine * d + k.cross(d) + k * (k.dot(d) / (1.0 + cosine));
  return across_.transpose() * turned;
}

int LinearMiss::rank() const { return static_cast<int>(decomposed(slope).rank()); }

double LinearMiss::slowest() const {
  const auto svd = decomposed(slope);
  return svd.rank() == 0 ? 0.0 : svd.singularValues()[svd.rank() - 1];
}

Eigen::VectorXd least_within_box(const LinearMiss& model) {
  constexpr int kSweeps = 60;
  const Eigen::Index n = model.slope.cols();
  Eigen::VectorXd x = decomposed(model.slope).solve(-model.value);
  for (Eigen::Index i = 0; i < n; ++i) x[i] = std::isfinite(x[i]) ? std::clamp(x[i], -1.0, 1.0) : 0.0;
  // one unknown after the other: the sum of squares is convex
  for (int sweep = 0; sweep < (n == 1 ? 1 : kSweeps); ++sweep)
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Vector2d column = model.slope.col(i);
      const double square = column.squaredNorm();
      if (square == 0.0) continue;
      const Eigen::Vector2d rest = model.value + model.slope * x - column * x[i];
      x[i] = std::clamp(-column.dot(rest) / square, -1.0, 1.0);
    }
  return x;
}

Eigen::VectorXd newton_step(const LinearMiss& model, const Eigen::VectorXd& x) {
  const Eigen::Index n = x.size();
  std::vector<bool> is_free(static_cast<std::size_t>(n), true);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(n);
  for (Eigen::Index round = 0; round <= n; ++round) {
    LinearMiss rest = model;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (is_free[static_cast<std::size_t>(i)]) continue;
      rest.value += model.slope.col(i) * step[i];
      rest.slope.col(i).setZero();
    }
    const Eigen::VectorXd free_step = decomposed(rest.slope).solve(-rest.value);
    bool leaves = false;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!is_free[static_cast<std::size_t>(i)]) continue;
      step[i] = std::clamp(x[i] + free_step[i], 0.0, 1.0) - x[i];
      if (step[i] == free_step[i] || x[i] + free_step[i] == std::clamp(x[i] + free_step[i], 0.0, 1.0)) {
        step[i] = free_step[i];
        continue;
      }
      is_free[static_cast<std::size_t>(i)] = false;
      leaves = true;
    }
    if (!leaves) break;
  }
  return step;
}

}  // namespace trajet
