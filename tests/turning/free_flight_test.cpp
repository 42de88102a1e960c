// The flights of the other tests here: they are what they are said to be, and their speeds are bounded.

#include <gtest/gtest.h>

#include "random_flights.hpp"
#include "trajet/ode/solve.hpp"

namespace trajet::turning {
namespace {

/// A free rigid body under gravity. State: r, v, q_WB (w x y z), w_WB_B.
struct FreeBody {
  Vector3 inertia = Vector3::Ones();
  double gravity = 9.81;

  template <class Time, class State, class Rate>
  void operator()(const Time&, const State& q, Rate& d) const {
    using N = std::decay_t<decltype(d[0])>;
    for (int i = 0; i < 3; ++i) d[i] = q[3 + i];
    d[3] = N(0.0), d[4] = N(0.0), d[5] = N(-gravity);
    const auto &w = q[6], &x = q[7], &y = q[8], &z = q[9], &a = q[10], &b = q[11], &c = q[12];
    d[6] = N(-0.5) * (x * a + y * b + z * c), d[7] = N(0.5) * (w * a + y * c - z * b);
    d[8] = N(0.5) * (w * b + z * a - x * c), d[9] = N(0.5) * (w * c + x * b - y * a);
    d[10] = N((inertia[1] - inertia[2]) / inertia[0]) * (b * c);
    d[11] = N((inertia[2] - inertia[0]) / inertia[1]) * (c * a);
    d[12] = N((inertia[0] - inertia[1]) / inertia[2]) * (a * b);
  }
};

}  // namespace

std::vector<FramePath> fly(const FreeState& start, const Vector3& inertia, double gravity, double from, double to) {
  SolveOptions options;
  options.rtol = options.atol = 1e-13;
  const auto run = solve<Taylor>(FreeBody{inertia, gravity}, from, start, to, options);
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
