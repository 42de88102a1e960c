// What must not matter: which solid is named first, when time begins, how the world is turned; and how fast a thin
// blade is.

#include <gtest/gtest.h>

#include "random_flights.hpp"
#include "separation_oracle.hpp"

namespace trajet::turning {
namespace {

const std::vector<std::pair<const char*, const char*>> kPairs{
    {"box", "plane"}, {"box", "box"}, {"hull", "static-triangle"}, {"capsule", "hull"}, {"capsule", "capsule"}};

template <class Change>
void expect_same(Change&& change, double time_shift, double tolerance, const Matrix3& turned) {
  for (const auto& [moving, other] : kPairs) {
    int contacts = 0;
    for (int k = 0; k < cases(40); ++k) {
      SCOPED_TRACE(std::string(moving) + " on " + other + " " + std::to_string(k));
      RandomFlights random(524287ULL * static_cast<unsigned>(k) + 7);
      const Encounter e = random.encounter(moving, other, 50.0, 0.25);
      const TurningContact c = search(e);
      const Encounter changed = change(e);
      const TurningContact d = search(changed);
      ASSERT_EQ(c.status, d.status);
      if (!is_contact(c)) continue;
      ++contacts;
      EXPECT_NEAR(c.time + time_shift, d.time, std::max(tolerance, c.time_error_bound + d.time_error_bound));
      EXPECT_LT((turned * c.normal - d.normal).norm(), 1e-6);
    }
    EXPECT_GT(contacts, 3);
  }
}

TEST(Invariance, ExchangedSolidsTurnTheNormalRound) {
  expect_same(
      [](const Encounter& e) {
        Encounter x = e;
        std::swap(x.a, x.b);
        return x;
      },
      0.0, 1e-13, -Matrix3::Identity());
}

TEST(Invariance, TheOriginOfTimeDoesNotMatterToWhatItsDigitsTell) {
  for (const double later : {100.0, 1e6})
    expect_same(
        [&](const Encounter& e) {
          Encounter x = e;
          x.from += later, x.to += later;
          for (MovingSolid* s : {&x.a, &x.b})
            for (FramePath& p : s->flight)
              if (!p.is_at_rest()) p = FramePath(p.t0() + later, p.t1() + later, p.coefficients());
          return x;
        },
        later, 1e-15 * later, Matrix3::Identity());
}

TEST(Invariance, TheWorldCanBeTurnedAndMoved) {
  const Quaternion q = Quaternion(0.3, -0.4, 0.5, 0.7).normalized();
  const Matrix3 R = q.toRotationMatrix();
  expect_same(
      [&](const Encounter& e) {
        Encounter x = e;
        for (MovingSolid* s : {&x.a, &x.b})
          for (FramePath& p : s->flight) {
            FramePath::Coefficients c = p.coefficients();
            for (Eigen::Index k = 0; k < c.cols(); ++k) {
              c.col(k).head<3>() = R * c.col(k).head<3>();
              const Quaternion turned = q * Quaternion(c(3, k), c(4, k), c(5, k), c(6, k));
              c.col(k).tail<4>() << turned.w(), turned.x(), turned.y(), turned.z();
            }
            c.col(0).head<3>() += Vector3(3, -2, 1);
            p = p.is_at_rest() ? FramePath::at_rest(c.col(0).head<3>(), {c(3, 0), c(4, 0), c(5, 0), c(6, 0)})
                               : FramePath(p.t0(), p.t1(), c);
          }
        return x;
      },
      0.0, 1e-12, R);
}

TEST(FastBlades, AMillimetreThickAtTenThousandRadiansASecond) {
  for (const char* other : {"plane", "static-box", "box", "blade"}) {
    for (int k = 0; k < cases(6); ++k) {
      SCOPED_TRACE(std::string("blade on ") + other + " " + std::to_string(k));
      RandomFlights random(65537ULL * static_cast<unsigned>(k) + 11);
      const Encounter e = random.encounter("blade", other, 1e4, 0.02);
      const TurningContact c = search(e);
      const Truth t = truth(e, e.from, e.to);
      ASSERT_EQ(is_contact(c), t.time.has_value()) << static_cast<int>(c.status);
      if (t.time) {
        EXPECT_NEAR(c.time, static_cast<double>(*t.time), c.time_error_bound + 1e-16);  // the oracle's resolution
      }
    }
  }
}

/// The synchronised propeller: a point at 900 m/s through the disk of a blade 1 mm thick at 1e5 rad/s.
TEST(FastBlades, APointAtNineHundredMetresASecondMeetsTheBladeOrThePlaceBetween) {
  const ConvexCore blade = convex_core(Cuboid{{0.05, 0.004, 0.0005}});
  const ConvexCore point = convex_core(Point{});
  MovingSolid spinning{blade, {}, 0.0, Vector3::Ones()};
  set_flight(spinning, free_state(Vector3::Zero(), Vector3::Zero(), Quaternion::Identity(), {0, 0, 1e5}), 0.0, 0.0,
             4e-4);
  int hits = 0, misses = 0;
  for (int k = 0; k < cases(40); ++k) {
    SCOPED_TRACE(k);
    Encounter e;
    e.to = 2.2e-4;
    e.a = spinning;
    e.b.core = point;
    FramePath::Coefficients c = FramePath::Coefficients::Zero(7, 2);
    c.col(0) << 0.03, 0, 0.03 + 0.0041 * k, 1, 0, 0, 0;
    c(2, 1) = -900.0;
    e.b.flight = {FramePath(0.0, 1.0, c)};
    const TurningContact found = search(e);
    // the point is in the blade's slab from then on for 1.1 microseconds; the blade is over it when the angle is right
    const auto is_inside = [&](double t) {
      const Vector3 p(0.03, 0, 0.03 + 0.0041 * k - 900.0 * t);
      const double angle = 1e5 * t;
      const Vector3 q(std::cos(angle) * p.x() + std::sin(angle) * p.y(),
                      -std::sin(angle) * p.x() + std::cos(angle) * p.y(), p.z());
      return std::abs(q.x()) < 0.05 && std::abs(q.y()) < 0.004 && std::abs(q.z()) < 0.0005;
    };
    double first = -1.0;
    for (int i = 0; i <= 220000 && first < 0.0; ++i)
      if (is_inside(1e-9 * i)) first = 1e-9 * i;
    ASSERT_EQ(is_contact(found), first >= 0.0);
    (first >= 0.0 ? hits : misses)++;
    if (first >= 0.0) {
      EXPECT_NEAR(found.time, first, 1.1e-9);
    }
  }
  EXPECT_GT(hits, 0);
  EXPECT_GT(misses, 0);
}

}  // namespace
}  // namespace trajet::turning
