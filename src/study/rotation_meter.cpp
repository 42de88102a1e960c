#include "rotation_meter.hpp"

#include <algorithm>
#include <cmath>

namespace trajet {
namespace {

void raise(std::optional<double>& worst, const std::optional<double>& value, double right) {
  if (value && !(worst && std::abs(*worst - right) >= std::abs(*value - right))) worst = value;
}

/// Of a body under Euler's equations: w in the body's frame behind the numbers of its orientation.
struct FreeMotion {
  double energy;
  Vector3 momentum_W;
};

FreeMotion free_motion(const World::Rotation& rotation, const double* part) {
  const Vector3 w_B(part + rotation.layout.size());
  const Vector3 momentum_B = *rotation.inertia * w_B;
  return {0.5 * w_B.dot(momentum_B), rotation.layout.rotation(part) * momentum_B};
}

Quaternion nearest_quaternion(const OrientationLayout& layout, const double* part) {
  if (layout.way == OrientationWay::matrix) return from_rotation_matrix(nearest_rotation(layout.matrix(part)));
  return layout.quaternion(part).normalized();
}

}  // namespace

void raise(RotationDeviation& worst, const RotationDeviation& value) {
  raise(worst.determinant, value.determinant, 1.0);
  raise(worst.norm, value.norm, 1.0);
  raise(worst.angle_rad, value.angle_rad, 0.0);
  raise(worst.energy, value.energy, 0.0);
  raise(worst.momentum, value.momentum, 0.0);
}

RotationMeter::RotationMeter(const World& world) {
  for (const World::Body& each : world.bodies) {
    if (!each.rotation) continue;
    Body& body = bodies_.emplace_back(Body{each.group, &*each.rotation});
    if (!body.keeps_energy()) continue;
    const double* start = world.groups[static_cast<std::size_t>(each.group)].start.data() + each.rotation->offset;
    const FreeMotion motion = free_motion(*each.rotation, start);
    body.energy = motion.energy;
    body.momentum = motion.momentum_W;
  }
}

RotationDeviation RotationMeter::measure(int group, const Eigen::VectorXd& state,
                                         const Eigen::VectorXd& reference) const {
  RotationDeviation worst;
  for (const Body& body : bodies_)
    if (body.group == group)
      raise(worst, body.measure(state.data() + body.rotation->offset, reference.data() + body.rotation->offset));
  return worst;
}

RotationDeviation RotationMeter::Body::measure(const double* state, const double* reference) const {
  const OrientationLayout& layout = rotation->layout;
  RotationDeviation result;
  result.determinant = layout.matrix(state).determinant();
  if (layout.way != OrientationWay::matrix) result.norm = layout.quaternion(state).norm();
  if (std::all_of(reference, reference + layout.size(), [](double number) { return std::isfinite(number); })) {
    const Quaternion turn = nearest_quaternion(layout, state) * nearest_quaternion(layout, reference).conjugate();
    result.angle_rad = to_rotation_vector(turn).norm();
  }
  if (keeps_energy() && energy > 0.0) {
    const FreeMotion motion = free_motion(*rotation, state);
    result.energy = std::abs(motion.energy - energy) / energy;
    result.momentum = (motion.momentum_W - momentum).norm() / momentum.norm();
  }
  return result;
}

}  // namespace trajet
