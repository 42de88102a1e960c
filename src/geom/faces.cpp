#include "trajet/geom/faces.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

namespace trajet {

namespace {

using Edge = std::pair<int, int>;  // from vertex to vertex, in the direction of its triangle

constexpr double kFlat = 1e-6;  // rad

/// The only loop that the edges make, as vertices; nothing if they make several or touch themselves.
std::optional<std::vector<int>> loop(const std::vector<Edge>& edges) {
  std::map<int, int> next;
  for (const auto& [from, to] : edges)
    if (!next.emplace(from, to).second) return std::nullopt;
  std::vector<int> vertices;
  int at = edges.front().first;
  do {
    vertices.push_back(at);
    const auto found = next.find(at);
    if (found == next.end()) return std::nullopt;
    at = found->second;
  } while (at != vertices.front() && vertices.size() <= edges.size());
  if (vertices.size() != edges.size()) return std::nullopt;
  return vertices;
}

/// Sets of triangles that grow together.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

Face face(const Disk& disk, int sides) {
  const Vector3 u = disk.radius * disk.normal.unitOrthogonal();
  const Vector3 v = disk.normal.cross(u);
  Face result{{}, disk.normal};
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    result.corners.push_back(disk.center + std::cos(angle) * u + std::sin(angle) * v);
  }
  return result;
}

Face face(const Rectangle& rectangle) {
  const Vector3 u = 0.5 * rectangle.width * rectangle.up.cross(rectangle.normal);
  const Vector3 v = 0.5 * rectangle.height * rectangle.up;
  const Vector3& c = rectangle.center;
  return {{c - u - v, c + u - v, c + u + v, c - u + v}, rectangle.normal};
}

Face face(const Triangle& triangle) {
  return {{triangle.corners[0], triangle.corners[1], triangle.corners[2]}, triangle.normal};
}

std::array<Face, 6> faces(const Box& box) {
  std::array<Face, 6> result;
  for (int i = 0; i < 6; ++i) {
    const int axis = i / 2;
    const double side = i % 2 == 0 ? -1.0 : 1.0;
    const Vector3 normal = side * box.R_WB.col(axis);
    const Vector3 u = box.half_size[(axis + 1) % 3] * box.R_WB.col((axis + 1) % 3);
    const Vector3 v = side * box.half_size[(axis + 2) % 3] * box.R_WB.col((axis + 2) % 3);
    const Vector3 middle = box.center + box.half_size[axis] * normal;
    result[static_cast<std::size_t>(i)] = {{middle - u - v, middle + u - v, middle + u + v, middle - u + v}, normal};
  }
  return result;
}

std::vector<Face> faces(const TriangleMesh& surface) {
  const auto vertex = [&](int i) -> const Vector3& { return surface.vertices[static_cast<std::size_t>(i)]; };
  std::vector<Vector3> normals;
  std::map<Edge, std::size_t> triangle_of;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& corners = surface.triangles[t];
    const Vector3 area = (vertex(corners[1]) - vertex(corners[0])).cross(vertex(corners[2]) - vertex(corners[0]));
    normals.push_back(area.stableNormalized());
    if (area.isZero(0.0)) continue;
    for (std::size_t i = 0; i < 3; ++i) triangle_of[{corners[i], corners[(i + 1) % 3]}] = t;
  }

  Groups groups(surface.triangles.size());
  for (const auto& [edge, t] : triangle_of) {
    const auto other = triangle_of.find({edge.second, edge.first});
    if (other != triangle_of.end() && normals[t].cross(normals[other->second]).norm() < kFlat &&
        normals[t].dot(normals[other->second]) > 0.0)
      groups.join(t, other->second);
  }

  std::map<std::size_t, std::vector<Edge>> rims;
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (const auto& [edge, t] : triangle_of) {
    const auto other = triangle_of.find({edge.second, edge.first});
    if (other == triangle_of.end() || groups.find(other->second) != groups.find(t))
      rims[groups.find(t)].push_back(edge);
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (!normals[t].isZero(0.0)) members[groups.find(t)].push_back(t);

  std::vector<Face> result;
  for (const auto& [group, triangles] : members) {
    const auto add = [&](const auto& corners, const Vector3& normal) {
      Face face{{}, normal};
      for (const int i : corners) face.corners.push_back(vertex(i));
      result.push_back(std::move(face));
    };
    if (const auto rim = rims.contains(group) ? loop(rims.at(group)) : std::nullopt) {
      add(*rim, normals[triangles.front()]);
    } else {
      for (const std::size_t t : triangles) add(surface.triangles[t], normals[t]);
    }
  }
  return result;
}

}  // namespace trajet
