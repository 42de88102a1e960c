#include "trajet/math/quaternion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "trajet/math/euler_angles.hpp"

namespace trajet {
namespace {

using std::numbers::pi;

// Each result is a few operations on numbers of order 10: their rounding.
constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();

const Quaternion kA(1, -2, 3, 0.5), kB(0.25, 4, -1, 2);

void expect_near(const Quaternion& a, const Quaternion& b, double tolerance = kRounding) {
  EXPECT_LE(difference(a, b).norm(), tolerance) << a << " and " << b;
}

TEST(Quaternion, ProductIsHamiltons) {
  const Quaternion i(0, 1, 0, 0), j(0, 0, 1, 0), k(0, 0, 0, 1), minus_one(-1, 0, 0, 0);
  expect_near(i * j, k);
  expect_near(j * k, i);
  expect_near(k * i, j);
  expect_near(i * i, minus_one);
  expect_near(j * i, scaled(-1.0, k));
}

TEST(Quaternion, QuotientsSolveTheirEquations) {
  expect_near(kA * left_quotient(kA, kB), kB);
  expect_near(right_quotient(kB, kA) * kA, kB);
  // they differ: quaternions do not commute
  EXPECT_GT(difference(left_quotient(kA, kB), right_quotient(kB, kA)).norm(), 0.1);
}

TEST(Quaternion, DotIsTheScalarPartOfTheProductWithTheConjugate) {
  EXPECT_NEAR(dot(kA, kB), (kA * kB.conjugate()).w(), kRounding);
  const Quaternion p(1, 1, 0, 0), q(1, 0, 1, 0);
  EXPECT_EQ(dot(p, q), 1.0);
  expect_near(p * q.conjugate(), {1, 1, -1, -1});  // not a number
  expect_near(scaled(0.5, sum(kA * kB.conjugate(), kB * kA.conjugate())), {dot(kA, kB), 0, 0, 0});
}

TEST(Quaternion, RotatesTheVectorOfTheNotes) {  // F91: (1, 1, 1) by pi/2 about z
  const Vector3 v = rotate<double>(from_axis_angle<double>(Vector3(0, 0, 1), pi / 2), Vector3(1, 1, 1));
  EXPECT_LE((v - Vector3(-1, 1, 1)).norm(), kRounding);
  // an axis of another length is the same axis
  const Vector3 w = rotate<double>(from_axis_angle<double>(Vector3(0, 0, 2), pi / 2), Vector3(1, 1, 1));
  EXPECT_LE((w - v).norm(), kRounding);
}

TEST(Quaternion, MatrixIsTheSandwichProduct) {
  const Vector3 v(0.3, -2, 1);
  const Quaternion sandwich = kA * pure<double>(v) * kA.conjugate();
  EXPECT_LE((rotate<double>(kA, v) - sandwich.vec()).norm(), 10 * kRounding);
  const double scale = kA.squaredNorm();
  EXPECT_NEAR(rotation_matrix(kA).determinant(), std::pow(scale, 3), 1e3 * kRounding);
}

TEST(Quaternion, ExpAndLogAreInverse) {
  for (const Vector3& v : {Vector3(0.1, -0.2, 0.3), Vector3(0, 0, 3.1), Vector3(1e-9, 0, 1e-9), Vector3(0, 0, 0)}) {
    const Quaternion q(0.7, v.x(), v.y(), v.z());
    expect_near(log(exp(q)), q);
    expect_near(exp(scaled(0.5, q)) * exp(scaled(0.5, q)), exp(q));
  }
  expect_near(exp(log(kA)), kA);
  expect_near(exp(log(Quaternion(-2, 0, 0, 0))), {-2, 0, 0, 0});
  expect_near(exp(log(Quaternion(2, 1e-200, 0, 0))), {2, 1e-200, 0, 0});
}

TEST(Quaternion, PowersOfARotationAddUp) {
  expect_near(pow(kA, 0.3) * pow(kA, 0.7), kA);
  expect_near(pow(kA, 2.0), kA * kA, 10 * kRounding);
  expect_near(pow(kA, -1.0), inverse(kA));
}

TEST(Quaternion, RotationVectorGoesBothWaysToHalfATurn) {
  for (const double angle : {0.0, 1e-12, 1.0, 3.0, pi - 1e-9}) {
    const Vector3 u = angle * Vector3(2, -1, 2) / 3.0;
    EXPECT_LE((to_rotation_vector(from_rotation_vector<double>(u)) - u).norm(), kRounding) << angle;
    // -q is the same rotation
    EXPECT_LE((to_rotation_vector(scaled(-1.0, from_rotation_vector<double>(u))) - u).norm(), kRounding) << angle;
  }
  // three quarters of a turn are one backward
  const AxisAngle<double> turn = to_axis_angle(from_axis_angle<double>(Vector3(0, 1, 0), 1.5 * pi));
  EXPECT_NEAR(turn.angle_rad, 0.5 * pi, kRounding);
  EXPECT_LE((turn.axis + Vector3(0, 1, 0)).norm(), kRounding);
  EXPECT_EQ(to_axis_angle(Quaternion::Identity()).angle_rad, 0.0);
}

TEST(Quaternion, SlerpTurnsAtConstantSpeedTheShortWay) {
  const Quaternion a = from_rotation_vector<double>(Vector3(0.2, 0.5, -0.1));
  const Quaternion turn = from_rotation_vector<double>(Vector3(0.6, -0.8, 0));  // by 1 rad
  for (const double t : {0.0, 0.25, 1.0})
    for (const double sign : {1.0, -1.0}) {
      const Quaternion q = slerp(a, scaled(sign, a * turn), t);
      EXPECT_LE((to_rotation_vector(a.conjugate() * q) - t * Vector3(0.6, -0.8, 0)).norm(), kRounding);
    }
  // where an arc cosine of the dot product would have lost half the digits
  const Vector3 small(0, 1e-9, 0);
  const Quaternion q = slerp(a, a * from_rotation_vector<double>(small), 0.5);
  EXPECT_LE((to_rotation_vector(a.conjugate() * q) - 0.5 * small).norm(), 4 * std::numeric_limits<double>::epsilon());
}

TEST(Quaternion, MatrixGoesBackToTheQuaternion) {
  for (const Vector3& u :
       {Vector3(0.1, 0.2, 0.3), Vector3(pi, 0, 0), Vector3(0, pi, 0), Vector3(0, 0, pi), Vector3(2, -2, 1)}) {
    const Quaternion q = from_rotation_vector<double>(u);
    const Matrix3 R = rotation_matrix(q);
    EXPECT_LE((rotation_matrix(from_rotation_matrix(R)) - R).norm(), kRounding);
  }
}

TEST(Quaternion, NearestRotationUndoesAStretch) {
  const Matrix3 R = rotation_matrix(from_rotation_vector<double>(Vector3(1, 2, -1)));
  const Matrix3 stretch = Vector3(1.3, 0.8, 1.1).asDiagonal();
  EXPECT_LE((nearest_rotation(R * stretch) - R).norm(), kRounding);
  const Matrix3 mirror = Vector3(1, 1, -1).asDiagonal();
  EXPECT_NEAR(nearest_rotation(mirror).determinant(), 1.0, kRounding);
}

TEST(EulerAngles, AreTheProductOfTheirRotations) {
  const auto about = [](int axis, double angle) {
    return rotation_matrix(from_axis_angle<double>(Vector3::Unit(axis), angle));
  };
  const Vector3 angles(0.4, -1.1, 2.5);
  const auto matrix = [&](const EulerConvention& c) { return rotation_matrix(from_euler_angles(angles, c)); };
  EXPECT_LE((matrix(kYawPitchRoll) - about(2, 0.4) * about(1, -1.1) * about(0, 2.5)).norm(), kRounding);
  EXPECT_LE((matrix(kRollPitchYaw) - about(2, 2.5) * about(1, -1.1) * about(0, 0.4)).norm(), kRounding);
  EXPECT_LE((matrix(kPrecessionNutationSpin) - about(2, 0.4) * about(0, -1.1) * about(2, 2.5)).norm(), kRounding);
}

TEST(EulerAngles, ComeBackFromTheRotationInAllConventions) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) {
        if (i == j || j == k) continue;
        for (const bool is_intrinsic : {true, false}) {
          const EulerConvention convention{{i, j, k}, is_intrinsic};
          const Vector3 angles(0.4, i == k ? 1.1 : -1.1, 2.5);
          const Quaternion q = from_euler_angles(angles, convention);
          EXPECT_LE((to_euler_angles(q, convention) - angles).norm(), kRounding) << i << j << k << is_intrinsic;
          EXPECT_LE((to_euler_angles(scaled(-3.0, q), convention) - angles).norm(), kRounding);
        }
      }
}

TEST(EulerAngles, GiveTheRotationInGimbalLock) {
  for (const EulerConvention& convention : {kYawPitchRoll, kRollPitchYaw, kPrecessionNutationSpin}) {
    const bool is_proper = convention.axes[0] == convention.axes[2];
    for (const double middle : is_proper ? std::array{0.0, pi} : std::array{-pi / 2, pi / 2}) {
      const Quaternion q = from_euler_angles(Vector3(0.4, middle, 0.7), convention);
      const Quaternion back = from_euler_angles(to_euler_angles(q, convention), convention);
      EXPECT_NEAR(std::abs(dot(q, back)), 1.0, kRounding) << middle;
    }
  }
}

}  // namespace
}  // namespace trajet
