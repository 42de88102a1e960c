#include "trajet/sim/state_at.hpp"

namespace trajet {

void read_orientations(const World& world, int group, Eigen::VectorXd& q) {
  for (const int body : world.groups[static_cast<std::size_t>(group)].bodies)
    if (const auto& rotation = world.bodies[static_cast<std::size_t>(body)].rotation)
      rotation->layout.settle(q.data() + rotation->offset);
}

Eigen::VectorXd state_at(const World& world, int group, const Segment<>& segment, double t) {
  Eigen::VectorXd q = segment.state(t);
  read_orientations(world, group, q);
  return q;
}

}  // namespace trajet
