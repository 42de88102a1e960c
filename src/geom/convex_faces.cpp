#include "trajet/geom/convex_faces.hpp"

#include <cstddef>
#include <map>
#include <utility>

namespace trajet {

ConvexFaces convex_faces(const TriangleMesh& hull) {
  // to rounding, as the faces of the hull are cut into triangles
  constexpr double kFlat = 1e-11;
  ConvexFaces faces;
  faces.corners = hull.vertices;
  faces.edges_at.resize(hull.vertices.size());
  const auto corner = [&](int i) -> const Vector3& { return hull.vertices[static_cast<std::size_t>(i)]; };

  std::vector<Vector3> normals;
  std::map<std::pair<int, int>, std::size_t> triangle_of;
  for (std::size_t t = 0; t < hull.triangles.size(); ++t) {
    const auto& [a, b, c] = hull.triangles[t];
    normals.push_back((corner(b) - corner(a)).cross(corner(c) - corner(a)).stableNormalized());
    triangle_of[{a, b}] = triangle_of[{b, c}] = triangle_of[{c, a}] = t;
  }
  const auto neighbour = [&](const std::pair<int, int>& edge) { return triangle_of.at({edge.second, edge.first}); };

  // triangles that adjoin in one plane, found from one another
  std::vector<int> side_of(hull.triangles.size(), -1);
  for (std::size_t first = 0; first < hull.triangles.size(); ++first) {
    if (side_of[first] >= 0) continue;
    const int side = static_cast<int>(faces.sides.size());
    faces.sides.push_back({normals[first], corner(hull.triangles[first][0])});
    std::vector<std::size_t> open{first};
    while (!open.empty()) {
      const std::size_t t = open.back();
      open.pop_back();
      if (side_of[t] >= 0) continue;
      side_of[t] = side;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = neighbour({hull.triangles[t][k], hull.triangles[t][(k + 1) % 3]});
        if (side_of[next] < 0 && normals[first].cross(normals[next]).norm() < kFlat) open.push_back(next);
      }
    }
  }

  for (const auto& [edge, triangle] : triangle_of) {
    const int left = side_of[triangle], right = side_of[neighbour(edge)];
    if (edge.first > edge.second || left == right) continue;
    const Vector3 way = corner(edge.second) - corner(edge.first), along = way.normalized();
    const auto past = [&](int side, double sign) {
      return Vector3(sign * along.cross(faces.sides[static_cast<std::size_t>(side)].normal));
    };
    const int index = static_cast<int>(faces.edges.size());
    faces.edges.push_back(
        {edge.first, edge.second, along, way.norm(), {left, right}, {past(left, 1.0), past(right, -1.0)}});
    for (const int side : {left, right}) faces.sides[static_cast<std::size_t>(side)].edges.push_back(index);
    for (const int end : {edge.first, edge.second}) faces.edges_at[static_cast<std::size_t>(end)].push_back(index);
  }
  return faces;
}

}  // namespace trajet
