// Gaps that vanish with their rate, made of polynomials: touch and back, touch and through, zero all the time; and near
// misses whose clearance is known.

#include <gtest/gtest.h>

#include "random_flights.hpp"
#include "separation_oracle.hpp"

namespace trajet::turning {
namespace {

const ConvexCore kGround = convex_core(HalfSpace{});
const FramePath kAtRest = FramePath::at_rest(Vector3::Zero(), Quaternion::Identity());

/// A height z(tau) with t0 = -1, from -1 to 1, of a solid that does not turn.
FramePath height(std::initializer_list<double> in_tau, const Quaternion& q = Quaternion::Identity()) {
  FramePath::Coefficients c = FramePath::Coefficients::Zero(7, static_cast<Eigen::Index>(in_tau.size()));
  c.col(0).tail<4>() << q.w(), q.x(), q.y(), q.z();
  Eigen::Index k = 0;
  for (const double x : in_tau) c(2, k++) = x;
  return {-1.0, 1.0, c};
}

/// Solids whose lowest point is 0.5 below their origin.
std::vector<ConvexCore> solids() {
  return {convex_core(Cuboid{{0.3, 0.4, 0.5}}), convex_core(Ball{0.5}), convex_core(Capsule{0.25, 0.25}),
          hull_core(convex_hull(std::vector<Vector3>{{0, 0, -0.5}, {1, 0, 0.5}, {-1, 1, 0.5}, {-1, -1, 0.5}}))};
}

TEST(Tangential, TouchAndThroughIsAHitOfNoSpeed) {
  // g = -t^3 = -(tau - 1)^3
  const FramePath path = height({0.5 + 1.0, -3.0, 3.0, -1.0});
  for (const ConvexCore& core : solids()) {
    const TurningContact c = first_contact(core, path, kGround, kAtRest, -1.0, 1.0);
    ASSERT_EQ(c.status, ContactStatus::hit);
    EXPECT_NEAR(c.time, 0.0, std::max(1e-4, c.time_error_bound));
    EXPECT_LE(std::abs(c.time), c.time_error_bound);
    EXPECT_NEAR(c.gap_rate, 0.0, 1e-8);
  }
}

TEST(Tangential, TouchAndBackIsAGrazeWhateverTheLastDigit) {
  // g = t^2 - depth = (tau - 1)^2 - depth
  for (const double depth : {0.0, 1e-16, -1e-16})
    for (const ConvexCore& core : solids()) {
      const TurningContact c = first_contact(core, height({0.5 + 1.0 - depth, -2.0, 1.0}), kGround, kAtRest, -1.0, 1.0);
      ASSERT_EQ(c.status, ContactStatus::graze);
      EXPECT_LE(std::abs(c.time), c.time_error_bound);
      EXPECT_LT(c.time_error_bound, 1e-5);
      EXPECT_NEAR(c.gap_curvature, 2.0, 1e-6);
      // the search that goes on finds no more
      EXPECT_EQ(
          first_contact(core, height({0.5 + 1.0 - depth, -2.0, 1.0}), kGround, kAtRest, c.time, 1.0, c.memory).status,
          ContactStatus::separated);
    }
}

TEST(Tangential, ClearancesDownToAPicometreAreToldFromTouches) {
  for (const double depth : {1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-11, 1e-12})
    for (const ConvexCore& core : solids()) {
      const TurningContact miss =
          first_contact(core, height({0.5 + 1.0 + depth, -2.0, 1.0}), kGround, kAtRest, -1.0, 1.0);
      EXPECT_EQ(miss.status, ContactStatus::separated) << depth;
      const TurningContact hit =
          first_contact(core, height({0.5 + 1.0 - depth, -2.0, 1.0}), kGround, kAtRest, -1.0, 1.0);
      ASSERT_EQ(hit.status, ContactStatus::hit) << depth;
      // the height's own rounding, 2e-16, moves a shallow crossing
      EXPECT_NEAR(hit.time, -std::sqrt(depth), 2e-16 / std::sqrt(depth) + hit.time_error_bound);
    }
}

TEST(Tangential, ALastingContactIsNoHit) {
  for (const ConvexCore& core : solids()) {
    const TurningContact c = first_contact(core, height({0.5}), kGround, kAtRest, -1.0, 1.0);
    EXPECT_EQ(c.status, ContactStatus::separated);
  }
  // a ball that rolls: z stays, it turns about x
  FramePath::Coefficients c = FramePath::Coefficients::Zero(7, 12);
  double term = 1.0;
  for (int k = 0; k < 12; ++k) {  // cos(tau / 2), sin(tau / 2)
    c(k % 2 == 0 ? 3 : 4, k) = (k / 2 % 2 == 0 ? 1.0 : -1.0) * term;
    term *= 0.5 / (k + 1);
  }
  c(2, 0) = 0.5, c(1, 1) = -0.5;
  const FramePath rolling(-1.0, 1.0, c);
  EXPECT_EQ(first_contact(convex_core(Ball{0.5}), rolling, kGround, kAtRest, -1.0, 1.0).status,
            ContactStatus::separated);
}

/// The oracle's least gap along the flights.
std::pair<Extended, Extended> least_gap(const Encounter& e) {
  std::pair<Extended, Extended> best{1e30L, 0};
  each_piece(e, e.from, e.to, [&](const FramePath& a, const FramePath& b, double from, double to) {
    best = std::min(best, SeparationOracle(e.a.core, a, e.b.core, b, Extended(e.a.speed + e.b.speed)).least(from, to));
    return true;
  });
  return best;
}
Extended gap_at(const Encounter& e, Extended t) {
  Extended gap = 0;
  each_piece(e, e.from, e.to, [&](const FramePath& a, const FramePath& b, double, double to) {
    if (t > Extended(to) && to < e.to) return true;
    gap = SeparationOracle(e.a.core, a, e.b.core, b, 0.0L).gap(t);
    return false;
  });
  return gap;
}
/// Within `width` of a time, where it is unimodal, by golden section.
std::pair<Extended, Extended> least_near(const Encounter& e, Extended at, Extended width) {
  const Extended phi = (std::sqrt(Extended(5)) - 1) / 2;
  Extended from = std::max(Extended(e.from), at - width), to = std::min(Extended(e.to), at + width);
  for (int k = 0; k < 70; ++k) {
    const Extended x = to - phi * (to - from), y = from + phi * (to - from);
    (gap_at(e, x) < gap_at(e, y) ? to : from) = gap_at(e, x) < gap_at(e, y) ? y : x;
  }
  const Extended middle = (from + to) / 2;
  return {gap_at(e, middle), middle};
}

/// Random flights moved until they pass at a clearance, or dip in by as much.
TEST(Tangential, FlightsThatPassAtAClearanceByConstruction) {
  int made = 0;
  for (const auto& [moving, other] : std::vector<std::pair<const char*, const char*>>{
           {"box", "plane"}, {"box", "static-box"}, {"box", "box"}, {"capsule", "box"}, {"capsule", "capsule"}}) {
    int pairs = 0;
    for (int k = 0; pairs < cases(4) && k < 400; ++k) {
      SCOPED_TRACE(std::string(moving) + " past " + other + " " + std::to_string(k));
      RandomFlights random(7919ULL * static_cast<unsigned>(k) + 3);
      Encounter e = random.encounter(moving, other, 50.0, 0.25);
      if (search(e).status != ContactStatus::separated) continue;
      auto least = least_gap(e);
      if (least.first > 0.3L || least.second < 0.0025L || least.second > 0.2475L) continue;
      // the direction in which b must move for the gap to change
      const auto gradient = [&] {
        Vector3 g;
        for (int i = 0; i < 3; ++i) {
          Encounter up = e, down = e;
          shift(up.b, 1e-7 * Vector3::Unit(i)), shift(down.b, -1e-7 * Vector3::Unit(i));
          g[i] = static_cast<double>((gap_at(up, least.second) - gap_at(down, least.second)) / 2e-7L);
        }
        return g;
      };
      const auto move_to = [&](double clearance, double width) {
        Vector3 g = gradient();
        for (int step = 0; step < 20; ++step) {
          least = least_near(e, least.second, width);
          if (std::abs(least.first - Extended(clearance)) <= 0.02L * std::abs(Extended(clearance)) + 2e-16L)
            return true;
          if (std::abs(clearance) > 1e-5) g = gradient();
          if (g.norm() < 0.5) return false;
          shift(e.b, static_cast<double>(Extended(clearance) - least.first) / g.squaredNorm() * g);
        }
        return false;
      };
      if (!move_to(1e-3, 1e-3) || std::abs(least_gap(e).second - least.second) > 2e-3L) continue;
      ++pairs;
      for (const double clearance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-11, 3e-12}) {
        if (!move_to(clearance, 3e-4)) break;
        EXPECT_EQ(search(e).status, ContactStatus::separated) << clearance;
        ++made;
      }
      for (const double depth : {1e-6, 1e-8, 1e-10, 1e-12}) {
        if (!move_to(-depth, 3e-4)) break;
        const TurningContact c = search(e);
        ASSERT_TRUE(is_contact(c)) << depth;
        Extended from = least.second - 2e-3L, to = least.second;
        for (Extended w = 1e-9L; w < 2e-3L; w *= 2)
          if (gap_at(e, least.second - w) > 0) {
            from = least.second - w;
            break;
          }
        for (int step = 0; step < 80; ++step) (gap_at(e, (from + to) / 2) > 0 ? from : to) = (from + to) / 2;
        EXPECT_NEAR(c.time, static_cast<double>(to), std::max(1e-10, c.time_error_bound)) << depth;
        ++made;
      }
    }
    EXPECT_GT(pairs, 0) << moving << " past " << other;
  }
  EXPECT_GT(made, 60);
}

}  // namespace
}  // namespace trajet::turning
