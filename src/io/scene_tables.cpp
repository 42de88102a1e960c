#include "scene_tables.hpp"

#include <algorithm>

#include "trajet/portable.hpp"
#include "trajet/rigid/orientation.hpp"

namespace trajet::detail {

namespace {

using Form = ValueForm;

Names orientation_names() {
  Names found;
  for (const OrientationInfo& info : orientation_ways()) {
    found.push_back(info.name);
    found.insert(found.end(), info.aliases.begin(), info.aliases.end());
  }
  return found;
}

}  // namespace

Keys scene_keys() {
  static const std::vector<Key> keys{
      {"title", Form::text, "one line for people"},
      {"up", Form::word, "the axis of the world that points up in pictures; default z", {}, {"y", "z"}},
      {"parameters", Form::formulas, "numbers and vectors by name, for all formulas"},
      {"time", Form::table, "from when to when", {}, {}, 0, true},
      {"method", Form::table, "how the motion is computed"},
      {"body", Form::tables, "what moves"},
      {"obstacle", Form::tables, "what bodies meet"},
      {"pair", Form::tables, "what becomes of two things where they touch"},
      {"state", Form::tables, "further ordinary differential equations"},
      {"event", Form::tables, "what is noticed when it happens"},
      {"exact", Form::closed_forms, "closed forms to compare with"},
  };
  return keys;
}

Keys time_keys() {
  static const std::vector<Key> keys{
      {"start", Form::scalar, "when the motion starts; default 0", kTime},
      {"end", Form::scalar, "when it ends", kTime, {}, 0, true},
      {"sample", Form::scalar, "spacing of the written samples; default (end - start)/200", kTime},
  };
  return keys;
}

Keys method_keys() {
  static const std::vector<Key> keys{
      {"name", Form::text, "a name or alias of 'trajet methods'; default taylor"},
      {"rtol", Form::scalar, "relative tolerance of error-controlled methods; default 1e-12", kDimensionless},
      {"atol", Form::scalar, "absolute tolerance in the unit of each component; default: follows its scale",
       kDimensionless},
      {"step", Form::scalar, "step of a fixed-step method; of others the first", kTime},
      {"steps", Form::scalars, "unequal steps of a fixed-step method, instead of 'step'", kTime},
      {"max_step", Form::scalar, "no step is longer; default: no limit", kTime},
      {"order", Form::whole_number, "order of the methods series and taylor"},
      {"max_steps", Form::whole_number, "a run that needs more fails; default 1000000"},
      {"max_seconds", Form::scalar, "elapsed time that a run may take; default: no limit", kTime},
      {"orientation",
       Form::word,
       "how orientations are carried; default quaternion-normalized",
       {},
       orientation_names()},
      {"locate",
       Form::word,
       "how the times of impacts are found; default polynomial",
       {},
       {"polynomial", "interpolation", "subdivision"}},
      {"simultaneous",
       Form::word,
       "how impacts at one instant are resolved; default reflections",
       {},
       {"reflections", "group"}},
  };
  return keys;
}

Keys state_keys() {
  static const std::vector<Key> keys{
      {"name", Form::text, "unique; laws use it", {}, {}, 0, true},
      {"value", Form::scalar, "at the start", {}, {}, 0, true},
      {"rate", Form::scalar, "its derivative by time: a formula", {}, {}, 0, true},
  };
  return keys;
}

Keys event_keys() {
  static const std::vector<Key> keys{
      {"name", Form::text, "unique", {}, {}, 0, true},
      {"when", Form::scalar, "happens where this formula crosses zero", {}, {}, 0, true},
      {"direction", Form::word, "of the crossing; default any", {}, {"rising", "falling", "any"}},
      {"action",
       Form::word,
       "what happens then; default record, or set where there is a 'set'",
       {},
       {"record", "stop", "set"},
       0,
       false,
       Form::setting},
      {"set", Form::formulas, "new values of extra states and of parts of bodies, by name"},
  };
  return keys;
}

Keys friction_keys() {
  static const std::vector<Key> keys{
      {"friction", Form::scalar, "Coulomb's coefficient, at least 0; default 0", kDimensionless},
      {"tangential_restitution", Form::scalar, "-1 to 1, of the slip of a point of contact that grips", kDimensionless},
      {"rolling_friction", Form::scalar, "of contact that lasts: torque over normal force", kLength},
      {"spinning_friction", Form::scalar, "of contact that lasts: torque about the normal over normal force", kLength},
      {"impact", Form::word, "what the restitution measures; default stronge", {}, {"stronge", "poisson", "newton"}},
  };
  return keys;
}

Keys pair_keys() {
  static const std::vector<Key> keys{
      {"of", Form::names, "two bodies, or a body and an obstacle", {}, {}, 2, true},
      {"on_hit", Form::word, "what becomes of them where they touch", {}, {"stop", "bounce", "pass", "stick"}},
      {"restitution", Form::scalar, "0 to 1; may be a formula of u, the speed of approach", kDimensionless},
  };
  return keys;
}

Keys body_keys() {
  static const std::vector<Key> keys{
      {"name", Form::text, "unique; laws use it", {}, {}, 0, true},
      {"position", Form::vector, "of the centre of mass at the start; default 0", kLength},
      {"velocity", Form::vector, "at the start; default 0", kSpeed},
      {"acceleration", Form::vector, "the law; default 0", kAcceleration},
      {"force", Form::vector, "the law as a force on a mass, instead of 'acceleration'", kForce},
      {"mass", Form::scalar, "may be a formula of t and the states", kMass},
      {"density", Form::scalar, "of an extended shape, instead of 'mass'", kDensity},
      {"position_rate", Form::vector, "the rate of the position where it is not the velocity", kSpeed},
      {"orientation", Form::orientation, "at the start; default: none"},
      {"angular_velocity", Form::vector, "at the start, world frame", kAngularVelocity},
      {"angular_velocity_body", Form::vector, "at the start, body frame", kAngularVelocity},
      {"angular_acceleration", Form::vector, "the law, world frame", kAngularAcceleration},
      {"angular_acceleration_body", Form::vector, "the law, body frame", kAngularAcceleration},
      {"torque", Form::vector, "about the centre of mass, world frame", kTorque},
      {"torque_body", Form::vector, "about the centre of mass, body frame", kTorque},
      {"force_point", Form::vector, "where the force acts, body frame", kLength},
      {"inertia",
       Form::vector,
       "three moments along the body's axes, or a matrix",
       kInertia,
       {},
       3,
       false,
       Form::vectors},
      {"points", Form::named_points, "points of the body to be reported, body frame", kLength},
      {"restitution", Form::scalar, "against other bodies, 0 to 1; may be a formula of u, the speed of approach",
       kDimensionless},
      {"collides_with",
       Form::word,
       "what it meets; default all",
       {},
       {"all", "obstacles", "none"},
       0,
       false,
       Form::names},
      {"color", Form::text, "in pictures: \"#rrggbb\" or a name of CSS 2.1"},
  };
  return keys;
}

Keys obstacle_keys() {
  static const std::vector<Key> keys{
      {"name", Form::text, "unique", {}, {}, 0, true},
      {"on_hit",
       Form::word,
       "what becomes of a body that hits it; default stop",
       {},
       {"stop", "bounce", "pass", "stick"}},
      {"restitution", Form::scalar, "of bounces, 0 to 1; may be a formula of u, the speed of approach", kDimensionless},
      {"color", Form::text, "in pictures: \"#rrggbb\" or a name of CSS 2.1"},
      {"velocity", Form::vector, "constant, of its frame", kSpeed},
      {"angular_velocity", Form::vector, "constant, of its frame, world axes", kAngularVelocity},
  };
  return keys;
}

Keys part_keys() {
  static const std::vector<Key> keys{
      {"position", Form::vector, "of the part in the compound's frame; default 0", kLength},
      {"orientation", Form::orientation, "of the part in the compound's frame; default: none"},
  };
  return keys;
}

Keys orientation_keys() {
  static const std::vector<Key> keys{
      {"axis", Form::vector, "of the rotation, of any length", kDimensionless},
      {"angle", Form::scalar, "about the axis", kAngle},
      {"quaternion", Form::scalars, "w, x, y, z", kDimensionless, {}, 4},
      {"matrix", Form::vectors, "three rows", kDimensionless, {}, 3},
      {"roll", Form::scalar, "about the x axis", kAngle},
      {"pitch", Form::scalar, "about the y axis", kAngle},
      {"yaw", Form::scalar, "about the z axis", kAngle},
  };
  return keys;
}

Keys shape_keys() {
  static const std::vector<Key> keys{
      {"point", Form::vector, "a point of the plane", kLength},
      {"center", Form::vector, "where its frame is; may be a formula of t", kLength},
      {"normal", Form::vector, "of any length", kDimensionless},
      {"up", Form::vector, "direction of the height", kDimensionless},
      {"radius", Form::scalar, "of a ball, a base, a cap", kLength},
      {"height", Form::scalar, "along z; of a terrain a formula of x and y", kLength},
      {"size",
       Form::vector,
       "full edge lengths; of a rectangle width and height",
       kLength,
       {},
       2,
       false,
       Form::scalars},
      {"radii", Form::vector, "along x, y, z", kLength},
      {"points", Form::vectors, "the corners", kLength},
      {"file", Form::text, "of a mesh: OBJ, STL, glTF, relative to the scene"},
      {"scale", Form::scalar, "of the mesh's coordinates; default 1", kDimensionless},
      {"parts", Form::parts, "solids that are one"},
      {"orientation", Form::orientation, "of its frame; may have formulas of t; default: none"},
      {"inside", Form::flag, "hollow: bodies live inside"},
      {"rounding", Form::scalar, "edges and corners are rounded by that radius, inside the shape", kLength},
      {"mass", Form::scalar, "of a part", kMass},
      {"density", Form::scalar, "of a part", kDensity},
  };
  return keys;
}

Names names(Keys keys) {
  Names found;
  for (const Key& key : keys) found.push_back(key.name);
  return found;
}

Names operator+(Names a, const Names& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::span<const std::string_view> words(Keys keys, std::string_view name) {
  return ranges::find(keys, name, &Key::name)->words;
}

}  // namespace trajet::detail
