#include <Eigen/LU>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "trajet/geom/faces.hpp"
#include "trajet/geom/triangle_mesh.hpp"

namespace trajet {

TriangleMesh eroded_hull(const TriangleMesh& hull, double depth) {
  struct Side {
    Vector3 normal;
    double limit;  // normal . p <= limit
  };
  std::vector<Side> sides;
  double size = 0.0;
  for (const Face& face : faces(hull)) sides.push_back({face.normal, face.normal.dot(face.corners[0]) - depth});
  for (const Vector3& vertex : hull.vertices) size = std::max(size, (vertex - hull.vertices[0]).norm());

  // corners: where three sides meet and no other is in front
  constexpr double kLeastVolume = 1e-9;  // of three unit normals: less parallel makes a corner
  constexpr double kInFront = 1e-12;     // of the size: far above rounding
  std::vector<Vector3> corners;
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t j = i + 1; j < sides.size(); ++j)
      for (std::size_t k = j + 1; k < sides.size(); ++k) {
        Matrix3 normals;
        normals << sides[i].normal.transpose(), sides[j].normal.transpose(), sides[k].normal.transpose();
        if (std::abs(normals.determinant()) < kLeastVolume) continue;
        const Vector3 corner = normals.inverse() * Vector3(sides[i].limit, sides[j].limit, sides[k].limit);
        bool is_within = true;
        for (const Side& side : sides) is_within = is_within && side.normal.dot(corner) <= side.limit + kInFront * size;
        if (is_within) corners.push_back(corner);
      }
  try {
    return convex_hull(corners);
  } catch (const std::domain_error&) {
    throw std::domain_error("the rounding leaves nothing of the shape");
  }
}

}  // namespace trajet
