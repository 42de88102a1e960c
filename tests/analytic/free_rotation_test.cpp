#include "trajet/rigid/free_rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "trajet/rigid/kinematics.hpp"

namespace trajet {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
const Quaternion kStart = Quaternion(0.3, 0.1, -0.5, 0.8).normalized();

struct Top {
  Vector3 moments, w;
};

/// Tumbling around either axis in either direction, symmetric ones, near the intermediate axis, about fixed axes.
const std::vector<Top> kTops{{{1, 2, 3}, {0.01, 3, 0.02}}, {{1, 2, 3}, {0.02, 3, 0.01}},
                             {{3, 1, 2}, {-0.4, 1, -2}},   {{3, 1, 2}, {0.4, -1, 2}},
                             {{2, 2, 1}, {0.4, 1, -2}},    {{2, 1, 2}, {0.4, 1, -2}},
                             {{1, 2, 2}, {0.4, 1, -2}},    {{3, 3, 2}, {0.4, 1, 0}},
                             {{1, 2, 3}, {1e-8, 0, 2}},    {{1, 2, 3}, {3, 0, 1e-8}},
                             {{2, 2, 2}, {1, 2, 3}},       {{1, 2, 3}, {0, 2, 0}},
                             {{1, 2, 2.5}, {0, 0, 0}},     {{1, 1.0000001, 1.9}, {1, 2, 0.3}}};

TEST(FreeRotation, KeepsEnergyAndTheMomentumInTheWorld) {
  for (const Top& top : kTops) {
    const FreeRotation rotation(kStart, top.w, top.moments.asDiagonal());
    const Vector3 L = rotate<double>(kStart, top.moments.cwiseProduct(top.w));
    const double energy = top.w.dot(top.moments.cwiseProduct(top.w));
    for (const double t : {0.0, 0.7, -3.0, 50.0}) {
      const Quaternion q = rotation.q_WB(t);
      const Vector3 w = rotation.w_WB_B(t);
      // the rounding of the phase, |w| t, moves the momentum by as much
      const double tolerance = 16 * kEpsilon * (1.0 + std::abs(t)) * (1.0 + L.norm());
      EXPECT_NEAR(q.norm(), 1.0, 2 * kEpsilon);
      EXPECT_NEAR(w.dot(top.moments.cwiseProduct(w)), energy, tolerance * top.w.norm());
      EXPECT_LE((rotate<double>(q, top.moments.cwiseProduct(w)) - L).norm(), tolerance) << top.w << " at " << t;
      EXPECT_LE((rotation.w_WB_W(t) - rotate<double>(q, w)).norm(), tolerance);
    }
  }
}

TEST(FreeRotation, SolvesItsDifferentialEquations) {
  // Central differences of the closed form: error h^2/6 times a third derivative, below |w|^3 for these tops.
  const double h = 1e-4;
  for (const Top& top : kTops) {
    const Matrix3 inertia = top.moments.asDiagonal();
    const FreeRotation rotation(kStart, top.w, inertia);
    const double tolerance = h * h * std::pow(2.0 + top.w.norm(), 3);
    for (const double t : {0.0, 0.4, 1.7, 6.0}) {
      const Vector3 w = rotation.w_WB_B(t);
      const Vector3 slope = (rotation.w_WB_B(t + h) - rotation.w_WB_B(t - h)) / (2 * h);
      const Vector3 acceleration = angular_acceleration_body<double>(inertia, inertia.inverse(), w, Vector3(0, 0, 0));
      EXPECT_LE((slope - acceleration).norm(), tolerance) << top.w << " at " << t;
      const Quaternion rate = scaled(0.5 / h, difference(rotation.q_WB(t + h), rotation.q_WB(t - h)));
      EXPECT_LE(difference(rate, quaternion_rate_body<double>(rotation.q_WB(t), w)).norm(), tolerance)
          << top.w << " at " << t;
    }
  }
}

TEST(FreeRotation, StartsWhereItShould) {
  Matrix3 inertia;
  inertia << 3, 0.2, -0.1, 0.2, 2, 0.3, -0.1, 0.3, 2.5;
  const Vector3 w(1, -2, 0.5);
  const FreeRotation rotation(kStart, w, inertia);
  EXPECT_LE((rotation.w_WB_B(0.0) - w).norm(), 16 * kEpsilon);
  EXPECT_NEAR(std::abs(dot(rotation.q_WB(0.0), kStart)), 1.0, 4 * kEpsilon);
  // full inertia: the momentum in the world stays
  const Vector3 L = rotate<double>(kStart, inertia * w);
  EXPECT_LE((rotate<double>(rotation.q_WB(9.0), inertia * rotation.w_WB_B(9.0)) - L).norm(), 1e-13);
}

TEST(FreeRotation, AgreesWithFortyDigitsNearTheIntermediateAxis) {
  // Jacobi's functions in 40 digits; the period is 6.2 quarter-logarithms long, the phase some 170: rounding 4e-14.
  const FreeRotation rotation(kStart, Vector3(0.01, 3, 0.02), Vector3(1, 2, 3).asDiagonal());
  const Vector3 w(-0.74460917354858401024, -2.9061412867696736775, 0.43032655094037028355);
  EXPECT_LE((rotation.w_WB_B(100.0) - w).norm(), 1e-13);
}

TEST(FreeRotation, PublishedTops) {
  // Hipparchus, TestProblem8: the period
  const FreeRotation hipparchus(kStart, Vector3(5, 0, 4), Vector3(0.375, 0.5, 0.625).asDiagonal());
  EXPECT_LE((hipparchus.w_WB_B(6.861525571809244) - Vector3(5, 0, 4)).norm(), 1e-13);
  // NASA TM-2015-218675, case 2: published to 10 decimals, of which forty-digit arithmetic confirms nine
  const double degree = std::numbers::pi / 180.0;
  const FreeRotation brick(kStart, Vector3(10, 20, 30) * degree,
                           Vector3(0.001894220, 0.006211019, 0.007194665).asDiagonal());
  EXPECT_LE((brick.w_WB_B(30.0) / degree - Vector3(12.6183907757, -17.3974747619, 31.1195888868)).norm(), 5e-10);
}

TEST(FreeRotation, FlipsForEver) {
  // after a hundred periods the state is that of the start
  const Vector3 w(0.01, 3, 0.02), moments(1, 2, 3);
  const FreeRotation rotation(kStart, w, moments.asDiagonal());
  double period = 0.0;  // by the return of w1 w2 w3, refined by Newton's method
  for (double t = 1.0; period == 0.0; t += 0.01)
    if ((rotation.w_WB_B(t) - w).norm() < 0.05) period = t;
  for (int i = 0; i < 8; ++i) {
    const Vector3 at = rotation.w_WB_B(period);
    const double slope = (moments[2] - moments[0]) / moments[1] * at[2] * at[0];
    const double slope0 = (moments[1] - moments[2]) / moments[0] * at[1] * at[2];
    period -= ((at[1] - w[1]) * slope + (at[0] - w[0]) * slope0) / (slope * slope + slope0 * slope0);
  }
  // the rounding of the period comes back a hundredfold, times the rate 3
  EXPECT_LE((rotation.w_WB_B(100 * period) - w).norm(), 1e-10);
}

TEST(FreeRotation, IsAScrewAtConstantAngularVelocity) {
  const Vector3 w(0, 1, 1);
  const FreeRotation rotation(kStart, w);
  const Quaternion expected = from_axis_angle<double>(w, w.norm() * 10.0) * kStart;
  EXPECT_LE(difference(rotation.q_WB(10.0), expected).norm(), 16 * kEpsilon);
  EXPECT_EQ(rotation.w_WB_W(10.0), w);
}

}  // namespace
}  // namespace trajet
