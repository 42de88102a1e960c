#include "carried_orientations.hpp"

#include <limits>

namespace trajet {

Eigen::VectorXd carried_as_in(const World& to, const World& from, int group, const Eigen::VectorXd& q) {
  const auto g = static_cast<std::size_t>(group);
  Eigen::VectorXd result(to.groups[g].start.size());
  for (const int b : to.groups[g].bodies) {
    const World::Body& here = to.bodies[static_cast<std::size_t>(b)];
    const World::Body& there = from.bodies[static_cast<std::size_t>(b)];
    here.slice().moving_part(result) = there.slice().moving_part(q);
    if (!here.rotation) continue;
    const OrientationLayout &layout = here.rotation->layout, &other = there.rotation->layout;
    const auto numbers = q.segment(there.rotation->offset, other.size());
    auto part = result.segment(here.rotation->offset, layout.size());
    if (layout.way == other.way) {
      part = numbers;
    } else if (!numbers.allFinite()) {
      part.setConstant(std::numeric_limits<double>::quiet_NaN());
    } else {
      const bool is_matrix = other.way == OrientationWay::matrix;
      layout.put(is_matrix ? from_rotation_matrix(nearest_rotation(other.matrix(numbers.data())))
                           : other.quaternion(numbers.data()).normalized(),
                 part.data());
    }
    here.slice().angular_velocity(result) = there.slice().angular_velocity(q);
  }
  for (std::size_t s = 0; s < to.states.size(); ++s)
    if (to.states[s].group == group) result[to.states[s].offset] = q[from.states[s].offset];
  return result;
}

void align_orientations(const World& world, int group, Eigen::VectorXd& q, const Eigen::VectorXd& other) {
  for (const int body : world.groups[static_cast<std::size_t>(group)].bodies)
    if (const auto& rotation = world.bodies[static_cast<std::size_t>(body)].rotation)
      rotation->layout.align(q.data() + rotation->offset, other.data() + rotation->offset);
}

}  // namespace trajet
