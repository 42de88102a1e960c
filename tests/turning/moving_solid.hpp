#pragma once

// Solids in flight, for the tests of their first contacts.

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "free_flight.hpp"
#include "trajet/collide/detect/turning_contact.hpp"

namespace trajet::turning {

/// r, v, q_WB (w x y z), w_WB_B.
using FreeState = FreeFlight::State;

inline FreeState free_state(const Vector3& r, const Vector3& v, const Quaternion& q, const Vector3& w_B) {
  return (FreeState() << r, v, q.w(), q.x(), q.y(), q.z(), w_B).finished();
}

/// A solid on its way: paths that follow each other.
struct MovingSolid {
  ConvexCore core{};
  std::vector<FramePath> flight{};
  double speed = 0.0;  ///< no point of it is ever faster, m/s
  Vector3 inertia = Vector3::Ones();
};

/// The flight of a free rigid body under gravity by the Taylor method.
std::vector<FramePath> fly(const FreeState& start, const Vector3& inertia, double gravity, double from, double to);

inline void set_flight(MovingSolid& solid, const FreeState& start, double gravity, double from, double to) {
  solid.flight = fly(start, solid.inertia, gravity, from, to);
  const Vector3 momentum = solid.inertia.cwiseProduct(start.tail<3>());
  solid.speed = start.segment<3>(3).norm() + std::abs(gravity * (to - from)) +
                momentum.norm() / solid.inertia.minCoeff() * (std::isfinite(solid.core.reach) ? solid.core.reach : 0.0);
}

inline void rest(MovingSolid& solid, const Vector3& r, const Quaternion& q) {
  solid.flight = {FramePath::at_rest(r, q)};
  solid.speed = 0.0;
}

/// Moves the whole flight.
inline void shift(MovingSolid& solid, const Vector3& by) {
  for (FramePath& path : solid.flight) {
    FramePath::Coefficients c = path.coefficients();
    c.col(0).head<3>() += by;
    path = path.is_at_rest() ? FramePath::at_rest(c.col(0).head<3>(), {c(3, 0), c(4, 0), c(5, 0), c(6, 0)})
                             : FramePath(path.t0(), path.t1(), c);
  }
}

/// Two solids between two times.
struct Encounter {
  MovingSolid a{};
  MovingSolid b{};
  double from = 0.0;
  double to = 0.0;
};

/// The pieces of time in which both are on one path each.
template <class Visit>
void each_piece(const Encounter& e, double from, double to, Visit&& visit) {
  const bool is_forward = from <= to;
  const auto before = [&](double s, double t) { return is_forward ? s < t : s > t; };
  const auto on = [&](const MovingSolid& s, double t) {
    std::size_t i = 0;
    if (s.flight.size() == 1) return i;
    if (is_forward) {
      while (i + 1 < s.flight.size() && s.flight[i].t1() <= t) ++i;
    } else {
      i = s.flight.size() - 1;
      while (i > 0 && s.flight[i].t0() >= t) --i;
    }
    return i;
  };
  for (double t = from; before(t, to);) {
    const FramePath &a = e.a.flight[on(e.a, t)], &b = e.b.flight[on(e.b, t)];
    const double end_a = is_forward ? a.t1() : a.t0(), end_b = is_forward ? b.t1() : b.t0();
    double end = to;
    if (std::isfinite(end_a) && before(end_a, end)) end = end_a;
    if (std::isfinite(end_b) && before(end_b, end)) end = end_b;
    if (!visit(a, b, t, end)) return;
    t = end;
  }
}

/// The first contact along both flights.
inline TurningContact search(const Encounter& e, double from, double to, TurningMemory memory = {},
                             std::vector<WitnessLink>* chain = nullptr) {
  TurningContact contact;
  each_piece(e, from, to, [&](const FramePath& a, const FramePath& b, double begin, double end) {
    contact = first_contact(e.a.core, a, e.b.core, b, begin, end, memory, chain);
    memory = contact.memory;
    return contact.status == ContactStatus::separated;
  });
  return contact;
}
inline TurningContact search(const Encounter& e) { return search(e, e.from, e.to); }

inline bool is_contact(const TurningContact& c) {
  return c.status == ContactStatus::hit || c.status == ContactStatus::graze;
}

}  // namespace trajet::turning
