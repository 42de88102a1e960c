#include "trajet/geom/convex_core.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "trajet/geom/rounded_solid.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Makes edges and neighbours of what faces and vertices there are.
ConvexCore finished(ConvexCore core) {
  const auto& v = core.vertices;
  std::map<std::pair<int, int>, int> known;
  const auto edge = [&](int from, int to) -> CoreEdge& {
    const auto [place, is_new] =
        known.try_emplace({std::min(from, to), std::max(from, to)}, static_cast<int>(core.edges.size()));
    if (is_new) {
      const Vector3 d = v[static_cast<std::size_t>(to)] - v[static_cast<std::size_t>(from)];
      core.edges.push_back({from, to, d.normalized(), d.norm(), {}});
    }
    return core.edges[static_cast<std::size_t>(place->second)];
  };
  core.faces_of.resize(v.size());
  core.edges_of.resize(v.size());
  for (std::size_t f = 0; f < core.faces.size(); ++f) {
    CoreFace& face = core.faces[f];
    const std::size_t n = face.loop.size();
    for (std::size_t i = 0; i < n; ++i) {
      const int from = face.loop[i], to = face.loop[(i + 1) % n];
      const Vector3 d = v[static_cast<std::size_t>(to)] - v[static_cast<std::size_t>(from)];
      edge(from, to).inward.push_back(face.normal.cross(d).normalized());
      core.faces_of[static_cast<std::size_t>(from)].push_back(static_cast<int>(f));
    }
  }
  if (core.faces.empty() && v.size() == 2) edge(0, 1);
  for (std::size_t e = 0; e < core.edges.size(); ++e)
    for (const int end : {core.edges[e].from, core.edges[e].to})
      core.edges_of[static_cast<std::size_t>(end)].push_back(static_cast<int>(e));
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double spread = core.is_spread() ? core.spreads[i].norm() : 0.0;
    core.reach = std::max(core.reach, v[i].norm() + spread);
  }
  core.reach += core.rounding;
  return core;
}

/// All vertices are on the face's side of its plane in spite of rounding.
CoreFace face(const ConvexCore& core, const Vector3& normal, std::vector<int> loop) {
  double offset = -kInfinity;
  for (const Vector3& p : core.vertices) offset = std::max(offset, normal.dot(p));
  return {normal, offset, std::move(loop)};
}

/// The vertices in the plane, counterclockwise seen against the normal.
std::vector<int> loop_around(const std::vector<Vector3>& vertices, const Vector3& normal, double thickness) {
  double offset = -kInfinity;
  for (const Vector3& p : vertices) offset = std::max(offset, normal.dot(p));
  std::vector<int> loop;
  Vector3 middle = Vector3::Zero();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (normal.dot(vertices[i]) < offset - thickness) continue;
    loop.push_back(static_cast<int>(i));
    middle += vertices[i];
  }
  middle /= static_cast<double>(loop.size());
  const Vector3 right = normal.unitOrthogonal(), up = normal.cross(right);
  const auto angle = [&](int i) {
    const Vector3 p = vertices[static_cast<std::size_t>(i)] - middle;
    return std::atan2(up.dot(p), right.dot(p));
  };
  ranges::sort(loop, [&](int a, int b) { return angle(a) < angle(b); });
  return loop;
}

ConvexCore box_core(const Vector3& half) {
  ConvexCore core;
  for (int i = 0; i < 8; ++i)
    core.vertices.push_back(half.cwiseProduct(Vector3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  constexpr std::array<std::array<int, 4>, 6> kLoops{
      {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3}, {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}}};
  for (std::size_t f = 0; f < 6; ++f)
    core.faces.push_back(face(core, Vector3::Unit(static_cast<int>(f) / 2) * (f % 2 == 0 ? 1.0 : -1.0),
                              {kLoops[f].begin(), kLoops[f].end()}));
  return finished(core);
}

/// Two equal disks around z, `half_height` above and below the origin; one in two faces if that is zero.
ConvexCore disks_core(double radius, double half_height) {
  ConvexCore core;
  core.vertices.push_back({0, 0, half_height});
  if (half_height > 0.0) core.vertices.push_back({0, 0, -half_height});
  core.spreads.assign(core.vertices.size(), Vector3(radius, radius, 0).asDiagonal());
  for (const double side : {1.0, -1.0}) core.faces.push_back({{0, 0, side}, half_height, {}});
  return finished(core);
}

struct MakeCore {
  ConvexCore operator()(const Point&) const { return stretch(0.0, 0.0); }
  ConvexCore operator()(const Ball& ball) const { return stretch(0.0, ball.radius); }
  ConvexCore operator()(const Cuboid& cuboid) const { return box_core(cuboid.half_size); }
  ConvexCore operator()(const Cylinder& cylinder) const { return disks_core(cylinder.radius, cylinder.half_height); }
  ConvexCore operator()(const Capsule& capsule) const { return stretch(capsule.half_height, capsule.radius); }
  ConvexCore operator()(const SoccerBall& ball) const {
    return hull_core(convex_hull(truncated_icosahedron(ball.radius)));
  }
  ConvexCore operator()(const Hull& hull) const { return hull_core(hull.polyhedron->surface); }
  ConvexCore operator()(const Mesh&) const { throw std::domain_error("a mesh is not convex"); }
  ConvexCore operator()(const Compound&) const { throw std::domain_error("a compound is not convex"); }
  ConvexCore operator()(const Surroundings&) const { throw std::domain_error("surroundings are not convex"); }
  ConvexCore operator()(const Cone& cone) const {
    return cone_core(cone.radius, -0.25 * cone.height, 0.75 * cone.height);
  }
  ConvexCore operator()(const Ellipsoid& ellipsoid) const { return ellipsoid_core(ellipsoid.radii); }
  ConvexCore operator()(const RoundedSolid& rounded) const {
    if (!rounded.core->profile.empty()) return revolved(rounded.core->profile, rounded.core->rounding);
    return grown(rounded.core->corners, rounded.core->rounding);
  }
  ConvexCore operator()(const HalfSpace&) const {
    ConvexCore core;
    core.is_half_space = true;
    core.faces.push_back({Vector3::UnitZ(), 0.0, {}});
    core.reach = kInfinity;
    return core;
  }
  ConvexCore operator()(const RoundPlate& plate) const { return disks_core(plate.radius, 0.0); }
  ConvexCore operator()(const RectangularPlate& plate) const {
    const double x = plate.half_width, y = plate.half_height;
    return polygon_core({{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}});
  }
  ConvexCore operator()(const TriangularPlate& plate) const {
    return polygon_core({plate.corners[0], plate.corners[1], plate.corners[2]});
  }

 private:
  /// The hull of disks about z, each at a height (m) with a radius, grown.
  static ConvexCore revolved(const std::vector<Eigen::Vector2d>& profile, double rounding) {
    ConvexCore core;
    core.rounding = rounding;
    double lowest = kInfinity, highest = -kInfinity;
    for (const Eigen::Vector2d& disk : profile) {
      core.vertices.push_back({0, 0, disk[1]});
      core.spreads.emplace_back(Vector3(disk[0], disk[0], 0).asDiagonal());
      lowest = std::min(lowest, disk[1]);
      highest = std::max(highest, disk[1]);
    }
    for (const double side : {1.0, -1.0}) {
      const double end = side > 0.0 ? highest : lowest;
      const auto is_flat = [&](const Eigen::Vector2d& disk) { return disk[1] == end && disk[0] > 0.0; };
      if (ranges::any_of(profile, is_flat)) core.faces.push_back({{0, 0, side}, side * end, {}});
    }
    return finished(core);
  }
  /// A polytope, which may be flat or a stretch, grown.
  static ConvexCore grown(const std::vector<Vector3>& corners, double rounding) {
    ConvexCore core;
    try {
      core = hull_core(convex_hull(corners));
    } catch (const std::domain_error&) {
      // too flat for a hull: its corners alone hold all that its support needs
      core = finished({.vertices = corners});
    }
    core.rounding = rounding;
    core.reach += rounding;
    return core;
  }
  static ConvexCore stretch(double half_height, double radius) {
    ConvexCore core;
    core.vertices.push_back({0, 0, -half_height});
    if (half_height > 0.0) core.vertices.push_back({0, 0, half_height});
    core.rounding = radius;
    return finished(core);
  }
};

}  // namespace

CoreSupport support(const ConvexCore& core, const Vector3& direction) {
  CoreSupport best{0, core.vertices[0], -kInfinity};
  if (!core.is_spread()) {
    for (std::size_t i = 0; i < core.vertices.size(); ++i)
      if (const double height = direction.dot(core.vertices[i]); height > best.height)
        best.vertex = static_cast<int>(i), best.height = height;
    best.point = core.vertices[static_cast<std::size_t>(best.vertex)];
    return best;
  }
  for (std::size_t i = 0; i < core.vertices.size(); ++i) {
    const Vector3 y = core.spreads[i].transpose() * direction;
    const double length = y.norm(), height = direction.dot(core.vertices[i]) + length;
    if (!(height > best.height)) continue;
    best = {static_cast<int>(i), core.vertices[i], height};
    if (length > 0.0) best.point += core.spreads[i] * (y / length);
  }
  return best;
}

ConvexCore convex_core(const Solid& solid) { return std::visit(MakeCore{}, solid); }

ConvexCore ellipsoid_core(const Vector3& radii) {
  ConvexCore core;
  core.vertices.push_back(Vector3::Zero());
  core.spreads.push_back(radii.asDiagonal());
  return finished(core);
}

ConvexCore cone_core(double radius, double base, double apex) {
  ConvexCore core;
  core.vertices = {{0, 0, base}, {0, 0, apex}};
  core.spreads = {Vector3(radius, radius, 0).asDiagonal(), Matrix3::Zero()};
  const double down = apex > base ? -1.0 : 1.0;
  core.faces.push_back({{0, 0, down}, down * base, {}});
  return finished(core);
}

ConvexCore hull_core(const TriangleMesh& surface) {
  ConvexCore core;
  core.vertices = surface.vertices;
  double extent = 0.0;
  for (const Vector3& p : core.vertices) extent = std::max(extent, p.norm());
  const double thickness = 4e-12 * extent;  // more than that within which convex_hull takes points for coplanar

  // larger triangles have the better normals
  struct Sized {
    std::array<int, 3> corners{};
    Vector3 area = Vector3::Zero();
  };
  std::vector<Sized> triangles;
  for (const auto& t : surface.triangles) {
    const auto p = [&](std::size_t i) { return core.vertices[static_cast<std::size_t>(t[i])]; };
    triangles.push_back({t, (p(1) - p(0)).cross(p(2) - p(0))});
  }
  ranges::stable_sort(triangles,
                      [](const Sized& a, const Sized& b) { return a.area.squaredNorm() > b.area.squaredNorm(); });
  for (const Sized& t : triangles) {
    const Vector3 normal = t.area.normalized();
    const bool is_known = ranges::any_of(core.faces, [&](const CoreFace& f) {
      return f.normal.dot(normal) > 0.0 &&
             ranges::all_of(t.corners, [&](int i) { return ranges::find(f.loop, i) != f.loop.end(); });
    });
    if (!is_known && t.area.squaredNorm() > 0.0)
      core.faces.push_back(face(core, normal, loop_around(core.vertices, normal, thickness)));
  }
  return finished(core);
}

ConvexCore polygon_core(const std::vector<Vector3>& corners) {
  ConvexCore core;
  core.vertices = corners;
  Vector3 area = Vector3::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i) area += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
  std::vector<int> loop;
  for (std::size_t i = 0; i < corners.size(); ++i) loop.push_back(static_cast<int>(i));
  const Vector3 normal = area.normalized();
  core.faces.push_back(face(core, normal, loop));
  core.faces.push_back(face(core, -normal, {loop.rbegin(), loop.rend()}));
  return finished(core);
}

}  // namespace trajet
