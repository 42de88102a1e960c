#include <algorithm>
#include <cmath>

#include "trajet/collide/sustain/contact_law.hpp"

namespace trajet {
namespace {

Vector3 middle_of(const std::vector<Vector3>& points) {
  Vector3 sum = Vector3::Zero();
  for (const Vector3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

/// The normal of the plane in which points lie, unit.
Vector3 normal_of_plane(const std::vector<Vector3>& points) {
  const Vector3 middle = middle_of(points);
  Vector3 best = Vector3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Vector3 normal = (points[i] - middle).cross(points[k] - middle);
      if (normal.norm() > best.norm()) best = normal;
    }
  return best.normalized();
}

/// An edge of the hull of points that lie in a plane.
struct HullEdge {
  int from, to;    // of the points
  Vector3 inward;  // unit
};

std::vector<HullEdge> hull_edges(const std::vector<Vector3>& points) {
  const Vector3 normal = normal_of_plane(points);
  double size = 0.0;
  for (const Vector3& point : points) size = std::max(size, (point - points[0]).norm());
  std::vector<HullEdge> edges;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (i == k) continue;
      const Vector3 inward = normal.cross(points[k] - points[i]).normalized();
      constexpr double kFlat = 1e-9;
      const bool is_edge = std::all_of(points.begin(), points.end(), [&](const Vector3& point) {
        return inward.dot(point - points[i]) >= -kFlat * size;
      });
      if (is_edge) edges.push_back({static_cast<int>(i), static_cast<int>(k), inward});
    }
  return edges;
}

}  // namespace

std::vector<ContactPoints> contact_points(const std::vector<SustainedContact>& contacts) {
  std::vector<ContactPoints> result;
  int next = 0;
  for (const SustainedContact& contact : contacts) {
    ContactPoints& points = result.emplace_back();
    const auto count = static_cast<Eigen::Index>(contact.corners.size());
    for (Eigen::Index i = 0; i < count; ++i) points.points.push_back(next++);
    points.shares = Eigen::MatrixXd::Identity(count, count);
    std::vector<Vector3> corners;
    for (const SupportCorner& corner : contact.corners) corners.push_back(corner.p_B);
    const Vector3 middle = middle_of(corners);
    for (const Vector3& corner : corners) points.spread += (corner - middle).norm() / static_cast<double>(count);
    points.sides = points.shares;
    points.is_rim = contact.is_on_rim;
    points.remaining = count == 2 ? std::vector<std::vector<int>>{{1}, {0}} : std::vector<std::vector<int>>(1);
    if (count < 3) continue;
    const std::vector<HullEdge> edges = points.is_rim ? std::vector<HullEdge>() : hull_edges(corners);
    points.sides.setZero(static_cast<Eigen::Index>(edges.size()), count);
    points.remaining.clear();
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto [from, to, inward] = edges[e];
      for (int i = 0; i < static_cast<int>(count); ++i)
        if (i != from && i != to)
          points.sides(static_cast<Eigen::Index>(e), i) =
              inward.dot(corners[static_cast<std::size_t>(i)] - corners[static_cast<std::size_t>(from)]);
      points.remaining.push_back({from, to});
    }
    // 1, x, y in the plane of the corners
    const Vector3 normal = normal_of_plane(corners);
    const Vector3 x = (corners[0] - middle).normalized(), y = normal.cross(x);
    points.shares.resize(3, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Vector3 arm = (corners[static_cast<std::size_t>(i)] - middle) / points.spread;
      points.shares.col(i) << 1.0, x.dot(arm), y.dot(arm);
    }
    if (points.is_rim) points.sides = points.shares.bottomRows(2);
  }
  return result;
}

}  // namespace trajet
