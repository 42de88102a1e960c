#include "scene_solids.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include "mesh_file.hpp"
#include "scene_tables.hpp"

#include "trajet/portable.hpp"

namespace trajet::detail {

OrientationDefinition read_orientation(const TableReader& table) {
  OrientationDefinition orientation;
  orientation.where = table.where();
  constexpr std::array<std::string_view, 3> kAngles{"roll", "pitch", "yaw"};
  table.check_keys(names(orientation_keys()));
  const bool by_angle = table.has("axis") || table.has("angle");
  const bool by_angles = ranges::any_of(kAngles, [&](std::string_view key) { return table.has(key); });
  const int forms = int{by_angle} + int{table.has("quaternion")} + int{table.has("matrix")} + int{by_angles};
  if (forms != 1)
    throw InputError(table.where(),
                     "an orientation is one of {axis, angle}, {quaternion}, {matrix}, {roll, pitch, yaw}; got " +
                         std::string(forms == 0 ? "none" : "several"));
  if (by_angle) {
    orientation.axis = table.vector("axis", kDimensionless);
    orientation.angle_rad = table.scalar("angle", kAngle);
  } else if (table.has("quaternion")) {
    orientation.quaternion = table.scalars("quaternion", 4, kDimensionless);
  } else if (by_angles) {
    for (const std::string_view key : kAngles)
      orientation.roll_pitch_yaw.push_back(table.has(key) ? table.scalar(key, kAngle) : Expression(0.0));
  } else {
    orientation.matrix = table.vectors("matrix", 3, kDimensionless);
  }
  return orientation;
}

std::optional<RgbColor> read_color(const TableReader& table) {
  if (!table.has("color")) return std::nullopt;
  const std::string text = table.text("color");
  const std::optional<RgbColor> color = find_color(text);
  if (!color) table.fail("color", unknown_color(text));
  return color;
}

MeshShape read_mesh_shape(const TableReader& table) {
  MeshShape shape{read_mesh(table)};
  if (table.has("scale")) shape.scale = table.scalar("scale", kDimensionless);
  return shape;
}

ShapeDefinition read_cylinder(const TableReader& table) {
  return CylinderShape{table.scalar("radius", kLength), table.scalar("height", kLength)};
}

ShapeDefinition read_capsule(const TableReader& table) {
  return CapsuleShape{table.scalar("radius", kLength), table.scalar("height", kLength)};
}

ShapeDefinition read_cone(const TableReader& table) {
  return ConeShape{table.scalar("radius", kLength), table.scalar("height", kLength)};
}

ShapeDefinition read_ellipsoid(const TableReader& table) { return EllipsoidShape{table.vector("radii", kLength)}; }

ShapeDefinition read_hull(const TableReader& table) { return HullShape{table.vector_list("points", kLength)}; }

ShapeDefinition read_disk_across_z(const TableReader& table) {
  return DiskShape{Vector3(0, 0, 1), table.scalar("radius", kLength)};
}

namespace {

ShapeDefinition read_plane(const TableReader& table) { return PlaneShape{table.vector("normal", kDimensionless)}; }

ShapeDefinition read_disk(const TableReader& table) {
  return DiskShape{table.vector("normal", kDimensionless), table.scalar("radius", kLength)};
}

ShapeDefinition read_rectangle(const TableReader& table) {
  const std::vector<Expression> size = table.scalars("size", 2, kLength);
  return RectangleShape{table.vector("normal", kDimensionless), table.vector("up", kDimensionless), size[0], size[1]};
}

ShapeDefinition read_triangle(const TableReader& table) {
  const std::vector<Expression> points = table.vectors("points", 3, kLength);
  return TriangleShape{points[0], points[1], points[2]};
}

ShapeDefinition read_ball(const TableReader& table) { return BallShape{table.scalar("radius", kLength)}; }

ShapeDefinition read_cuboid(const TableReader& table) { return CuboidShape{table.vector("size", kLength)}; }

ShapeDefinition read_terrain(const TableReader& table) { return TerrainShape{table.scalar("height", kLength)}; }

ShapeDefinition read_compound(const TableReader& table) { return CompoundShape{read_parts(table, false)}; }

constexpr std::array<std::string_view, 5> kHollow{"sphere", "box", "cylinder", "capsule", "ellipsoid"};
constexpr std::array<std::string_view, 7> kRounded{"sphere", "box", "cylinder", "capsule", "cone", "ellipsoid", "hull"};

/// Shapes of obstacles: one row each.
struct ObstacleKind {
  std::string_view name;
  std::string_view center;  ///< the key that says where it is; none: its own keys say so
  bool needs_center;
  Names keys;  ///< that describe it, without `center`
  ShapeDefinition (*read)(const TableReader&);
};

const std::array<ObstacleKind, 14>& obstacle_kinds() {
  static const std::array<ObstacleKind, 14> kinds{{
      {"plane", "point", true, {"normal"}, read_plane},
      {"disk", "center", true, {"normal", "radius"}, read_disk},
      {"rectangle", "center", true, {"normal", "up", "size"}, read_rectangle},
      {"triangle", "center", false, {"points"}, read_triangle},
      {"sphere", "center", true, {"radius"}, read_ball},
      {"box", "center", true, {"size"}, read_cuboid},
      {"cylinder", "center", true, {"radius", "height"}, read_cylinder},
      {"capsule", "center", true, {"radius", "height"}, read_capsule},
      {"cone", "center", true, {"radius", "height"}, read_cone},
      {"ellipsoid", "center", true, {"radii"}, read_ellipsoid},
      {"hull", "center", false, {"points"}, read_hull},
      {"terrain", "center", false, {"height"}, read_terrain},
      {"compound", "center", false, {"parts"}, read_compound},
      {"mesh",
       "center",
       false,
       {"file", "scale"},
       [](const TableReader& t) { return ShapeDefinition(read_mesh_shape(t)); }},
  }};
  return kinds;
}

template <std::size_t Count>
bool is_among(const std::array<std::string_view, Count>& shapes, std::string_view shape) {
  return ranges::find(shapes, shape) != shapes.end();
}

/// The keys of an obstacle of that shape that not all obstacles have.
Names all_keys(const ObstacleKind& kind) {
  Names keys = kind.keys;
  if (!kind.center.empty()) keys.push_back(kind.center);
  // a plane is the same however it turns about its normal: its `normal` says it all
  if (kind.name != "plane") keys.push_back("orientation");
  if (is_among(kHollow, kind.name)) keys.push_back("inside");
  if (is_among(kRounded, kind.name)) keys.push_back("rounding");
  return keys;
}

Names required_keys(const ObstacleKind& kind) {
  Names required;
  for (const std::string_view key : kind.keys)
    if (key != "scale") required.push_back(key);
  if (kind.needs_center) required.push_back(kind.center);
  return required;
}

/// Shapes of the parts of a compound: those that bodies have too.
constexpr std::array<std::string_view, 9> kParts{"sphere", "box",       "cylinder", "capsule", "cone",
                                                 "disk",   "ellipsoid", "hull",     "mesh"};

/// What describes a part. A disk lies across the z axis of its own frame, as that of a body.
const ObstacleKind& part_kind(std::string_view shape) {
  static const ObstacleKind disk{"disk", "center", true, {"radius"}, read_disk_across_z};
  return shape == disk.name ? disk : *ranges::find(obstacle_kinds(), shape, &ObstacleKind::name);
}

}  // namespace

std::vector<ShapeKind> obstacle_shapes() {
  std::vector<ShapeKind> shapes;
  for (const ObstacleKind& kind : obstacle_kinds()) shapes.push_back({kind.name, all_keys(kind), required_keys(kind)});
  return shapes;
}

std::vector<ShapeKind> part_shapes() {
  std::vector<ShapeKind> shapes;
  for (const std::string_view part : kParts) {
    const ObstacleKind& kind = part_kind(part);
    Names keys = kind.keys + Names{"mass", "density"};
    if (is_among(kRounded, kind.name)) keys.push_back("rounding");
    Names required = required_keys(kind);
    std::erase(required, kind.center);
    shapes.push_back({kind.name, keys, required});
  }
  return shapes;
}

std::vector<PartDefinition> read_parts(const TableReader& table, bool have_masses) {
  std::vector<PartDefinition> parts;
  for (const TableReader& each : table.subtables("parts", "a part of a compound")) {
    if (!each.has("shape")) throw InputError(each.where(), "a part of a compound lacks the key 'shape'");
    const std::string_view shape = kParts[each.choice("shape", kParts, 0)];
    const ObstacleKind& kind = part_kind(shape);
    const bool may_be_round = is_among(kRounded, shape);
    each.titled("a part of shape " + std::string(shape))
        .check_keys(Names{"shape"} + names(part_keys()) + kind.keys + (may_be_round ? Names{"rounding"} : Names{}) +
                    (have_masses ? Names{"mass", "density"} : Names{}));
    PartDefinition part{.shape = kind.read(each)};
    part.where = each.where();
    part.rounding = each.optional_scalar("rounding", kLength);
    if (each.has("position")) part.position = each.vector("position", kLength);
    if (each.has("orientation")) part.orientation = read_orientation(each.subtable("orientation"));
    part.mass = each.optional_scalar("mass", kMass);
    part.density = each.optional_scalar("density", kDensity);
    parts.push_back(std::move(part));
  }
  return parts;
}

ObstacleDefinition read_obstacle(const TableReader& table) {
  std::vector<std::string_view> shapes;
  for (const ObstacleKind& kind : obstacle_kinds()) shapes.push_back(kind.name);
  if (!table.has("shape")) throw InputError(table.where(), table.title() + " lacks the key 'shape'");
  const ObstacleKind& kind = obstacle_kinds()[table.choice("shape", shapes, 0)];

  const std::string with_shape = table.title() + " of shape " + std::string(kind.name);
  TableReader titled = table.titled(with_shape);
  const bool has_center = !kind.center.empty();
  titled.check_keys(Names{"shape"} + names(obstacle_keys()) + names(friction_keys()) + all_keys(kind));

  ObstacleDefinition obstacle{.name = table.text("name"), .shape = PointShape{}};
  obstacle.where = table.where("name");
  if (kind.needs_center || (has_center && titled.has(kind.center)))
    obstacle.center = titled.vector(kind.center, kLength);
  obstacle.shape = kind.read(titled);
  obstacle.rounding = titled.optional_scalar("rounding", kLength);
  if (titled.has("inside")) obstacle.is_hollow = titled.flag("inside");
  if (obstacle.is_hollow && obstacle.rounding) titled.fail("rounding", "the inside of a shape is not rounded");
  if (titled.has("orientation"))
    obstacle.orientation =
        std::make_shared<const OrientationDefinition>(read_orientation(titled.subtable("orientation")));
  if (table.has("velocity")) obstacle.velocity = table.vector("velocity", kSpeed);
  if (table.has("angular_velocity")) obstacle.angular_velocity = table.vector("angular_velocity", kAngularVelocity);
  obstacle.on_hit = read_on_hit(table);
  if (table.has("restitution")) obstacle.restitution = table.scalar("restitution", kDimensionless);
  obstacle.friction = read_friction(table);
  obstacle.color = read_color(table);
  return obstacle;
}

}  // namespace trajet::detail
