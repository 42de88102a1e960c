#include "trajet/geom/triangle_mesh.hpp"

#include <algorithm>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include "trajet/geom/vertex_joiner.hpp"

namespace trajet {

std::vector<Vector3> truncated_icosahedron(double radius) {
  using std::numbers::phi;
  // edge length 2; even permutations with all signs [Coxeter1973]
  constexpr std::array<std::array<double, 3>, 3> kCorners{
      {{0.0, 1.0, 3.0 * phi}, {1.0, 2.0 + phi, 2.0 * phi}, {phi, 2.0, 2.0 * phi + 1.0}}};
  std::vector<Vector3> corners;
  for (const auto& corner : kCorners)
    for (int rotation = 0; rotation < 3; ++rotation)
      for (int signs = 0; signs < 8; ++signs) {
        if ((signs & 1) != 0 && corner[0] == 0.0) continue;
        Vector3 p;
        for (int i = 0; i < 3; ++i)
          p[(i + rotation) % 3] =
              ((signs >> i) & 1) != 0 ? -corner[static_cast<std::size_t>(i)] : corner[static_cast<std::size_t>(i)];
        corners.push_back(radius * p.normalized());
      }
  return corners;
}

TriangleMesh closed_mesh(const TriangleMesh& mesh) {
  TriangleMesh result;
  std::vector<int> joined;
  VertexJoiner joiner;
  for (const Vector3& vertex : mesh.vertices) joined.push_back(joiner.index(vertex));
  result.vertices = joiner.take_vertices();
  std::set<std::pair<int, int>> edges;
  double volume = 0.0;
  for (const auto& triangle : mesh.triangles) {
    std::array<int, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) corners[i] = joined.at(static_cast<std::size_t>(triangle[i]));
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    const auto at = [&](std::size_t i) {
      return Vector3(result.vertices[static_cast<std::size_t>(corners[i])] - result.vertices[0]);
    };
    volume += at(0).cross(at(1)).dot(at(2));
    for (std::size_t i = 0; i < 3; ++i)
      if (!edges.emplace(corners[i], corners[(i + 1) % 3]).second)
        throw std::domain_error("the surface is not closed: two triangles have an edge in the same direction");
    result.triangles.push_back(corners);
  }
  if (result.triangles.empty()) throw std::domain_error("the surface has no triangles");
  for (const auto& [from, to] : edges)
    if (!edges.contains({to, from}))
      throw std::domain_error("the surface is not closed: an edge has one triangle only");
  if (volume < 0.0)
    for (auto& triangle : result.triangles) std::swap(triangle[1], triangle[2]);
  return result;
}

}  // namespace trajet
