// The flights of the other tests here: they are what they are said to be, and their speeds are bounded.

#include <gtest/gtest.h>

#include "free_flight.hpp"
#include "random_flights.hpp"
#include "trajet/ode/solve.hpp"

namespace trajet::turning {
std::vector<FramePath> fly(const FreeState& start, const Vector3& inertia, double gravity, double from, double to) {
  SolveOptions options;
  options.rtol = options.atol = 1e-13;
  const auto run = solve<Taylor>(FreeFlight{inertia, gravity}, from, start, to, options);
  std::vector<FramePath> flight;
  for (const auto& s : run.segments) {
    FramePath::Coefficients c(7, s.coefficients().cols());
    c << s.coefficients().topRows<3>(), s.coefficients().middleRows<4>(6);
    flight.emplace_back(s.t0(), s.t1(), c);
  }
  return flight;
}

namespace {

TEST(FreeFlight, FallsKeepsItsAngularMomentumAndItsSpeedLimit) {
  for (int k = 0; k < 20; ++k) {
    RandomFlights random(static_cast<std::uint64_t>(k));
    const double speed = random.uniform(0, 5);
    const MovingSolid s = random.solid("box", {1, 2, 3}, {speed, 0, 0}, 30.0, 0.25);
    const auto momentum = [&](const FramePose& p) {
      return Vector3(p.R_WB * s.inertia.cwiseProduct(p.R_WB.transpose() * p.w_WB_W));
    };
    const FramePose start = s.flight.front().pose(0.0), end = s.flight.back().pose(0.25);
    EXPECT_LT((end.p_WB - Vector3(1 + 0.25 * speed, 2, 3 - 0.5 * 9.81 * 0.0625)).norm(), 1e-12);
    EXPECT_LT((momentum(end) - momentum(start)).norm(), 1e-9 * momentum(start).norm());
    for (const FramePath& path : s.flight)
      for (const Vector3& p : s.core.vertices) {
        const FramePose pose = path.pose(0.5 * (path.t0() + path.t1()));
        EXPECT_LE(pose.velocity_at(pose.point(p)).norm(), s.speed);
      }
  }
}

}  // namespace
}  // namespace trajet::turning
