#include "shaped_solid.hpp"

#include <stdexcept>

#include "trajet/geom/compound.hpp"
#include "trajet/geom/rounded_solid.hpp"

namespace trajet {
namespace {

class SolidMaker {
 public:
  SolidMaker(const ShapeNumbers& numbers, std::optional<double> rounding) : numbers_(numbers), rounding_(rounding) {}

  ShapedSolid operator()(const PointShape&) const {
    refuse_rounding("a point");
    return at_center(Point{});
  }
  ShapedSolid operator()(const BallShape& shape) const {
    const double radius = numbers_.positive(shape.radius, "radius");
    require_blunt(Vector3::Constant(radius), rounding_);
    return at_center(Ball{radius});
  }
  ShapedSolid operator()(const CuboidShape& shape) const {
    const Vector3 size = numbers_.positive_vector(shape.size, "size");
    if (rounding_) return at_center(make_rounded_hull(box_corners(size), *rounding_));
    return at_center(Cuboid{0.5 * size});
  }
  ShapedSolid operator()(const CylinderShape& shape) const {
    const double radius = numbers_.positive(shape.radius, "radius");
    const double height = numbers_.positive(shape.height, "height");
    if (rounding_) return at_center(make_rounded_cylinder(radius, height, *rounding_));
    return at_center(Cylinder{radius, 0.5 * height});
  }
  ShapedSolid operator()(const CapsuleShape& shape) const {
    const double radius = numbers_.positive(shape.radius, "radius");
    require_blunt(Vector3::Constant(radius), rounding_);
    return at_center(Capsule{radius, 0.5 * numbers_.positive(shape.height, "height")});
  }
  ShapedSolid operator()(const ConeShape& shape) const {
    const double radius = numbers_.positive(shape.radius, "radius");
    const double height = numbers_.positive(shape.height, "height");
    if (!rounding_) return at_center(Cone{radius, height});
    return {make_rounded_cone(radius, height, *rounding_),
            grown_profile_properties(cone_core_profile(radius, height, *rounding_), *rounding_).center};
  }
  ShapedSolid operator()(const EllipsoidShape& shape) const {
    const Vector3 radii = numbers_.positive_vector(shape.radii, "radii");
    require_blunt(radii, rounding_);
    return at_center(Ellipsoid{radii});
  }
  ShapedSolid operator()(const SoccerBallShape& shape) const {
    const double radius = numbers_.positive(shape.radius, "radius");
    if (rounding_) return at_center(make_rounded_hull(truncated_icosahedron(radius), *rounding_));
    return at_center(SoccerBall{radius});
  }
  ShapedSolid operator()(const HullShape& shape) const {
    std::vector<Vector3> points;
    for (const Expression& point : shape.points) points.push_back(numbers_.vector(point, "point"));
    const TriangleMesh hull = convex_hull(points);
    if (!rounding_) return {make_hull(points), mesh_properties(hull).center};
    const Vector3 center = grown_hull_properties(eroded_hull(hull, *rounding_), *rounding_).center;
    return {make_rounded_hull(points, *rounding_), center};
  }
  ShapedSolid operator()(const MeshShape& shape) const {
    refuse_rounding("a mesh");
    const TriangleMesh surface = closed_mesh(scaled(shape, numbers_));
    return {make_closed_mesh(surface), mesh_properties(surface).center};
  }
  ShapedSolid operator()(const CompoundShape& shape) const {
    if (rounding_) throw std::domain_error("a compound has no rounding of its own: give it to its parts");
    std::vector<CompoundPart> parts;
    for (const PartDefinition& part : shape.parts) parts.push_back(this->part(part));
    if (any_differs(parts))
      throw InputError(shape.parts[0].where,
                       "either all parts" + numbers_.of() + " have a mass or density, or none has");
    const Compound compound = make_compound(std::move(parts));
    return {compound, -compound.parts->origin};
  }
  ShapedSolid operator()(const DiskShape& shape) const {
    const Vector3 normal = numbers_.direction(shape.normal, "normal");
    if (normal.head<2>() != Eigen::Vector2d(0.0, 0.0))
      throw std::domain_error("the normal of a disk that moves is the z axis of its frame: turn it by its orientation");
    if (rounding_)
      throw std::domain_error("a disk has no thickness within which it could be rounded: make it a flat cylinder");
    return at_center(RoundPlate{numbers_.positive(shape.radius, "radius")});
  }
  ShapedSolid operator()(const PlaneShape&) const { return refuse("plane"); }
  ShapedSolid operator()(const RectangleShape&) const { return refuse("rectangle"); }
  ShapedSolid operator()(const TriangleShape&) const { return refuse("triangle"); }
  ShapedSolid operator()(const TerrainShape&) const { return refuse("terrain"); }

 private:
  static ShapedSolid at_center(Solid solid) { return {std::move(solid), Vector3(0, 0, 0)}; }
  [[noreturn]] static ShapedSolid refuse(const std::string& shape) {
    throw std::domain_error("a " + shape + " is a shape of obstacles only");
  }
  void refuse_rounding(const std::string& shape) const {
    if (rounding_) throw std::domain_error(shape + " cannot be rounded");
  }

  CompoundPart part(const PartDefinition& part) const {
    ShapedSolid own;
    try {
      own = shaped_solid(part.shape, part.rounding, numbers_);
    } catch (const std::domain_error& error) {
      throw InputError(part.where, "part" + numbers_.of() + ": " + error.what());
    }
    CompoundPart result{std::move(own.solid), numbers_.vector(part.position, "position of a part"),
                        numbers_.rotation(part.orientation)};
    result.p_BP += result.R_BP * own.center;
    if (part.mass && part.density)
      throw InputError(part.density->where(), "a part" + numbers_.of() + " has both `mass` and `density`");
    if (part.mass) result.mass = numbers_.positive(*part.mass, "mass of a part");
    if (part.density) {
      const std::optional<VolumeProperties> properties = volume_properties(result.solid);
      if (!properties)
        throw InputError(part.density->where(),
                         "a part" + numbers_.of() + " is flat and has no volume: give `mass` instead of `density`");
      result.mass = numbers_.positive(*part.density, "density of a part") * properties->volume;
    }
    return result;
  }

  static bool any_differs(const std::vector<CompoundPart>& parts) {
    for (const CompoundPart& part : parts)
      if (part.mass.has_value() != parts[0].mass.has_value()) return true;
    return false;
  }

  const ShapeNumbers& numbers_;
  std::optional<double> rounding_;
};

}  // namespace

ShapedSolid shaped_solid(const ShapeDefinition& shape, const std::optional<Expression>& rounding,
                         const ShapeNumbers& numbers) {
  return std::visit(SolidMaker(numbers, numbers.rounding(rounding)), shape);
}

std::vector<Vector3> box_corners(const Vector3& size) {
  std::vector<Vector3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(0.5 * size.cwiseProduct(Vector3(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0)));
  return corners;
}

void require_blunt(const Vector3& radii, std::optional<double> rounding) {
  const double sharpest = radii.minCoeff() * (radii.minCoeff() / radii.maxCoeff());
  if (rounding && *rounding > sharpest)
    throw std::domain_error("the rounding is larger than the shape's least radius of curvature");
}

}  // namespace trajet
