#include "solid_maker.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

#include "trajet/geom/triangle_surface.hpp"

namespace trajet {
namespace {

/// The numbers of a shape's definition. Messages end in whose they are: " of body 'ball'".
class ShapeNumbers {
 public:
  ShapeNumbers(const SceneNumbers& numbers, std::string of) : numbers_(numbers), of_(std::move(of)) {}

  double positive(const Expression& value, const char* key) const { return numbers_.positive(value, key + of_); }
  Vector3 vector(const Expression& value, const char* key) const { return numbers_.vector(value, key + of_); }
  Vector3 positive_vector(const Expression& value, const char* key) const {
    const Vector3 numbers = vector(value, key);
    if (!(numbers.minCoeff() > 0.0)) throw InputError(value.where(), key + of_ + " must be positive");
    return numbers;
  }
  Vector3 direction(const Expression& value, const char* key) const {
    const Vector3 numbers = vector(value, key);
    if (numbers.isZero(0.0)) throw InputError(value.where(), key + of_ + " must not be zero");
    return numbers;
  }
  Matrix3 rotation(const OrientationDefinition& orientation) const {
    return rotation_matrix(numbers_.orientation(orientation, "orientation" + of_));
  }

 private:
  const SceneNumbers& numbers_;
  std::string of_;
};

TriangleMesh scaled(const MeshShape& mesh, const ShapeNumbers& numbers) {
  const double scale = numbers.positive(mesh.scale, "scale");
  TriangleMesh surface = mesh.mesh;
  for (Vector3& vertex : surface.vertices) vertex *= scale;
  return surface;
}

/// The solids of bodies.
class BodySolid {
 public:
  explicit BodySolid(const ShapeNumbers& numbers) : numbers_(numbers) {}

  Solid operator()(const PointShape&) const { return Point{}; }
  Solid operator()(const BallShape& ball) const { return Ball{numbers_.positive(ball.radius, "radius")}; }
  Solid operator()(const CuboidShape& box) const { return Cuboid{0.5 * numbers_.positive_vector(box.size, "size")}; }
  Solid operator()(const CylinderShape& cylinder) const {
    const double radius = numbers_.positive(cylinder.radius, "radius");
    return Cylinder{radius, 0.5 * numbers_.positive(cylinder.height, "height")};
  }
  Solid operator()(const CapsuleShape& capsule) const {
    const double radius = numbers_.positive(capsule.radius, "radius");
    return Capsule{radius, 0.5 * numbers_.positive(capsule.height, "height")};
  }
  Solid operator()(const SoccerBallShape& ball) const { return SoccerBall{numbers_.positive(ball.radius, "radius")}; }
  Solid operator()(const HullShape& hull) const {
    std::vector<Vector3> points;
    for (const Expression& point : hull.points) points.push_back(numbers_.vector(point, "point"));
    return make_hull(points);
  }
  Solid operator()(const MeshShape& mesh) const { return make_closed_mesh(scaled(mesh, numbers_)); }
  Solid operator()(const PlaneShape&) const { return refuse("plane"); }
  Solid operator()(const DiskShape&) const { return refuse("disk"); }
  Solid operator()(const RectangleShape&) const { return refuse("rectangle"); }
  Solid operator()(const TriangleShape&) const { return refuse("triangle"); }

 private:
  [[noreturn]] static Solid refuse(const std::string& shape) {
    throw std::domain_error("a " + shape + " is a shape of obstacles only");
  }

  const ShapeNumbers& numbers_;
};

/// Obstacles: the solid, where it stands, and the numbers of both together.
class FixedSolid {
 public:
  FixedSolid(const ObstacleDefinition& definition, const ShapeNumbers& numbers)
      : numbers_(numbers),
        center_(definition.center ? numbers.vector(*definition.center, name_of_center(definition.shape))
                                  : Vector3(0, 0, 0)),
        is_moved_(definition.center.has_value()),
        R_WB_(definition.orientation ? numbers.rotation(*definition.orientation) : Matrix3::Identity()),
        is_turned_(!R_WB_.isIdentity(0.0)) {}

  World::Obstacle operator()(const PlaneShape& shape) const {
    const Plane plane = make_plane(center_, direction(shape.normal, "normal"));
    return placed(HalfSpace{}, plane.point, frame(plane.normal.unitOrthogonal(), plane.normal), plane);
  }
  World::Obstacle operator()(const DiskShape& shape) const {
    const Disk disk = make_disk(center_, direction(shape.normal, "normal"), numbers_.positive(shape.radius, "radius"));
    return placed(RoundPlate{disk.radius}, disk.center, frame(disk.normal.unitOrthogonal(), disk.normal), disk);
  }
  World::Obstacle operator()(const RectangleShape& shape) const {
    const Vector3 normal = direction(shape.normal, "normal"), up = direction(shape.up, "up");
    const double width = numbers_.positive(shape.width, "size");
    const Rectangle rectangle = make_rectangle(center_, normal, up, width, numbers_.positive(shape.height, "size"));
    return placed(RectangularPlate{0.5 * rectangle.width, 0.5 * rectangle.height}, rectangle.center,
                  frame(rectangle.up.cross(rectangle.normal), rectangle.normal), rectangle);
  }
  World::Obstacle operator()(const TriangleShape& shape) const {
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
  World::Obstacle operator()(const BallShape& shape) const {
    const Sphere sphere = make_sphere(center_, numbers_.positive(shape.radius, "radius"));
    return placed(Ball{sphere.radius}, sphere.center, R_WB_, sphere);
  }
  World::Obstacle operator()(const CuboidShape& shape) const {
    const Box box = make_box(center_, numbers_.vector(shape.size, "size"), R_WB_);
    return placed(Cuboid{box.half_size}, box.center, R_WB_, box);
  }
  World::Obstacle operator()(const PointShape&) const { return refuse("point"); }
  World::Obstacle operator()(const CylinderShape&) const { return refuse("cylinder"); }
  World::Obstacle operator()(const CapsuleShape&) const { return refuse("capsule"); }
  World::Obstacle operator()(const SoccerBallShape&) const { return refuse("soccer ball"); }
  World::Obstacle operator()(const HullShape&) const { return refuse("hull"); }
  World::Obstacle operator()(const MeshShape& shape) const {
    TriangleMesh mesh = scaled(shape, numbers_);
    for (Vector3& vertex : mesh.vertices) vertex = center_ + R_WB_ * vertex;
    MeshSurface surface = make_mesh_surface(mesh);
    mesh = surface.triangles->mesh;
    for (Vector3& vertex : mesh.vertices) vertex = R_WB_.transpose() * (vertex - center_);
    const CenteredMesh solid = make_mesh(std::move(mesh), surface.triangles->is_closed);
    return placed(solid.mesh, center_ + R_WB_ * solid.origin, R_WB_, std::move(surface));
  }

 private:
  [[noreturn]] static World::Obstacle refuse(const std::string& shape) {
    throw std::domain_error("a " + shape + " is a shape of bodies only");
  }

  static World::Obstacle placed(Solid solid, const Vector3& p_WB, const Matrix3& R_WB, Shape shape) {
    World::Obstacle obstacle;
    obstacle.solid = std::move(solid);
    obstacle.p_WB = p_WB;
    obstacle.q_WB = from_rotation_matrix(R_WB);
    obstacle.shape = std::move(shape);
    return obstacle;
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
  bool is_moved_;
  Matrix3 R_WB_;
  bool is_turned_;
};

}  // namespace

// What is wrong with a shape as a whole is reported where its body or obstacle stands.

Solid make_solid(const BodyDefinition& body, const SceneNumbers& numbers) {
  const std::string name = "body '" + body.name + "'";
  try {
    return std::visit(BodySolid(ShapeNumbers(numbers, " of " + name)), body.shape);
  } catch (const std::domain_error& error) {
    throw InputError(body.where, name + ": " + error.what());
  }
}

World::Obstacle make_obstacle(const ObstacleDefinition& definition, const SceneNumbers& numbers) {
  const std::string name = "obstacle '" + definition.name + "'";
  try {
    const ShapeNumbers shape_numbers(numbers, " of " + name);
    World::Obstacle obstacle = std::visit(FixedSolid(definition, shape_numbers), definition.shape);
    obstacle.name = definition.name;
    obstacle.where = definition.where;
    obstacle.on_hit = definition.on_hit;
    return obstacle;
  } catch (const std::domain_error& error) {
    throw InputError(definition.where, name + ": " + error.what());
  }
}

}  // namespace trajet
