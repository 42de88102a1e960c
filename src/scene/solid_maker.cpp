#include "solid_maker.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

#include "shaped_solid.hpp"
#include "terrain_maker.hpp"
#include "trajet/geom/cavity.hpp"
#include "trajet/geom/rounded_solid.hpp"
#include "trajet/geom/triangle_surface.hpp"

namespace trajet {
namespace {

/// Obstacles: the solid, where it stands, and the numbers of both together. One that is hollow, or has parts, may
/// become several.
class FixedSolid {
 public:
  using Made = std::vector<World::Obstacle>;

  FixedSolid(const ObstacleDefinition& definition, const ShapeNumbers& numbers, const ShapeNumbers& at_start)
      : FixedSolid(numbers,
                   definition.center ? at_start.vector(*definition.center, name_of_center(definition.shape))
                                     : Vector3(0, 0, 0),
                   definition.orientation ? at_start.rotation(*definition.orientation) : Matrix3(Matrix3::Identity()),
                   numbers.rounding(definition.rounding)) {
    is_moved_ = definition.center.has_value();
    is_hollow_ = definition.is_hollow;
    stays_outside_ = definition.on_hit == OnHit::bounce || definition.on_hit == OnHit::stick;
  }
  FixedSolid(const ShapeNumbers& numbers, const Vector3& center, const Matrix3& R_WB, std::optional<double> rounding)
      : numbers_(numbers), center_(center), R_WB_(R_WB), is_turned_(!R_WB_.isIdentity(0.0)), rounding_(rounding) {}

  Made operator()(const PlaneShape& shape) const {
    refuse_rounding();
    const Plane plane = make_plane(center_, direction(shape.normal, "normal"));
    return placed(HalfSpace{}, plane.point, frame(plane.normal.unitOrthogonal(), plane.normal), plane);
  }
  Made operator()(const DiskShape& shape) const {
    refuse_rounding();
    const Disk disk = make_disk(center_, direction(shape.normal, "normal"), numbers_.positive(shape.radius, "radius"));
    return placed(RoundPlate{disk.radius}, disk.center, frame(disk.normal.unitOrthogonal(), disk.normal), disk);
  }
  Made operator()(const RectangleShape& shape) const {
    refuse_rounding();
    const Vector3 normal = direction(shape.normal, "normal"), up = direction(shape.up, "up");
    const double width = numbers_.positive(shape.width, "size");
    const Rectangle rectangle = make_rectangle(center_, normal, up, width, numbers_.positive(shape.height, "size"));
    return placed(RectangularPlate{0.5 * rectangle.width, 0.5 * rectangle.height}, rectangle.center,
                  frame(rectangle.up.cross(rectangle.normal), rectangle.normal), rectangle);
  }
  Made operator()(const TriangleShape& shape) const {
    refuse_rounding();
    const Vector3 a = corner(shape.a), b = corner(shape.b), c = corner(shape.c);
    const Triangle triangle = make_triangle(a, b, c);
    const Vector3 middle = (a + b + c) / 3.0;
    const Matrix3 R_WB = frame((b - a).stableNormalized(), triangle.normal);
    const auto in_frame = [&](const Vector3& p) {
      const Vector3 q = R_WB.transpose() * (p - middle);
      return Vector3(q.x(), q.y(), 0.0);
    };
    return placed(TriangularPlate{{in_frame(a), in_frame(b), in_frame(c)}}, middle, R_WB, triangle);
  }
  Made operator()(const BallShape& shape) const {
    const double radius = numbers_.positive(shape.radius, "radius");
    if (is_hollow_) return hollow(make_sphere_cavity(center_, radius));
    require_blunt(Vector3::Constant(radius), rounding_);
    const Sphere sphere = make_sphere(center_, radius);
    return placed(Ball{sphere.radius}, sphere.center, R_WB_, sphere);
  }
  Made operator()(const CuboidShape& shape) const {
    const Vector3 size = numbers_.positive_vector(shape.size, "size");
    if (is_hollow_) return hollow(make_box_cavity(center_, size, R_WB_));
    if (rounding_) return rounded_hull(box_corners(size));
    const Box box = make_box(center_, size, R_WB_);
    return placed(Cuboid{box.half_size}, box.center, R_WB_, box);
  }
  Made operator()(const CylinderShape& shape) const {
    const double radius = numbers_.positive(shape.radius, "radius");
    const double height = numbers_.positive(shape.height, "height");
    if (is_hollow_) return hollow(make_cylinder_cavity(center_, R_WB_, radius, height));
    SolidOfRevolution cylinder = make_cylinder(center_, R_WB_, radius, height);
    if (!rounding_) return placed(Cylinder{radius, 0.5 * height}, center_, R_WB_, std::move(cylinder));
    cylinder.profile = cylinder_core_profile(radius, height, *rounding_);
    cylinder.growth = *rounding_;
    return placed(make_rounded_cylinder(radius, height, *rounding_), center_, R_WB_, std::move(cylinder));
  }
  Made operator()(const CapsuleShape& shape) const {
    const double radius = numbers_.positive(shape.radius, "radius");
    const double height = numbers_.positive(shape.height, "height");
    if (is_hollow_) return hollow(make_capsule_cavity(center_, R_WB_, radius, height));
    require_blunt(Vector3::Constant(radius), rounding_);
    return placed(Capsule{radius, 0.5 * height}, center_, R_WB_, make_capsule(center_, R_WB_, radius, height));
  }
  Made operator()(const ConeShape& shape) const {
    const double radius = numbers_.positive(shape.radius, "radius");
    const double height = numbers_.positive(shape.height, "height");
    SolidOfRevolution cone = make_cone(center_, R_WB_, radius, height);
    if (!rounding_) return placed(Cone{radius, height}, center_, R_WB_, std::move(cone));
    cone.profile = cone_core_profile(radius, height, *rounding_);
    cone.growth = *rounding_;
    const Vector3 center = grown_profile_properties(cone.profile, *rounding_).center;
    return placed(make_rounded_cone(radius, height, *rounding_), center_ + R_WB_ * center, R_WB_, std::move(cone));
  }
  Made operator()(const EllipsoidShape& shape) const {
    const Vector3 radii = numbers_.positive_vector(shape.radii, "radii");
    if (is_hollow_) return hollow(make_ellipsoid_cavity(center_, R_WB_, radii));
    require_blunt(radii, rounding_);
    return placed(Ellipsoid{radii}, center_, R_WB_, make_ellipsoid(center_, R_WB_, radii));
  }
  /// Its faces where they stand, as of a closed mesh.
  Made operator()(const HullShape& shape) const {
    std::vector<Vector3> points;
    if (rounding_) {
      for (const Expression& point : shape.points) points.push_back(numbers_.vector(point, "point"));
      return rounded_hull(points);
    }
    for (const Expression& point : shape.points) points.push_back(corner(point));
    MeshSurface surface = make_hull_surface(points);
    TriangleMesh mesh = surface.triangles->mesh;
    const VolumeProperties properties = mesh_properties(mesh);
    for (Vector3& vertex : mesh.vertices) vertex = R_WB_.transpose() * (vertex - properties.center);
    return placed(make_hull(mesh.vertices), properties.center, R_WB_, std::move(surface));
  }
  Made operator()(const MeshShape& shape) const {
    refuse_rounding();
    TriangleMesh mesh = scaled(shape, numbers_);
    for (Vector3& vertex : mesh.vertices) vertex = center_ + R_WB_ * vertex;
    MeshSurface surface = make_mesh_surface(mesh);
    mesh = surface.triangles->mesh;
    for (Vector3& vertex : mesh.vertices) vertex = R_WB_.transpose() * (vertex - center_);
    const CenteredMesh solid = make_mesh(std::move(mesh), surface.triangles->is_closed);
    return placed(solid.mesh, center_ + R_WB_ * solid.origin, R_WB_, std::move(surface));
  }
  Made operator()(const TerrainShape& shape) const {
    refuse_rounding();
    return placed(Surroundings{}, center_, R_WB_,
                  Terrain{make_landscape(shape.height, numbers_.scene().constants(), center_, R_WB_)});
  }
  Made operator()(const CompoundShape& shape) const {
    if (rounding_) throw std::domain_error("a compound has no rounding of its own: give it to its parts");
    Made made;
    for (const PartDefinition& part : shape.parts) {
      const Vector3 p_BP = numbers_.vector(part.position, "position of a part");
      try {
        FixedSolid maker(numbers_, center_ + R_WB_ * p_BP, R_WB_ * numbers_.rotation(part.orientation),
                         numbers_.rounding(part.rounding));
        maker.is_moved_ = true;
        for (World::Obstacle& each : std::visit(maker, part.shape)) made.push_back(std::move(each));
      } catch (const std::domain_error& error) {
        throw InputError(part.where, "part" + numbers_.of() + ": " + error.what());
      }
    }
    return made;
  }
  Made operator()(const PointShape&) const { return refuse("point"); }
  Made operator()(const SoccerBallShape&) const { return refuse("soccer ball"); }

 private:
  [[noreturn]] static Made refuse(const std::string& shape) {
    throw std::domain_error("a " + shape + " is a shape of bodies only");
  }
  void refuse_rounding() const {
    if (rounding_) throw std::domain_error("this shape cannot be rounded");
  }

  static Made placed(Solid solid, const Vector3& p_WB, const Matrix3& R_WB, Shape shape) {
    World::Obstacle obstacle;
    obstacle.solid = std::move(solid);
    obstacle.p_WB = p_WB;
    obstacle.q_WB = from_rotation_matrix(R_WB);
    obstacle.shape = std::move(shape);
    return {obstacle};
  }

  /// Where bodies do not get through, each wall is an obstacle of its own: in an edge they meet two at once.
  Made hollow(const Cavity& cavity) const {
    if (rounding_) throw std::domain_error("a hollow shape cannot be rounded");
    if (!stays_outside_) return placed(Surroundings{}, center_, R_WB_, cavity);
    Made made;
    for (const Cavity& wall : walls_of(cavity)) {
      const std::vector<Plane>& planes = wall.walls->planes;
      const bool is_flat = planes.size() == 1 && !wall.walls->round && !wall.walls->ellipsoid;
      made.push_back(is_flat ? placed(HalfSpace{}, planes[0].point,
                                      frame(planes[0].normal.unitOrthogonal(), planes[0].normal), wall)[0]
                             : placed(Surroundings{}, center_, R_WB_, wall)[0]);
    }
    return made;
  }

  Made rounded_hull(std::vector<Vector3> points) const {
    const RoundedSolid solid = make_rounded_hull(points, *rounding_);
    const Vector3 center = grown_hull_properties(eroded_hull(convex_hull(points), *rounding_), *rounding_).center;
    for (Vector3& point : points) point = center_ + R_WB_ * point;
    return placed(solid, center_ + R_WB_ * center, R_WB_, make_hull_surface(points, *rounding_));
  }

  /// As scene files call it.
  static const char* name_of_center(const ShapeDefinition& shape) {
    return std::holds_alternative<PlaneShape>(shape) ? "point" : "center";
  }

  /// The frame with these directions of x and z, orthogonal unit vectors.
  static Matrix3 frame(const Vector3& x, const Vector3& z) {
    Matrix3 R;
    R << x, z.cross(x), z;
    return R;
  }

  // What is not turned or moved keeps its numbers to the last bit, the sign of a zero too.
  Vector3 direction(const Expression& value, const char* key) const {
    const Vector3 v = numbers_.direction(value, key);
    return is_turned_ ? Vector3(R_WB_ * v) : v;
  }
  Vector3 corner(const Expression& value) const {
    const Vector3 p = numbers_.vector(value, "corner");
    const Vector3 turned = is_turned_ ? Vector3(R_WB_ * p) : p;
    return is_moved_ ? Vector3(center_ + turned) : turned;
  }

  const ShapeNumbers& numbers_;
  Vector3 center_;
  Matrix3 R_WB_;
  bool is_turned_;
  std::optional<double> rounding_;
  bool is_moved_ = false;
  bool is_hollow_ = false;
  bool stays_outside_ = false;
};

}  // namespace

// What is wrong with a shape as a whole is reported where its body or obstacle stands.

Solid make_solid(const BodyDefinition& body, const SceneNumbers& numbers) {
  const std::string name = "body '" + body.name + "'";
  try {
    return shaped_solid(body.shape, body.rounding, ShapeNumbers(numbers, " of " + name)).solid;
  } catch (const std::domain_error& error) {
    throw InputError(body.where, name + ": " + error.what());
  }
}

std::vector<World::Obstacle> make_obstacles(const ObstacleDefinition& definition, const SceneNumbers& numbers,
                                            const SceneNumbers& at_start) {
  const std::string name = "obstacle '" + definition.name + "'";
  try {
    const ShapeNumbers shape_numbers(numbers, " of " + name), place_numbers(at_start, " of " + name);
    std::vector<World::Obstacle> made =
        std::visit(FixedSolid(definition, shape_numbers, place_numbers), definition.shape);
    for (World::Obstacle& obstacle : made) {
      obstacle.name = definition.name;
      obstacle.where = definition.where;
      obstacle.color = definition.color;
    }
    return made;
  } catch (const std::domain_error& error) {
    throw InputError(definition.where, name + ": " + error.what());
  }
}

}  // namespace trajet
