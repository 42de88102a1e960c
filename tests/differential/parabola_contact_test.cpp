// Random parabolas against random obstacles: the contacts that the library finds, in and out, are those of an
// independent oracle. The oracle writes every feature of the grown obstacle (face, edge, corner, rim) as a polynomial
// in time, solves it in long double by recursion over its derivatives, and looks at the sign of the distance between
// all candidate times.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "trajet/collide/detect/contact_table.hpp"

namespace trajet {
namespace {

using Real = long double;
using Polynomial = std::vector<Real>;

Polynomial operator+(Polynomial a, const Polynomial& b) {
  a.resize(std::max(a.size(), b.size()), 0.0L);
  for (std::size_t i = 0; i < b.size(); ++i) a[i] += b[i];
  return a;
}
Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial c(a.size() + b.size() - 1, 0.0L);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
  }
  return c;
}
Polynomial constant(Real x) { return {x}; }

Real evaluate(const Polynomial& p, Real t) {
  Real sum = 0.0L;
  for (std::size_t k = p.size(); k-- > 0;) sum = sum * t + p[k];
  return sum;
}

// All sign changes of p in [0, end]: between the roots of the derivative p is monotone, and bisection finds the one
// root.
std::vector<Real> roots(const Polynomial& p, Real end) {
  if (p.size() < 2) return {};
  Polynomial derivative;
  for (std::size_t k = 1; k < p.size(); ++k) derivative.push_back(static_cast<Real>(k) * p[k]);
  std::vector<Real> grid = roots(derivative, end);
  grid.insert(grid.begin(), 0.0L);
  grid.push_back(end);
  std::vector<Real> found;
  for (std::size_t i = 0; i + 1 < grid.size(); ++i) {
    Real a = grid[i];
    Real b = grid[i + 1];
    const bool negative = evaluate(p, a) < 0.0L;
    if (negative == (evaluate(p, b) < 0.0L)) continue;
    for (int step = 0; step < 70; ++step) {
      const Real middle = 0.5L * (a + b);
      ((evaluate(p, middle) < 0.0L) == negative ? a : b) = middle;
    }
    found.push_back(0.5L * (a + b));
  }
  return found;
}

struct Parabola {
  Vector3 position, velocity, acceleration;
  double duration;

  Polynomial along(const Vector3& axis, const Vector3& origin) const {
    Polynomial p{0.0L, 0.0L, 0.0L};
    for (int i = 0; i < 3; ++i) {
      const Real n = axis[i];
      p[0] += n * (static_cast<Real>(position[i]) - origin[i]);
      p[1] += n * velocity[i];
      p[2] += n * 0.5L * acceleration[i];
    }
    return p;
  }
};

struct Crossing {
  Real time;
  int direction;  // -1 in or through from the positive side, +1 the other way
};

struct Oracle {
  std::vector<Crossing> crossings;
  Real margin;  // the least distance from zero that the gap has between two candidate times
  bool starts_inside;
};

// The polynomial of a rim has degree 8: its rounding errors are a thousand times those of the gap itself.
template <class Gap>
Real polished(Real root, const Gap& gap) {
  Real a = root - 1e-10L;
  Real b = root + 1e-10L;
  const bool negative = gap(a) < 0.0L;
  if (negative == (gap(b) < 0.0L)) return root;
  for (int step = 0; step < 40; ++step) {
    const Real middle = 0.5L * (a + b);
    ((gap(middle) < 0.0L) == negative ? a : b) = middle;
  }
  return 0.5L * (a + b);
}

template <class Gap>
Oracle crossings_between(std::vector<Real> candidates, Real end, const Gap& gap) {
  candidates.push_back(0.0L);
  candidates.push_back(end);
  std::sort(candidates.begin(), candidates.end());
  Oracle oracle{{}, 1.0L, gap(0.0L) < 0.0L};
  int last = gap(0.0L) < 0.0L ? -1 : 1;
  oracle.margin = std::abs(gap(0.0L));
  for (std::size_t i = 0; i + 1 < candidates.size(); ++i) {
    const Real value = gap(0.5L * (candidates[i] + candidates[i + 1]));
    // Candidates that two features share are as good as one.
    if (candidates[i + 1] - candidates[i] < 1e-15L) continue;
    oracle.margin = std::min(oracle.margin, std::abs(value));
    const int sign = value < 0.0L ? -1 : 1;
    if (sign != last) oracle.crossings.push_back({polished(candidates[i], gap), sign});
    last = sign;
  }
  return oracle;
}

void append(std::vector<Real>& to, const std::vector<Real>& from) { to.insert(to.end(), from.begin(), from.end()); }

Oracle oracle_for(const Parabola& motion, const Sphere& sphere, double radius) {
  Polynomial squared = constant(0.0L);
  for (int i = 0; i < 3; ++i) {
    const Polynomial q = motion.along(Vector3::Unit(i), sphere.center);
    squared = squared + q * q;
  }
  const Real reach = static_cast<Real>(sphere.radius) + radius;
  const Polynomial f = squared + constant(-reach * reach);
  return crossings_between(roots(f, motion.duration), motion.duration,
                           [&](Real t) { return std::sqrt(evaluate(squared, t)) - reach; });
}

Oracle oracle_for(const Parabola& motion, const Box& box, double radius) {
  std::vector<Polynomial> beyond;  // q_i - h_i and -q_i - h_i
  Polynomial q[3];
  for (int i = 0; i < 3; ++i) {
    q[i] = motion.along(box.R_WB.col(i), box.center);
    beyond.push_back(q[i] + constant(-static_cast<Real>(box.half_size[i])));
    beyond.push_back(constant(-1.0L) * q[i] + constant(-static_cast<Real>(box.half_size[i])));
  }
  const Real r = radius;
  std::vector<Real> candidates;
  for (int i = 0; i < 6; ++i) {
    const Polynomial& a = beyond[static_cast<std::size_t>(i)];
    append(candidates, roots(a + constant(-r), motion.duration));
    append(candidates, roots(a, motion.duration));
    for (int j = (i / 2 + 1) * 2; j < 6 && radius > 0.0; ++j) {
      const Polynomial& b = beyond[static_cast<std::size_t>(j)];
      const Polynomial edge = a * a + b * b + constant(-r * r);
      append(candidates, roots(edge, motion.duration));
      for (int k = (j / 2 + 1) * 2; k < 6; ++k) {
        const Polynomial& c = beyond[static_cast<std::size_t>(k)];
        append(candidates, roots(edge + c * c, motion.duration));
      }
    }
  }
  return crossings_between(candidates, motion.duration, [&](Real t) {
    Real squared = 0.0L;
    Real inside = -1e30L;
    for (int i = 0; i < 3; ++i) {
      const Real d = std::abs(evaluate(q[i], t)) - static_cast<Real>(box.half_size[i]);
      inside = std::max(inside, d);
      squared += d > 0.0L ? d * d : 0.0L;
    }
    return inside < 0.0L && radius == 0.0 ? inside : std::sqrt(squared) - r;
  });
}

Oracle oracle_for(const Parabola& motion, const Disk& disk, double radius) {
  const Polynomial height = motion.along(disk.normal, disk.center);
  Polynomial squared = constant(0.0L);
  for (int i = 0; i < 3; ++i) {
    const Polynomial q = motion.along(Vector3::Unit(i), disk.center);
    squared = squared + q * q;
  }
  // The disk's normal is a unit vector only to rounding: divide.
  const Real n2 = static_cast<Real>(disk.normal.x()) * disk.normal.x() +
                  static_cast<Real>(disk.normal.y()) * disk.normal.y() +
                  static_cast<Real>(disk.normal.z()) * disk.normal.z();
  const Polynomial a2 = height * height * constant(1.0L / n2);
  const Polynomial rho2 = squared + constant(-1.0L) * a2;
  const Real R = disk.radius;
  const Real r = radius;
  if (radius == 0.0) {
    Oracle oracle{{}, 1.0L, false};
    for (const Real t : roots(height, motion.duration)) {
      const Real beyond = std::sqrt(std::max(0.0L, evaluate(rho2, t))) - R;
      oracle.margin = std::min(oracle.margin, std::abs(beyond));
      const Real rate = height[1] + 2.0L * height[2] * t;
      oracle.margin = std::min(oracle.margin, std::abs(rate));
      if (beyond <= 0.0L) oracle.crossings.push_back({t, rate < 0.0L ? -1 : 1});
    }
    return oracle;
  }
  // |a| = r, and the rim: (a^2 + rho^2 + R^2 - r^2)^2 = 4 R^2 rho^2
  std::vector<Real> candidates = roots(a2 + constant(-r * r), motion.duration);
  const Polynomial sum = squared + constant(R * R - r * r);
  append(candidates, roots(sum * sum + constant(-4.0L * R * R) * rho2, motion.duration));
  append(candidates, roots(rho2 + constant(-R * R), motion.duration));
  return crossings_between(candidates, motion.duration, [&](Real t) {
    const Real overhang = std::max(0.0L, std::sqrt(std::max(0.0L, evaluate(rho2, t))) - R);
    return std::sqrt(evaluate(a2, t) + overhang * overhang) - r;
  });
}

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
  Parabola parabola() { return {vector(2.0), vector(4.0), vector(10.0), uniform(0.5, 3.0)}; }

 private:
  std::mt19937 engine_;
};

Segment<6> segment_of(const Parabola& motion) {
  Segment<6> segment;
  segment.resize(6, 2);
  segment.set_interval(0.0, motion.duration);
  segment.error_bound().setZero();
  segment.coefficients().col(0) << motion.position, motion.velocity;
  segment.coefficients().col(1) << motion.velocity, motion.acceleration;
  segment.coefficients().col(2) << 0.5 * motion.acceleration, Vector3::Zero();
  return segment;
}

struct Counts {
  int hits = 0;
  int overlaps = 0;
  int close_calls = 0;  // cases that rounding may decide either way
  double worst_time_error = 0.0;
};

// Where the gap of the oracle comes closer to zero than this without a sign change, or hardly changes sign, the library
// may call it a graze or nothing: 1e-11 m is a hundred times its tolerance at this scale.
constexpr Real kCloseCall = 1e-11L;

template <class S>
void compare(const Parabola& motion, const S& shape, double radius, Counts& counts) {
  const Oracle oracle = oracle_for(motion, shape, radius);
  const Segment<6> segment = segment_of(motion);
  const PointPath path(segment, 0);
  std::vector<ContactResult> contacts;
  ContactMemory memory;
  double from = 0.0;
  bool overlaps = false;
  for (;;) {
    const ContactResult contact = first_contact(Shape(shape), {path, radius, from, motion.duration}, memory);
    if (contact.status == ContactStatus::separated) break;
    overlaps = contact.status == ContactStatus::overlapping_at_start;
    if (overlaps) break;
    contacts.push_back(contact);
    ASSERT_NE(contact.status, ContactStatus::unresolved);
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
    counts.worst_time_error = std::max(counts.worst_time_error, error);
    ++counts.hits;
  }
}

constexpr int kCases = 16'700;  // of each of six kinds: 100,200 parabolas

template <class MakeShape>
void run(unsigned seed, bool is_ball, const MakeShape& make_shape) {
  Random random(seed);
  Counts counts;
  for (int i = 0; i < kCases; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const Parabola motion = random.parabola();
    const double t = random.uniform(0.0, motion.duration);
    const Vector3 near = motion.position + t * motion.velocity + 0.5 * t * t * motion.acceleration + random.vector(0.6);
    const double radius = is_ball ? random.uniform(0.01, 0.5) : 0.0;
    compare(motion, make_shape(random, near), radius, counts);
    if (testing::Test::HasFatalFailure()) return;
  }
  testing::Test::RecordProperty("hits", counts.hits);
  testing::Test::RecordProperty("overlaps", counts.overlaps);
  testing::Test::RecordProperty("close_calls", counts.close_calls);
  testing::Test::RecordProperty("worst_time_error", std::to_string(counts.worst_time_error * 1e12) + "e-12 s");
  std::printf("hits %d, overlapping starts %d, close calls %d, worst time error %.2e s\n", counts.hits, counts.overlaps,
              counts.close_calls, counts.worst_time_error);
  EXPECT_GT(counts.hits, kCases / 10);
  // A margin below 1e-11 m at a scale of 1 m comes about once in 1e11 / (features) cases.
  EXPECT_LE(counts.close_calls, 3);
}

Sphere random_sphere(Random& random, const Vector3& near) { return make_sphere(near, random.uniform(0.05, 1.0)); }
Disk random_disk(Random& random, const Vector3& near) {
  return make_disk(near, random.rotation().col(0), random.uniform(0.05, 1.0));
}
Box random_box(Random& random, const Vector3& near) {
  const Vector3 size(random.uniform(0.05, 1.5), random.uniform(0.05, 1.5), random.uniform(0.05, 1.5));
  return make_box(near, size, random.rotation());
}

TEST(ParabolaContact, PointAgainstSpheres) { run(1, false, random_sphere); }
TEST(ParabolaContact, BallAgainstSpheres) { run(2, true, random_sphere); }
TEST(ParabolaContact, PointAgainstDisks) { run(3, false, random_disk); }
TEST(ParabolaContact, BallAgainstDisks) { run(4, true, random_disk); }
TEST(ParabolaContact, PointAgainstBoxes) { run(5, false, random_box); }
TEST(ParabolaContact, BallAgainstBoxes) { run(6, true, random_box); }

}  // namespace
}  // namespace trajet
