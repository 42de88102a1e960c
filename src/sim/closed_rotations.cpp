#include "closed_rotations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "trajet/math/polynomial.hpp"
#include "trajet/math/shift_rows.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

constexpr int kOrder = 20;

/// How long a Taylor polynomial of order kOrder holds to rounding: until its last two terms are as small.
double duration_of(const Eigen::Ref<const Eigen::MatrixXd>& coefficients) {
  double duration = std::numeric_limits<double>::infinity();
  for (const int k : {kOrder - 1, kOrder}) {
    const double term = coefficients.col(k).cwiseAbs().maxCoeff();
    const double size = coefficients.col(0).cwiseAbs().maxCoeff();
    if (term > 0.0) duration = std::min(duration, std::pow(kUnitRoundoff * size / term, 1.0 / k));
  }
  return duration;
}

}  // namespace

ClosedRotations::ClosedRotations(const World& world, int group)
    : system_(world.groups[static_cast<std::size_t>(group)].law) {
  for (const int body : world.groups[static_cast<std::size_t>(group)].bodies) {
    const auto& rotation = world.bodies[static_cast<std::size_t>(body)].rotation;
    if (rotation && rotation->layout.way == OrientationWay::exact) places_.push_back(&*rotation);
  }
}

void ClosedRotations::begin(double t, const Eigen::VectorXd& q, const Eigen::VectorXd* before,
                            const std::vector<const World::Rotation*>& pushed) {
  const std::vector<Rotation> known = std::exchange(rotations_, {});
  for (const World::Rotation* place : places_) {
    if (ranges::find(pushed, place) != pushed.end()) continue;
    const int size = place->layout.size() + 3;
    const auto old = ranges::find(known, place, &Rotation::place);
    if (old != known.end() && before != nullptr &&
        q.segment(place->offset, size) == before->segment(place->offset, size)) {
      rotations_.push_back(*old);
      continue;
    }
    const Quaternion q_WB = place->layout.quaternion(q.data() + place->offset).normalized();
    const Vector3 w = q.segment<3>(place->offset + place->layout.size());
    rotations_.push_back({place, t, place->inertia ? FreeRotation(q_WB, w, *place->inertia) : FreeRotation(q_WB, w)});
  }
}

void ClosedRotations::write(double t, Eigen::VectorXd& q) const {
  for (const Rotation& rotation : rotations_) {
    const OrientationLayout& layout = rotation.place->layout;
    const double time = t - rotation.start;
    layout.put(rotation.closed_form.q_WB(time), q.data() + rotation.place->offset);
    q.segment<3>(rotation.place->offset + layout.size()) =
        layout.frame == Frame::body ? rotation.closed_form.w_WB_B(time) : rotation.closed_form.w_WB_W(time);
  }
}

std::deque<Segment<>> ClosedRotations::pieces(const Segment<>& step) {
  std::deque<Segment<>> pieces;
  const double direction = step.t1() < step.t0() ? -1.0 : 1.0;
  Eigen::MatrixXd series(step.dimension(), kOrder + 1);
  for (double t = step.t0(); t != step.t1();) {
    Segment<>& piece = pieces.emplace_back();
    piece.resize(step.dimension(), std::max(step.degree(), kOrder));
    auto& coefficients = piece.coefficients();
    coefficients.setZero();
    coefficients.leftCols(step.degree() + 1) = step.coefficients();
    shift_rows(coefficients.leftCols(step.degree() + 1), t - step.t0());
    piece.error_bound() = pieces.size() == 1 ? step.error_bound() : Eigen::VectorXd::Zero(step.dimension());

    Eigen::VectorXd q = coefficients.col(0);
    write(t, q);
    system_.expand(t, q.data(), kOrder, series.data());
    double duration = std::abs(step.t1() - t);
    for (const Rotation& rotation : rotations_) {
      const int first = rotation.place->offset, size = rotation.place->layout.size() + 3;
      coefficients.middleRows(first, size).setZero();
      coefficients.middleRows(first, size).leftCols(kOrder + 1) = series.middleRows(first, size);
      piece.error_bound().segment(first, size) = 4.0 * kUnitRoundoff * q.segment(first, size).cwiseAbs();
      duration = std::min(duration, duration_of(series.middleRows(first, rotation.place->layout.size())));
      if (rotation.place->inertia) duration = std::min(duration, duration_of(series.middleRows(first + size - 3, 3)));
    }
    const double left = std::abs(step.t1() - t);
    // pieces of equal length; what is left to rounding of time is the last one
    const double next = t + direction * left / std::ceil(left / duration);
    const double end = !(duration < left) || next == t ? step.t1() : next;
    piece.set_interval(t, end);
    t = end;
  }
  return pieces;
}

}  // namespace trajet
