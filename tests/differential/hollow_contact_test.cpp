// Random parabolas against hollow shapes, from the inside out and back, against rounded ones, and over a terrain.

#include "oracle_distances.hpp"
#include "trajet/geom/cavity.hpp"
#include "trajet/geom/landscape.hpp"
#include "trajet/geom/rounded_solid.hpp"
#include "trajet/geom/triangle_surface.hpp"

namespace trajet {
namespace {

using namespace sampled;

/// Around a place, so that the flight may begin inside.
Kind sphere_cavity(Random& random, const Vector3& near) {
  const double radius = random.uniform(0.6, 2.5);
  return {make_sphere_cavity(near, radius),
          in_frame(near, Matrix3::Identity(), [=](const RealVector& q) { return Real(radius) - q.norm(); })};
}
Kind box_cavity(Random& random, const Vector3& near) {
  const Matrix3 R = random.rotation();
  const Vector3 half(random.uniform(0.6, 2.5), random.uniform(0.6, 2.5), random.uniform(0.6, 2.5));
  return {make_box_cavity(near, 2.0 * half, R),
          in_frame(near, R, [=](const RealVector& q) { return (half.cast<Real>() - q.cwiseAbs()).minCoeff(); })};
}
Kind cylinder_cavity(Random& random, const Vector3& near) {
  const Matrix3 R = random.rotation();
  const double radius = random.uniform(0.6, 2.5), height = random.uniform(1.2, 5.0);
  return {make_cylinder_cavity(near, R, radius, height), in_frame(near, R, [=](const RealVector& q) {
            return std::min(Real(radius) - std::hypot(q.x(), q.y()), Real(height) / 2 - std::abs(q.z()));
          })};
}
Kind capsule_cavity(Random& random, const Vector3& near) {
  const Matrix3 R = random.rotation();
  const double radius = random.uniform(0.6, 2.5), height = random.uniform(0.2, 3.0);
  return {make_capsule_cavity(near, R, radius, height),
          in_frame(near, R, [=](const RealVector& q) { return -capsule_distance(q, radius, Real(height) / 2); })};
}
/// No narrower than balls of half a metre.
Kind ellipsoid_cavity(Random& random, const Vector3& near) {
  const Matrix3 R = random.rotation();
  const Vector3 radii(random.uniform(1.2, 2.5), random.uniform(1.2, 2.5), random.uniform(1.2, 2.5));
  const RealVector a = radii.cast<Real>();
  return {make_ellipsoid_cavity(near, R, radii),
          in_frame(near, R, [=](const RealVector& q) { return -ellipsoid_distance(q, a); })};
}

Kind rounded_cylinder(Random& random, const Vector3& near) {
  const Matrix3 R = random.rotation();
  const double radius = random.uniform(0.2, 1.0), height = random.uniform(0.4, 2.0);
  const double rounding = random.uniform(0.01, 0.19);
  SolidOfRevolution cylinder = make_cylinder(near, R, radius, height);
  cylinder.profile = cylinder_core_profile(radius, height, rounding);
  cylinder.growth = rounding;
  return {cylinder, in_frame(near, R, [=](const RealVector& q) {
            const Real r = rounding;
            return cylinder_distance(q, Real(radius) - r, Real(height) / 2 - r) - r;
          })};
}
/// Inset, a triangle is similar to itself about the middle of its incircle.
Kind rounded_cone(Random& random, const Vector3& near) {
  const Matrix3 R = random.rotation();
  const double radius = random.uniform(0.3, 1.0), height = random.uniform(0.5, 2.0);
  const double rounding = random.uniform(0.01, 0.1);
  SolidOfRevolution cone = make_cone(near, R, radius, height);
  cone.profile = cone_core_profile(radius, height, rounding);
  cone.growth = rounding;
  return {cone, in_frame(near, R, [=](const RealVector& q) {
            const Real incircle = Real(radius) * height / (radius + std::hypot(Real(radius), Real(height)));
            const Real part = (incircle - rounding) / incircle, middle = -Real(height) / 4 + incircle;
            // a cone of that size with its base at -height/4 of its own
            const Real base = middle - incircle * part, h = height * part;
            return cone_distance({q.x(), q.y(), q.z() - base - h / 4}, radius * part, h) - rounding;
          })};
}
Real box_distance(const RealVector& q, const RealVector& half) {
  const RealVector beyond = q.cwiseAbs() - half;
  const Real outside = beyond.cwiseMax(Real(0)).norm();
  return outside > 0 ? outside : beyond.maxCoeff();
}
Kind rounded_box(Random& random, const Vector3& near) {
  const Matrix3 R = random.rotation();
  const Vector3 half(random.uniform(0.2, 1.0), random.uniform(0.2, 1.0), random.uniform(0.2, 1.0));
  const double rounding = random.uniform(0.01, 0.19);
  std::vector<Vector3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(near + R * half.cwiseProduct(Vector3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  return {make_hull_surface(corners, rounding), in_frame(near, R, [=](const RealVector& q) {
            return box_distance(q, half.cast<Real>().array() - Real(rounding)) - rounding;
          })};
}

/// A box again, by its corners alone.
Kind sharp_box(Random& random, const Vector3& near) {
  const Matrix3 R = random.rotation();
  const Vector3 half(random.uniform(0.1, 1.0), random.uniform(0.1, 1.0), random.uniform(0.1, 1.0));
  std::vector<Vector3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(near + R * half.cwiseProduct(Vector3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  return {make_hull_surface(corners),
          in_frame(near, R, [=](const RealVector& q) { return box_distance(q, half.cast<Real>()); })};
}

/// Of a hull the oracle knows the corners only: outside, the distance is the greatest of those to planes through each
/// three of them that have the others behind, to lines through two and to corners; each where its foot is nearest.
Kind tetrahedron(Random& random, const Vector3& near) {
  std::vector<Vector3> corners;
  for (int i = 0; i < 4; ++i) corners.push_back(near + random.vector(1.0));
  return {make_hull_surface(corners), [=](const RealVector& p) {
            Real outside = -1e30L, nearest = 1e30L;
            for (std::size_t i = 0; i < 4; ++i) {
              const RealVector a = corners[(i + 1) % 4].cast<Real>(), b = corners[(i + 2) % 4].cast<Real>(),
                               c = corners[(i + 3) % 4].cast<Real>();
              RealVector n = (b - a).cross(c - a).normalized();
              if (n.dot(corners[i].cast<Real>() - a) > 0) n = -n;
              const Real above = n.dot(p - a);
              outside = std::max(outside, above);
              const RealVector foot = p - above * n;
              const auto side = [&](const RealVector& u, const RealVector& v) {
                return (v - u).cross(foot - u).dot(n);
              };
              const Real ab = side(a, b), bc = side(b, c), ca = side(c, a);
              if ((ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0))
                nearest = std::min(nearest, std::abs(above));
              for (const auto& [u, v] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
                const Real s = std::clamp<Real>((p - u).dot(v - u) / (v - u).squaredNorm(), 0, 1);
                nearest = std::min(nearest, (p - u - s * (v - u)).norm());
              }
            }
            return outside > 0 ? nearest : outside;
          }};
}

/// Waves on a slope.
class Waves : public Landscape {
 public:
  Waves(const Vector3& p_WB, const Matrix3& R_WB, double x, double y) : Landscape(p_WB, R_WB), x_(x), y_(y) {}
  double height(double x, double y) const override { return formula(x, y); }
  IntervalJet height(const IntervalJet& x, const IntervalJet& y) const override { return formula(x, y); }
  template <class T>
  T formula(const T& x, const T& y) const {
    using std::cos, std::sin;
    return T(0.3) * sin(T(x_) * x) * cos(T(y_) * y) + T(0.1) * x;
  }

 private:
  double x_, y_;
};
Kind terrain(Random& random, const Vector3& near) {
  const Matrix3 R = random.rotation();
  const double x = random.uniform(0.5, 4.0), y = random.uniform(0.5, 4.0);
  const auto waves = std::make_shared<const Waves>(near, R, x, y);
  // no steeper than this: so that the height changes no faster than the point moves
  const Real steepest = 1 + Real(0.3) * (x + y) + Real(0.1);
  return {Terrain{waves}, in_frame(near, R, [=](const RealVector& q) {
            return (q.z() - waves->formula<Real>(q.x(), q.y())) / steepest;
          })};
}

TEST(HollowContact, PointInSpheres) { run(1, false, sphere_cavity, 0.6); }
TEST(HollowContact, BallInSpheres) { run(2, true, sphere_cavity, 0.6); }
TEST(HollowContact, PointInBoxes) { run(3, false, box_cavity, 0.6); }
TEST(HollowContact, BallInBoxes) { run(4, true, box_cavity, 0.6); }
TEST(HollowContact, PointInCylinders) { run(5, false, cylinder_cavity, 0.6); }
TEST(HollowContact, BallInCylinders) { run(6, true, cylinder_cavity, 0.6); }
TEST(HollowContact, PointInCapsules) { run(7, false, capsule_cavity, 0.6); }
TEST(HollowContact, BallInCapsules) { run(8, true, capsule_cavity, 0.6); }
TEST(HollowContact, PointInEllipsoids) { run(9, false, ellipsoid_cavity, 0.6); }
TEST(HollowContact, BallInEllipsoids) { run(10, true, ellipsoid_cavity, 0.6); }

TEST(RoundedContact, PointAgainstCylinders) { run(11, false, rounded_cylinder); }
TEST(RoundedContact, BallAgainstCylinders) { run(12, true, rounded_cylinder); }
TEST(RoundedContact, PointAgainstCones) { run(13, false, rounded_cone); }
TEST(RoundedContact, BallAgainstCones) { run(14, true, rounded_cone); }
TEST(RoundedContact, PointAgainstBoxes) { run(15, false, rounded_box); }
TEST(RoundedContact, BallAgainstBoxes) { run(16, true, rounded_box); }

TEST(HullContact, PointAgainstBoxes) { run(18, false, sharp_box); }
TEST(HullContact, BallAgainstBoxes) { run(19, true, sharp_box); }
TEST(HullContact, PointAgainstTetrahedra) { run(20, false, tetrahedron); }
TEST(HullContact, BallAgainstTetrahedra) { run(21, true, tetrahedron); }

TEST(TerrainContact, PointOverWaves) { run(17, false, terrain); }

}  // namespace
}  // namespace trajet
