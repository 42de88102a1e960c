#include "extended_numbers.hpp"

#include "trajet/law/program_builder.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

using Real = Extended;

class ExtendedReader {
 public:
  explicit ExtendedReader(const Symbols& parameters) : parameters_(parameters) {}

  Real scalar(const Expression& value) const {
    return std::get<ExtendedConstant>(evaluate_constant(value, parameters_)).as<Real>();
  }
  Vector3T<Real> vector(const Expression& value) const {
    const auto parts = std::get<Symbols::ConstantVector>(evaluate_constant(value, parameters_));
    return {parts[0].as<Real>(), parts[1].as<Real>(), parts[2].as<Real>()};
  }

 private:
  const Symbols& parameters_;
};

}  // namespace

World::ExtendedNumbers extended_numbers(const Scene& scene, const World& world, const Symbols& parameters) {
  const ExtendedReader read(parameters);
  World::ExtendedNumbers numbers;
  for (const World::Group& group : world.groups) numbers.starts.push_back(group.start.cast<Real>());
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const World::Body& body = world.bodies[i];
    const BodyDefinition& definition = scene.bodies[i];
    auto& start = numbers.starts[static_cast<std::size_t>(body.group)];
    start.segment<3>(body.slice().position_index()) = read.vector(definition.position);
    start.segment<3>(body.slice().velocity_index()) = read.vector(definition.velocity);
    const auto* ball = std::get_if<BallShape>(&definition.shape);
    numbers.radii.push_back(ball != nullptr ? read.scalar(ball->radius) : Real(bounding_radius(body.solid)));
  }
  for (std::size_t i = 0; i < world.states.size(); ++i) {
    const World::ExtraState& state = world.states[i];
    numbers.starts[static_cast<std::size_t>(state.group)][state.offset] = read.scalar(scene.states[i].value);
  }
  for (std::size_t i = 0; i < world.obstacles.size(); ++i) {
    if (!std::holds_alternative<Sphere>(world.obstacles[i].shape)) continue;
    const ObstacleDefinition& definition =
        *ranges::find(scene.obstacles, world.obstacles[i].name, &ObstacleDefinition::name);
    const auto* ball = std::get_if<BallShape>(&definition.shape);
    // a part of a compound, or one that moves
    if (ball == nullptr || world.obstacles[i].drive) continue;
    const Vector3T<Real> center =
        definition.center ? read.vector(*definition.center) : Vector3T<Real>(Vector3T<Real>::Zero());
    numbers.spheres.emplace(static_cast<int>(i), World::ExtendedNumbers::Sphere{center, read.scalar(ball->radius)});
  }
  return numbers;
}

}  // namespace trajet
