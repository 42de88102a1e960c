#include "extended_bounce.hpp"

#include <variant>

#include "trajet/geom/closest_point.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

using Real = Extended;
using RealVector = Vector3T<Real>;

/// How far a ball's centre is from touching a shape, and the unit normal of the shape there.
struct Gap {
  Real value;
  RealVector normal;
};

/// The gap of a sphere, of which the centre of a body of that radius is at x. `normal`: to double precision.
Gap gap_of(const World::ExtendedNumbers::Sphere& sphere, const Vector3& normal, const RealVector& x, Real radius) {
  const RealVector arm = x - sphere.center;
  const Real distance = arm.norm();
  const Real side = arm.cast<double>().dot(normal) < 0.0 ? Real(-1) : Real(1);
  return {side * (distance - sphere.radius) - radius, side / distance * arm};
}

/// Of any other shape, touched at `point` with that normal.
Gap gap_of(const Shape& shape, const Vector3& point, const Vector3& normal, const RealVector& x, Real radius) {
  if (radius > Real(0)) {
    const RealVector arm = x - std::visit([&](const auto& s) { return closest_point(s, x); }, shape);
    const Real distance = arm.norm();
    const Real side = arm.cast<double>().dot(normal) < 0.0 ? Real(-1) : Real(1);
    return {side * distance - radius, side / distance * arm};
  }
  // a point on a flat face
  const RealVector unit = normal.cast<Real>().normalized();
  return {unit.dot(x - point.cast<Real>()), unit};
}

}  // namespace

void bounce_extended(const World& world, const Pair& pair, Instant& instant) {
  const World::Body& body = world.bodies[static_cast<std::size_t>(pair.id.body)];
  const World::Obstacle& obstacle = world.obstacles[static_cast<std::size_t>(pair.id.obstacle)];
  const Course& course = instant.course();
  const BodySlice slice = body.slice();
  const Real radius = world.extended->radii[static_cast<std::size_t>(pair.id.body)];
  const auto sphere = world.extended->spheres.find(pair.id.obstacle);
  const Real nominal = Real(instant.time()) - Real(course.segment().t0());
  const auto state_at = [&](Real tau) { return course.extended_state(tau); };
  auto q = state_at(nominal);
  if (!q) return;

  Real tau = nominal;
  Gap gap{};
  constexpr int kSteps = 4;  // Newton's method doubles the digits, of which fifteen are right
  for (int i = 0; i < kSteps; ++i) {
    const RealVector x = slice.position(*q);
    const Vector3& normal = pair.contact.normal;
    gap = sphere != world.extended->spheres.end() ? gap_of(sphere->second, normal, x, radius)
                                                  : gap_of(obstacle.shape, pair.contact.point, normal, x, radius);
    const Real approach = gap.normal.dot(RealVector(slice.velocity(*q)));
    if (!(approach < Real(0))) return;
    tau -= gap.value / approach;
    q = state_at(tau);
    if (!q) return;
  }
  RealVector velocity = slice.velocity(*q);
  const Real approach = velocity.dot(gap.normal);
  const double restitution =
      world.surface(pair.id.body, pair.id.obstacle).restitution.at(-static_cast<double>(approach));
  velocity -= (Real(1) + Real(restitution)) * approach * gap.normal;
  // from the impact on to the instant, some roundings of time later or earlier
  const Real rest = nominal - tau;
  const RealVector acceleration = instant.free_acceleration(slice.first).cast<Real>();
  instant.set_extended(slice.velocity_index(), velocity + rest * acceleration);
  instant.set_extended(slice.position_index(), RealVector(slice.position(*q)) + rest * velocity);
}

}  // namespace trajet
