#include "trajet/geom/landscape.hpp"

#include <cmath>

namespace trajet {

namespace {

Vector3 in_frame(const Landscape& landscape, const Vector3& p) {
  return landscape.R_WB().transpose() * (p - landscape.p_WB());
}

/// (-dh/dx, -dh/dy, 1)
Vector3 upward(const Landscape& landscape, double x, double y) {
  const auto number = [](double value) { return IntervalJet(Interval(value)); };
  const auto moving = [](double value) { return IntervalJet::variable(Interval(value)); };
  const Interval by_x = landscape.height(moving(x), number(y))[1];
  const Interval by_y = landscape.height(number(x), moving(y))[1];
  return {-median(by_x), -median(by_y), 1.0};
}

}  // namespace

GroundPlace ground_below(const Terrain& terrain, const Vector3& p) {
  const Landscape& landscape = *terrain.landscape;
  const Vector3 q = in_frame(landscape, p);
  const double height = landscape.height(q.x(), q.y());
  return {landscape.p_WB() + landscape.R_WB() * Vector3(q.x(), q.y(), height),
          landscape.R_WB() * upward(landscape, q.x(), q.y()).normalized(), q.z() - height};
}

double signed_distance(const Terrain& terrain, const Vector3& p) {
  const GroundPlace below = ground_below(terrain, p);
  return below.above * below.normal.dot(terrain.landscape->R_WB().col(2));
}

Vector3 closest_point(const Terrain& terrain, const Vector3& p) {
  Vector3 foot = ground_below(terrain, p).point;
  constexpr int kSteps = 30;
  for (int step = 0; step < kSteps; ++step) {
    const GroundPlace at = ground_below(terrain, foot);
    const Vector3 next = ground_below(terrain, p - at.normal.dot(p - at.point) * at.normal).point;
    const double moved = (next - foot).norm();
    foot = next;
    constexpr double kNoStep = 1e-15;
    if (!(moved > kNoStep * (1.0 + foot.norm()))) break;
  }
  return foot;
}

}  // namespace trajet
