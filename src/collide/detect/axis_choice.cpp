#include "axis_choice.hpp"

#include <algorithm>
#include <cmath>

#include "trajet/portable.hpp"

namespace trajet::detail {
namespace {

/// All that belong to one of the vertices, each once.
std::vector<int> around(const FeatureVertices& vertices, const std::vector<std::vector<int>>& of) {
  std::vector<int> all;
  for (const int v : vertices)
    for (const int x : of[static_cast<std::size_t>(v)])
      if (ranges::find(all, x) == all.end()) all.push_back(x);
  return all;
}

const CoreEdge& edge(const ConvexCore& core, int i) { return core.edges[static_cast<std::size_t>(i)]; }

/// Whether the edge is support along a unit normal of it: it leans into neither face. What passes by rounding only
/// costs a candidate.
bool is_support(const CoreEdge& e, const Vector3& n) {
  constexpr double kSlack = 1e-9;
  return ranges::all_of(e.inward, [&](const Vector3& into) { return n.dot(into) <= kSlack; });
}

bool joins(const CoreEdge& e, const FeatureVertices& v) {
  return v.count == 2 && std::min(v.index[0], v.index[1]) == std::min(e.from, e.to) &&
         std::max(v.index[0], v.index[1]) == std::max(e.from, e.to);
}

double distance(const ConvexCore& core, const CoreEdge& e, const Vector3& p) {
  const Vector3 d = p - core.vertices[static_cast<std::size_t>(e.from)];
  return (d - e.direction * std::clamp(e.direction.dot(d), 0.0, e.length)).norm();
}

/// No more than that of a point from a face.
double distance(const ConvexCore& core, const CoreFace& f, const Vector3& p) {
  double most = std::abs(f.normal.dot(p) - f.offset);
  for (std::size_t i = 0; i < f.loop.size(); ++i) {
    const Vector3& from = core.vertices[static_cast<std::size_t>(f.loop[i])];
    const Vector3& to = core.vertices[static_cast<std::size_t>(f.loop[(i + 1) % f.loop.size()])];
    most = std::max(most, (to - from).normalized().cross(f.normal).dot(p - from));
  }
  return most;
}

template <class Features>
std::vector<int> near(const ConvexCore& core, const Features& features, const Vector3& p, double reach) {
  std::vector<int> found;
  for (std::size_t i = 0; i < features.size(); ++i)
    if (distance(core, features[i], p) <= reach) found.push_back(static_cast<int>(i));
  return found;
}

}  // namespace

AxisCandidate AxisChoice::measure(const RelativePose& pose, const WitnessAxis& axis, double tolerance) const {
  AxisCandidate c{axis, separation_along(A_, B_, pose, axis_direction(A_, B_, pose, axis)), tolerance};
  // the rounding of an axis that is a product or a difference does not shrink with its length
  if (axis.kind == AxisKind::edges) {
    const double sine = line_of_a(A_, axis).cross(pose.R_AB * line_of_b(B_, axis)).norm();
    c.resolution /= std::max(sine, 1e-300);
  } else if (axis.kind != AxisKind::in_a && axis.kind != AxisKind::in_b) {
    c.resolution *= std::max(1.0, size_ / std::max(A_.rounding + B_.rounding + c.separation, 1e-300));
  }
  return c;
}

AxisCandidate AxisChoice::choose(const RelativePose& pose, double tolerance, const Vector3* place) {
  pose_ = pose;
  tolerance_ = tolerance;
  best_ = {};
  best_.resolution = tolerance;
  if (A_.is_half_space) {
    offer_face_of_a(0);
    best_.apart = std::max(0.0, best_.separation);
    return best_;
  }
  const ClosestFeatures closest = closest_features(A_, B_, pose, guess_);
  guess_ = closest.direction;
  best_.apart = closest.distance - A_.rounding - B_.rounding;
  const double apart = best_.apart;
  if (closest.distance > 0.0) {
    // a face's axis that shows half the distance is good enough: it turns with its solid and lasts
    constexpr double kEnough = 0.5;
    for (const int f : around(closest.a, A_.faces_of)) offer_face_of_a(f);
    for (const int f : around(closest.b, B_.faces_of)) offer_face_of_b(f);
    if (best_.is_clear() && best_.separation > kEnough * apart) return best_;
    const std::vector<int> edges_a = around(closest.a, A_.edges_of), edges_b = around(closest.b, B_.edges_of);
    for (const int i : edges_a)
      for (const int j : edges_b) offer_edges(i, j);
    if (A_.rounding + B_.rounding > 0.0) offer_rounded(closest, edges_a, edges_b);
    if (A_.is_spread() || B_.is_spread() || !best_.is_clear()) offer_fixed(closest.direction);
    if (best_.is_clear()) return best_;
    offer_near(closest.on_a);
  }
  if (place != nullptr) offer_near(*place);
  if (best_.is_clear() || (best_.separation > -tolerance && std::abs(apart) <= tolerance)) return best_;
  offer_all();
  if (best_.axis.direction.isZero(0.0) && best_.axis.kind == AxisKind::in_a) offer_fixed(Vector3::UnitX());
  return best_;
}

void AxisChoice::offer(const WitnessAxis& axis) {
  AxisCandidate c = measure(pose_, axis, tolerance_);
  c.apart = best_.apart;
  if (c.is_clear() != best_.is_clear() ? c.is_clear() : c.separation > best_.separation) best_ = c;
}

void AxisChoice::offer_face_of_a(int face) {
  offer({.kind = AxisKind::in_a, .a = face, .direction = A_.faces[static_cast<std::size_t>(face)].normal});
}

void AxisChoice::offer_face_of_b(int face) {
  offer({.kind = AxisKind::in_b, .b = face, .direction = -B_.faces[static_cast<std::size_t>(face)].normal});
}

/// If their arcs on the sphere of normals cross: both are support along their common normal.
void AxisChoice::offer_edges(int edge_a, int edge_b) {
  WitnessAxis axis{.kind = AxisKind::edges, .a = edge_a, .b = edge_b};
  const Vector3 n = axis_direction(A_, B_, pose_, axis);
  if (n.isZero(0.0)) return;
  for (const double sign : {1.0, -1.0}) {
    if (!is_support(edge(A_, edge_a), sign * n) || !is_support(edge(B_, edge_b), -sign * (pose_.R_AB.transpose() * n)))
      continue;
    axis.sign = sign;
    offer(axis);
  }
}

/// A direction that turns with neither feature, but with A or with B.
void AxisChoice::offer_fixed(const Vector3& direction) {
  offer({.kind = AxisKind::in_a, .direction = direction});
  offer({.kind = AxisKind::in_b, .direction = pose_.R_AB.transpose() * direction});
}

void AxisChoice::offer_rounded(const ClosestFeatures& closest, const std::vector<int>& edges_a,
                               const std::vector<int>& edges_b) {
  const double apart = closest.distance - A_.rounding - B_.rounding;
  if (closest.b.count == 1)
    for (const int e : edges_a)
      if (joins(edge(A_, e), closest.a)) offer({.kind = AxisKind::edge_vertex, .a = e, .b = closest.b.index[0]});
  if (closest.a.count == 1)
    for (const int e : edges_b)
      if (joins(edge(B_, e), closest.b)) offer({.kind = AxisKind::vertex_edge, .a = closest.a.index[0], .b = e});
  if (closest.a.count == 1 && closest.b.count == 1)
    offer({.kind = AxisKind::vertices, .a = closest.a.index[0], .b = closest.b.index[0]});
  constexpr double kEnough = 0.5;
  if (best_.is_clear() && best_.separation >= kEnough * apart) return;
  // parallel edges, and what else the simplex leaves out
  for (const int e : edges_a)
    for (const int v : closest.b) offer({.kind = AxisKind::edge_vertex, .a = e, .b = v});
  for (const int e : edges_b)
    for (const int v : closest.a) offer({.kind = AxisKind::vertex_edge, .a = v, .b = e});
}

/// The axes of all features around a place: those along which solids that nearly touch there can be apart.
void AxisChoice::offer_near(const Vector3& place) {
  constexpr double kAround = 1e-4;
  const double reach = kAround * size_;
  const Vector3 in_b = pose_.R_AB.transpose() * (place - pose_.p_AB);
  for (const int f : near(A_, A_.faces, place, reach)) offer_face_of_a(f);
  for (const int f : near(B_, B_.faces, in_b, reach)) offer_face_of_b(f);
  const std::vector<int> edges_b = near(B_, B_.edges, in_b, reach);
  for (const int i : near(A_, A_.edges, place, reach))
    for (const int j : edges_b) offer_edges(i, j);
}

void AxisChoice::offer_all() {
  for (int f = 0; f < static_cast<int>(A_.faces.size()); ++f) offer_face_of_a(f);
  for (int f = 0; f < static_cast<int>(B_.faces.size()); ++f) offer_face_of_b(f);
  for (int i = 0; i < static_cast<int>(A_.edges.size()); ++i)
    for (int j = 0; j < static_cast<int>(B_.edges.size()); ++j) offer_edges(i, j);
}

}  // namespace trajet::detail
