#pragma once

#include <limits>

#include "trajet/math/vector.hpp"

namespace trajet {

/// A box along the axes of the world, m. Bounds may be infinite. The default is empty: it overlaps nothing that
/// is bounded, and united with a box it is that box.
struct Aabb {
  Vector3 lower = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 upper = Vector3::Constant(-std::numeric_limits<double>::infinity());
};

/// Whether the closed boxes have a point in common. A bound that is not a number excludes nothing.
inline bool overlaps(const Aabb& a, const Aabb& b) {
  for (int i = 0; i < 3; ++i)
    if (a.lower[i] > b.upper[i] || a.upper[i] < b.lower[i]) return false;
  return true;
}

/// The least box around both.
inline Aabb united(const Aabb& a, const Aabb& b) { return {a.lower.cwiseMin(b.lower), a.upper.cwiseMax(b.upper)}; }
inline Aabb united(const Aabb& a, const Vector3& p) { return {a.lower.cwiseMin(p), a.upper.cwiseMax(p)}; }

/// Wider by `margin` (m) on every side.
inline Aabb grown(const Aabb& box, double margin) { return {box.lower.array() - margin, box.upper.array() + margin}; }

/// All of space.
inline Aabb unbounded_box() { return {Aabb().upper, Aabb().lower}; }

inline bool is_bounded(const Aabb& box) { return box.lower.allFinite() && box.upper.allFinite(); }

}  // namespace trajet
