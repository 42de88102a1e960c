#include "touch.hpp"

#include <algorithm>
#include <cmath>

namespace trajet::detail {
namespace {

const Vector3& vertex(const ConvexCore& core, int i) { return core.vertices[static_cast<std::size_t>(i)]; }
const CoreEdge& edge(const ConvexCore& core, int i) { return core.edges[static_cast<std::size_t>(i)]; }
const CoreFace& face(const ConvexCore& core, int i) { return core.faces[static_cast<std::size_t>(i)]; }

bool is_end(const CoreEdge& e, int v) { return v == e.from || v == e.to; }

/// How far a point is within the outline of a face, m.
double inside(const ConvexCore& core, const CoreFace& f, const Vector3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < f.loop.size(); ++i) {
    const Vector3 &from = vertex(core, f.loop[i]), &to = vertex(core, f.loop[(i + 1) % f.loop.size()]);
    least = std::min(least, f.normal.cross(to - from).normalized().dot(p - from));
  }
  return least;
}

double inside(const ConvexCore& core, const CoreEdge& e, const Vector3& p) {
  const double x = e.direction.dot(p - vertex(core, e.from));
  return std::min(x, e.length - x);
}

Touch within(double inside, double margin) {
  return inside > margin ? Touch::contact : inside < -margin ? Touch::apart : Touch::unclear;
}

}  // namespace

FacingPoints facing_points(const ConvexCore& A, const ConvexCore& B, const RelativePose& pose, const WitnessAxis& axis,
                           const SeparationZero& zero) {
  const auto in_a = [&](int i) { return Vector3(pose.p_AB + pose.R_AB * vertex(B, i)); };
  const auto onto = [](const Vector3& p, const Vector3& o, const Vector3& e) { return Vector3(o + e * e.dot(p - o)); };
  switch (axis.kind) {
    case AxisKind::in_a: {
      const Vector3 p = in_a(zero.b);
      const double height = A.is_half_space ? 0.0 : support(A, axis.direction).height;
      return {p - axis.direction * (axis.direction.dot(p) - height), p};
    }
    case AxisKind::in_b: {
      const Vector3 &p = vertex(A, zero.a), n = pose.R_AB * axis.direction;
      const double height = n.dot(pose.p_AB) - support(B, -axis.direction).height;
      return {p, p - n * (n.dot(p) - height)};
    }
    case AxisKind::edges: {
      if (axis.a < 0) {
        const Vector3 n = axis_direction(A, B, pose, axis);
        return {support(A, n).point, pose.p_AB + pose.R_AB * support(B, -(pose.R_AB.transpose() * n)).point};
      }
      const Vector3 &e = edge(A, axis.a).direction, f = pose.R_AB * edge(B, axis.b).direction, n = e.cross(f);
      const Vector3 &a = vertex(A, edge(A, axis.a).from), b = in_a(edge(B, axis.b).from), d = b - a;
      return {a + e * (n.dot(d.cross(f)) / n.squaredNorm()), b + f * (n.dot(d.cross(e)) / n.squaredNorm())};
    }
    case AxisKind::edge_vertex: {
      const Vector3 p = in_a(axis.b);
      return {onto(p, vertex(A, edge(A, axis.a).from), edge(A, axis.a).direction), p};
    }
    case AxisKind::vertex_edge: {
      const Vector3& p = vertex(A, axis.a);
      return {p, onto(p, in_a(edge(B, axis.b).from), pose.R_AB * edge(B, axis.b).direction)};
    }
    case AxisKind::vertices:
      return {vertex(A, axis.a), in_a(axis.b)};
    case AxisKind::balls:
      break;
  }
  return {Vector3::Zero(), pose.p_AB};
}

Touch judge(const ConvexCore& A, const ConvexCore& B, const RelativePose& pose, const WitnessAxis& axis,
            const SeparationZero& zero, double margin) {
  const FacingPoints facing = facing_points(A, B, pose, axis, zero);
  const auto in_b = [&](const Vector3& p) { return Vector3(pose.R_AB.transpose() * (p - pose.p_AB)); };
  switch (axis.kind) {
    case AxisKind::in_a:
      if (A.is_half_space) return Touch::contact;
      if (axis.a < 0 || face(A, axis.a).loop.empty() || B.is_spread()) return Touch::unclear;
      return within(inside(A, face(A, axis.a), facing.on_b), margin);
    case AxisKind::in_b:
      if (axis.b < 0 || face(B, axis.b).loop.empty() || A.is_spread()) return Touch::unclear;
      return within(inside(B, face(B, axis.b), in_b(facing.on_a)), margin);
    case AxisKind::edges: {
      if (axis.a < 0) return Touch::unclear;
      const CoreEdge &e = edge(A, axis.a), &f = edge(B, axis.b);
      if (!is_end(e, zero.a) || !is_end(f, zero.b)) return Touch::apart;
      // where the edges are parallel the axis vanishes, not the gap
      const double gap = (facing.on_b - facing.on_a).norm();
      if (!(gap <= A.rounding + B.rounding + margin)) return Touch::apart;
      return within(std::min(inside(A, e, facing.on_a), inside(B, f, in_b(facing.on_b))), margin);
    }
    case AxisKind::edge_vertex:
      if (zero.b != axis.b || !is_end(edge(A, axis.a), zero.a)) return Touch::apart;
      return within(inside(A, edge(A, axis.a), facing.on_b), margin);
    case AxisKind::vertex_edge:
      if (zero.a != axis.a || !is_end(edge(B, axis.b), zero.b)) return Touch::apart;
      return within(inside(B, edge(B, axis.b), in_b(facing.on_a)), margin);
    case AxisKind::vertices:
      return zero.a == axis.a && zero.b == axis.b ? Touch::contact : Touch::apart;
    case AxisKind::balls:
      break;
  }
  return Touch::apart;
}

}  // namespace trajet::detail
