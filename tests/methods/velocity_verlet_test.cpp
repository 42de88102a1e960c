#include "trajet/ode/velocity_verlet.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "problems/drag.hpp"
#include "problems/kepler.hpp"
#include "trajet/ode/solve.hpp"

namespace trajet {
namespace {

using problems::Kepler;

double observed_order(double coarse, double fine) { return std::log2(std::abs(coarse / fine)); }

/// Two masses on springs that time stiffens: coupled, non-linear, with time in the law. State: (r1, r2, v1, v2); where
/// the velocities stand does not matter.
struct Springs {
  template <class Time, class Vector, class Rate>
  void operator()(const Time& t, const Vector& q, Rate& dq) const {
    const auto stretch = q[1] - q[0];
    const auto pull = (1.0 + 0.3 * t) * stretch * (1.0 + stretch * stretch);
    dq[0] = q[2];
    dq[1] = q[3];
    dq[2] = pull - q[0];
    dq[3] = -pull;
  }
  static Eigen::Vector4d start() { return {0.3, -0.4, 0.5, 0.1}; }
};

template <class Method>
Trajectory<4> solve_springs(double t0, const Eigen::Vector4d& q0, double t1, double step) {
  SolveOptions options;
  options.rtol = options.atol = 1e-14;
  options.step = step;
  return solve<Method>(Springs(), t0, q0, t1, options);
}

TEST(VelocityVerlet, ErrorsAreOfOrderTwo) {
  const Eigen::Vector4d exact = solve_springs<Taylor>(0.0, Springs::start(), 3.0, 0.1).end();
  const auto end_error = [&](int steps) {
    return (solve_springs<VelocityVerlet>(0.0, Springs::start(), 3.0, 3.0 / steps).end() - exact).eval();
  };
  for (const int steps : {400, 800}) {
    const auto coarse = end_error(steps), fine = end_error(2 * steps);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(observed_order(coarse[i], fine[i]), 2.0, 0.1) << i;
  }
}

TEST(VelocityVerlet, SegmentsAreOfOrderTwoAndWithinTheirBounds) {
  for (const double part : {0.2, 0.6, 1.0}) {
    Eigen::Vector4d errors[2], bounds[2];
    for (int half = 0; half < 2; ++half) {
      const double h = half == 0 ? 0.01 : 0.005;
      const auto segment = solve_springs<VelocityVerlet>(1.0, Springs::start(), 1.0 + h, h).segments.front();
      const double t = 1.0 + part * h;
      errors[half] = segment.state(t) - solve_springs<Taylor>(1.0, Springs::start(), t, h).end();
      bounds[half] = segment.error_bound();
    }
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(observed_order(errors[0][i], errors[1][i]), 3.0, 0.2) << i << " at " << part;
      EXPECT_NEAR(observed_order(bounds[0][i], bounds[1][i]), 3.0, 0.2) << i;
      // the bound is a leading term, its estimate off by h
      EXPECT_LE(std::abs(errors[0][i]), 1.05 * bounds[0][i]) << i << " at " << part;
    }
  }
}

// Symmetric: the way back with the same steps ends in the start but for rounding, however coarse the steps.
TEST(VelocityVerlet, GoesBackToItsStart) {
  const auto way = solve_springs<VelocityVerlet>(0.0, Springs::start(), 5.0, 0.25);
  const auto back = solve_springs<VelocityVerlet>(5.0, way.end(), 0.0, 0.25);
  EXPECT_GT((way.end() - solve_springs<Taylor>(0.0, Springs::start(), 5.0, 0.1).end()).norm(), 0.01);
  EXPECT_LT((back.end() - Springs::start()).cwiseAbs().maxCoeff(), 1e-14);
}

// Symplectic: the energy's error stays what it is over a hundred orbits, and angular momentum is kept to rounding.
TEST(VelocityVerlet, KeepsEnergyAndAngularMomentum) {
  const auto largest_energy_error = [](double orbits) {
    auto stepper = VelocityVerlet::make_stepper<4>(Kepler(), 4, [] {
      StepOptions options;
      options.step = Kepler::kPeriod / 500;
      return options;
    }());
    const Eigen::Vector2d start = Kepler::invariants(Kepler::start());
    double largest = 0.0;
    integrate(stepper, 0.0, Kepler::start(), orbits * Kepler::kPeriod, kDefaultMaxSteps, [&](const auto& s) {
      const Eigen::Vector2d change = Kepler::invariants(s.state()) - start;
      largest = std::max(largest, std::abs(change[0]));
      EXPECT_LT(std::abs(change[1]), 1e-12);
    });
    return largest;
  };
  const double first = largest_energy_error(2.0);
  EXPECT_LT(first, 1e-2);
  EXPECT_LT(largest_energy_error(100.0), 1.05 * first);
}

// A wind and a law for the position: dr/dt = v + w(t) is not v alone, but still of two halves.
TEST(VelocityVerlet, TakesADriftOfItsOwn) {
  const auto law = [](const auto& t, const auto& q, auto& dq) {
    dq[0] = q[1] + t * t;
    dq[1] = -q[0] + t * t * t / 3.0 - 2.0 * t;  // x = cos t + t^3/3 - …
  };
  // r = u + t^3/3 with u'' = -u - 2 t: u = cos t - 2 t, v = u'
  const auto exact = [](double t) {
    return Eigen::Vector2d(std::cos(t) - 2.0 * t + t * t * t / 3.0, -std::sin(t) - 2.0);
  };
  const auto error = [&](int steps) {
    SolveOptions options;
    options.step = 2.0 / steps;
    return (solve<VelocityVerlet>(law, 0.0, exact(0.0), 2.0, options).end() - exact(2.0)).norm();
  };
  EXPECT_LT(error(400), 1e-4);
  EXPECT_NEAR(observed_order(error(200), error(400)), 2.0, 0.05);
}

TEST(VelocityVerlet, RefusesForcesThatDependOnVelocities) {
  SolveOptions options;
  options.step = 0.1;
  EXPECT_THROW(solve<VelocityVerlet>(problems::Drag(), 0.0, problems::Drag::start(), 1.0, options),
               std::invalid_argument);
}

}  // namespace
}  // namespace trajet
