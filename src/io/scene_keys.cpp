#include "scene_keys.hpp"

#include <optional>
#include <string>
#include <vector>

#include "trajet/portable.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet::detail {

namespace {

template <class Definition, class Member>
struct KeyOf {
  std::string_view name;
  Dimension dimension;
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
    {"restitution", kDimensionless, &ObstacleDefinition::restitution}};

/// Looks a name up while it collects those that there are.
class KeySearch {
 public:
  explicit KeySearch(std::string_view name) : name_(name) {}

  template <class Definition, class Keys>
  void look_among(std::vector<Definition>& definitions, const Keys& keys) {
    for (Definition& definition : definitions)
      for (const auto& key : keys) {
        known_.push_back(definition.name + "." + std::string(key.name));
        if (known_.back() != name_) continue;
        found_ = SceneKey{key.dimension, [&definition, member = key.member](Expression value) {
                            definition.*member = std::move(value);
                          }};
      }
  }

  const std::optional<SceneKey>& found() const { return found_; }
  const std::vector<std::string>& known() const { return known_; }

 private:
  std::string_view name_;
  std::vector<std::string> known_;
  std::optional<SceneKey> found_;
};

}  // namespace

SceneKey find_key(Scene& scene, std::string_view name, const SourceLocation& where) {
  KeySearch search(name);
  search.look_among(scene.bodies, kBodyStarts);
  search.look_among(scene.bodies, kBodyKeys);
  search.look_among(scene.obstacles, kObstacleKeys);
  if (search.found()) return *search.found();
  const std::vector<std::string_view> known(search.known().begin(), search.known().end());
  throw InputError(
      where, "the scene has no key '" + std::string(name) + "' that a formula can replace" + did_you_mean(name, known));
}

}  // namespace trajet::detail
