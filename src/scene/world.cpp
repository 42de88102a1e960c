#include "trajet/scene/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <unordered_map>

#include "body_maker.hpp"
#include "extended_numbers.hpp"
#include "law_formulas.hpp"
#include "law_symbols.hpp"
#include "never_zero.hpp"
#include "obstacle_maker.hpp"
#include "pair_maker.hpp"
#include "partition.hpp"
#include "scene_method.hpp"
#include "scene_names.hpp"
#include "scene_numbers.hpp"
#include "scene_symbols.hpp"
#include "start_check.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/law/program_builder.hpp"
#include "trajet/portable.hpp"
#include "trajet/scene/scene_units.hpp"

namespace trajet {
namespace {

constexpr double kDefaultSampleCount = 200.0;
constexpr double kMostSamples = 1e12;  // no disk holds more

/// Builds a World from a Scene: numbers first, then who depends on whom, then one program per group.
class WorldBuilder {
 public:
  explicit WorldBuilder(const Scene& scene)
      : scene_(scene),
        parameters_(evaluate_parameters(scene)),
        numbers_(parameters_.symbols),
        partition_(static_cast<int>(scene.bodies.size() + scene.states.size() + scene.events.size())) {}

  World build() {
    world_.scene = scene_.file;
    world_.title = scene_.title;
    world_.up = scene_.up;
    world_.parameters = parameters_.values;
    world_.tables = scene_.tables;
    world_.warnings = scene_.warnings;
    set_time();
    set_method(scene_.method, numbers_, world_);
    make_obstacles(scene_, parameters_, world_);
    find_dependencies();
    place_in_groups();
    for (std::size_t g = 0; g < world_.groups.size(); ++g) compile_group(static_cast<int>(g));
    check_masses();
    make_companies(scene_, world_);
    make_pairs(scene_, numbers_, world_);
    check_fits(world_);
    check_starts(world_);
    check_that_method_suits(scene_, world_);
    for (const NamedExpression& closed_form : scene_.exact) compile_exact(closed_form);
    for (const ExactOrientation& closed_form : scene_.exact_orientations) compile_exact_orientation(closed_form);
    for (const World::ClosedRotation& closed_form : world_.exact_rotations) check_exact_rotation(closed_form);
    check_units(scene_);
    if (world_.method->carries_extended) world_.extended = extended_numbers(scene_, world_, parameters_.symbols);
    return std::move(world_);
  }

 private:
  // Members of the partition: bodies, then extra states, then events.
  int state_member(std::size_t i) const { return static_cast<int>(scene_.bodies.size() + i); }
  int event_member(std::size_t i) const { return static_cast<int>(scene_.bodies.size() + scene_.states.size() + i); }

  void set_time() {
    const TimeOptions& time = scene_.time;
    if (!time.end) throw InputError({scene_.file, 1, 1}, "[time] needs `end`");
    world_.epoch = numbers_.scalar(time.start, "start time");
    const double end = numbers_.scalar(*time.end, "end time");
    world_.duration = end - world_.epoch;
    const double duration = std::abs(world_.duration);
    if (world_.duration < 0.0 && !scene_.obstacles.empty())
      throw InputError(time.end->where(), "the end is before the start: impacts have no meaning backward in time");
    warn_of_coarse_times(world_, end);
    if (!std::isfinite(duration)) throw InputError(time.end->where(), "start and end are too far apart for a double");
    if (time.sample) {
      world_.sample = numbers_.positive(*time.sample, "sample spacing");
      if (duration / world_.sample > kMostSamples)
        throw InputError(time.sample->where(), "sample spacing gives more than 1e12 samples");
    } else {
      world_.sample =
          duration > 0.0 ? std::max(duration / kDefaultSampleCount, std::numeric_limits<double>::min()) : 1.0;
    }
  }

  /// Joins `member` with all bodies and states that a formula of its own names.
  void depend(int member, const Expression& formula) {
    for (const std::string& name : formula.names()) {
      const std::string_view owner = std::string_view(name).substr(0, name.find('.'));
      const auto found = members_.find(owner);
      if (found == members_.end()) continue;
      const bool is_body = found->second < state_member(0);
      if (is_body == (owner.size() != name.size())) partition_.join(member, found->second);
    }
  }

  void find_dependencies() {
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) members_[scene_.bodies[i].name] = static_cast<int>(i);
    for (std::size_t i = 0; i < scene_.states.size(); ++i) members_[scene_.states[i].name] = state_member(i);
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      const BodyDefinition& body = scene_.bodies[i];
      for (const auto* law :
           {&body.acceleration, &body.force, &body.mass, &body.position_rate, &body.angular_acceleration,
            &body.angular_acceleration_body, &body.torque, &body.torque_body, &body.force_point})
        if (*law) depend(static_cast<int>(i), **law);
    }
    for (std::size_t i = 0; i < scene_.states.size(); ++i) depend(state_member(i), scene_.states[i].rate);
    for (std::size_t i = 0; i < scene_.events.size(); ++i) {
      const EventDefinition& event = scene_.events[i];
      depend(event_member(i), event.when);
      for (const NamedExpression& assignment : event.set) {
        depend(event_member(i), Expression::parse(assignment.name, assignment.where, dashed_names()));
        depend(event_member(i), assignment.value);
      }
      // an event of time alone goes with the first motion
      if (partition_.find(event_member(i)) == event_member(i)) partition_.join(event_member(i), 0);
    }
  }

  /// Names that hold a `-`, which formulas must not take for a subtraction.
  std::vector<std::string> dashed_names() const {
    std::vector<std::string> names;
    for (const BodyDefinition& body : scene_.bodies)
      if (body.name.find('-') != std::string::npos) names.push_back(body.name);
    for (const StateDefinition& state : scene_.states)
      if (state.name.find('-') != std::string::npos) names.push_back(state.name);
    return names;
  }

  /// The group of a member, made at its first sight; groups come in the order of their first members.
  int group_of(int member) {
    const auto [place, is_new] =
        group_of_root_.try_emplace(partition_.find(member), static_cast<int>(world_.groups.size()));
    if (is_new) world_.groups.emplace_back();
    return place->second;
  }

  World::Group& group(int index) { return world_.groups[static_cast<std::size_t>(index)]; }

  static int append(Eigen::VectorXd& state, const Eigen::VectorXd& values) {
    const auto offset = state.size();
    state.conservativeResize(offset + values.size());
    state.tail(values.size()) = values;
    return static_cast<int>(offset);
  }

  /// What there is that a body may bounce off.
  Bounces bounces(const BodyDefinition& body) const {
    const auto kind = body.collides_with.kind;
    const bool meets_bodies = kind == CollidesWith::Kind::all || kind == CollidesWith::Kind::listed;
    const auto are_bounced_off = [](const auto& each) { return each.on_hit == OnHit::bounce; };
    if (!(meets_bodies && scene_.bodies.size() > 1) && !ranges::any_of(scene_.obstacles, are_bounced_off) &&
        !ranges::any_of(scene_.pairs, are_bounced_off))
      return Bounces::nowhere;
    return has_friction_ ? Bounces::with_friction : Bounces::smoothly;
  }

  static bool has_friction(const Scene& scene) {
    const auto has = [](const auto& each) {
      return each.friction && (each.friction->friction || each.friction->tangential_restitution);
    };
    return ranges::any_of(scene.bodies, has) || ranges::any_of(scene.obstacles, has) ||
           ranges::any_of(scene.pairs, has);
  }

  void place_in_groups() {
    const bool is_turned = may_turn_bodies(scene_, world_);
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      const BodyDefinition& definition = scene_.bodies[i];
      World::Body body = make_body(definition, numbers_, scene_.method, bounces(definition), is_turned);
      body.color = definition.color;
      body.group = group_of(static_cast<int>(i));
      body.offset = append(group(body.group).start, start_state(definition, body, numbers_));
      if (body.rotation) body.rotation->offset = body.slice().orientation_index();
      group(body.group).bodies.push_back(static_cast<int>(i));
      world_.bodies.push_back(std::move(body));
    }
    for (std::size_t i = 0; i < scene_.states.size(); ++i) {
      const StateDefinition& definition = scene_.states[i];
      const int index = group_of(state_member(i));
      const double value = numbers_.scalar(definition.value, "value of state '" + definition.name + "'");
      world_.states.push_back(
          {definition.name, index, append(group(index).start, Eigen::VectorXd::Constant(1, value))});
    }
    world_.events.resize(scene_.events.size());
    for (std::size_t i = 0; i < scene_.events.size(); ++i) {
      const int index = group_of(event_member(i));
      group(index).events.push_back(static_cast<int>(i));
    }
  }

  Symbols group_symbols(int index, ProgramBuilder& builder) const {
    return trajet::group_symbols(world_, index, parameters_.symbols, builder);
  }

  void compile_group(int index) {
    World::Group& target = group(index);
    const int input_count = 1 + static_cast<int>(target.start.size());
    ProgramBuilder law(input_count);
    const Symbols symbols = group_symbols(index, law);
    for (const int b : target.bodies) compile_body(b, symbols, law);
    for (std::size_t i = 0; i < scene_.states.size(); ++i) {
      if (world_.states[i].group != index) continue;
      law.add_output(law.compile_scalar(scene_.states[i].rate, symbols));
      target.formulas.push_back({"rate", -1, world_.states[i].offset, 1, scene_.states[i].rate});
    }
    target.law = law.build();
    for (const int b : target.bodies) compile_mass(b, input_count);
    for (const int e : target.events) compile_event(e, input_count);
  }

  void compile_body(int index, const Symbols& group_scope, ProgramBuilder& law) {
    const BodyDefinition& definition = scene_.bodies[static_cast<std::size_t>(index)];
    const World::Body& body = world_.bodies[static_cast<std::size_t>(index)];
    const int velocity = 1 + body.slice().velocity_index();
    const Symbols own = own_symbols(body, group_scope, law);
    add_formulas(definition, body, index, group(body.group).formulas);

    law.add_output(definition.position_rate ? law.compile_vector(*definition.position_rate, own)
                                            : law.inputs({velocity, velocity + 1, velocity + 2}));
    if (definition.acceleration && definition.force)
      throw InputError(definition.force->where(), "body '" + body.name + "' has both `acceleration` and `force`");
    if (definition.force && !definition.mass && !mass_from_solid(definition, numbers_))
      throw InputError(definition.force->where(), "body '" + body.name + "' has a `force` but no `mass`");
    if (definition.acceleration) {
      law.add_output(law.compile_vector(*definition.acceleration, own));
    } else if (definition.force) {
      law.add_output(law.divide(law.compile_vector(*definition.force, own), mass_of(definition, own, law)));
    } else {
      for (int i = 0; i < 3; ++i) law.add_output(law.constant(0.0));
    }
    if (body.rotation) add_rotation_law(definition, body, own, law);
  }

  ProgramBuilder::Value mass_of(const BodyDefinition& definition, const Symbols& own, ProgramBuilder& builder) const {
    if (definition.mass) return builder.compile_scalar(*definition.mass, own);
    return builder.constant(*mass_from_solid(definition, numbers_));
  }

  void compile_mass(int index, int input_count) {
    const BodyDefinition& definition = scene_.bodies[static_cast<std::size_t>(index)];
    World::Body& body = world_.bodies[static_cast<std::size_t>(index)];
    if (!mass_from_solid(definition, numbers_) && !definition.mass) return;
    ProgramBuilder mass(input_count);
    const Symbols symbols = group_symbols(body.group, mass);
    mass.add_output(mass_of(definition, own_symbols(body, symbols, mass), mass));
    body.mass = mass.build();
  }

  /// At the start: what becomes of a mass that changes shows on the way.
  void check_masses() const {
    for (std::size_t i = 0; i < world_.bodies.size(); ++i) {
      const World::Body& body = world_.bodies[i];
      if (!scene_.bodies[i].mass) continue;
      double mass = 0.0;
      Evaluator<double> (*body.mass)(0.0, world_.groups[static_cast<std::size_t>(body.group)].start.data(), &mass);
      if (!(mass > 0.0))
        throw InputError(scene_.bodies[i].mass->where(), "mass of body '" + body.name + "' must be positive");
    }
  }

  void compile_event(int index, int input_count) {
    const EventDefinition& definition = scene_.events[static_cast<std::size_t>(index)];
    World::Event& event = world_.events[static_cast<std::size_t>(index)];
    event.name = definition.name;
    event.group = group_of(event_member(static_cast<std::size_t>(index)));
    event.direction = definition.direction;
    event.action = definition.action;
    if (definition.when.is_condition())
      throw InputError(definition.when.where(),
                       "'when' is a condition, which crosses no zero: write the quantity "
                       "that does, for `a > b` its difference `a - b`");
    ProgramBuilder when(input_count);
    when.add_output(when.compile_scalar(definition.when, group_symbols(event.group, when)));
    event.when = when.build();
    if (never_crosses_zero(event.when))
      world_.warnings.push_back("event '" + event.name +
                                "' can never happen: whatever time and state are, its 'when', " +
                                definition.when.text() + ", does not cross zero");
    ProgramBuilder set(input_count);
    const Symbols symbols = group_symbols(event.group, set);
    for (const NamedExpression& assignment : definition.set) {
      const AssignmentTarget target = find_target(assignment);  // in the event's group, which depends on it
      const ProgramBuilder::Value value = target.size == 3 ? set.compile_vector(assignment.value, symbols)
                                                           : set.compile_scalar(assignment.value, symbols);
      set.add_output(target.turning == nullptr ? value : in_frame_of_state(value, *target.turning, set));
      for (int i = 0; i < target.size; ++i) event.targets.push_back(target.offset + i);
    }
    event.set = set.build();
  }

  void compile_exact(const NamedExpression& closed_form) {
    const bool is_in_body = closed_form.name.ends_with(".w_body");
    ProgramBuilder value(1);
    Symbols symbols(&parameters_.symbols);
    symbols.set_node("t", value.clock(world_.epoch));
    if (is_in_body || closed_form.name.ends_with(".w")) {
      value.add_output(value.compile_vector(closed_form.value, symbols));
      auto& angular_velocity = exact_rotation(closed_form.name, closed_form.where).angular_velocity;
      if (angular_velocity) throw InputError(closed_form.where, "[exact] has both `w` and `w_body` of one body");
      angular_velocity = {is_in_body ? Frame::body : Frame::world, value.build(), closed_form.where};
      return;
    }
    const AssignmentTarget target = find_target(closed_form);
    value.add_output(target.size == 3 ? value.compile_vector(closed_form.value, symbols)
                                      : value.compile_scalar(closed_form.value, symbols));
    world_.exact.push_back({closed_form.name, target.group, target.offset, value.build(), closed_form.where});
  }

  /// The closed form of the rotation of the body in `name`, BODY.PART.
  World::ClosedRotation& exact_rotation(const std::string& name, const SourceLocation& where) {
    const std::string_view owner = std::string_view(name).substr(0, name.find('.'));
    const auto body = ranges::find(world_.bodies, owner, &World::Body::name);
    if (body == world_.bodies.end()) throw InputError(where, "there is no body of '" + name + "'");
    if (!body->rotation)
      throw InputError(where, "body '" + body->name + "' does not turn: give it an `angular_velocity`, which may be 0");
    const int index = static_cast<int>(body - world_.bodies.begin());
    const auto known = ranges::find(world_.exact_rotations, index, &World::ClosedRotation::body);
    if (known != world_.exact_rotations.end()) return *known;
    return world_.exact_rotations.emplace_back(World::ClosedRotation{.body = index});
  }

  void compile_exact_orientation(const ExactOrientation& closed_form) {
    using Form = World::ClosedRotation::Form;
    ProgramBuilder value(1);
    Symbols symbols(&parameters_.symbols);
    symbols.set_node("t", value.clock(world_.epoch));
    const OrientationDefinition& given = closed_form.value;
    if (given.axis) value.add_output(value.compile_vector(*given.axis, symbols));
    if (given.angle_rad) value.add_output(value.compile_scalar(*given.angle_rad, symbols));
    for (const Expression& part : given.quaternion) value.add_output(value.compile_scalar(part, symbols));
    for (const Expression& row : given.matrix) value.add_output(value.compile_vector(row, symbols));
    if (given.roll_pitch_yaw.size() == 3) {
      std::array<ProgramBuilder::Value, 3> angles;
      for (std::size_t i = 0; i < 3; ++i) angles[i] = value.compile_scalar(given.roll_pitch_yaw[i], symbols);
      add_quaternion(angles, value);
    }
    auto& orientation = exact_rotation(closed_form.name, closed_form.where).orientation;
    if (orientation) throw InputError(closed_form.where, "[exact] has '" + closed_form.name + "' twice");
    const Form form = given.axis ? Form::axis_angle : given.matrix.empty() ? Form::quaternion : Form::matrix;
    orientation = {form, value.build(), closed_form.where};
  }

  /// An angular velocity in the other frame than the state's needs the orientation.
  void check_exact_rotation(const World::ClosedRotation& closed_form) const {
    const World::Body& body = world_.bodies[static_cast<std::size_t>(closed_form.body)];
    const auto& w = closed_form.angular_velocity;
    if (!w || closed_form.orientation || w->frame == body.rotation->layout.frame) return;
    throw InputError(w->where, "the state of body '" + body.name + "' holds its angular velocity in the frame of the " +
                                   (w->frame == Frame::world ? "body: give `w_body`" : "world: give `w`") +
                                   ", or the closed form of its orientation too");
  }

  /// Components of a group's state that an assignment replaces, or a closed form gives.
  struct AssignmentTarget {
    int group;
    int offset;
    int size;
    const World::Body* turning = nullptr;  ///< whose angular velocity it is
  };

  AssignmentTarget find_target(const NamedExpression& assignment) const {
    for (const World::ExtraState& state : world_.states)
      if (state.name == assignment.name) return {state.group, state.offset, 1};
    const std::size_t dot = assignment.name.find('.');
    if (dot != std::string::npos) {
      const std::string_view name = std::string_view(assignment.name).substr(dot + 1);
      const BodyPart* part = find_body_part(name);
      for (const World::Body& body : world_.bodies) {
        if (body.name != assignment.name.substr(0, dot)) continue;
        if (part != nullptr) return {body.group, body.offset + part->first, part->size};
        if (name == "w" && body.rotation) return {body.group, body.slice().angular_velocity_index(), 3, &body};
        if (name == "w")
          throw InputError(assignment.where,
                           "body '" + body.name + "' does not turn: give it an `angular_velocity`, which may be 0");
      }
    }
    throw InputError(assignment.where,
                     "'" + assignment.name + "' is neither an extra state nor a part of a body such as ball.v");
  }

  const Scene& scene_;
  ParameterSet parameters_;
  SceneNumbers numbers_;
  Partition partition_;
  std::unordered_map<std::string_view, int> members_;  // of the partition, by the names of bodies and extra states
  std::map<int, int> group_of_root_;
  bool has_friction_ = has_friction(scene_);
  World world_;
};

}  // namespace

World make_world(const Scene& scene) {
  detail::check_names(scene);
  return WorldBuilder(scene).build();
}

}  // namespace trajet
