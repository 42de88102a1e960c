#pragma once

// Solids of all kinds, as bodies and as obstacles, and whether they overlap: by an algorithm and by support functions
// that the search for contacts does not know.

#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "scene_run.hpp"
#include "trajet/geom/solid_overlap.hpp"
#include "trajet/rigid/orientation.hpp"
#include "trajet/scene/world.hpp"

namespace trajet::test {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  Vector3 vector(double half) {
    const double x = between(-half, half), y = between(-half, half), z = between(-half, half);
    return {x, y, z};
  }

 private:
  std::mt19937 engine_;
};

inline std::string array(const Vector3& v) {
  return "[" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + "]";
}

/// A shape as the lines of its table; of a mesh those of another shape, which it then replaces.
struct Kind {
  std::string name;
  std::string lines;
};

inline const std::vector<Kind>& bodies() {
  static const std::vector<Kind> all{
      {"box", "shape = \"box\"\nsize = [1, 0.6, 0.4]\n"},
      {"rounded_box", "shape = \"box\"\nsize = [1, 0.6, 0.4]\nrounding = 0.05\n"},
      {"cylinder", "shape = \"cylinder\"\nradius = 0.3\nheight = 0.8\n"},
      {"rounded_cylinder", "shape = \"cylinder\"\nradius = 0.3\nheight = 0.8\nrounding = 0.05\n"},
      {"capsule", "shape = \"capsule\"\nradius = 0.2\nheight = 0.6\n"},
      {"cone", "shape = \"cone\"\nradius = 0.4\nheight = 0.7\n"},
      {"ellipsoid", "shape = \"ellipsoid\"\nradii = [0.5, 0.3, 0.4]\n"},
      {"hull", "shape = \"hull\"\npoints = [[0, 0, 0], [1, 0, 0], [0, 0.8, 0], [0, 0, 0.7], [0.5, 0.5, 0.4]]\n"},
      {"hammer",
       "shape = \"compound\"\nparts = [{shape = \"box\", size = [0.8, 0.2, 0.2]}, {shape = \"ellipsoid\", radii = "
       "[0.2, 0.25, 0.3], position = [0.4, 0.1, 0]}]\n"},
      {"dumbbell",
       "shape = \"compound\"\nparts = [{shape = \"cylinder\", radius = 0.1, height = 0.8}, {shape = \"sphere\", radius "
       "= 0.2, position = [0, 0, 0.4]}, {shape = \"cone\", radius = 0.2, height = 0.3, position = [0, 0, -0.4]}]\n"},
      {"mesh", "shape = \"box\"\nsize = [1, 1, 1]\n"}};
  return all;
}

inline const std::vector<Kind>& obstacles() {
  static const std::string tilted = "orientation = {axis = [1, 0.2, 0], angle = 1.4}\n";
  static const std::vector<Kind> all{
      {"plane", "shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0.1, 0.2, 1]\n"},
      {"disk", "shape = \"disk\"\ncenter = [0, 0, 0]\nnormal = [0.1, 0.2, 1]\nradius = 1.5\n"},
      {"rectangle",
       "shape = \"rectangle\"\ncenter = [0, 0, 0]\nnormal = [0.1, 0.2, 1]\nup = [1, 0, -0.1]\nsize = [2.5, 2]\n"},
      {"triangle", "shape = \"triangle\"\npoints = [[-1.5, -1, 0], [1.5, -1.2, 0.1], [0.1, 1.6, -0.1]]\n"},
      {"sphere", "shape = \"sphere\"\ncenter = [0, 0, -0.5]\nradius = 1\n"},
      {"box", "shape = \"box\"\ncenter = [0, 0, -0.5]\nsize = [2, 1.5, 1]\n" + tilted},
      {"rounded_box", "shape = \"box\"\ncenter = [0, 0, -0.5]\nsize = [2, 1.5, 1]\nrounding = 0.1\n" + tilted},
      {"cylinder", "shape = \"cylinder\"\ncenter = [0, 0, -0.5]\nradius = 0.7\nheight = 2\n" + tilted},
      {"capsule", "shape = \"capsule\"\ncenter = [0, 0, -0.5]\nradius = 0.7\nheight = 1\n" + tilted},
      {"cone", "shape = \"cone\"\ncenter = [0, 0, -0.5]\nradius = 1.2\nheight = 1.5\n"},
      {"ellipsoid", "shape = \"ellipsoid\"\ncenter = [0, 0, -0.5]\nradii = [1.2, 0.8, 0.6]\n" + tilted},
      {"hull",
       "shape = \"hull\"\ncenter = [0, 0, -0.7]\npoints = [[-1, -1, 0], [1, -1, 0], [0, 1, 0], [0, 0, 1], [0.7, 0.6, "
       "0.4]]\n"},
      {"mesh", "shape = \"box\"\ncenter = [0, 0, 0]\nsize = [1, 1, 1]\n"},
      {"compound",
       "shape = \"compound\"\ncenter = [0, 0, -0.5]\nparts = [{shape = \"box\", size = [2, 0.6, 0.6]}, {shape = "
       "\"ellipsoid\", radii = [0.5, 0.7, 0.6], position = [0.6, 0.1, 0]}, {shape = \"cone\", radius = 0.5, height = "
       "1, position = [-0.6, 0, 0.3]}]\n"},
      {"room", "shape = \"box\"\ncenter = [0, 0, 0.8]\nsize = [4, 4, 5]\ninside = true\n"}};
  return all;
}

/// A prism over an L, closed and not convex.
inline TriangleMesh corner_block() {
  TriangleMesh mesh;
  for (const double z : {0.0, 0.4})
    for (const auto& [x, y] :
         std::vector<std::pair<double, double>>{{0.0, 0.0}, {0.8, 0.0}, {0.8, 0.3}, {0.3, 0.3}, {0.3, 0.7}, {0.0, 0.7}})
      mesh.vertices.push_back({x, y, z});
  for (int i = 1; i < 5; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({6, i + 6, i + 7});
  }
  for (int i = 0; i < 6; ++i) {
    const int j = (i + 1) % 6;
    mesh.triangles.push_back({i, j, j + 6});
    mesh.triangles.push_back({i, j + 6, i + 6});
  }
  return mesh;
}

inline TriangleMesh hills() {
  constexpr int kSide = 5;
  TriangleMesh mesh;
  for (int i = 0; i <= kSide; ++i)
    for (int j = 0; j <= kSide; ++j)
      mesh.vertices.push_back({-1.5 + 3.0 * i / kSide, -1.5 + 3.0 * j / kSide, 0.1 * ((7 * i + 5 * j) % 3)});
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const int a = i * (kSide + 1) + j, b = a + kSide + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

/// What bounded convex solids, or compounds of them, a thing is made of; of a half space what is near.
inline std::vector<Solid> parts_of(const Solid& solid) {
  const auto* mesh = std::get_if<Mesh>(&solid);
  if (mesh == nullptr) return {solid};
  const TriangleMesh& surface = mesh->polyhedron->surface;
  std::vector<Solid> parts;
  for (const auto& corners : surface.triangles) {
    const auto at = [&](std::size_t i) { return surface.vertices[static_cast<std::size_t>(corners[i])]; };
    parts.emplace_back(TriangularPlate{{at(0), at(1), at(2)}});
  }
  return parts;
}

/// How an obstacle moves: about its centre.
struct Drive {
  Vector3 pivot = Vector3::Zero(), velocity = Vector3::Zero(), w = Vector3::Zero();
};

/// Whether the only body of a world overlaps its obstacles.
class OverlapOracle {
 public:
  explicit OverlapOracle(const Drive& drive = {}) : drive_(drive) {}
  void begin(const World& world) {
    world_ = &world;
    body_ = parts_of(world.bodies.front().solid);
    for (const World::Obstacle& obstacle : world.obstacles) obstacles_.push_back(parts_of(obstacle.solid));
  }
  bool overlaps(const BodyState& state, double t) const {
    const double angle = drive_.w.norm() * t;
    const Matrix3 turn =
        angle > 0.0 ? rotation_matrix(from_axis_angle<double>(drive_.w.normalized(), angle)) : Matrix3::Identity();
    for (std::size_t i = 0; i < obstacles_.size(); ++i) {
      const World::Obstacle& obstacle = world_->obstacles[i];
      const Matrix3 R = turn * rotation_matrix(obstacle.q_WB);
      const Vector3 p = drive_.pivot + drive_.velocity * t + turn * (obstacle.p_WB - drive_.pivot);
      for (const Solid& part : obstacles_[i])
        for (const Solid& piece : body_)
          if (overlap({piece, state.position, state.rotation_matrix}, near_part(part, p, R, state.position)))
            return true;
    }
    return false;
  }

 private:
  static PlacedSolid near_part(const Solid& part, const Vector3& p, const Matrix3& R, const Vector3& body) {
    if (!std::holds_alternative<HalfSpace>(part)) return {part, p, R};
    constexpr double kThick = 20.0;
    static const Solid block = Cuboid{{kThick, kThick, kThick}};
    const Vector3 n = R.col(2), above = body - n * n.dot(body - p);
    return {block, above - kThick * n, R};
  }

  Drive drive_;
  const World* world_ = nullptr;
  std::vector<Solid> body_;
  std::vector<std::vector<Solid>> obstacles_;
};

/// A body of one kind thrown at an obstacle of another; some of the obstacles move.
struct Throw {
  Scene scene{};
  Drive drive{};
  Vector3 velocity = Vector3::Zero(), w = Vector3::Zero(), position = Vector3::Zero();
};
/// `on_hit`: the lines of what becomes of a hit.
inline Throw random_throw(const Kind& body, const Kind& other, bool is_driven, const std::string& on_hit, double mass,
                          unsigned seed) {
  Random random(seed);
  const bool is_room = other.name == "room";
  Throw thrown;
  const double height = is_room ? random.between(0.0, 1.5) : random.between(1.2, 2.0);
  thrown.position = {random.between(-0.6, 0.6), random.between(-0.6, 0.6), height};
  thrown.velocity = random.vector(1.0);
  thrown.w = random.vector(8.0);
  const Vector3 axis = random.vector(1.0);
  if (const auto at = other.lines.find("center = [0, 0, "); at != std::string::npos)
    thrown.drive.pivot.z() = std::stod(other.lines.substr(at + 16));
  if (is_driven) {
    thrown.drive.w = is_room ? Vector3(0.3, 0.2, 0.4) : Vector3(0.5, 0.3, 1.0);
    if (!is_room) thrown.drive.velocity = {0.1, 0.0, 0.3};
  }
  std::string text = "[time]\nend = 1.5\nsample = 0.01\n[[body]]\nname = \"b\"\nmass = " + number(mass) + "\n" +
                     body.lines + "position = " + array(thrown.position) + "\nvelocity = " + array(thrown.velocity) +
                     "\nangular_velocity = " + array(thrown.w) + "\norientation = {axis = " + array(axis) +
                     ", angle = " + number(random.between(0.0, 6.0)) + "}\nforce = [0, 0, \"-9.8*" + number(mass) +
                     "\"]\n[[obstacle]]\nname = \"o\"\n" + other.lines + on_hit;
  if (is_driven)
    text += "velocity = " + array(thrown.drive.velocity) + "\nangular_velocity = " + array(thrown.drive.w) + "\n";
  thrown.scene = parse_scene(text, "test.toml");
  if (body.name == "mesh") thrown.scene.bodies.front().shape = MeshShape{corner_block()};
  if (other.name == "mesh") thrown.scene.obstacles.front().shape = MeshShape{hills()};
  return thrown;
}

}  // namespace trajet::test
