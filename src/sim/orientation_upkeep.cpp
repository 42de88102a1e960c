#include "orientation_upkeep.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "trajet/portable.hpp"
#include "trajet/rigid/kinematics.hpp"

namespace trajet {
namespace {

/// Adds to some components of a Segment what leads from one correction at its start to another one at its end:
/// smoothly, 3 s^2 - 2 s^3, where its degree is enough.
void bend(Segment<>& segment, int first, const Eigen::VectorXd& at_start, const Eigen::VectorXd& at_end) {
  const double h = segment.duration();
  auto rows = segment.coefficients().middleRows(first, at_start.size());
  const Eigen::VectorXd change = at_end - at_start;
  rows.col(0) += at_start;
  if (segment.degree() >= 3) {
    rows.col(2) += 3.0 / (h * h) * change;
    rows.col(3) -= 2.0 / (h * h * h) * change;
  } else if (segment.degree() >= 1) {
    rows.col(1) += change / h;
  }
}

/// Of all vectors that are the same rotation as `u`, whole turns more or less, the one nearest to another.
Vector3 nearest_rotation_vector(const Vector3& u, const Vector3& other) {
  const double angle = u.norm();
  if (angle == 0.0) return u;
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return u + kTurn * std::round((other.dot(u) / angle - angle) / kTurn) / angle * u;
}

}  // namespace

OrientationUpkeep::OrientationUpkeep(const World& world, int group) {
  for (const int body : world.groups[static_cast<std::size_t>(group)].bodies) {
    const auto& rotation = world.bodies[static_cast<std::size_t>(body)].rotation;
    if (rotation) turning_.push_back({&*rotation});
  }
}

double OrientationUpkeep::tolerance_factor() const {
  // Near its intermediate axis a top stands nearly still, and an error of a step is a long time: along the orbit it
  // becomes |dw/dt| there over |dw/dt| here times as large. Measured on I = (1, 2, 3), w = (0.01, 3, 0.02), over 25
  // flips: from 1e-6 to 1e-11, 21 times the tolerance by `taylor`.
  constexpr double kTop = 1.0 / 64.0;
  for (const Turning& turning : turning_)
    if (turning.rotation->inertia && turning.rotation->layout.way != OrientationWay::exact) return kTop;
  return 1.0;
}

void OrientationUpkeep::begin(Eigen::VectorXd& q, const Eigen::VectorXd* before,
                              const std::vector<const World::Rotation*>& pushed) {
  for (Turning& turning : turning_) {
    const World::Rotation& rotation = *turning.rotation;
    const OrientationLayout& layout = rotation.layout;
    double* part = q.data() + rotation.offset;
    const bool goes_on_as_it_came = before != nullptr && q.segment(turning.offset(), turning.size()) ==
                                                             before->segment(turning.offset(), turning.size());
    layout.settle(part);
    turning.correction = Eigen::VectorXd::Zero(turning.size());
    turning.is_pushed = ranges::find(pushed, turning.rotation) != pushed.end();
    if (turning.is_pushed) turning.invariants.reset();
    const bool is_left_alone = layout.way == OrientationWay::quaternion || layout.way == OrientationWay::matrix;
    if (turning.is_pushed || !rotation.is_free || !rotation.inertia || is_left_alone ||
        layout.way == OrientationWay::exact)
      continue;
    if (turning.invariants && goes_on_as_it_came) continue;
    turning.invariants.emplace(layout.quaternion(part).normalized(), q.segment<3>(rotation.offset + layout.size()),
                               *rotation.inertia);
  }
}

Eigen::VectorXd OrientationUpkeep::right_numbers(const Turning& turning, const Eigen::VectorXd& numbers) {
  const OrientationLayout& layout = turning.rotation->layout;
  Eigen::VectorXd right = numbers;
  if (layout.way == OrientationWay::quaternion || layout.way == OrientationWay::matrix) return right;
  Quaternion q_WB = layout.quaternion(numbers.data()).normalized();
  Vector3 w_WB_B = numbers.tail<3>();
  if (turning.invariants) turning.invariants->restore(q_WB, w_WB_B);
  right.tail<3>() = w_WB_B;
  if (layout.way != OrientationWay::rotation_vector) {
    layout.put(q_WB, right.data());
    layout.align(right.data(), numbers.data());
    return right;
  }
  if (!turning.invariants) return right;
  const Quaternion start(numbers[0], numbers[1], numbers[2], numbers[3]);
  const bool in_world = layout.frame == Frame::world;
  const Quaternion step = in_world ? q_WB * start.conjugate() : start.conjugate() * q_WB;
  right.segment<3>(4) = nearest_rotation_vector(to_rotation_vector(step), numbers.segment<3>(4));
  return right;
}

void OrientationUpkeep::end_step(Segment<>& segment, Eigen::VectorXd& end) {
  for (Turning& turning : turning_) {
    if (turning.rotation->layout.way == OrientationWay::exact && !turning.is_pushed) continue;
    auto numbers = end.segment(turning.offset(), turning.size());
    const Eigen::VectorXd right = right_numbers(turning, numbers);
    const Eigen::VectorXd correction = right - numbers;
    bend(segment, turning.offset(), turning.correction, correction);
    turning.correction = correction;
    numbers = right;
    turning.rotation->layout.settle(numbers.data());
  }
}

void OrientationUpkeep::was_taken() {
  for (Turning& turning : turning_) turning.correction.setZero();
}

double OrientationUpkeep::drift(const Eigen::VectorXd& q) const {
  double largest = 0.0;
  for (const Turning& turning : turning_)
    largest = std::max(largest, turning.rotation->layout.unsettled(q.data() + turning.rotation->offset));
  return largest;
}

}  // namespace trajet
