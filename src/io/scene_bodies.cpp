#include <array>

#include "scene_solids.hpp"
#include "scene_tables.hpp"

namespace trajet::detail {

namespace {

/// Shapes of bodies: one row each, with the keys that describe them.
struct BodyKind {
  std::string_view name;
  Names keys;  // without `rounding`
  ShapeDefinition (*read)(const TableReader&);
};

const std::array<BodyKind, 12>& body_kinds() {
  using Table = const TableReader&;
  static const std::array<BodyKind, 12> kinds{{
      {"point", {}, [](Table) { return ShapeDefinition(PointShape{}); }},
      {"sphere", {"radius"}, [](Table t) { return ShapeDefinition(BallShape{t.scalar("radius", kLength)}); }},
      {"box", {"size"}, [](Table t) { return ShapeDefinition(CuboidShape{t.vector("size", kLength)}); }},
      {"soccer-ball",
       {"radius"},
       [](Table t) { return ShapeDefinition(SoccerBallShape{t.scalar("radius", kLength)}); }},
      {"cylinder", {"radius", "height"}, read_cylinder},
      {"capsule", {"radius", "height"}, read_capsule},
      {"cone", {"radius", "height"}, read_cone},
      {"disk", {"radius"}, read_disk_across_z},
      {"ellipsoid", {"radii"}, read_ellipsoid},
      {"hull", {}, read_hull},  // its `points` are the corners
      {"compound", {"parts"}, [](Table t) { return ShapeDefinition(CompoundShape{read_parts(t, true)}); }},
      {"mesh", {"file", "scale"}, [](Table t) { return ShapeDefinition(read_mesh_shape(t)); }},
  }};
  return kinds;
}

/// All keys of a shape but `scale` and the default of `shape` are needed.
Names required_keys(const Names& keys) {
  Names required;
  for (const std::string_view key : keys)
    if (key != "scale") required.push_back(key);
  return required;
}

const BodyKind& read_kind(const TableReader& table) {
  std::vector<std::string_view> names;
  for (const BodyKind& kind : body_kinds()) names.push_back(kind.name);
  return body_kinds()[table.choice("shape", names, 0)];
}

void read_translation(const TableReader& table, BodyDefinition& body) {
  if (table.has("position")) body.position = table.vector("position", kLength);
  if (table.has("velocity")) body.velocity = table.vector("velocity", kSpeed);
  body.acceleration = table.optional_vector("acceleration", kAcceleration);
  body.force = table.optional_vector("force", kForce);
  body.mass = table.optional_scalar("mass", kMass);
  body.density = table.optional_scalar("density", kDensity);
  body.position_rate = table.optional_vector("position_rate", kSpeed);
  if (body.acceleration && body.force)
    table.fail("force", "a body moves by its acceleration or by a force with a mass, not by both");
  const auto* compound = std::get_if<CompoundShape>(&body.shape);
  const bool have_parts_mass = compound != nullptr && (compound->parts[0].mass || compound->parts[0].density);
  if (body.force && !body.mass && !body.density && !have_parts_mass)
    table.fail("force", "a force needs the key 'mass'");
}

void read_rotation(const TableReader& table, BodyDefinition& body) {
  if (table.has("orientation")) body.orientation = read_orientation(table.subtable("orientation"));
  body.angular_velocity = table.optional_vector("angular_velocity", kAngularVelocity);
  body.angular_velocity_body = table.optional_vector("angular_velocity_body", kAngularVelocity);
  body.angular_acceleration = table.optional_vector("angular_acceleration", kAngularAcceleration);
  body.angular_acceleration_body = table.optional_vector("angular_acceleration_body", kAngularAcceleration);
  body.torque = table.optional_vector("torque", kTorque);
  body.torque_body = table.optional_vector("torque_body", kTorque);
  body.force_point = table.optional_vector("force_point", kLength);
  if (table.has("inertia")) read_inertia(table, body);
}

void read_points(const TableReader& table, BodyDefinition& body) {
  const TableReader points = table.subtable("points");
  for (const auto& [key, node] : entries_in_file_order(points.table()))
    body.points.push_back({std::string(key->str()), points.vector(key->str(), kLength), points.where(key->str())});
}

}  // namespace

void read_inertia(const TableReader& table, BodyDefinition& body) {
  body.inertia.clear();
  body.principal_inertia.reset();
  const toml::array* rows = table.table().get("inertia")->as_array();
  if (rows != nullptr && !rows->empty() && rows->get(0)->is_array()) {
    body.inertia = table.vectors("inertia", 3, kInertia);
  } else {
    body.principal_inertia = table.vector("inertia", kInertia);
  }
}

std::vector<ShapeKind> body_shapes() {
  std::vector<ShapeKind> shapes;
  for (const BodyKind& kind : body_kinds()) {
    // a hull's corners stand where other bodies have points by name
    const Names keys = kind.name == "hull" ? Names{"points"} : kind.keys;
    shapes.push_back({kind.name, keys + Names{"rounding"}, required_keys(keys)});
  }
  return shapes;
}

BodyDefinition read_body(const TableReader& table) {
  const BodyKind& kind = read_kind(table);
  if (kind.name == "point" && table.has("radius"))
    table.fail("radius", "a point has no radius; for one, write shape = \"sphere\"");
  table.check_keys(names(body_keys()) + Names{"shape", "rounding"} + kind.keys + names(friction_keys()));

  BodyDefinition body;
  body.where = table.where("name");
  body.name = table.text("name");
  body.shape = kind.read(table);
  body.rounding = table.optional_scalar("rounding", kLength);
  read_translation(table, body);
  read_rotation(table, body);
  if (kind.name != "hull" && table.has("points")) read_points(table, body);
  body.restitution = table.optional_scalar("restitution", kDimensionless);
  body.friction = read_friction(table);
  body.collides_with = read_collides_with(table);
  body.color = read_color(table);
  return body;
}

}  // namespace trajet::detail
