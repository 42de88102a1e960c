#include "scene_solids.hpp"

#include <algorithm>
#include <array>

namespace trajet::detail {

OrientationDefinition read_orientation(const TableReader& table) {
  OrientationDefinition orientation;
  orientation.where = table.where();
  constexpr std::array<std::string_view, 7> kKeys{"axis", "angle", "quaternion", "matrix", "roll", "pitch", "yaw"};
  constexpr std::array<std::string_view, 3> kAngles{"roll", "pitch", "yaw"};
  table.check_keys(kKeys);
  const bool by_angle = table.has("axis") || table.has("angle");
  const bool by_angles = std::ranges::any_of(kAngles, [&](std::string_view key) { return table.has(key); });
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

namespace {

using Keys = std::vector<std::string_view>;

Keys operator+(Keys a, const Keys& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

PlaneDefinition read_plane(const TableReader& table) {
  return {table.vector("point", kLength), table.vector("normal", kDimensionless)};
}

DiskDefinition read_disk(const TableReader& table) {
  return {table.vector("center", kLength), table.vector("normal", kDimensionless), table.scalar("radius", kLength)};
}

RectangleDefinition read_rectangle(const TableReader& table) {
  const std::vector<Expression> size = table.scalars("size", 2, kLength);
  return {table.vector("center", kLength), table.vector("normal", kDimensionless), table.vector("up", kDimensionless),
          size[0], size[1]};
}

TriangleDefinition read_triangle(const TableReader& table) {
  const std::vector<Expression> points = table.vectors("points", 3, kLength);
  return {points[0], points[1], points[2]};
}

SphereDefinition read_sphere(const TableReader& table) {
  return {table.vector("center", kLength), table.scalar("radius", kLength)};
}

BoxDefinition read_box(const TableReader& table) {
  BoxDefinition box{table.vector("center", kLength), table.vector("size", kLength)};
  if (table.has("orientation")) box.orientation = read_orientation(table.subtable("orientation"));
  return box;
}

/// Shapes of obstacles: one row each.
struct ObstacleKind {
  std::string_view name;
  Keys keys;
  ObstacleShape (*read)(const TableReader&);
};

const std::array<ObstacleKind, 6>& obstacle_kinds() {
  static const std::array<ObstacleKind, 6> kinds{{
      {"plane", {"point", "normal"}, [](const TableReader& t) { return ObstacleShape(read_plane(t)); }},
      {"disk", {"center", "normal", "radius"}, [](const TableReader& t) { return ObstacleShape(read_disk(t)); }},
      {"rectangle",
       {"center", "normal", "up", "size"},
       [](const TableReader& t) { return ObstacleShape(read_rectangle(t)); }},
      {"triangle", {"points"}, [](const TableReader& t) { return ObstacleShape(read_triangle(t)); }},
      {"sphere", {"center", "radius"}, [](const TableReader& t) { return ObstacleShape(read_sphere(t)); }},
      {"box", {"center", "size", "orientation"}, [](const TableReader& t) { return ObstacleShape(read_box(t)); }},
  }};
  return kinds;
}

}  // namespace

ObstacleDefinition read_obstacle(const TableReader& table) {
  std::vector<std::string_view> shapes;
  for (const ObstacleKind& kind : obstacle_kinds()) shapes.push_back(kind.name);
  constexpr std::array<std::string_view, 4> kPlannedShapes{"cylinder", "capsule", "hull", "mesh"};
  if (!table.has("shape")) throw InputError(table.where(), table.title() + " lacks the key 'shape'");
  const ObstacleKind& kind = obstacle_kinds()[table.choice("shape", shapes, 0, kPlannedShapes)];

  const Keys common = {"name", "shape", "on_hit", "restitution"};
  Keys planned = {"friction", "velocity", "angular_velocity", "file", "scale"};
  const std::string with_shape = table.title() + " of shape " + std::string(kind.name);
  TableReader titled = table.titled(with_shape);
  titled.check_keys(common + kind.keys, planned);

  constexpr std::array<std::string_view, 3> kOnHit{"stop", "bounce", "pass"};
  constexpr std::array<std::string_view, 1> kPlannedOnHit{"stick"};
  ObstacleDefinition obstacle{table.text("name"), kind.read(titled)};
  obstacle.where = table.where("name");
  obstacle.on_hit =
      std::array{OnHit::stop, OnHit::bounce, OnHit::pass}[table.choice("on_hit", kOnHit, 0, kPlannedOnHit)];
  if (table.has("restitution")) obstacle.restitution = table.scalar("restitution", kDimensionless);
  return obstacle;
}

}  // namespace trajet::detail
