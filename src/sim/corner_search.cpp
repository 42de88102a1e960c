#include "corner_search.hpp"

#include <algorithm>
#include <array>

#include "frame_paths.hpp"
#include "trajet/collide/detect/ball_features.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/event/path.hpp"
#include "trajet/geom/convex_core.hpp"
#include "trajet/math/polynomial.hpp"

namespace trajet {
namespace {

using Row = Eigen::RowVectorXd;

Row product(const Row& a, const Row& b) {
  Row c = Row::Zero(a.size() + b.size() - 1);
  for (Eigen::Index i = 0; i < a.size(); ++i) c.segment(i, b.size()) += a[i] * b;
  return c;
}

/// The rows of R_WB along a path, element by element: R = N(q) of a quaternion that is a unit one, to rounding.
using RotationRows = std::array<std::array<Row, 3>, 3>;
RotationRows rotation_rows(const FramePath& path) {
  const Row w = path.orientation().row(0), x = path.orientation().row(1), y = path.orientation().row(2),
            z = path.orientation().row(3);
  const Row ww = product(w, w), xx = product(x, x), yy = product(y, y), zz = product(z, z), wx = product(w, x),
            wy = product(w, y), wz = product(w, z), xy = product(x, y), xz = product(x, z), yz = product(y, z);
  return {{{ww + xx - yy - zz, 2.0 * (xy - wz), 2.0 * (xz + wy)},
           {2.0 * (xy + wz), ww - xx + yy - zz, 2.0 * (yz - wx)},
           {2.0 * (xz - wy), 2.0 * (yz + wx), ww - xx - yy + zz}}};
}

Segment<> corner_path(const FramePath& path, const RotationRows& R, const Vector3& p_B) {
  const Eigen::Index count = std::max(path.position().cols(), R[0][0].size());
  Segment<> corner;  // of any degree
  corner.resize(3, std::min(static_cast<int>(count) - 1, kMaxPolynomialDegree));
  auto& rows = corner.coefficients();
  rows.setZero();
  rows.leftCols(path.position().cols()) = path.position().topRows<3>();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const Row& element = R[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
      rows.row(i).head(std::min(element.size(), rows.cols())) +=
          p_B[k] * element.head(std::min(element.size(), rows.cols()));
    }
  corner.error_bound().setConstant(path.point_error(p_B.norm()));
  corner.set_interval(path.t0(), path.t1());
  return corner;
}

}  // namespace

bool has_corners(const Solid& solid) {
  return std::holds_alternative<Cuboid>(solid) || std::holds_alternative<Hull>(solid) ||
         std::holds_alternative<SoccerBall>(solid);
}

ContactResult first_corner_contact(const World::Body& body, const World::Obstacle& obstacle, const Segment<>& motion,
                                   double from, double to, Locator locator, const ContactMemory& memory) {
  const ConvexCore core = convex_core(body.solid);
  ContactResult first{.memory = memory};
  while (first.status == ContactStatus::separated && from < to) {
    const FramePath path = body_path(body, motion, from);
    const RotationRows R = rotation_rows(path);
    const ContactMemory known = first.memory;
    double end = std::min(to, path.t1());
    if (!(end > from)) return {.status = ContactStatus::unresolved, .time = from, .memory = known};
    const double next = end;
    first.memory = {.side = 1};
    for (const Vector3& p_B : core.vertices) {
      const Segment<> corner = corner_path(path, R, p_B);
      const PointPath point(corner, 0);
      ContactResult found = first_contact(obstacle.shape, {point, 0.0, from, end, locator}, known);
      if (found.status == ContactStatus::separated) continue;
      found.position = path.pose(found.time).p_WB;
      found.touched = features_of_ball(0.0, obstacle.shape, found.point, found.normal);
      first = found;
      end = found.time;
      if (end == from) break;
    }
    from = next;
  }
  return first;
}

}  // namespace trajet
