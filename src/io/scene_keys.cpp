#include "scene_keys.hpp"

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "scene_method.hpp"
#include "scene_solids.hpp"
#include "trajet/portable.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet::detail {

namespace {

template <class Definition, class Member>
struct KeyOf {
  std::string_view name;
  std::optional<Dimension> dimension;
  Member Definition::*member;
};
template <class Definition>
using Required = KeyOf<Definition, Expression>;
template <class Definition>
using Optional = KeyOf<Definition, std::optional<Expression>>;

constexpr Required<BodyDefinition> kBodyStarts[] = {{"position", kLength, &BodyDefinition::position},
                                                    {"velocity", kSpeed, &BodyDefinition::velocity}};
constexpr Optional<BodyDefinition> kBodyKeys[] = {
    {"acceleration", kAcceleration, &BodyDefinition::acceleration},
    {"force", kForce, &BodyDefinition::force},
    {"mass", kMass, &BodyDefinition::mass},
    {"density", kDensity, &BodyDefinition::density},
    {"position_rate", kSpeed, &BodyDefinition::position_rate},
    {"angular_velocity", kAngularVelocity, &BodyDefinition::angular_velocity},
    {"angular_velocity_body", kAngularVelocity, &BodyDefinition::angular_velocity_body},
    {"angular_acceleration", kAngularAcceleration, &BodyDefinition::angular_acceleration},
    {"angular_acceleration_body", kAngularAcceleration, &BodyDefinition::angular_acceleration_body},
    {"torque", kTorque, &BodyDefinition::torque},
    {"torque_body", kTorque, &BodyDefinition::torque_body},
    {"force_point", kLength, &BodyDefinition::force_point},
    {"restitution", kDimensionless, &BodyDefinition::restitution},
};
constexpr Optional<ObstacleDefinition> kObstacleKeys[] = {
    {"center", kLength, &ObstacleDefinition::center},
    {"velocity", kSpeed, &ObstacleDefinition::velocity},
    {"angular_velocity", kAngularVelocity, &ObstacleDefinition::angular_velocity},
    {"restitution", kDimensionless, &ObstacleDefinition::restitution}};
constexpr Required<PartDefinition> kPartStarts[] = {{"position", kLength, &PartDefinition::position}};
constexpr Optional<PartDefinition> kPartKeys[] = {{"mass", kMass, &PartDefinition::mass},
                                                  {"density", kDensity, &PartDefinition::density}};
constexpr Optional<PairDefinition> kPairKeys[] = {{"restitution", kDimensionless, &PairDefinition::restitution}};
constexpr Optional<OrientationDefinition> kOrientationKeys[] = {{"axis", kDimensionless, &OrientationDefinition::axis},
                                                                {"angle", kAngle, &OrientationDefinition::angle_rad}};
constexpr Optional<FrictionDefinition> kFrictionMembers[] = {
    {"friction", kDimensionless, &FrictionDefinition::friction},
    {"tangential_restitution", kDimensionless, &FrictionDefinition::tangential_restitution},
    {"rolling_friction", kLength, &FrictionDefinition::rolling_friction},
    {"spinning_friction", kLength, &FrictionDefinition::spinning_friction}};
constexpr Optional<TimeOptions> kTimeKeys[] = {{"end", kTime, &TimeOptions::end},
                                               {"sample", kTime, &TimeOptions::sample}};
constexpr Required<TimeOptions> kTimeStarts[] = {{"start", kTime, &TimeOptions::start}};
constexpr Optional<MethodOptions> kMethodKeys[] = {{"rtol", kDimensionless, &MethodOptions::rtol},
                                                   {"atol", kDimensionless, &MethodOptions::atol},
                                                   {"step", kTime, &MethodOptions::step},
                                                   {"max_step", kTime, &MethodOptions::max_step},
                                                   {"max_seconds", kTime, &MethodOptions::max_seconds}};
/// Any dimension: what they are is known of all of them together.
constexpr Required<StateDefinition> kStateKeys[] = {{"value", {}, &StateDefinition::value},
                                                    {"rate", {}, &StateDefinition::rate}};
constexpr Required<EventDefinition> kEventKeys[] = {{"when", {}, &EventDefinition::when}};

/// Looks a name up while it collects those that there are.
class KeySearch {
 public:
  explicit KeySearch(std::string_view name) : name_(name) {}

  template <class Definition, class Keys>
  void look_in(Definition& definition, const std::string& owner, const Keys& keys) {
    for (const auto& key : keys)
      if (is_it(owner, key.name))
        found_ = SceneKey{.dimension = key.dimension, .set = [&definition, member = key.member](Expression value) {
                            definition.*member = std::move(value);
                          }};
  }

  template <class Definition, class Keys>
  void look_among(std::vector<Definition>& definitions, const Keys& keys) {
    for (Definition& definition : definitions) look_in(definition, definition.name, keys);
  }

  /// The sizes of shapes, and what else describes them.
  template <class Definition>
  void look_at_shape(const std::string& owner, Definition& definition) {
    if (definition.rounding && is_it(owner, "rounding"))
      take(kLength, [&](Expression value) { definition.rounding = std::move(value); });
    std::visit(
        [&]<class Shape>(Shape& shape) {
          if constexpr (requires { shape.radius; }) look_at(owner, "radius", kLength, shape.radius);
          // a rectangle's height is a part of its size
          if constexpr (
              requires { shape.height; } && !requires { shape.width; })
            look_at(owner, "height", kLength, shape.height);
          if constexpr (requires { shape.size; }) look_at(owner, "size", kLength, shape.size);
          if constexpr (requires { shape.radii; }) look_at(owner, "radii", kLength, shape.radii);
          if constexpr (requires { shape.normal; }) look_at(owner, "normal", kDimensionless, shape.normal);
          if constexpr (requires { shape.up; }) look_at(owner, "up", kDimensionless, shape.up);
          if constexpr (requires { shape.scale; }) look_at(owner, "scale", kDimensionless, shape.scale);
          look_at_lists(owner, shape);
        },
        definition.shape);
  }

  template <class Definition>
  void look_at_friction(const std::string& owner, Definition& definition) {
    const auto change = [&definition](const auto& what) {
      FrictionDefinition changed = definition.friction ? *definition.friction : FrictionDefinition{};
      what(changed);
      definition.friction = std::make_shared<const FrictionDefinition>(std::move(changed));
    };
    for (const auto& [key, dimension, member] : kFrictionMembers)
      if (is_it(owner, key))
        take(dimension, [change, member = member](Expression value) {
          change([&](FrictionDefinition& friction) { friction.*member = std::move(value); });
        });
    look_at_other(owner, "impact", [change](const TableReader& table) {
      change([&](FrictionDefinition& friction) { friction.impact = read_friction(table)->impact; });
    });
  }

  /// `put(value)` takes an orientation that is read as a whole.
  template <class Put>
  void look_at_orientation(const std::string& owner, OrientationDefinition* orientation, Put put) {
    look_at_other(owner, "orientation",
                  [put](const TableReader& table) { put(read_orientation(table.subtable("orientation"))); });
    if (orientation != nullptr && orientation->axis) look_in(*orientation, owner + ".orientation", kOrientationKeys);
  }

  template <class Thing>
  void look_at_color(Thing& thing) {
    look_at_other(thing.name, "color", [&thing](const TableReader& table) { thing.color = read_color(table); });
  }

  void look_at_body(BodyDefinition& body) {
    look_at_color(body);
    look_at_orientation(body.name, &body.orientation,
                        [&body](OrientationDefinition value) { body.orientation = std::move(value); });
    look_at_other(body.name, "inertia", [&body](const TableReader& table) { read_inertia(table, body); });
    look_at_other(body.name, "collides_with",
                  [&body](const TableReader& table) { body.collides_with = read_collides_with(table); });
    for (NamedExpression& point : body.points) look_at(body.name + ".points", point.name, kLength, point.value);
  }

  void look_at_obstacle(ObstacleDefinition& obstacle) {
    look_at_color(obstacle);
    if (!std::holds_alternative<PlaneShape>(obstacle.shape))
      look_at_orientation(obstacle.name, nullptr, [&obstacle](OrientationDefinition value) {
        obstacle.orientation = std::make_shared<const OrientationDefinition>(std::move(value));
      });
    look_at_other(obstacle.name, "on_hit",
                  [&obstacle](const TableReader& table) { obstacle.on_hit = read_on_hit(table); });
    if (obstacle.is_hollow)
      look_at_other(obstacle.name, "inside",
                    [&obstacle](const TableReader& table) { obstacle.is_hollow = table.flag("inside"); });
  }

  void look_at_pair(const std::string& owner, PairDefinition& pair) {
    look_in(pair, owner, kPairKeys);
    look_at_friction(owner, pair);
    look_at_other(owner, "on_hit", [&pair](const TableReader& table) { pair.on_hit = read_on_hit(table); });
  }

  void look_at_event(EventDefinition& event) {
    look_at_other(event.name, "direction",
                  [&event](const TableReader& table) { event.direction = read_direction(table); });
    for (NamedExpression& each : event.set) look_at(event.name + ".set", each.name, {}, each.value);
  }

  void look_at_method(MethodOptions& method) {
    const auto look_at_key = [&](std::string_view key, auto member) {
      look_at_other("method", key,
                    [&method, member](const TableReader& table) { method.*member = read_method(table).*member; });
    };
    look_at_other("method", "name", [&method](const TableReader& table) {
      method.name = read_method(table).name;
      method.where = table.where("name");
    });
    look_at_other("method", "orientation", [&method](const TableReader& table) {
      method.orientation = read_method(table).orientation;
      method.orientation_where = table.where("orientation");
    });
    look_at_other("method", "order", [&method](const TableReader& table) {
      method.order = read_method(table).order;
      method.order_where = table.where("order");
    });
    look_at_other("method", "steps", [&method](const TableReader& table) {
      method.steps = read_method(table).steps;
      method.step.reset();
    });
    look_at_key("max_steps", &MethodOptions::max_steps);
    look_at_key("locate", &MethodOptions::locate);
    look_at_key("simultaneous", &MethodOptions::simultaneous);
  }

  void look_at_exact(Scene& scene) {
    for (NamedExpression& each : scene.exact) look_at("exact", each.name, {}, each.value);
    for (ExactOrientation& each : scene.exact_orientations)
      look_at_orientation("exact." + each.name.substr(0, each.name.rfind('.')), &each.value,
                          [&each](OrientationDefinition value) { each.value = std::move(value); });
  }

  void look_at_plane(ObstacleDefinition& obstacle) {
    if (std::holds_alternative<PlaneShape>(obstacle.shape) && is_it(obstacle.name, "point"))
      take(kLength, [&](Expression value) { obstacle.center = std::move(value); });
  }

  const std::optional<SceneKey>& found() const { return found_; }
  const std::vector<std::string>& known() const { return known_; }

 private:
  /// What of a shape is an array.
  template <class Shape>
  void look_at_lists(const std::string&, Shape&) {}
  void look_at_lists(const std::string& owner, HullShape& hull) {
    look_at_other(owner, "points",
                  [&hull](const TableReader& table) { hull.points = table.vector_list("points", kLength); });
  }
  void look_at_lists(const std::string& owner, TriangleShape& triangle) {
    look_at_other(owner, "points", [&triangle](const TableReader& table) {
      const std::vector<Expression> points = table.vectors("points", 3, kLength);
      triangle = {points[0], points[1], points[2]};
    });
  }
  void look_at_lists(const std::string& owner, RectangleShape& rectangle) {
    look_at_other(owner, "size", [&rectangle](const TableReader& table) {
      const std::vector<Expression> size = table.scalars("size", 2, kLength);
      rectangle.width = size[0];
      rectangle.height = size[1];
    });
  }
  void look_at_lists(const std::string& owner, CompoundShape& compound) {
    for (std::size_t i = 0; i < compound.parts.size(); ++i) {
      PartDefinition& part = compound.parts[i];
      const std::string name = owner + ".parts[" + std::to_string(i) + "]";
      look_in(part, name, kPartStarts);
      look_in(part, name, kPartKeys);
      look_at_orientation(name, &part.orientation,
                          [&part](OrientationDefinition value) { part.orientation = std::move(value); });
      look_at_shape(name, part);
    }
  }

  bool is_it(const std::string& owner, std::string_view key) {
    known_.push_back(owner + "." + std::string(key));
    return known_.back() == name_;
  }

  void take(std::optional<Dimension> dimension, std::function<void(Expression)> set) {
    found_ = SceneKey{.dimension = dimension, .set = std::move(set)};
  }

  void look_at_other(const std::string& owner, std::string_view key, std::function<void(const TableReader&)> read) {
    if (is_it(owner, key)) found_ = SceneKey{.read = std::move(read)};
  }

  void look_at(const std::string& owner, std::string_view key, std::optional<Dimension> dimension, Expression& target) {
    if (is_it(owner, key)) take(dimension, [&target](Expression value) { target = std::move(value); });
  }

  std::string_view name_;
  std::vector<std::string> known_;
  std::optional<SceneKey> found_;
};

}  // namespace

SceneKey find_key(Scene& scene, std::string_view name, const SourceLocation& where) {
  KeySearch search(name);
  search.look_in(scene.time, "time", kTimeKeys);
  search.look_in(scene.time, "time", kTimeStarts);
  search.look_in(scene.method, "method", kMethodKeys);
  search.look_among(scene.bodies, kBodyStarts);
  search.look_among(scene.bodies, kBodyKeys);
  for (BodyDefinition& body : scene.bodies) {
    search.look_at_shape(body.name, body);
    search.look_at_friction(body.name, body);
    search.look_at_body(body);
  }
  search.look_among(scene.obstacles, kObstacleKeys);
  for (ObstacleDefinition& obstacle : scene.obstacles) {
    search.look_at_shape(obstacle.name, obstacle);
    search.look_at_friction(obstacle.name, obstacle);
    search.look_at_plane(obstacle);
    search.look_at_obstacle(obstacle);
  }
  for (std::size_t i = 0; i < scene.pairs.size(); ++i)
    search.look_at_pair("pair[" + std::to_string(i) + "]", scene.pairs[i]);
  search.look_among(scene.states, kStateKeys);
  search.look_among(scene.events, kEventKeys);
  for (EventDefinition& event : scene.events) search.look_at_event(event);
  search.look_at_method(scene.method);
  search.look_at_exact(scene);
  if (search.found()) return *search.found();
  const std::vector<std::string_view> known(search.known().begin(), search.known().end());
  throw InputError(where,
                   "the scene has no key '" + std::string(name) + "' that can be replaced" + did_you_mean(name, known));
}

}  // namespace trajet::detail
