// Signed distances to shapes in their own frames, by ways of their own.
#pragma once

#include <algorithm>
#include <cmath>

#include "sampled_contacts.hpp"

namespace trajet::sampled {

/// To a segment of the half plane.
inline Real to_segment(Real rho, Real z, Real r0, Real z0, Real r1, Real z1) {
  const Real dr = r1 - r0, dz = z1 - z0;
  const Real s = std::clamp<Real>(((rho - r0) * dr + (z - z0) * dz) / (dr * dr + dz * dz), 0, 1);
  return std::hypot(rho - r0 - s * dr, z - z0 - s * dz);
}

inline Real cylinder_distance(const RealVector& q, Real R, Real h) {
  const Real rho = std::hypot(q.x(), q.y()), z = std::abs(q.z());
  const Real outline = std::min(to_segment(rho, z, R, 0, R, h), to_segment(rho, z, 0, h, R, h));
  return rho < R && z < h ? -outline : outline;
}

inline Real capsule_distance(const RealVector& q, Real R, Real h) {
  const Real rho = std::hypot(q.x(), q.y());
  return to_segment(rho, q.z(), 0, -h, 0, h) - R;
}

inline Real cone_distance(const RealVector& q, Real R, Real height) {
  const Real rho = std::hypot(q.x(), q.y()), base = -height / 4, tip = height * 3 / 4;
  const Real outline = std::min(to_segment(rho, q.z(), R, base, 0, tip), to_segment(rho, q.z(), 0, base, R, base));
  return q.z() > base && rho * height < R * (tip - q.z()) ? -outline : outline;
}

/// By the tangent planes: the distance outside is the largest of those to all of them, and inside too, where it is
/// negative. From many normals the best one is climbed from by steps along the sphere.
inline Real ellipsoid_distance(const RealVector& q, const RealVector& a) {
  const auto above = [&](const RealVector& n) { return n.dot(q) - a.cwiseProduct(n).norm(); };
  RealVector best = RealVector::UnitX();
  Real value = -1e30L;
  const auto look_at = [&](const RealVector& n) {
    const Real v = above(n);
    if (v <= value) return false;
    value = v;
    best = n;
    return true;
  };
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      for (int k = -2; k <= 2; ++k)
        if (i != 0 || j != 0 || k != 0) look_at(RealVector(i, j, k).normalized());
  // Newton's steps on the sphere, as long as they climb; else a part of them, else along the gradient
  for (int step = 0; step < 60; ++step) {
    const RealVector n = best, an = a.cwiseProduct(n);
    const Real reach = an.norm();
    const RealVector gradient = q - a.cwiseProduct(an) / reach;
    const RealVector u = n.unitOrthogonal(), v = n.cross(u);
    const RealVector bend_u = a.cwiseProduct(a).cwiseProduct(u), bend_v = a.cwiseProduct(a).cwiseProduct(v);
    const RealVector p = a.cwiseProduct(an) / reach;
    const auto hessian = [&](const RealVector& x, const RealVector& bend_y, const RealVector& y) {
      return -(x.dot(bend_y) - x.dot(p) * y.dot(p)) / reach - gradient.dot(n) * x.dot(y);
    };
    const Real uu = hessian(u, bend_u, u), uv = hessian(u, bend_v, v), vv = hessian(v, bend_v, v);
    const Real gu = gradient.dot(u), gv = gradient.dot(v), det = uu * vv - uv * uv;
    RealVector way = -((vv * gu - uv * gv) * u + (uu * gv - uv * gu) * v) / det;
    if (!(det > 0.0L && uu < 0.0L)) way = gu * u + gv * v;
    bool climbs = false;
    for (Real part = 1; part > 1e-9L && !climbs; part /= 4) climbs = look_at((n + part * way).normalized());
    if (!climbs) break;
  }
  return value;
}

}  // namespace trajet::sampled
