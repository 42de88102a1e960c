// Contacts of points and balls on random parabolas beside those of an independent oracle. The oracle knows the distance
// to a shape by another way than the library, in long double, samples it along the flight, looks closer wherever a
// sample is so small that the speed could have led to the surface in between, and bisects.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/geom/closest_point.hpp"
#include "trajet/portable.hpp"

namespace trajet::sampled {

using Real = Extended;
using RealVector = Vector3T<Real>;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double a, double b) { return a + (b - a) * static_cast<double>(engine_()) / 4294967296.0; }
  Vector3 vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  Matrix3 rotation() {
    return Quaternion(uniform(0.1, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0))
        .normalized()
        .toRotationMatrix();
  }

 private:
  std::mt19937 engine_;
};

struct Parabola {
  Vector3 position, velocity, acceleration;
  double duration;

  RealVector at(Real t) const {
    return position.cast<Real>() + t * velocity.cast<Real>() + (t * t / Real(2)) * acceleration.cast<Real>();
  }
  Real top_speed(Real from, Real to) const {
    const RealVector v = velocity.cast<Real>(), a = acceleration.cast<Real>();
    return std::max((v + from * a).norm(), (v + to * a).norm());  // convex in time
  }
};

struct Crossing {
  Real time;
  int direction;
};

struct Oracle {
  std::vector<Crossing> crossings;
  Real margin = 1;
  bool starts_inside = false;
};

/// The gap changes by no more than the speed allows: a piece at whose middle it is larger holds no root.
class Sampling {
 public:
  Sampling(const Parabola& motion, std::function<Real(const RealVector&)> distance, Real radius)
      : motion_(motion), distance_(std::move(distance)), radius_(radius) {}

  Oracle run() {
    oracle_.starts_inside = gap(0) < 0;
    side_ = oracle_.starts_inside ? -1 : 1;
    search(0, motion_.duration, 0);
    return oracle_;
  }

 private:
  Real gap(Real t) const { return distance_(motion_.at(t)) - radius_; }

  void search(Real from, Real to, int depth) {
    const Real middle = (from + to) / 2, value = gap(middle);
    const Real reach = motion_.top_speed(from, to) * (to - from) / 2;
    if (std::abs(value) > reach) return;
    // as fine as the least margin that is told apart
    if (depth < 9) {
      search(from, middle, depth + 1);
      return search(middle, to, depth + 1);
    }
    const Real a = gap(from), b = gap(to);
    const bool differs = (a < 0) != (b < 0);
    if (!differs) {
      // an extremum between: the smallest |gap| by golden sections
      const Real sign = a < 0 ? -1 : 1;
      Real low = from, high = to;
      constexpr Real kGolden = 0.618033988749894848L;
      Real x = high - kGolden * (high - low), y = low + kGolden * (high - low);
      Real gx = sign * gap(x), gy = sign * gap(y);
      for (int i = 0; i < 60; ++i) {
        if (gx < 0 || gy < 0) break;
        if (gx < gy) {
          high = y, y = x, gy = gx, x = high - kGolden * (high - low), gx = sign * gap(x);
        } else {
          low = x, x = y, gx = gy, y = low + kGolden * (high - low), gy = sign * gap(y);
        }
      }
      oracle_.margin = std::min(oracle_.margin, std::abs(std::min(gx, gy)));
      if (std::min(gx, gy) < 0) {
        const Real extremum = gx < gy ? x : y;
        cross(from, extremum);
        cross(extremum, to);
      }
      return;
    }
    cross(from, to);
  }

  void cross(Real from, Real to) {
    const bool negative = gap(from) < 0;
    for (int i = 0; i < 64; ++i) {
      const Real middle = (from + to) / 2;
      ((gap(middle) < 0) == negative ? from : to) = middle;
    }
    side_ = -side_;
    oracle_.crossings.push_back({(from + to) / 2, side_});
  }

  const Parabola& motion_;
  std::function<Real(const RealVector&)> distance_;
  Real radius_;
  Oracle oracle_;
  int side_ = 1;
};

inline Segment<6> segment_of(const Parabola& motion) {
  Segment<6> segment;
  segment.resize(6, 2);
  segment.set_interval(0.0, motion.duration);
  segment.error_bound().setZero();
  segment.coefficients().col(0) << motion.position, motion.velocity;
  segment.coefficients().col(1) << motion.velocity, motion.acceleration;
  segment.coefficients().col(2) << 0.5 * motion.acceleration, Vector3::Zero();
  return segment;
}

struct Kind {
  Shape shape;
  std::function<Real(const RealVector&)> distance;  ///< in the world
};

inline std::function<Real(const RealVector&)> in_frame(const Vector3& center, const Matrix3& R_WB,
                                                       std::function<Real(const RealVector&)> distance) {
  return [=](const RealVector& p) {
    const Matrix3 R_BW = R_WB.transpose();
    return distance(R_BW.cast<Real>() * (p - center.cast<Real>()));
  };
}

struct Counts {
  int hits = 0;
  int overlaps = 0;
  int close_calls = 0;
  double worst_time_error = 0.0;
};

/// Where the gap comes closer to zero than this without a change of sign the library may say graze or nothing: a
/// hundred times its tolerance at a size of a metre.
inline constexpr Real kCloseCall = 1e-11L;

inline void compare(const Parabola& motion, const Kind& kind, double radius, Counts& counts) {
  const Oracle oracle = Sampling(motion, kind.distance, radius).run();
  const Segment<6> segment = segment_of(motion);
  const PointPath path(segment, 0);
  std::vector<ContactResult> contacts;
  ContactMemory memory;
  double from = 0.0;
  bool overlaps = false;
  for (;;) {
    const ContactResult contact = first_contact(kind.shape, {path, radius, from, motion.duration}, memory);
    if (contact.status == ContactStatus::separated) break;
    overlaps = contact.status == ContactStatus::overlapping_at_start;
    if (overlaps) break;
    ASSERT_NE(contact.status, ContactStatus::unresolved);
    ASSERT_LT(contacts.size(), 100u);
    contacts.push_back(contact);
    memory = contact.memory;
    from = contact.time;
  }
  if (oracle.margin < kCloseCall) {
    ++counts.close_calls;
    return;
  }
  ASSERT_EQ(overlaps, oracle.starts_inside);
  counts.overlaps += overlaps;
  if (overlaps) return;
  ASSERT_EQ(contacts.size(), oracle.crossings.size()) << "margin " << static_cast<double>(oracle.margin);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactResult& contact = contacts[i];
    ASSERT_EQ(contact.status, ContactStatus::hit);
    EXPECT_EQ(contact.memory.side, oracle.crossings[i].direction);
    const double error = std::abs(static_cast<double>(contact.time - oracle.crossings[i].time));
    EXPECT_LE(error, contact.time_error_bound) << "margin " << static_cast<double>(oracle.margin);
    EXPECT_NEAR(contact.normal.norm(), 1.0, 1e-12);
    // the contact's point is on the surface, and the ball's centre above it along the normal
    EXPECT_NEAR(static_cast<double>(kind.distance(contact.point.cast<Real>())), 0.0, 1e-13);
    const Vector3 outward = contact.side_before < 0 ? Vector3(-contact.normal) : contact.normal;
    EXPECT_LE((contact.position - contact.point - radius * outward).norm(), 1e-12);
    counts.worst_time_error = std::max(counts.worst_time_error, error);
    ++counts.hits;
  }
}

inline constexpr int kCases = 1'500;

/// `near_start`: m; the shape is around a place that near to the start of the flight; 0: to somewhere on its way.
inline void run(unsigned seed, bool is_ball, const std::function<Kind(Random&, const Vector3&)>& make_kind,
                double near_start = 0.0) {
  Random random(seed);
  Counts counts;
  for (int i = 0; i < kCases; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const Parabola motion{random.vector(2.0), random.vector(4.0), random.vector(10.0), random.uniform(0.5, 3.0)};
    const double t = random.uniform(0.0, motion.duration);
    const Vector3 on_way = motion.position + t * motion.velocity + 0.5 * t * t * motion.acceleration;
    const Vector3 near =
        near_start > 0.0 ? Vector3(motion.position + random.vector(near_start)) : Vector3(on_way + random.vector(0.6));
    const double radius = is_ball ? random.uniform(0.01, 0.5) : 0.0;
    compare(motion, make_kind(random, near), radius, counts);
    if (testing::Test::HasFatalFailure()) return;
  }
  std::printf("hits %d, overlapping starts %d, close calls %d, worst time error %.2e s\n", counts.hits, counts.overlaps,
              counts.close_calls, counts.worst_time_error);
  EXPECT_GT(counts.hits, kCases / 10);
  EXPECT_LE(counts.close_calls, 2);
}

}  // namespace trajet::sampled
