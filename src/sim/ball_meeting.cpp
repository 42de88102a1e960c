#include "ball_meeting.hpp"

#include <algorithm>

#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/event/path.hpp"
#include "trajet/math/shift_rows.hpp"

namespace trajet {
namespace {

/// Position of a body on a Segment as polynomials in the time behind `from`.
Eigen::Matrix<double, 3, Eigen::Dynamic> position_rows(const World::Body& body, const Segment<>& motion, double from) {
  Eigen::Matrix<double, 3, Eigen::Dynamic> rows = motion.coefficients().middleRows<3>(body.slice().position_index());
  shift_rows(rows, from - motion.t0());
  return rows;
}

}  // namespace

ContactResult first_contact_of_balls(const World::Body& a, const Segment<>& motion_a, const World::Body& b,
                                     const Segment<>& motion_b, const TimeSpan& span, Locator locator,
                                     const ContactMemory& memory) {
  const auto rows_a = position_rows(a, motion_a, span.from), rows_b = position_rows(b, motion_b, span.from);
  Segment<> apart;  // of any degree
  apart.resize(3, static_cast<int>(std::max(rows_a.cols(), rows_b.cols())) - 1);
  apart.coefficients().setZero();
  apart.coefficients().leftCols(rows_a.cols()) = rows_a;
  apart.coefficients().leftCols(rows_b.cols()) -= rows_b;
  apart.error_bound() = a.slice().position(motion_a.error_bound()) + b.slice().position(motion_b.error_bound());
  apart.set_interval(span.from, span.to);
  const PointPath path(apart, 0);

  // a point has no surface to be met: then the other one is the obstacle
  const double radius_a = bounding_radius(a.solid), radius_b = bounding_radius(b.solid);
  const Shape obstacle = Sphere{Vector3::Zero(), radius_b > 0.0 ? radius_b : radius_a};
  ContactResult result =
      first_contact(obstacle, {path, radius_b > 0.0 ? radius_a : 0.0, span.from, span.to, locator}, memory);
  if (result.status == ContactStatus::separated) return result;
  const double tau = result.time - span.from;
  Vector3 place_a, place_b;
  for (int i = 0; i < 3; ++i) {
    const auto value = [&](const auto& rows) {
      double sum = 0.0;
      for (Eigen::Index k = rows.cols() - 1; k >= 0; --k) sum = sum * tau + rows(i, k);
      return sum;
    };
    place_a[i] = value(rows_a);
    place_b[i] = value(rows_b);
  }
  result.position = place_a;
  result.point = place_b + radius_b * result.normal;
  return result;
}

}  // namespace trajet
