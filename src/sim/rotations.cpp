#include "rotations.hpp"

#include <algorithm>

#include "trajet/sim/run_result.hpp"

namespace trajet {

Rotations::Rotations(const World& world, int group) {
  for (const int body : world.groups[static_cast<std::size_t>(group)].bodies) {
    const auto& rotation = world.bodies[static_cast<std::size_t>(body)].rotation;
    if (rotation) turning_.push_back({&*rotation});
  }
}

double Rotations::tolerance_factor() const {
  // Near its intermediate axis a top stands nearly still, and an error of a step is a long time: along the orbit it
  // becomes |dw/dt| there over |dw/dt| here times as large. Measured on I = (1, 2, 3), w = (0.01, 3, 0.02), over 25
  // flips: from 1e-6 to 1e-11, 21 times the tolerance by `taylor`.
  constexpr double kTop = 1.0 / 64.0;
  for (const Turning& turning : turning_)
    if (turning.rotation->inertia && turning.rotation->layout.way != OrientationWay::exact) return kTop;
  return 1.0;
}

void Rotations::begin(double t, const Eigen::VectorXd& q) {
  for (Turning& turning : turning_) {
    const World::Rotation& rotation = *turning.rotation;
    const OrientationLayout& layout = rotation.layout;
    const bool is_left_alone = layout.way == OrientationWay::quaternion || layout.way == OrientationWay::matrix;
    if (!rotation.is_free || is_left_alone) continue;
    const Quaternion q_WB = layout.quaternion(q.data() + rotation.offset).normalized();
    const Vector3 w = q.segment<3>(rotation.offset + layout.size());
    turning.start = t;
    if (layout.way != OrientationWay::exact) {
      if (rotation.inertia) turning.invariants.emplace(q_WB, w, *rotation.inertia);
    } else if (rotation.inertia) {
      turning.closed_form.emplace(q_WB, w, *rotation.inertia);
    } else {
      turning.closed_form.emplace(q_WB, w);
    }
  }
}

void Rotations::settle(double t, Eigen::VectorXd& q) const {
  for (const Turning& turning : turning_) {
    const OrientationLayout& layout = turning.rotation->layout;
    double* part = q.data() + turning.rotation->offset;
    auto w = q.segment<3>(turning.rotation->offset + layout.size());
    if (turning.closed_form) {
      const double time = t - turning.start;
      layout.put(turning.closed_form->q_WB(time), part);
      w = layout.frame == Frame::body ? turning.closed_form->w_WB_B(time) : turning.closed_form->w_WB_W(time);
      continue;
    }
    layout.settle(part);
    if (turning.invariants) {
      Quaternion q_WB = layout.quaternion(part);
      Vector3 w_WB_B = w;
      turning.invariants->restore(q_WB, w_WB_B);
      layout.put(q_WB, part);
      w = w_WB_B;
    }
  }
}

Eigen::VectorXd MotionPiece::state(double t) const {
  Eigen::VectorXd q = segment.state(t);
  rotations.settle(t, q);
  return q;
}

double Rotations::unsettled(const Eigen::VectorXd& q) const {
  double largest = 0.0;
  for (const Turning& turning : turning_)
    largest = std::max(largest, turning.rotation->layout.unsettled(q.data() + turning.rotation->offset));
  return largest;
}

}  // namespace trajet
