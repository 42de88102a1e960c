#include "scene_keys.hpp"

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

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

  /// The sizes of shapes.
  template <class Definition>
  void look_at_shape(Definition& definition) {
    if (definition.rounding && is_it(definition.name, "rounding"))
      take(kLength, [&](Expression value) { definition.rounding = std::move(value); });
    std::visit(
        [&]<class Shape>(Shape& shape) {
          if constexpr (requires { shape.radius; }) look_at(definition.name, "radius", kLength, shape.radius);
          // a rectangle's height is a part of its size
          if constexpr (
              requires { shape.height; } && !requires { shape.width; })
            look_at(definition.name, "height", kLength, shape.height);
          if constexpr (requires { shape.size; }) look_at(definition.name, "size", kLength, shape.size);
          if constexpr (requires { shape.radii; }) look_at(definition.name, "radii", kLength, shape.radii);
          if constexpr (requires { shape.normal; }) look_at(definition.name, "normal", kDimensionless, shape.normal);
          if constexpr (requires { shape.scale; }) look_at(definition.name, "scale", kDimensionless, shape.scale);
        },
        definition.shape);
  }

  template <class Definition>
  void look_at_friction(Definition& definition) {
    for (const auto& [key, dimension, member] : kFrictionMembers)
      if (is_it(definition.name, key))
        take(dimension, [&definition, member = member](Expression value) {
          FrictionDefinition changed = definition.friction ? *definition.friction : FrictionDefinition{};
          changed.*member = std::move(value);
          definition.friction = std::make_shared<const FrictionDefinition>(std::move(changed));
        });
  }

  void look_at_plane(ObstacleDefinition& obstacle) {
    if (std::holds_alternative<PlaneShape>(obstacle.shape) && is_it(obstacle.name, "point"))
      take(kLength, [&](Expression value) { obstacle.center = std::move(value); });
  }

  void look_at_hit(ObstacleDefinition& obstacle, const SourceLocation& where) {
    if (!is_it(obstacle.name, "on_hit")) return;
    found_ =
        SceneKey{.set_word = [&obstacle, where](const std::string& word) { obstacle.on_hit = on_hit(word, where); }};
  }

  const std::optional<SceneKey>& found() const { return found_; }
  const std::vector<std::string>& known() const { return known_; }

 private:
  static OnHit on_hit(const std::string& word, const SourceLocation& where) {
    constexpr std::pair<std::string_view, OnHit> kWords[] = {
        {"stop", OnHit::stop}, {"bounce", OnHit::bounce}, {"pass", OnHit::pass}, {"stick", OnHit::stick}};
    for (const auto& [name, value] : kWords)
      if (word == name) return value;
    constexpr std::string_view kNames[] = {"stop", "bounce", "pass", "stick"};
    throw InputError(where, "stop, bounce, pass or stick expected, got '" + word + "'" + did_you_mean(word, kNames));
  }

  bool is_it(const std::string& owner, std::string_view key) {
    known_.push_back(owner + "." + std::string(key));
    return known_.back() == name_;
  }

  void take(std::optional<Dimension> dimension, std::function<void(Expression)> set) {
    found_ = SceneKey{.dimension = dimension, .set = std::move(set)};
  }

  void look_at(const std::string& owner, std::string_view key, Dimension dimension, Expression& target) {
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
    search.look_at_shape(body);
    search.look_at_friction(body);
  }
  search.look_among(scene.obstacles, kObstacleKeys);
  for (ObstacleDefinition& obstacle : scene.obstacles) {
    search.look_at_shape(obstacle);
    search.look_at_friction(obstacle);
    search.look_at_plane(obstacle);
    search.look_at_hit(obstacle, where);
  }
  search.look_among(scene.states, kStateKeys);
  search.look_among(scene.events, kEventKeys);
  if (search.found()) return *search.found();
  const std::vector<std::string_view> known(search.known().begin(), search.known().end());
  throw InputError(where,
                   "the scene has no key '" + std::string(name) + "' that can be replaced" + did_you_mean(name, known));
}

}  // namespace trajet::detail
