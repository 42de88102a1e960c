#include "trajet/geom/solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "trajet/geom/compound.hpp"
#include "trajet/geom/rounded_solid.hpp"
#include "trajet/geom/shape_pictures.hpp"
#include "trajet/math/polynomial.hpp"

namespace trajet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Moved to a place that becomes the origin.
std::shared_ptr<const Polyhedron> centered(TriangleMesh surface, const Vector3& origin,
                                           const std::optional<VolumeProperties>& properties) {
  double radius = 0.0;
  for (Vector3& vertex : surface.vertices) {
    vertex -= origin;
    radius = std::max(radius, vertex.norm());
  }
  return std::make_shared<const Polyhedron>(Polyhedron{std::move(surface), radius, properties});
}

/// Moved to the centre of mass.
std::shared_ptr<const Polyhedron> centered(TriangleMesh surface) {
  const VolumeProperties properties = mesh_properties(surface);
  return centered(std::move(surface), properties.center, properties);
}

Vector3 middle_of_box(const TriangleMesh& surface) {
  Aabb box;
  for (const Vector3& vertex : surface.vertices) box = united(box, vertex);
  return 0.5 * (box.lower + box.upper);
}

struct BoundingRadius {
  double operator()(const Point&) const { return 0.0; }
  double operator()(const Ball& ball) const { return ball.radius; }
  double operator()(const Cuboid& cuboid) const { return cuboid.half_size.norm(); }
  double operator()(const Cylinder& cylinder) const { return std::hypot(cylinder.radius, cylinder.half_height); }
  double operator()(const Capsule& capsule) const { return capsule.radius + capsule.half_height; }
  double operator()(const Cone& cone) const {
    return std::max(0.75 * cone.height, std::hypot(cone.radius, 0.25 * cone.height));
  }
  double operator()(const Ellipsoid& ellipsoid) const { return ellipsoid.radii.maxCoeff(); }
  double operator()(const SoccerBall& ball) const { return ball.radius; }
  double operator()(const Hull& hull) const { return hull.polyhedron->radius; }
  double operator()(const Mesh& mesh) const { return mesh.polyhedron->radius; }
  double operator()(const RoundedSolid& solid) const { return bounding_radius(*solid.core); }
  double operator()(const Compound& compound) const {
    double radius = 0.0;
    for (const CompoundPart& part : compound.parts->parts)
      radius = std::max(radius, part.p_BP.norm() + bounding_radius(part.solid));
    return radius;
  }
  double operator()(const HalfSpace&) const { return kInfinity; }
  double operator()(const Surroundings&) const { return kInfinity; }
  double operator()(const RoundPlate& plate) const { return plate.radius; }
  double operator()(const RectangularPlate& plate) const { return std::hypot(plate.half_width, plate.half_height); }
  double operator()(const TriangularPlate& plate) const {
    double radius = 0.0;
    for (const Vector3& corner : plate.corners) radius = std::max(radius, corner.norm());
    return radius;
  }
};

struct VolumePropertiesOf {
  using Result = std::optional<VolumeProperties>;
  Result operator()(const Point&) const { return std::nullopt; }
  Result operator()(const Ball& ball) const { return sphere_properties(ball.radius); }
  Result operator()(const Cuboid& cuboid) const { return box_properties(2.0 * cuboid.half_size); }
  Result operator()(const Cylinder& cylinder) const {
    return cylinder_properties(cylinder.radius, 2.0 * cylinder.half_height);
  }
  Result operator()(const Capsule& capsule) const {
    return capsule_properties(capsule.radius, 2.0 * capsule.half_height);
  }
  Result operator()(const Cone& cone) const { return cone_properties(cone.radius, cone.height); }
  Result operator()(const Ellipsoid& ellipsoid) const { return ellipsoid_properties(ellipsoid.radii); }
  Result operator()(const SoccerBall& ball) const {
    VolumeProperties properties = mesh_properties(convex_hull(truncated_icosahedron(ball.radius)));
    // by its symmetry every axis is a principal one: say so to the last bit
    properties.inertia = properties.inertia.trace() / 3.0 * Matrix3::Identity();
    return properties;
  }
  Result operator()(const Hull& hull) const { return hull.polyhedron->properties; }
  Result operator()(const Mesh& mesh) const { return mesh.polyhedron->properties; }
  Result operator()(const RoundedSolid& solid) const { return solid.core->properties; }
  Result operator()(const Compound& compound) const {
    const CompoundParts& parts = *compound.parts;
    if (parts.volume == 0.0) return std::nullopt;
    return VolumeProperties{parts.volume, Vector3::Zero(), parts.volume * parts.unit_inertia};
  }
  Result operator()(const HalfSpace&) const { return std::nullopt; }
  Result operator()(const Surroundings&) const { return std::nullopt; }
  Result operator()(const RoundPlate&) const { return std::nullopt; }
  Result operator()(const RectangularPlate&) const { return std::nullopt; }
  Result operator()(const TriangularPlate&) const { return std::nullopt; }
};

/// How far a solid reaches from its origin along a direction d (unit) of the world: the greatest d . (R p) of its
/// points p, with the direction n = R^T d in the solid's frame.
class Reach {
 public:
  explicit Reach(const Vector3& n) : n_(n) {}

  double operator()(const Point&) const { return 0.0; }
  double operator()(const Ball& ball) const { return ball.radius; }
  double operator()(const Cuboid& cuboid) const { return n_.cwiseAbs().dot(cuboid.half_size); }
  double operator()(const Cylinder& cylinder) const {
    return cylinder.radius * n_.head<2>().norm() + cylinder.half_height * std::abs(n_.z());
  }
  double operator()(const Capsule& capsule) const { return capsule.radius + capsule.half_height * std::abs(n_.z()); }
  double operator()(const Cone& cone) const {
    return std::max(0.75 * cone.height * n_.z(), cone.radius * n_.head<2>().norm() - 0.25 * cone.height * n_.z());
  }
  double operator()(const Ellipsoid& ellipsoid) const { return n_.cwiseProduct(ellipsoid.radii).norm(); }
  double operator()(const SoccerBall& ball) const { return ball.radius; }
  double operator()(const Hull& hull) const { return of_points(hull.polyhedron->surface.vertices); }
  double operator()(const Mesh& mesh) const { return of_points(mesh.polyhedron->surface.vertices); }
  double operator()(const RoundedSolid& solid) const { return n_.dot(farthest_point(*solid.core, n_)); }
  double operator()(const Compound& compound) const {
    double farthest = -kInfinity;
    for (const CompoundPart& part : compound.parts->parts)
      farthest = std::max(farthest, n_.dot(part.p_BP) + std::visit(Reach(part.R_BP.transpose() * n_), part.solid));
    return farthest;
  }
  double operator()(const Surroundings&) const { return kInfinity; }
  double operator()(const HalfSpace&) const { return n_ == Vector3::UnitZ() ? 0.0 : kInfinity; }
  double operator()(const RoundPlate& plate) const { return plate.radius * n_.head<2>().norm(); }
  double operator()(const RectangularPlate& plate) const {
    return plate.half_width * std::abs(n_.x()) + plate.half_height * std::abs(n_.y());
  }
  double operator()(const TriangularPlate& plate) const { return of_points(plate.corners); }

 private:
  double of_points(std::span<const Vector3> points) const {
    double farthest = -kInfinity;
    for (const Vector3& p : points) farthest = std::max(farthest, n_.dot(p));
    return farthest;
  }

  Vector3 n_;
};

/// The hull of rings about z: distance from the axis and height of each.
TriangleMesh turned(const std::vector<std::pair<double, double>>& rings) {
  constexpr int kSides = 32;
  std::vector<Vector3> points;
  for (const auto& [r, z] : rings)
    for (int i = 0; i < (r > 0.0 ? kSides : 1); ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kSides;
      points.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
  try {
    return convex_hull(points);
  } catch (const std::domain_error&) {  // too flat for a picture
    return {};
  }
}

/// A polygon in the plane z = 0, cut into triangles from its first corner.
TriangleMesh flat(std::vector<Vector3> corners) {
  TriangleMesh mesh{std::move(corners), {}};
  for (int i = 2; i < static_cast<int>(mesh.vertices.size()); ++i) mesh.triangles.push_back({0, i - 1, i});
  return mesh;
}

/// With the same triangles seen from behind, on corners of their own.
TriangleMesh two_sided(TriangleMesh mesh) {
  const auto corners = static_cast<int>(mesh.vertices.size());
  const std::vector<Vector3> front = mesh.vertices;
  mesh.vertices.insert(mesh.vertices.end(), front.begin(), front.end());
  const auto triangles = mesh.triangles;
  for (const auto& [a, b, c] : triangles) mesh.triangles.push_back({corners + a, corners + c, corners + b});
  return mesh;
}

struct PictureMesh {
  TriangleMesh operator()(const Point&) const { return {}; }
  TriangleMesh operator()(const Ball&) const { return {}; }
  TriangleMesh operator()(const Cuboid& cuboid) const {
    std::vector<Vector3> corners;
    for (int i = 0; i < 8; ++i)
      corners.push_back(
          cuboid.half_size.cwiseProduct(Vector3(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0)));
    return convex_hull(corners);
  }
  TriangleMesh operator()(const Cylinder& cylinder) const {
    return turned({{cylinder.radius, -cylinder.half_height}, {cylinder.radius, cylinder.half_height}});
  }
  TriangleMesh operator()(const Capsule& capsule) const {
    constexpr int kRings = 6;  // of a half sphere, without its pole
    std::vector<std::pair<double, double>> profile;
    for (int i = 0; i <= kRings; ++i) {
      const double angle = 0.5 * std::numbers::pi * i / kRings;
      const double r = i == kRings ? 0.0 : capsule.radius * std::cos(angle);
      const double z = capsule.half_height + capsule.radius * std::sin(angle);
      profile.insert(profile.end(), {{r, z}, {r, -z}});
    }
    return turned(profile);
  }
  TriangleMesh operator()(const Cone& cone) const {
    return turned({{cone.radius, -0.25 * cone.height}, {0.0, 0.75 * cone.height}});
  }
  TriangleMesh operator()(const Ellipsoid& ellipsoid) const { return ellipsoid_picture(ellipsoid.radii); }
  TriangleMesh operator()(const SoccerBall& ball) const { return convex_hull(truncated_icosahedron(ball.radius)); }
  TriangleMesh operator()(const Hull& hull) const { return hull.polyhedron->surface; }
  TriangleMesh operator()(const Mesh& mesh) const { return mesh.polyhedron->surface; }
  TriangleMesh operator()(const RoundedSolid& solid) const { return picture_mesh(*solid.core); }
  TriangleMesh operator()(const Compound& compound) const {
    TriangleMesh mesh;
    for (const CompoundPart& part : compound.parts->parts) {
      const auto* ball = std::get_if<Ball>(&part.solid);
      const TriangleMesh own =
          placed(ball != nullptr ? ellipsoid_picture(Vector3::Constant(ball->radius)) : std::visit(*this, part.solid),
                 part.p_BP, part.R_BP);
      const int first = static_cast<int>(mesh.vertices.size());
      mesh.vertices.insert(mesh.vertices.end(), own.vertices.begin(), own.vertices.end());
      for (const auto& [a, b, c] : own.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
    }
    return mesh;
  }
  TriangleMesh operator()(const HalfSpace&) const { return {}; }
  TriangleMesh operator()(const Surroundings&) const { return {}; }
  TriangleMesh operator()(const RoundPlate& plate) const {
    constexpr int kSides = 32;
    std::vector<Vector3> rim;
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kSides;
      rim.emplace_back(plate.radius * std::cos(angle), plate.radius * std::sin(angle), 0.0);
    }
    return two_sided(flat(std::move(rim)));
  }
  TriangleMesh operator()(const RectangularPlate& plate) const {
    const double x = plate.half_width, y = plate.half_height;
    return two_sided(flat({{-x, -y, 0.0}, {x, -y, 0.0}, {x, y, 0.0}, {-x, y, 0.0}}));
  }
  TriangleMesh operator()(const TriangularPlate& plate) const {
    return two_sided(flat({plate.corners[0], plate.corners[1], plate.corners[2]}));
  }
};

}  // namespace

Hull make_hull(std::span<const Vector3> points) { return {centered(convex_hull(points))}; }

Mesh make_closed_mesh(const TriangleMesh& surface) { return {centered(closed_mesh(surface))}; }

CenteredMesh make_mesh(TriangleMesh surface, bool is_closed) {
  const std::optional<VolumeProperties> properties = is_closed ? std::optional(mesh_properties(surface)) : std::nullopt;
  const Vector3 origin = properties ? properties->center : middle_of_box(surface);
  return {{centered(std::move(surface), origin, properties)}, origin};
}

double bounding_radius(const Solid& solid) { return std::visit(BoundingRadius(), solid); }

bool is_round(const Solid& solid) {
  return std::holds_alternative<Point>(solid) || std::holds_alternative<Ball>(solid);
}

std::optional<VolumeProperties> volume_properties(const Solid& solid) {
  return std::visit(VolumePropertiesOf(), solid);
}

Aabb bounds(const Solid& solid, const Vector3& p_WB, const Matrix3& R_WB) {
  Aabb box;
  for (int i = 0; i < 3; ++i) {
    const Vector3 n = R_WB.row(i).transpose();
    const double above = std::visit(Reach(n), solid), below = std::visit(Reach(-n), solid);
    // the sums of three products, and a pose that is rounded itself
    constexpr double kRoundings = 16.0;
    const auto widened = [&](double reach) {
      return std::isinf(reach) ? reach : reach + kRoundings * kUnitRoundoff * (std::abs(reach) + p_WB.lpNorm<1>());
    };
    box.lower[i] = p_WB[i] - widened(below);
    box.upper[i] = p_WB[i] + widened(above);
  }
  return box;
}

TriangleMesh picture_mesh(const Solid& solid) { return std::visit(PictureMesh(), solid); }

}  // namespace trajet
