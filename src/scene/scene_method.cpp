#include "scene_method.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "trajet/scene/program_system.hpp"
#include "trajet/text/did_you_mean.hpp"
#include "trajet/text/shortest_text.hpp"

namespace trajet {
namespace {

constexpr double kDefaultTolerance = 1e-12;

const MethodInfo* find_scene_method(const MethodOptions& method, std::vector<std::string>& warnings) {
  if (const MethodInfo* found = find_method(method.name)) return found;
  if (const MethodInfo* nearest = find_nearest_method(method.name)) {
    warnings.push_back("method '" + method.name + "' is not among ours: '" + std::string(nearest->name) +
                       "' is the nearest and taken for it");
    return nearest;
  }
  std::vector<std::string_view> known;
  for (const MethodInfo& info : methods()) {
    known.push_back(info.name);
    known.insert(known.end(), info.aliases.begin(), info.aliases.end());
  }
  throw InputError(method.where, "unknown method '" + method.name + "'" + did_you_mean(method.name, known));
}

void check_order(const MethodOptions& method, const MethodInfo& info) {
  if (method.order <= info.max_order) return;
  const std::string name = "method '" + std::string(info.name) + "'";
  throw InputError(method.order_where, info.max_order == 0
                                           ? name + " has an order of its own: [method] order does not go with it"
                                           : name + " takes an order of at most " + std::to_string(info.max_order));
}

/// The number of a step, s, that must not be longer than `max_step`.
double step_number(const Expression& step, const SceneNumbers& numbers, double max_step) {
  const double value = numbers.positive(step, "step");
  if (value > max_step)
    throw InputError(step.where(), "step of " + shortest_text(value) +
                                       " s is longer than max_step = " + shortest_text(max_step) + " s");
  return value;
}

/// The formula behind a component of a group's state, in words and as a place in the scene.
struct ComponentOrigin {
  std::string text;
  SourceLocation where;
};

ComponentOrigin origin(const Scene& scene, const World& world, int group, int component) {
  for (std::size_t i = 0; i < world.states.size(); ++i) {
    if (world.states[i].group == group && world.states[i].offset == component)
      return {"rate of state '" + world.states[i].name + "'", scene.states[i].rate.where()};
  }
  // bodies lie in the group's state in their order: the last one that begins at or before the component has it
  const auto begins_before = [&](const World::Body& body) { return body.group == group && body.offset <= component; };
  const auto body = std::find_if(world.bodies.rbegin(), world.bodies.rend(), begins_before);
  const BodyDefinition& definition = scene.bodies[static_cast<std::size_t>(world.bodies.rend() - body) - 1];
  const std::string of_body = " of body '" + body->name + "'";
  if (component < body->slice().velocity_index())
    return {"rate of the position" + of_body,
            definition.position_rate ? definition.position_rate->where() : definition.where};
  if (body->rotation && component >= body->rotation->offset) {
    for (const auto* law : {&definition.angular_acceleration, &definition.angular_acceleration_body, &definition.torque,
                            &definition.torque_body, &definition.force_point})
      if (*law) return {"rotation" + of_body, (*law)->where()};
    return {"rotation" + of_body, definition.where};
  }
  if (definition.force) return {"force" + of_body, definition.force->where()};
  return {"acceleration" + of_body, definition.acceleration ? definition.acceleration->where() : definition.where};
}

}  // namespace

void set_method(const MethodOptions& method, const SceneNumbers& numbers, World& world) {
  world.method = find_scene_method(method, world.warnings);
  check_order(method, *world.method);
  StepOptions& options = world.step_options;
  options.rtol = method.rtol ? numbers.not_negative(*method.rtol, "rtol") : kDefaultTolerance;
  options.atol = method.atol ? numbers.not_negative(*method.atol, "atol") : kDefaultTolerance;
  world.atol_follows_scale = !method.atol;
  if (options.rtol == 0.0 && options.atol == 0.0)
    throw InputError(method.rtol->where(), "rtol and atol must not both be zero");
  if (method.max_step) options.max_step = numbers.positive(*method.max_step, "max_step");
  if (method.step) options.step = step_number(*method.step, numbers, options.max_step);
  options.order = method.order;
  double t = 0.0;
  for (const Expression& step : method.steps)
    options.nodes.push_back(t += world.direction() * step_number(step, numbers, options.max_step));
  if (world.method->needs_step() && !options.step && options.nodes.empty())
    throw InputError(method.where,
                     "method '" + std::string(world.method->name) + "' takes fixed steps: give [method] step");
  if (method.max_steps <= 0) throw InputError(method.where, "max_steps must be positive");
  world.max_steps = method.max_steps;
  if (method.max_seconds) world.max_seconds = numbers.positive(*method.max_seconds, "max_seconds");
  world.locate = method.locate;
  world.simultaneous = method.simultaneous;
}

void check_that_method_suits(const Scene& scene, const World& world) {
  if (world.method->find_unsuitable == nullptr) return;
  for (std::size_t g = 0; g < world.groups.size(); ++g) {
    const auto unsuitable = world.method->find_unsuitable(ProgramSystem::structure_of(world.groups[g].law));
    if (!unsuitable) continue;
    const ComponentOrigin formula = origin(scene, world, static_cast<int>(g), unsuitable->component);
    throw InputError(formula.where, "method '" + std::string(world.method->name) + "' cannot integrate this: the " +
                                        formula.text + " " + unsuitable->reason);
  }
}

}  // namespace trajet
