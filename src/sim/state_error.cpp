#include "state_error.hpp"

#include <cmath>

#include "trajet/math/polynomial.hpp"

namespace trajet {

StateError::StateError(const World& world, int group)
    : bound_(Eigen::VectorXd::Zero(world.groups[static_cast<std::size_t>(group)].start.size())) {
  for (const int body : world.groups[static_cast<std::size_t>(group)].bodies)
    offsets_.push_back(world.bodies[static_cast<std::size_t>(body)].offset);
}

void StateError::pass(const Segment<>& segment, double t, const Eigen::VectorXd& end) {
  const double duration = std::abs(t - segment.t0());
  // an error of the velocity moves the body
  for (const int offset : offsets_) bound_.segment<3>(offset) += duration * bound_.segment<3>(offset + 3);
  bound_ += segment.error_bound() + kUnitRoundoff * end.cwiseAbs();
}

}  // namespace trajet
