#include "body_maker.hpp"

#include <algorithm>

#include "solid_maker.hpp"
#include "surface_maker.hpp"
#include "trajet/geom/compound.hpp"
#include "trajet/geom/unit_inertia.hpp"
#include "trajet/portable.hpp"
#include "trajet/rigid/principal_axes.hpp"

namespace trajet {
namespace {

std::string of_body(const BodyDefinition& body) { return " of body '" + body.name + "'"; }

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

/// kg, of a compound whose parts say it.
std::optional<double> mass_of_parts(const Solid& solid) {
  const auto* compound = std::get_if<Compound>(&solid);
  return compound != nullptr ? compound->parts->mass : std::nullopt;
}

/// The inertia about the centre of mass, where there is one.
std::optional<Matrix3> inertia(const BodyDefinition& definition, const Solid& solid, const SceneNumbers& numbers) {
  if (has_inertia(definition)) return given_inertia(definition, numbers);
  const std::optional<Matrix3> per_mass = unit_inertia(solid);
  if (!per_mass) return std::nullopt;
  if (const auto mass = mass_from_solid(definition, numbers)) return *mass * *per_mass;
  if (!definition.mass) return std::nullopt;
  return numbers.positive(*definition.mass, "mass" + of_body(definition)) * *per_mass;
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

/// Whether an impact can make the body turn: it has extent, a constant mass, and an inertia; only friction turns a
/// ball.
bool is_turned_by_impacts(const BodyDefinition& d, const Solid& solid, const SceneNumbers& numbers, Bounces bounces) {
  if (bounces == Bounces::nowhere || bounding_radius(solid) == 0.0) return false;
  if (is_round(solid) && bounces == Bounces::smoothly) return false;
  if (d.angular_acceleration || d.angular_acceleration_body) return false;
  if (!mass_from_solid(d, numbers) && !(d.mass && numbers.knows(*d.mass))) return false;
  return has_inertia(d) || unit_inertia(solid).has_value();
}

std::optional<World::Rotation> rotation(const BodyDefinition& d, const Solid& solid, const SceneNumbers& numbers,
                                        const MethodOptions& method, Bounces bounces, bool is_turned) {
  const std::optional<Expression>* const laws[] = {&d.angular_acceleration, &d.angular_acceleration_body, &d.torque,
                                                   &d.torque_body, &d.force_point};
  const auto law = ranges::find_if(laws, [](const auto* each) { return each->has_value(); });
  const bool has_law = law != std::end(laws);
  if (!has_law && !d.angular_velocity && !d.angular_velocity_body && !is_turned &&
      !is_turned_by_impacts(d, solid, numbers, bounces))
    return std::nullopt;

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

World::Body make_body(const BodyDefinition& definition, const SceneNumbers& numbers, const MethodOptions& method,
                      Bounces bounces, bool is_turned) {
  require_no_conflict(definition);
  if (has_inertia(definition)) given_inertia(definition, numbers);  // an error where it is none, even if nothing turns
  World::Body body;
  body.name = definition.name;
  body.where = definition.where;
  body.solid = make_solid(definition, numbers);
  body.q_WB = numbers.orientation(definition.orientation, "orientation" + of_body(definition));
  body.rotation = rotation(definition, body.solid, numbers, method, bounces, is_turned);
  if (body.rotation && is_turned_by_impacts(definition, body.solid, numbers, bounces))
    body.inertia = inertia(definition, body.solid, numbers);
  set_restitution(definition.restitution, "body '" + definition.name + "'", numbers, body.surface);
  set_friction(definition.friction, "body '" + definition.name + "'", numbers, body.surface);
  for (const NamedExpression& point : definition.points)
    body.points.push_back(
        {point.name, numbers.vector(point.value, "point '" + point.name + "'" + of_body(definition))});
  return body;
}

std::optional<double> mass_from_solid(const BodyDefinition& definition, const SceneNumbers& numbers) {
  const bool is_compound = std::holds_alternative<CompoundShape>(definition.shape);
  if (!definition.density && !is_compound) return std::nullopt;
  const Solid solid = make_solid(definition, numbers);
  if (const auto mass = mass_of_parts(solid)) {
    for (const auto* own : {&definition.mass, &definition.density})
      if (*own)
        throw InputError((*own)->where(), "the parts" + of_body(definition) + " have their masses: it has no other");
    return mass;
  }
  if (!definition.density) return std::nullopt;
  const std::optional<VolumeProperties> properties = volume_properties(solid);
  if (!properties)
    throw InputError(definition.density->where(), "body '" + definition.name + "' is " +
                                                      (bounding_radius(solid) > 0.0 ? "flat" : "a point") +
                                                      " and has no volume: give `mass` instead of `density`");
  return numbers.positive(*definition.density, "density" + of_body(definition)) * properties->volume;
}

Eigen::VectorXd start_state(const BodyDefinition& definition, const World::Body& body, const SceneNumbers& numbers) {
  const BodySlice slice{0, body.rotation ? std::optional(body.rotation->layout) : std::nullopt};
  Eigen::VectorXd state(slice.size());
  slice.position(state) = numbers.vector(definition.position, "position" + of_body(definition));
  slice.velocity(state) = numbers.vector(definition.velocity, "velocity" + of_body(definition));
  if (!body.rotation) return state;

  body.rotation->layout.put(body.q_WB, slice.orientation(state));
  Vector3 w = Vector3::Zero();
  const bool is_in_body = definition.angular_velocity_body.has_value();
  const auto& given = is_in_body ? definition.angular_velocity_body : definition.angular_velocity;
  if (given) w = numbers.vector(*given, "angular velocity" + of_body(definition));
  if (is_in_body && body.rotation->layout.frame == Frame::world) w = rotate<double>(body.q_WB, w);
  if (!is_in_body && body.rotation->layout.frame == Frame::body) w = rotate<double>(body.q_WB.conjugate(), w);
  slice.angular_velocity(state) = w;
  return state;
}

}  // namespace trajet
