#include "trajet/geom/closest_features.hpp"

#include <cmath>
#include <limits>

namespace trajet {
namespace {

/// A corner of B - A and where it comes from.
struct Corner {
  Vector3 difference = Vector3::Zero();
  Vector3 on_a = Vector3::Zero();
  int a = 0;
  int b = 0;
};

/// The point of a simplex nearest to the origin, as sum weights[k] corners[k].
struct Nearest {
  Vector3 point = Vector3::Zero();
  double norm2 = std::numeric_limits<double>::infinity();
  std::array<double, 4> weights{};
  bool is_inside = false;

  void offer(const Vector3& p, const std::array<double, 4>& w) {
    const double size = p.squaredNorm();
    if (size < norm2) *this = {p, size, w, false};
  }
};

/// Whether the origin is in the tetrahedron: on the same side of all four faces as the corner opposite.
bool holds_origin(const std::array<Corner, 4>& c) {
  const auto volume = [&](std::size_t i, std::size_t j, std::size_t k) {
    return c[i].difference.dot(c[j].difference.cross(c[k].difference));
  };
  const double s0 = volume(1, 2, 3), s1 = -volume(0, 2, 3), s2 = volume(0, 1, 3), s3 = -volume(0, 1, 2);
  return (s0 > 0 && s1 > 0 && s2 > 0 && s3 > 0) || (s0 < 0 && s1 < 0 && s2 < 0 && s3 < 0);
}

/// Of all faces of the simplex that hold the newest, last, corner: the nearest point is in one of them.
Nearest nearest(const std::array<Corner, 4>& c, std::size_t size) {
  Nearest best;
  const std::size_t last = size - 1;
  const Vector3& y = c[last].difference;
  std::array<double, 4> w{};
  w[last] = 1.0;
  best.offer(y, w);
  for (std::size_t i = 0; i < last; ++i) {
    const Vector3& yi = c[i].difference;
    const Vector3 d = y - yi;
    const double t = -yi.dot(d) / d.squaredNorm();
    if (t > 0.0 && t < 1.0) {
      w = {};
      w[last] = t;
      w[i] = 1.0 - t;
      best.offer(yi + t * d, w);
    }
    for (std::size_t j = i + 1; j < last; ++j) {
      const Vector3& yj = c[j].difference;
      const Vector3 n = (yj - yi).cross(d);
      const double n2 = n.squaredNorm();
      if (!(n2 > 0.0)) continue;
      const Vector3 p = n * (n.dot(yi) / n2);
      const double area_last = n.dot((yi - p).cross(yj - p)), area_i = n.dot((yj - p).cross(y - p)),
                   area_j = n.dot((y - p).cross(yi - p));
      if (!(area_last > 0.0 && area_i > 0.0 && area_j > 0.0)) continue;
      const double area = area_last + area_i + area_j;
      w = {};
      w[last] = area_last / area;
      w[i] = area_i / area;
      w[j] = area_j / area;
      best.offer(p, w);
    }
  }
  if (size == 4 && holds_origin(c)) best = {Vector3::Zero(), 0.0, {}, true};
  return best;
}

}  // namespace

ClosestFeatures closest_features(const ConvexCore& a, const ConvexCore& b, const RelativePose& pose,
                                 const Vector3& guess) {
  std::array<Corner, 4> simplex;
  std::size_t size = 0;
  Nearest now;
  Vector3 v = guess.squaredNorm() > 0.0 ? guess : pose.p_AB;
  if (!(v.squaredNorm() > 0.0)) v = Vector3::UnitX();
  constexpr int kMaxSteps = 60;
  for (int step = 0; step < kMaxSteps; ++step) {
    const CoreSupport of_a = support(a, v), of_b = support(b, -(pose.R_AB.transpose() * v));
    const Corner corner{pose.p_AB + pose.R_AB * of_b.point - of_a.point, of_a.point, of_a.vertex, of_b.vertex};
    // |v| - v . w / |v| bounds what is left to gain
    constexpr double kEnough = 1e-13;
    if (size > 0 && now.norm2 - v.dot(corner.difference) <= kEnough * now.norm2) break;
    bool is_known = false;
    for (std::size_t k = 0; k < size; ++k) is_known |= simplex[k].difference == corner.difference;
    if (is_known) break;
    simplex[size] = corner;
    const Nearest next = nearest(simplex, size + 1);
    if (!(next.norm2 < now.norm2)) break;
    now = next;
    v = next.point;
    if (now.is_inside || now.norm2 == 0.0) {
      ++size;
      break;
    }
    std::size_t kept = 0;
    std::array<double, 4> weights{};
    for (std::size_t k = 0; k <= size; ++k) {
      if (now.weights[k] == 0.0) continue;
      weights[kept] = now.weights[k];
      simplex[kept++] = simplex[k];
    }
    now.weights = weights;
    size = kept;
  }

  ClosestFeatures closest;
  closest.distance = std::sqrt(now.norm2);
  if (closest.distance > 0.0) closest.direction = now.point / closest.distance;
  for (std::size_t k = 0; k < size; ++k) {
    closest.on_a += now.weights[k] * simplex[k].on_a;
    closest.a.add(simplex[k].a);
    closest.b.add(simplex[k].b);
  }
  closest.on_b = closest.on_a + now.point;
  return closest;
}

}  // namespace trajet
