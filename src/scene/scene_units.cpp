#include "trajet/scene/scene_units.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <variant>

#include "scene_symbols.hpp"

#include "trajet/portable.hpp"

namespace trajet {
namespace {

using Measures = std::map<std::string, Measure, std::less<>>;

/// Measures each parameter after those it uses.
class ParameterSurvey {
 public:
  explicit ParameterSurvey(const Scene& scene) : scene_(scene) {}

  Measures run() {
    for (const NamedExpression& parameter : scene_.parameters) find(parameter.name);
    return measures_;
  }

 private:
  Measure find(std::string_view name) {
    const auto known = measures_.find(name);
    if (known != measures_.end()) return known->second;
    const auto parameter = ranges::find(scene_.parameters, name, &NamedExpression::name);
    if (parameter == scene_.parameters.end()) return {};
    measures_[parameter->name] = {};  // for a circle, which is an error elsewhere
    const Measure found = measure(parameter->value, [this](std::string_view used) { return find(used); });
    return measures_[parameter->name] = found;
  }

  const Scene& scene_;
  Measures measures_;
};

/// Of a part of a body, by its name in laws.
Dimension dimension_of_part(std::string_view part) {
  switch (part.front()) {
    case 'v':
      return kSpeed;
    case 'w':
      return kAngularVelocity;
    case 'q':
    case 'R':
      return kDimensionless;
    default:
      return kLength;
  }
}

bool is_part(std::string_view name) {
  return find_body_part(name) != nullptr || ranges::find(kRotationNames, name) != std::end(kRotationNames);
}

class UnitCheck {
 public:
  explicit UnitCheck(const Scene& scene) : scene_(scene), names_(parameter_measures(scene)) {
    const MeasureOfName parameters = [this](std::string_view name) { return of(name); };
    Measures states;
    for (const StateDefinition& state : scene.states) {
      Measure found = measure(state.value, parameters);
      if (found.kind == Measure::Kind::known) found = Measure::moving(found.dimension);
      states[state.name] = found;
    }
    names_.merge(states);
    names_["t"] = Measure::moving(kTime);
  }

  void run() {
    check(scene_.time.start, kTime);
    for (const auto* time : {&scene_.time.end, &scene_.time.sample, &scene_.method.step, &scene_.method.max_step,
                             &scene_.method.max_seconds})
      check(*time, kTime);
    for (const auto* tolerance : {&scene_.method.rtol, &scene_.method.atol}) check(*tolerance, kDimensionless);
    check(scene_.method.steps, kTime);
    for (const BodyDefinition& body : scene_.bodies) check_body(body);
    for (const ObstacleDefinition& obstacle : scene_.obstacles) {
      std::visit([this](const auto& shape) { check_shape(shape); }, obstacle.shape);
      check(obstacle.rounding, kLength);
      check(obstacle.center, kLength);
      check(obstacle.velocity, kSpeed);
      check(obstacle.angular_velocity, kAngularVelocity);
      if (obstacle.orientation) check_orientation(*obstacle.orientation);
      check_surface(obstacle);
    }
    for (const PairDefinition& pair : scene_.pairs) check_surface(pair);
    for (const StateDefinition& state : scene_.states) check_rate(state);
    for (const EventDefinition& event : scene_.events) {
      measure(event.when, global());
      for (const NamedExpression& assignment : event.set) check_target(assignment);
    }
    for (const NamedExpression& closed_form : scene_.exact) check_target(closed_form);
    for (const ExactOrientation& closed_form : scene_.exact_orientations) check_orientation(closed_form.value);
  }

 private:
  Measure of(std::string_view name) const {
    const auto known = names_.find(name);
    if (known != names_.end()) return known->second;
    const std::size_t dot = name.rfind('.');
    if (dot == std::string_view::npos || !is_part(name.substr(dot + 1))) return {};
    return Measure::moving(dimension_of_part(name.substr(dot + 1)));
  }

  MeasureOfName global() const {
    return [this](std::string_view name) { return of(name); };
  }
  /// With the names that a body's own laws have for its parts.
  MeasureOfName own() const {
    return
        [this](std::string_view name) { return is_part(name) ? Measure::moving(dimension_of_part(name)) : of(name); };
  }

  /// With the name that an impact's law has for the speed of approach.
  MeasureOfName at_impact() const {
    return [this](std::string_view name) { return name == "u" ? Measure::moving(kSpeed) : of(name); };
  }

  void check(const Expression& value, const Dimension& expected) const { require_dimension(value, expected, global()); }
  void check(const std::optional<Expression>& value, const Dimension& expected) const {
    if (value) check(*value, expected);
  }
  void check(const std::vector<Expression>& values, const Dimension& expected) const {
    for (const Expression& value : values) check(value, expected);
  }
  /// A direction may have any length, in any unit.
  void check_direction(const Expression& value) const { measure(value, global()); }

  template <class Definition>
  void check_surface(const Definition& definition) const {
    if (definition.restitution) require_dimension(*definition.restitution, kDimensionless, at_impact());
    if (!definition.friction) return;
    check(definition.friction->friction, kDimensionless);
    check(definition.friction->tangential_restitution, kDimensionless);
    check(definition.friction->rolling_friction, kLength);
    check(definition.friction->spinning_friction, kLength);
  }

  void check_body(const BodyDefinition& body) const {
    std::visit([this](const auto& shape) { check_shape(shape); }, body.shape);
    check_surface(body);
    check(body.rounding, kLength);
    check(body.position, kLength);
    check(body.velocity, kSpeed);
    check(body.angular_velocity, kAngularVelocity);
    check(body.angular_velocity_body, kAngularVelocity);
    check(body.density, kDensity);
    check(body.principal_inertia, kInertia);
    check(body.inertia, kInertia);
    for (const NamedExpression& point : body.points) check(point.value, kLength);
    check_orientation(body.orientation);
    const MeasureOfName own = this->own();
    const auto law = [&](const std::optional<Expression>& formula, const Dimension& expected) {
      if (formula) require_dimension(*formula, expected, own);
    };
    law(body.acceleration, kAcceleration);
    law(body.force, kForce);
    law(body.mass, kMass);
    law(body.position_rate, kSpeed);
    law(body.angular_acceleration, kAngularAcceleration);
    law(body.angular_acceleration_body, kAngularAcceleration);
    law(body.torque, kTorque);
    law(body.torque_body, kTorque);
    law(body.force_point, kLength);
  }

  void check_orientation(const OrientationDefinition& orientation) const {
    if (orientation.axis) check_direction(*orientation.axis);
    check(orientation.angle_rad, kAngle);
    for (const Expression& part : orientation.quaternion) check_direction(part);
    for (const Expression& row : orientation.matrix) check_direction(row);
    check(orientation.roll_pitch_yaw, kAngle);
  }

  void check_shape(const PointShape&) const {}
  void check_shape(const BallShape& ball) const { check(ball.radius, kLength); }
  void check_shape(const CuboidShape& box) const { check(box.size, kLength); }
  void check_shape(const CylinderShape& cylinder) const {
    check(cylinder.radius, kLength);
    check(cylinder.height, kLength);
  }
  void check_shape(const CapsuleShape& capsule) const {
    check(capsule.radius, kLength);
    check(capsule.height, kLength);
  }
  void check_shape(const ConeShape& cone) const {
    check(cone.radius, kLength);
    check(cone.height, kLength);
  }
  void check_shape(const EllipsoidShape& ellipsoid) const { check(ellipsoid.radii, kLength); }
  void check_shape(const SoccerBallShape& ball) const { check(ball.radius, kLength); }
  void check_shape(const HullShape& hull) const { check(hull.points, kLength); }
  void check_shape(const MeshShape& mesh) const { check(mesh.scale, kDimensionless); }

  void check_shape(const PlaneShape& plane) const { check_direction(plane.normal); }
  void check_shape(const DiskShape& disk) const {
    check_direction(disk.normal);
    check(disk.radius, kLength);
  }
  void check_shape(const RectangleShape& rectangle) const {
    check_direction(rectangle.normal);
    check_direction(rectangle.up);
    check(rectangle.width, kLength);
    check(rectangle.height, kLength);
  }
  void check_shape(const TriangleShape& triangle) const {
    for (const Expression* corner : {&triangle.a, &triangle.b, &triangle.c}) check(*corner, kLength);
  }

  void check_shape(const TerrainShape& terrain) const {
    require_dimension(terrain.height, kLength, [this](std::string_view name) {
      return name == "x" || name == "y" ? Measure::moving(kLength) : of(name);
    });
  }
  void check_shape(const CompoundShape& compound) const {
    for (const PartDefinition& part : compound.parts) {
      std::visit([this](const auto& shape) { check_shape(shape); }, part.shape);
      check(part.rounding, kLength);
      check(part.position, kLength);
      check_orientation(part.orientation);
      check(part.mass, kMass);
      check(part.density, kDensity);
    }
  }

  void check_rate(const StateDefinition& state) const {
    const Measure value = of(state.name);
    if (value.kind == Measure::Kind::known) return check(state.rate, product(value.dimension, kTime, -1));
    measure(state.rate, global());
  }

  /// A new value, or a closed form, of an extra state or a part of a body.
  void check_target(const NamedExpression& assignment) const {
    const Measure target = of(assignment.name);
    if (target.kind == Measure::Kind::known) return check(assignment.value, target.dimension);
    measure(assignment.value, global());
  }

  const Scene& scene_;
  Measures names_;  // of parameters, extra states and t
};

}  // namespace

Measures parameter_measures(const Scene& scene) { return ParameterSurvey(scene).run(); }

void check_units(const Scene& scene) { UnitCheck(scene).run(); }

}  // namespace trajet
