// Random parabolas against cylinders, capsules, cones and ellipsoids, in and out.

#include "oracle_distances.hpp"

namespace trajet {
namespace {

using namespace sampled;

Kind random_cylinder(Random& random, const Vector3& near) {
  const Matrix3 R = random.rotation();
  const double radius = random.uniform(0.05, 1.0), height = random.uniform(0.05, 2.0);
  return {make_cylinder(near, R, radius, height),
          in_frame(near, R, [=](const RealVector& q) { return cylinder_distance(q, radius, Real(height) / 2); })};
}
Kind random_capsule(Random& random, const Vector3& near) {
  const Matrix3 R = random.rotation();
  const double radius = random.uniform(0.05, 1.0), height = random.uniform(0.05, 2.0);
  return {make_capsule(near, R, radius, height),
          in_frame(near, R, [=](const RealVector& q) { return capsule_distance(q, radius, Real(height) / 2); })};
}
Kind random_cone(Random& random, const Vector3& near) {
  const Matrix3 R = random.rotation();
  const double radius = random.uniform(0.05, 1.0), height = random.uniform(0.05, 2.0);
  return {make_cone(near, R, radius, height),
          in_frame(near, R, [=](const RealVector& q) { return cone_distance(q, radius, height); })};
}
Kind random_ellipsoid(Random& random, const Vector3& near) {
  const Matrix3 R = random.rotation();
  const Vector3 radii(random.uniform(0.1, 1.0), random.uniform(0.1, 1.0), random.uniform(0.1, 1.0));
  const RealVector a = radii.cast<Real>();
  return {make_ellipsoid(near, R, radii),
          in_frame(near, R, [=](const RealVector& q) { return ellipsoid_distance(q, a); })};
}

TEST(CurvedContact, PointAgainstCylinders) { run(1, false, random_cylinder); }
TEST(CurvedContact, BallAgainstCylinders) { run(2, true, random_cylinder); }
TEST(CurvedContact, PointAgainstCapsules) { run(3, false, random_capsule); }
TEST(CurvedContact, BallAgainstCapsules) { run(4, true, random_capsule); }
TEST(CurvedContact, PointAgainstCones) { run(5, false, random_cone); }
TEST(CurvedContact, BallAgainstCones) { run(6, true, random_cone); }
TEST(CurvedContact, PointAgainstEllipsoids) { run(7, false, random_ellipsoid); }
TEST(CurvedContact, BallAgainstEllipsoids) { run(8, true, random_ellipsoid); }

}  // namespace
}  // namespace trajet
