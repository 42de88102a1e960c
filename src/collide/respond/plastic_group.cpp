#include "trajet/collide/respond/plastic_group.hpp"

#include <Eigen/QR>
#include <cstddef>

#include "trajet/math/polynomial.hpp"

namespace trajet {
namespace {

/// The impulses that take out of `velocity` all that is along the surfaces of `held`.
Eigen::VectorXd impulses_of(const std::vector<Vector3>& normals, const std::vector<std::size_t>& held,
                            const Vector3& velocity) {
  Eigen::Matrix3Xd n(3, static_cast<Eigen::Index>(held.size()));
  for (std::size_t i = 0; i < held.size(); ++i) n.col(static_cast<Eigen::Index>(i)) = normals[held[i]];
  const Eigen::MatrixXd inverse = n.completeOrthogonalDecomposition().pseudoInverse();
  return -inverse * velocity;
}

}  // namespace

std::vector<double> plastic_impulses(const std::vector<Vector3>& normals, const Vector3& velocity) {
  // The active set grows by the surface that is approached most and loses what would have to pull [Lawson1974, 23.3].
  const double rounding = 64.0 * kUnitRoundoff * velocity.norm();
  std::vector<double> impulses(normals.size(), 0.0);
  std::vector<std::size_t> held;
  const std::size_t most_rounds = 8 * normals.size();
  for (std::size_t round = 0; round < most_rounds; ++round) {
    Vector3 after = velocity;
    for (std::size_t i = 0; i < normals.size(); ++i) after += impulses[i] * normals[i];
    std::size_t worst = normals.size();
    double approach = rounding;
    for (std::size_t i = 0; i < normals.size(); ++i)
      if (-after.dot(normals[i]) > approach) approach = -after.dot(normals[worst = i]);
    if (worst == normals.size()) break;
    held.push_back(worst);
    while (!held.empty()) {
      const Eigen::VectorXd wanted = impulses_of(normals, held, velocity);
      // as far towards the wanted impulses as all still push
      double part = 1.0;
      std::size_t first_to_pull = held.size();
      for (std::size_t i = 0; i < held.size(); ++i) {
        const double now = impulses[held[i]], then = wanted[static_cast<Eigen::Index>(i)];
        if (then > 0.0) continue;
        const double reach = now > 0.0 ? now / (now - then) : 0.0;
        if (reach <= part) part = reach, first_to_pull = i;
      }
      for (std::size_t i = 0; i < held.size(); ++i)
        impulses[held[i]] += part * (wanted[static_cast<Eigen::Index>(i)] - impulses[held[i]]);
      if (first_to_pull == held.size()) break;
      impulses[held[first_to_pull]] = 0.0;
      held.erase(held.begin() + static_cast<std::ptrdiff_t>(first_to_pull));
    }
  }
  return impulses;
}

}  // namespace trajet
