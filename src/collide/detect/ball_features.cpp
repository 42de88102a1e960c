#include "trajet/collide/detect/ball_features.hpp"

#include <cmath>
#include <variant>

#include "trajet/geom/flat_faces.hpp"
#include "trajet/geom/triangle_surface.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

/// The part of a shape's surface that is at a point of it, where that is on no flat face.
class CurvedOrSharp {
 public:
  explicit CurvedOrSharp(const Vector3& point) : point_(point) {}

  Feature operator()(const Plane&) const { return Feature::face; }
  Feature operator()(const Sphere&) const { return Feature::surface; }
  Feature operator()(const EllipsoidBody&) const { return Feature::surface; }
  Feature operator()(const Terrain&) const { return Feature::surface; }
  Feature operator()(const Cavity&) const { return Feature::surface; }
  Feature operator()(const Disk&) const { return Feature::edge; }
  Feature operator()(const Triangle& triangle) const {
    return ranges::any_of(triangle.corners, [&](const Vector3& corner) { return is_at(corner); }) ? Feature::vertex
                                                                                                  : Feature::edge;
  }
  Feature operator()(const Rectangle& rectangle) const {
    const Vector3 right = rectangle.up.cross(rectangle.normal);
    const Vector3 arm = point_ - rectangle.center;
    const Vector3 folded(std::abs(arm.dot(right)), std::abs(arm.dot(rectangle.up)), 0.0);
    return is_small(folded - Vector3(0.5 * rectangle.width, 0.5 * rectangle.height, 0.0)) ? Feature::vertex
                                                                                          : Feature::edge;
  }
  Feature operator()(const Box& box) const {
    const Vector3 folded = (box.R_WB.transpose() * (point_ - box.center)).cwiseAbs();
    return is_small(folded - box.half_size) ? Feature::vertex : Feature::edge;
  }
  Feature operator()(const SolidOfRevolution& solid) const {
    if (solid.growth > 0.0) return Feature::surface;
    const Vector3 p = solid.R_WB.transpose() * (point_ - solid.center);
    const Eigen::Vector2d place(p.head<2>().norm(), p.z());
    for (const Eigen::Vector2d& corner : solid.profile)
      if (is_small({place.x() - corner.x(), place.y() - corner.y(), 0.0}))
        return corner.x() == 0.0 ? Feature::vertex : Feature::edge;
    return Feature::surface;
  }
  Feature operator()(const MeshSurface& surface) const {
    if (surface.triangles->growth > 0.0) return Feature::surface;
    for (const int index : triangles_at(*surface.triangles, point_, kNear * size()))
      if (const Triangle triangle = surface.triangles->triangle(index); (*this)(triangle) == Feature::vertex)
        return Feature::vertex;
    return Feature::edge;
  }

 private:
  /// Of the size of what is near: far above rounding, far below what can be seen.
  static constexpr double kNear = 1e-9;

  double size() const { return 1.0 + point_.norm(); }
  bool is_small(const Vector3& apart) const { return apart.norm() <= kNear * size(); }
  bool is_at(const Vector3& corner) const { return is_small(point_ - corner); }

  const Vector3& point_;
};

}  // namespace

TouchedFeatures features_of_ball(double radius, const Shape& shape, const Vector3& point, const Vector3& normal) {
  TouchedFeatures touched{radius > 0.0 ? Feature::surface : Feature::vertex, Feature::face, {point}};
  if (!is_flat_at(shape, point, normal)) touched.of_obstacle = std::visit(CurvedOrSharp(point), shape);
  return touched;
}

}  // namespace trajet
