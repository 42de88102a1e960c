#include "trajet/rigid/orientation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "trajet/portable.hpp"

namespace trajet {

std::span<const OrientationInfo> orientation_ways() {
  using enum OrientationWay;
  static const std::array<OrientationInfo, 5> table{{
      {quaternion_normalized,
       "quaternion-normalized",
       {"default"},
       4,
       "notes: Euler normalised",
       "unit quaternion, divided by its norm after each step"},
      {quaternion,
       "quaternion",
       {"quaternion-raw"},
       4,
       "notes: dR/dt = w R / 2",
       "four equations; the norm drifts, and sizes with it"},
      {matrix, "matrix", {"rotation-matrix"}, 9, "notes: dR/dt = w~R", "nine equations; R drifts from a rotation"},
      {rotation_vector,
       "rotation-vector",
       {"rkmk", "lie"},
       7,
       "Munthe-Kaas",
       "a rotation by construction: each step is the exponential of a vector"},
      {exact, "exact", {"closed-form"}, 4, "notes: exact", "closed form: no torque, or constant angular velocity"},
  }};
  return table;
}

const OrientationInfo* find_orientation_way(std::string_view name) {
  for (const OrientationInfo& info : orientation_ways())
    if (info.name == name || ranges::find(info.aliases, name) != info.aliases.end()) return &info;
  return nullptr;
}

const OrientationInfo& orientation_info(OrientationWay way) {
  return *ranges::find(orientation_ways(), way, &OrientationInfo::way);
}

void OrientationLayout::put(const Quaternion& q_WB, double* part) const {
  if (way == OrientationWay::matrix) {
    const Matrix3 R = rotation_matrix(q_WB);
    for (int i = 0; i < 9; ++i) part[i] = R(i / 3, i % 3);
    return;
  }
  part[0] = q_WB.w();
  for (int i = 0; i < 3; ++i) part[1 + i] = q_WB.vec()[i];
  if (way == OrientationWay::rotation_vector) std::fill_n(part + 4, 3, 0.0);
}

void OrientationLayout::align(double* part, const double* other) const {
  if (way == OrientationWay::matrix) return;
  double product = 0.0;
  for (int i = 0; i < 4; ++i) product += part[i] * other[i];
  if (product < 0.0) std::for_each_n(part, 4, [](double& number) { number = -number; });
}

void OrientationLayout::settle(double* part) const {
  if (way == OrientationWay::matrix || way == OrientationWay::quaternion) return;
  Quaternion q(part[0], part[1], part[2], part[3]);
  if (way == OrientationWay::rotation_vector) {
    const Quaternion step = from_rotation_vector<double>({part[4], part[5], part[6]});
    q = frame == Frame::world ? step * q : q * step;
  }
  put(q.normalized(), part);
}

double OrientationLayout::unsettled(const double* part) const {
  if (way == OrientationWay::matrix || way == OrientationWay::quaternion) return 0.0;
  if (way == OrientationWay::rotation_vector) return std::hypot(part[4], part[5], part[6]);
  // the logarithm: as many halvings of the norm as doublings are too many
  return std::abs(std::log(std::hypot(std::hypot(part[0], part[1]), std::hypot(part[2], part[3]))));
}

}  // namespace trajet
