#include "body_maker.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "trajet/geom/mass_properties.hpp"
#include "trajet/rigid/principal_axes.hpp"

namespace trajet {
namespace {

std::string of_body(const BodyDefinition& body) { return " of body '" + body.name + "'"; }

/// A shape with its numbers, centre of mass at the origin.
struct Solid {
  std::string_view name;
  double radius = 0.0;  // m, around the centre of mass
  bool is_ball = true;
  TriangleMesh surface{};
  std::optional<VolumeProperties> properties{};
};

/// What is wrong with a shape as a whole is reported where its body stands.
class SolidMaker {
 public:
  SolidMaker(const SceneNumbers& numbers, std::string of) : numbers_(numbers), of_(std::move(of)) {}

  Solid operator()(const PointShape&) const { return {"point"}; }
  Solid operator()(const BallShape& ball) const {
    const double radius = positive(ball.radius, "radius");
    return {"sphere", radius, true, {}, sphere_properties(radius)};
  }
  Solid operator()(const CuboidShape& box) const {
    const Vector3 size = numbers_.vector(box.size, "size" + of_);
    if (!(size.minCoeff() > 0.0)) throw InputError(box.size.where(), "size" + of_ + " must be positive");
    std::vector<Vector3> corners;
    for (int i = 0; i < 8; ++i)
      corners.push_back(0.5 * size.cwiseProduct(Vector3(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0)));
    return {"box", 0.5 * size.norm(), false, convex_hull(corners), box_properties(size)};
  }
  Solid operator()(const CylinderShape& cylinder) const {
    const double radius = positive(cylinder.radius, "radius"), height = positive(cylinder.height, "height");
    const TriangleMesh surface = turned({{radius, -0.5 * height}, {radius, 0.5 * height}});
    return {"cylinder", std::hypot(radius, 0.5 * height), false, surface, cylinder_properties(radius, height)};
  }
  Solid operator()(const CapsuleShape& capsule) const {
    const double radius = positive(capsule.radius, "radius"), height = positive(capsule.height, "height");
    constexpr int kRings = 6;  // of a half sphere, without its pole
    std::vector<std::pair<double, double>> profile;
    for (int i = 0; i <= kRings; ++i) {
      const double angle = 0.5 * std::numbers::pi * i / kRings;
      const double r = i == kRings ? 0.0 : radius * std::cos(angle), z = 0.5 * height + radius * std::sin(angle);
      profile.insert(profile.end(), {{r, z}, {r, -z}});
    }
    return {"capsule", radius + 0.5 * height, false, turned(profile), capsule_properties(radius, height)};
  }
  Solid operator()(const SoccerBallShape& ball) const {
    const double radius = positive(ball.radius, "radius");
    Solid solid{"soccer-ball", radius, false, convex_hull(truncated_icosahedron(radius))};
    VolumeProperties properties = mesh_properties(solid.surface);
    // by its symmetry every axis is a principal one: say so to the last bit
    properties.inertia = properties.inertia.trace() / 3.0 * Matrix3::Identity();
    solid.properties = properties;
    return solid;
  }
  Solid operator()(const HullShape& hull) const {
    std::vector<Vector3> points;
    for (const Expression& point : hull.points) points.push_back(numbers_.vector(point, "point" + of_));
    return centered("hull", convex_hull(points));
  }
  Solid operator()(const MeshShape& mesh) const {
    const double scale = positive(mesh.scale, "scale");
    TriangleMesh surface = closed_mesh(mesh.mesh);
    for (Vector3& vertex : surface.vertices) vertex *= scale;
    return centered("mesh", std::move(surface));
  }

 private:
  /// The hull of rings about z: distance from the axis and height of each.
  static TriangleMesh turned(const std::vector<std::pair<double, double>>& rings) {
    constexpr int kSides = 32;
    std::vector<Vector3> points;
    for (const auto& [r, z] : rings)
      for (int i = 0; i < (r > 0.0 ? kSides : 1); ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kSides;
        points.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
      }
    try {
      return convex_hull(points);
    } catch (const std::domain_error&) {  // too flat for a picture, which is no reason to refuse it
      return {};
    }
  }

  static Solid centered(std::string_view name, TriangleMesh surface) {
    const VolumeProperties properties = mesh_properties(surface);
    double radius = 0.0;
    for (Vector3& vertex : surface.vertices) {
      vertex -= properties.center;
      radius = std::max(radius, vertex.norm());
    }
    return {name, radius, false, std::move(surface), properties};
  }

  double positive(const Expression& value, const char* key) const { return numbers_.positive(value, key + of_); }

  const SceneNumbers& numbers_;
  std::string of_;
};

Solid make_solid(const BodyDefinition& definition, const SceneNumbers& numbers) {
  try {
    return std::visit(SolidMaker(numbers, of_body(definition)), definition.shape);
  } catch (const std::domain_error& error) {
    throw InputError(definition.where, "body '" + definition.name + "': " + error.what());
  }
}

bool has_inertia(const BodyDefinition& definition) {
  return definition.principal_inertia || !definition.inertia.empty();
}

Matrix3 given_inertia(const BodyDefinition& definition, const SceneNumbers& numbers) {
  const std::string what = "inertia" + of_body(definition);
  const Expression& first = definition.principal_inertia ? *definition.principal_inertia : definition.inertia[0];
  Matrix3 inertia;
  if (definition.principal_inertia) {
    inertia = numbers.vector(first, what).asDiagonal();
  } else {
    for (int i = 0; i < 3; ++i) inertia.row(i) = numbers.vector(definition.inertia[static_cast<std::size_t>(i)], what);
  }
  constexpr double kRounding = 1e-9;
  if (!(inertia - inertia.transpose()).isZero(kRounding * inertia.norm()))
    throw InputError(first.where(), what + " is not symmetric");
  inertia = Matrix3(0.5 * (inertia + inertia.transpose()));
  if (!is_possible_inertia(inertia))
    throw InputError(first.where(),
                     what +
                         " belongs to no body: its principal moments must be positive, and none more than "
                         "the sum of the other two");
  return inertia;
}

/// The inertia about the centre of mass, where there is one.
std::optional<Matrix3> inertia(const BodyDefinition& definition, const Solid& solid, const SceneNumbers& numbers) {
  if (has_inertia(definition)) return given_inertia(definition, numbers);
  if (!solid.properties) return std::nullopt;
  if (definition.density)
    return numbers.positive(*definition.density, "density" + of_body(definition)) * solid.properties->inertia;
  if (!definition.mass) return std::nullopt;
  const double mass = numbers.positive(*definition.mass, "mass" + of_body(definition));
  return mass / solid.properties->volume * solid.properties->inertia;
}

void require_no_conflict(const BodyDefinition& definition) {
  const auto exclude = [&](const std::optional<Expression>& a, const char* name_a, const std::optional<Expression>& b,
                           const char* name_b) {
    if (a && b)
      throw InputError(b->where(), "body '" + definition.name + "' has both `" + name_a + "` and `" + name_b + "`");
  };
  const auto& d = definition;
  exclude(d.angular_velocity, "angular_velocity", d.angular_velocity_body, "angular_velocity_body");
  exclude(d.angular_acceleration, "angular_acceleration", d.angular_acceleration_body, "angular_acceleration_body");
  for (const auto* acceleration : {&d.angular_acceleration, &d.angular_acceleration_body}) {
    exclude(*acceleration, "angular_acceleration", d.torque, "torque");
    exclude(*acceleration, "angular_acceleration", d.torque_body, "torque_body");
    exclude(*acceleration, "angular_acceleration", d.force_point, "force_point");
  }
  exclude(d.mass, "mass", d.density, "density");
  if (d.force_point && !d.force)
    throw InputError(d.force_point->where(), "body '" + d.name + "' has a `force_point` but no `force`");
}

std::optional<World::Rotation> rotation(const BodyDefinition& d, const Solid& solid, const SceneNumbers& numbers,
                                        const MethodOptions& method) {
  const std::optional<Expression>* const laws[] = {&d.angular_acceleration, &d.angular_acceleration_body, &d.torque,
                                                   &d.torque_body, &d.force_point};
  const auto law = std::ranges::find_if(laws, [](const auto* each) { return each->has_value(); });
  const bool has_law = law != std::end(laws);
  if (!has_law && !d.angular_velocity && !d.angular_velocity_body) return std::nullopt;

  World::Rotation result{.layout = {method.orientation}, .is_free = !has_law};
  if (!d.angular_acceleration && !d.angular_acceleration_body) result.inertia = inertia(d, solid, numbers);
  if (has_law && !result.inertia && !d.angular_acceleration && !d.angular_acceleration_body)
    throw InputError((*law)->value().where(), "body '" + d.name +
                                                  "' has a torque but no inertia: give `inertia`, or an "
                                                  "extended shape with `mass` or `density`");
  // sizes and masses far from those of this world overflow
  if (result.inertia && !(result.inertia->allFinite() && is_possible_inertia(*result.inertia)))
    throw InputError(d.where, "the inertia of body '" + d.name + "' is beyond the range of numbers");
  // free, with the same inertia about all axes: the angular velocity is constant
  const bool is_isotropic = result.inertia && *result.inertia == (*result.inertia)(0, 0) * Matrix3::Identity();
  if (result.is_free && is_isotropic) result.inertia.reset();
  result.layout.frame = result.inertia || d.angular_acceleration_body ? Frame::body : Frame::world;
  if (method.orientation == OrientationWay::exact && has_law)
    throw InputError((*law)->value().where(),
                     "orientation = \"exact\" knows closed forms only for bodies without torque or "
                     "with constant angular velocity; body '" +
                         d.name + "' has a law");
  return result;
}

}  // namespace

World::Body make_body(const BodyDefinition& definition, const SceneNumbers& numbers, const MethodOptions& method) {
  require_no_conflict(definition);
  if (has_inertia(definition)) given_inertia(definition, numbers);  // an error where it is none, even if nothing turns
  Solid solid = make_solid(definition, numbers);
  World::Body body;
  body.name = definition.name;
  body.where = definition.where;
  body.shape = solid.name;
  body.radius = solid.radius;
  body.is_ball = solid.is_ball;
  body.surface = std::move(solid.surface);
  body.q_WB = numbers.orientation(definition.orientation, "orientation" + of_body(definition));
  body.rotation = rotation(definition, solid, numbers, method);
  for (const NamedExpression& point : definition.points)
    body.points.push_back(
        {point.name, numbers.vector(point.value, "point '" + point.name + "'" + of_body(definition))});
  return body;
}

std::optional<double> mass_from_density(const BodyDefinition& definition, const SceneNumbers& numbers) {
  if (!definition.density) return std::nullopt;
  const Solid solid = make_solid(definition, numbers);
  if (!solid.properties)
    throw InputError(definition.density->where(), "a point has no volume: give `mass` instead of `density`");
  return numbers.positive(*definition.density, "density" + of_body(definition)) * solid.properties->volume;
}

Eigen::VectorXd start_state(const BodyDefinition& definition, const World::Body& body, const SceneNumbers& numbers) {
  const int rotation_size = body.rotation ? body.rotation->layout.size() + 3 : 0;
  Eigen::VectorXd state(6 + rotation_size);
  state.head<3>() = numbers.vector(definition.position, "position" + of_body(definition));
  state.segment<3>(3) = numbers.vector(definition.velocity, "velocity" + of_body(definition));
  if (!body.rotation) return state;

  body.rotation->layout.put(body.q_WB, state.data() + 6);
  Vector3 w = Vector3::Zero();
  const bool is_in_body = definition.angular_velocity_body.has_value();
  const auto& given = is_in_body ? definition.angular_velocity_body : definition.angular_velocity;
  if (given) w = numbers.vector(*given, "angular velocity" + of_body(definition));
  if (is_in_body && body.rotation->layout.frame == Frame::world) w = rotate<double>(body.q_WB, w);
  if (!is_in_body && body.rotation->layout.frame == Frame::body) w = rotate<double>(body.q_WB.conjugate(), w);
  state.tail<3>() = w;
  return state;
}

}  // namespace trajet
