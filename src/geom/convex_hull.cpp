#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "trajet/geom/triangle_mesh.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

using Triangle3 = std::array<int, 3>;

/// Adds points one by one to the hull of those before: the faces that a new point sees give way to the cone from it
/// over their rim.
class HullBuilder {
 public:
  explicit HullBuilder(std::span<const Vector3> points) : points_(points) {
    for (const Vector3& p : points)
      if (!p.allFinite()) throw std::domain_error("the points must be finite");
    Vector3 low = points.empty() ? Vector3(0, 0, 0) : points[0], high = low;
    for (const Vector3& p : points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    constexpr double kCoplanar = 1e-12;  // of the extent: some thousand roundings of a coordinate
    thickness_ = kCoplanar * (high - low).norm();
    start();
    for (int i = 0; i < static_cast<int>(points.size()); ++i) add(i);
  }

  TriangleMesh mesh() const {
    TriangleMesh mesh;
    std::map<int, int> index;
    for (const Face& face : faces_) {
      Triangle3 corners{};
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [place, is_new] = index.try_emplace(face.corners[i], static_cast<int>(mesh.vertices.size()));
        if (is_new) mesh.vertices.push_back(point(face.corners[i]));
        corners[i] = place->second;
      }
      mesh.triangles.push_back(corners);
    }
    return mesh;
  }

 private:
  struct Face {
    Triangle3 corners;
    Vector3 normal;  // unit, outward
  };

  const Vector3& point(int i) const { return points_[static_cast<std::size_t>(i)]; }

  Face face(int a, int b, int c) const {
    return {{a, b, c}, (point(b) - point(a)).cross(point(c) - point(a)).stableNormalized()};
  }
  double height(const Face& face, const Vector3& p) const { return face.normal.dot(p - point(face.corners[0])); }

  template <class Measure>
  int farthest(const Measure& measure) const {
    const auto found = ranges::max_element(points_, {}, measure);
    if (found == points_.end() || !(measure(*found) > thickness_))
      throw std::domain_error("at least four points that do not lie in a plane are needed");
    return static_cast<int>(found - points_.begin());
  }

  /// The tetrahedron of the points farthest from each other, from their line and from their plane.
  void start() {
    const int a = 0;
    const int b = farthest([&](const Vector3& p) { return (p - points_[0]).norm(); });
    const Vector3 along = (point(b) - point(a)).normalized();
    const int c = farthest([&](const Vector3& p) { return along.cross(p - point(a)).norm(); });
    const Face base = face(a, b, c);
    const int d = farthest([&](const Vector3& p) { return std::abs(height(base, p)); });
    const bool is_above = height(base, point(d)) > 0.0;
    const auto [p, q] = is_above ? std::pair(c, b) : std::pair(b, c);
    faces_ = {face(a, p, q), face(p, a, d), face(q, p, d), face(a, q, d)};
  }

  void add(int index) {
    std::vector<Face> kept;
    std::map<std::pair<int, int>, int> edges;  // of faces seen
    for (const Face& each : faces_) {
      if (height(each, point(index)) <= thickness_) {
        kept.push_back(each);
        continue;
      }
      for (std::size_t i = 0; i < 3; ++i) ++edges[{each.corners[i], each.corners[(i + 1) % 3]}];
    }
    if (edges.empty()) return;
    for (const auto& [edge, count] : edges)
      if (!edges.contains({edge.second, edge.first})) kept.push_back(face(edge.first, edge.second, index));
    faces_ = std::move(kept);
  }

  std::span<const Vector3> points_;
  double thickness_ = 0.0;
  std::vector<Face> faces_;
};

}  // namespace

TriangleMesh convex_hull(std::span<const Vector3> points) { return closed_mesh(HullBuilder(points).mesh()); }

}  // namespace trajet
