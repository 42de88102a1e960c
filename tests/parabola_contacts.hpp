#pragma once

// Contacts of balls on parabolas, for the tests of their traps.

#include <vector>

#include "trajet/collide/detect/contact_table.hpp"

namespace trajet::test {

inline const Vector3 kNone = Vector3::Zero();
inline const Vector3 kGravity(0.0, 0.0, -9.8);
inline const Shape kGround = make_plane(kNone, Vector3::UnitZ());

/// r + v tau + a tau^2 / 2 + j tau^3 / 6 from t0 to t1.
inline Segment<3> segment(double t0, double t1, const Vector3& r, const Vector3& v, const Vector3& a = kNone,
                          const Vector3& j = kNone) {
  Segment<3> s;
  s.resize(3, 3);
  s.set_interval(t0, t1);
  s.error_bound().setZero();
  s.coefficients() << r, v, 0.5 * a, j / 6.0;
  return s;
}

/// All contacts of a ball that passes through the shape, one after the other; the last is not a contact.
inline std::vector<ContactResult> contacts(const Segment<3>& s, const Shape& shape, double radius = 0.0,
                                           ContactMemory memory = {}) {
  const PointPath path(s, 0);
  std::vector<ContactResult> found;
  double from = s.t0();
  for (int i = 0; i < 100; ++i) {
    found.push_back(first_contact(shape, {path, radius, from, s.t1()}, memory));
    memory = found.back().memory;
    if (found.back().status != ContactStatus::hit && found.back().status != ContactStatus::graze) return found;
    from = found.back().time;
  }
  ADD_FAILURE() << "stuck at a contact";
  return found;
}

inline int count(const std::vector<ContactResult>& found, ContactStatus status = ContactStatus::hit) {
  return static_cast<int>(std::count_if(found.begin(), found.end(), [&](const auto& c) { return c.status == status; }));
}

}  // namespace trajet::test
