#include "trajet/geom/triangle_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

#include "mixed_bits.hpp"
#include "trajet/geom/closest_point.hpp"
#include "trajet/geom/vertex_joiner.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

using Corners = std::array<int, 3>;

const Vector3& vertex(const TriangleMesh& mesh, int i) { return mesh.vertices[static_cast<std::size_t>(i)]; }

/// Vertices in one place become one: the first of them. Keeps the order, leaves triangles without area out.
TriangleMesh joined(const TriangleMesh& mesh) {
  VertexJoiner joiner;
  std::vector<int> index;
  index.reserve(mesh.vertices.size());
  for (const Vector3& p : mesh.vertices) index.push_back(joiner.index(p));
  TriangleMesh result{joiner.take_vertices(), {}};
  result.triangles.reserve(mesh.triangles.size());
  for (const Corners& corners : mesh.triangles) {
    const auto corner = [&](std::size_t i) { return index[static_cast<std::size_t>(corners[i])]; };
    const Corners own{corner(0), corner(1), corner(2)};
    const Vector3 ab = vertex(result, own[1]) - vertex(result, own[0]);
    const Vector3 ac = vertex(result, own[2]) - vertex(result, own[0]);
    constexpr double kLeastSine = 2e-12;  // what make_triangle takes for a triangle, whatever the rounding
    const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
    if (ab.cross(ac).norm() > kLeastSine * longest) result.triangles.push_back(own);
  }
  return result;
}

/// Whether every edge is passed as often in one direction as in the other, by two sums of hashes of each: they agree by
/// chance once in 2^128.
bool has_no_rim(const TriangleMesh& mesh) {
  std::uint64_t forward[2] = {0, 0}, backward[2] = {0, 0};
  const auto add = [](std::uint64_t(&sums)[2], int from, int to) {
    const std::uint64_t edge = std::uint64_t{static_cast<std::uint32_t>(from)} << 32 | static_cast<std::uint32_t>(to);
    sums[0] += detail::mixed(edge);
    sums[1] += detail::mixed(~edge);
  };
  for (const Corners& corners : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      add(forward, corners[i], corners[(i + 1) % 3]);
      add(backward, corners[(i + 1) % 3], corners[i]);
    }
  return forward[0] == backward[0] && forward[1] == backward[1];
}

double six_volumes(const TriangleMesh& mesh) {
  const Vector3 origin = mesh.vertices[0];
  double sum = 0.0;
  for (const Corners& corners : mesh.triangles)
    sum += (vertex(mesh, corners[0]) - origin)
               .cross(vertex(mesh, corners[1]) - origin)
               .dot(vertex(mesh, corners[2]) - origin);
  return sum;
}

/// The side of a triangle, seen from the lesser of its vertices.
struct Side {
  int other;  ///< the greater vertex
  int triangle;
  bool is_forward;
};

/// The sides of all triangles in the order of their lesser vertices, then of the others: those of one edge are
/// together. Calls `visit(sides)` for each lesser vertex.
template <class Visit>
void visit_sides(const TriangleMesh& mesh, const Visit& visit) {
  const auto for_each_side = [&mesh](const auto& take) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const int a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
        take(static_cast<std::size_t>(std::min(a, b)), Side{std::max(a, b), static_cast<int>(t), a < b});
      }
  };
  std::vector<std::uint32_t> end(mesh.vertices.size() + 1, 0);
  for_each_side([&](std::size_t lesser, const Side&) { ++end[lesser + 1]; });
  for (std::size_t v = 1; v < end.size(); ++v) end[v] += end[v - 1];
  std::vector<Side> sides(3 * mesh.triangles.size());
  for_each_side([&](std::size_t lesser, const Side& side) { sides[end[lesser]++] = side; });
  std::size_t begin = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const std::span<Side> own(sides.data() + begin, end[v] - begin);
    ranges::sort(own, {}, [](const Side& side) { return std::pair(side.other, side.triangle); });
    visit(own);
    begin = end[v];
  }
}

/// Turns triangles so that those that share an edge with one other look to the same side, from the first one on.
void turn_to_same_side(TriangleMesh& mesh) {
  struct Neighbour {
    int triangle = -1;       // none
    bool is_turned = false;  // against the other
  };
  std::vector<std::array<Neighbour, 3>> neighbours(mesh.triangles.size());
  bool is_any_turned = false;
  const auto add = [&](int triangle, const Neighbour& next) {
    auto& known = neighbours[static_cast<std::size_t>(triangle)];
    *ranges::find(known, -1, &Neighbour::triangle) = next;
  };
  visit_sides(mesh, [&](std::span<const Side> sides) {
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
      const auto is_of_edge = [&](std::size_t j) { return j < sides.size() && sides[j].other == sides[i].other; };
      if (!is_of_edge(i + 1) || is_of_edge(i + 2) || (i > 0 && is_of_edge(i - 1))) continue;
      const bool is_turned = sides[i].is_forward == sides[i + 1].is_forward;
      add(sides[i].triangle, {sides[i + 1].triangle, is_turned});
      add(sides[i + 1].triangle, {sides[i].triangle, is_turned});
      is_any_turned = is_any_turned || is_turned;
    }
  });
  if (!is_any_turned) return;
  std::vector<signed char> state(mesh.triangles.size(), 0);  // 1 as it was, -1 turned, 0 not seen
  std::vector<int> open;
  for (std::size_t first = 0; first < mesh.triangles.size(); ++first) {
    if (state[first] != 0) continue;
    state[first] = 1;
    open.push_back(static_cast<int>(first));
    while (!open.empty()) {
      const auto t = static_cast<std::size_t>(open.back());
      open.pop_back();
      for (const Neighbour& next : neighbours[t]) {
        if (next.triangle < 0) continue;
        signed char& its = state[static_cast<std::size_t>(next.triangle)];
        if (its != 0) continue;
        its = static_cast<signed char>(next.is_turned ? -state[t] : state[t]);
        open.push_back(next.triangle);
      }
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (state[t] < 0) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
}

/// The solid angle under which p sees a triangle, positive from behind [VanOosterom1983].
double solid_angle(const TriangleMesh& mesh, const Corners& corners, const Vector3& p) {
  const Vector3 a = vertex(mesh, corners[0]) - p, b = vertex(mesh, corners[1]) - p, c = vertex(mesh, corners[2]) - p;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

Triangle SurfaceTriangles::triangle(int index) const {
  const Corners& corners = mesh.triangles[static_cast<std::size_t>(index)];
  return make_triangle(vertex(mesh, corners[0]), vertex(mesh, corners[1]), vertex(mesh, corners[2]));
}

MeshSurface make_mesh_surface(const TriangleMesh& mesh) {
  TriangleMesh own = joined(mesh);
  if (own.triangles.empty()) throw std::domain_error("the surface has no triangles");
  bool is_closed = has_no_rim(own);
  if (!is_closed) {
    turn_to_same_side(own);
    is_closed = has_no_rim(own);
  }
  if (is_closed && six_volumes(own) < 0.0)
    for (Corners& corners : own.triangles) std::swap(corners[1], corners[2]);

  double length = 0.0;
  for (const Corners& corners : own.triangles)
    for (std::size_t i = 0; i < 3; ++i) length += (vertex(own, corners[(i + 1) % 3]) - vertex(own, corners[i])).norm();
  const double spacing = length / (3.0 * static_cast<double>(own.triangles.size()));
  const auto box = [&own](int triangle) {
    Aabb around;
    for (const int corner : own.triangles[static_cast<std::size_t>(triangle)])
      around = united(around, vertex(own, corner));
    return around;
  };
  BoxTree tree(static_cast<int>(own.triangles.size()), box);
  return {
      std::make_shared<const SurfaceTriangles>(SurfaceTriangles{std::move(own), is_closed, spacing, std::move(tree)})};
}

MeshSurface make_hull_surface(std::span<const Vector3> points, double rounding) {
  const TriangleMesh hull = convex_hull(points);
  SurfaceTriangles triangles = *make_mesh_surface(rounding > 0.0 ? eroded_hull(hull, rounding) : hull).triangles;
  triangles.convex = std::make_shared<const ConvexFaces>(convex_faces(triangles.mesh));
  triangles.growth = rounding;
  return {std::make_shared<const SurfaceTriangles>(std::move(triangles))};
}

double growth(const MeshSurface& surface) { return surface.triangles->growth; }

SurfacePlace nearest_place(const SurfaceTriangles& surface, const Vector3& p) {
  SurfacePlace nearest{0, surface.mesh.vertices[0], std::numeric_limits<double>::infinity()};
  // Whatever is nearer than the half side of a box around p lies within the box.
  for (double reach = surface.spacing; !(nearest.distance <= reach); reach *= 4.0) {
    surface.tree.visit_overlapping(grown({p, p}, reach), [&](int index) {
      const Vector3 point = closest_point(surface.triangle(index), p);
      const double distance = (p - point).norm();
      if (distance < nearest.distance) nearest = {index, point, distance};
      return true;
    });
    if (!std::isfinite(reach)) break;
  }
  return nearest;
}

Triangle nearest_triangle(const MeshSurface& surface, const Vector3& p) {
  return surface.triangles->triangle(nearest_place(*surface.triangles, p).triangle);
}

double signed_distance(const MeshSurface& surface, const Vector3& p) {
  const SurfaceTriangles& triangles = *surface.triangles;
  const double distance = nearest_place(triangles, p).distance;
  if (!triangles.is_closed) return distance;
  const double growth = triangles.growth;
  double angle = 0.0;
  for (const Corners& corners : triangles.mesh.triangles) angle += solid_angle(triangles.mesh, corners, p);
  return (angle > 2.0 * std::numbers::pi ? -distance : distance) - growth;  // 4 pi inside, 0 outside
}

BoundingBall bounding_ball(const MeshSurface& surface) {
  Aabb box;
  for (const Vector3& p : surface.triangles->mesh.vertices) box = united(box, p);
  const Vector3 center = 0.5 * (box.lower + box.upper);
  double squared = 0.0;
  for (const Vector3& p : surface.triangles->mesh.vertices) squared = std::max(squared, (p - center).squaredNorm());
  return {center, std::sqrt(squared) + surface.triangles->growth};
}

std::vector<int> triangles_at(const SurfaceTriangles& surface, const Vector3& point, double tolerance) {
  std::vector<int> found;
  surface.tree.visit_overlapping(grown({point, point}, tolerance), [&](int index) {
    if ((closest_point(surface.triangle(index), point) - point).norm() <= tolerance) found.push_back(index);
    return true;
  });
  ranges::sort(found);
  return found;
}

}  // namespace trajet
