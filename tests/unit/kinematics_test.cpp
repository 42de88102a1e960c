#include "trajet/rigid/kinematics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "trajet/law/evaluate.hpp"
#include "trajet/law/program_number.hpp"
#include "trajet/rigid/free_invariants.hpp"
#include "trajet/rigid/orientation.hpp"
#include "trajet/rigid/principal_axes.hpp"

namespace trajet {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
const Quaternion kStart = Quaternion(0.3, 0.1, -0.5, 0.8).normalized();
const Vector3 kSpin(1, -2, 0.5);

/// The orientation after a short time at constant angular velocity in a frame.
Quaternion turned(Frame frame, double time) {
  const Quaternion step = from_rotation_vector<double>(kSpin * time);
  return frame == Frame::world ? step * kStart : kStart * step;
}

TEST(Kinematics, RatesAreDerivativesInTheirFrame) {
  const double h = 1e-4;  // central differences: h^2/6 |w|^3 = 2e-8
  const Matrix3 R = rotation_matrix(kStart);
  for (const Frame frame : {Frame::world, Frame::body}) {
    const bool in_world = frame == Frame::world;
    const Quaternion dq = scaled(0.5 / h, difference(turned(frame, h), turned(frame, -h)));
    const Quaternion rate =
        in_world ? quaternion_rate_world<double>(kStart, kSpin) : quaternion_rate_body<double>(kStart, kSpin);
    EXPECT_LE(difference(dq, rate).norm(), 3e-8);
    const Matrix3 dR = (rotation_matrix(turned(frame, h)) - rotation_matrix(turned(frame, -h))) / (2 * h);
    const Matrix3 matrix_rate = in_world ? matrix_rate_world<double>(R, kSpin) : matrix_rate_body<double>(R, kSpin);
    EXPECT_LE((dR - matrix_rate).norm(), 6e-8);
  }
}

TEST(Kinematics, SmallRotationIsTheExponentialUpToHalfATurn) {
  for (const double angle : {0.0, 1e-9, 0.5, 2.0, std::numbers::pi}) {
    const Vector3 u = angle * kSpin.normalized();
    EXPECT_LE(difference(small_rotation<double>(u), from_rotation_vector<double>(u)).norm(), 4 * kEpsilon) << angle;
  }
}

TEST(Kinematics, InverseDerivativeOfTheExponential) {
  for (const double theta : {1e-3, 0.3, 0.9}) {
    const double exact = (1.0 - 0.5 * theta / std::tan(0.5 * theta)) / (theta * theta);
    // the cancellation of the closed form: eps / theta^2
    EXPECT_NEAR(detail::polynomial(detail::kInverseDerivative, theta * theta), exact, 2 * kEpsilon / (theta * theta));
  }
}

/// Euler's equations are the derivative of R I w = L, worked out in the world: dL/dt = torque.
TEST(Kinematics, EulersEquationsAreTheBalanceOfAngularMomentum) {
  const double h = 1e-4;
  Matrix3 inertia;
  inertia << 3, 0.2, -0.1, 0.2, 2, 0.3, -0.1, 0.3, 2.5;
  const Vector3 torque_B(0.4, -0.7, 0.2);
  const Vector3 alpha_B = angular_acceleration_body<double>(inertia, inertia.inverse(), kSpin, torque_B);
  const auto momentum_W = [&](double time) {
    return rotate<double>(turned(Frame::body, time), inertia * (kSpin + time * alpha_B));
  };
  const Vector3 rate = (momentum_W(h) - momentum_W(-h)) / (2 * h);
  EXPECT_LE((rate - rotate<double>(kStart, torque_B)).norm(), 1e-6);
}

/// Velocity and acceleration of a point are the derivatives of its position.
TEST(Kinematics, APointOfASolidMovesAsItsDerivativesSay) {
  const Vector3 p_B(0.3, -0.2, 0.5), alpha(0.2, 0.4, -0.3);
  const PointMotion center{{1, 2, 3}, {0.5, 0, -1}, {0, 0, -9.8}};
  const auto position = [&](double t) {
    const Vector3 angle = kSpin * t + 0.5 * t * t * alpha;  // the order t^3 apart, where the axis turns
    return Vector3(center.position + t * center.velocity + 0.5 * t * t * center.acceleration +
                   rotate<double>(from_rotation_vector<double>(angle) * kStart, p_B));
  };
  const PointMotion point = point_motion(center, rotation_matrix(kStart), kSpin, alpha, p_B);
  const double h = 1e-3;
  EXPECT_EQ(point.position, center.position + rotation_matrix(kStart) * p_B);
  EXPECT_LE(((position(h) - position(-h)) / (2 * h) - point.velocity).norm(), 1e-5);
  EXPECT_LE(((position(h) - 2 * position(0.0) + position(-h)) / (h * h) - point.acceleration).norm(), 1e-4);
}

TEST(PrincipalAxes, AreARotationThatMakesTheInertiaDiagonal) {
  for (int i = 0; i < 20; ++i) {
    const Matrix3 R = rotation_matrix(Quaternion(0.3 + i, 0.1 * i, -0.5, 0.8 - i).normalized());
    const Matrix3 inertia = R * Vector3(1, 2, 2.5).asDiagonal() * R.transpose();
    const PrincipalAxes axes = principal_axes(inertia);
    EXPECT_NEAR(axes.R_BP.determinant(), 1.0, 8 * kEpsilon) << i;
    EXPECT_LE((axes.R_BP * axes.moments.asDiagonal() * axes.R_BP.transpose() - inertia).norm(), 32 * kEpsilon) << i;
  }
}

TEST(OrientationLayout, AligningChoosesTheNearerOfTwoQuaternions) {
  const OrientationLayout layout;
  std::vector<double> part(4), other(4);
  layout.put(kStart, other.data());
  layout.put(scaled(-1.0, turned(Frame::world, 0.1)), part.data());
  layout.align(part.data(), other.data());
  EXPECT_GT(part[0] * other[0] + part[1] * other[1] + part[2] * other[2] + part[3] * other[3], 0.9);
  const std::vector<double> aligned = part;
  layout.align(part.data(), other.data());
  EXPECT_EQ(part, aligned);
}

/// All ways, in both frames: the rate of the numbers is the rate of the rotation they stand for.
TEST(OrientationLayout, RatesAreThoseOfTheRotation) {
  const double h = 1e-4;
  for (const OrientationInfo& info : orientation_ways())
    for (const Frame frame : {Frame::world, Frame::body}) {
      const OrientationLayout layout{info.way, frame};
      std::vector<double> part(static_cast<std::size_t>(info.size)), rates = part, ahead = part, behind = part;
      layout.put(kStart, part.data());
      if (info.way == OrientationWay::rotation_vector)
        for (std::size_t i = 0; i < 3; ++i) part[4 + i] = 0.2 * static_cast<double>(i) - 0.3;
      layout.rate<double>(part.data(), kSpin, rates.data());
      for (std::size_t i = 0; i < part.size(); ++i) {
        ahead[i] = part[i] + h * rates[i];
        behind[i] = part[i] - h * rates[i];
      }
      const Matrix3 R = layout.matrix(part.data());
      const Matrix3 dR = (layout.matrix(ahead.data()) - layout.matrix(behind.data())) / (2 * h);
      const Matrix3 rate =
          frame == Frame::world ? matrix_rate_world<double>(R, kSpin) : matrix_rate_body<double>(R, kSpin);
      EXPECT_LE((dR - rate).norm(), 1e-7) << info.name;
    }
}

TEST(OrientationLayout, SettlingKeepsTheRotation) {
  for (const OrientationInfo& info : orientation_ways()) {
    const OrientationLayout layout{info.way, Frame::body};
    std::vector<double> part(static_cast<std::size_t>(info.size));
    layout.put(kStart, part.data());
    const bool is_vector = info.way == OrientationWay::rotation_vector;
    if (is_vector) part[5] = 0.7;
    const double stretch = is_vector || info.way == OrientationWay::matrix ? 1.0 : 1.5;
    for (double& x : part) x *= stretch;
    const Matrix3 before = layout.rotation(part.data());
    layout.settle(part.data());
    EXPECT_LE((layout.rotation(part.data()) - before).norm(), 8 * kEpsilon) << info.name;
    const bool is_left_alone = info.way == OrientationWay::quaternion || info.way == OrientationWay::matrix;
    if (!is_left_alone) {
      EXPECT_LE(layout.unsettled(part.data()), 2 * kEpsilon) << info.name;
    }
  }
  EXPECT_EQ(find_orientation_way("rkmk")->way, OrientationWay::rotation_vector);
  EXPECT_EQ(find_orientation_way("no such way"), nullptr);
}

TEST(ProgramNumber, ALawOnThemIsTheLawOnNumbers) {
  const OrientationLayout layout{OrientationWay::rotation_vector, Frame::body};
  const Matrix3 inertia = Vector3(1, 2, 2.5).asDiagonal();
  const auto law = [&]<class T>(const T* q, T* dq) {
    const Vector3T<T> w(q[7], q[8], q[9]);
    layout.rate(q, w, dq);
    const Vector3T<T> torque(T(0.0), q[0] * w.x(), -w.z() / (q[1] - T(3.0)));
    const Vector3T<T> alpha = angular_acceleration_body<T>(inertia, inertia.inverse(), w, torque);
    for (int i = 0; i < 3; ++i) dq[7 + i] = alpha[i];
  };
  ProgramBuilder builder(11);
  std::vector<ProgramNumber> inputs, outputs(10);
  for (int i = 1; i <= 10; ++i) inputs.emplace_back(builder, i);
  law(inputs.data(), outputs.data());
  for (const ProgramNumber& output : outputs) builder.add_output({false, {output.node(builder), 0, 0}});
  const Program program = builder.build();

  const std::vector<double> q{0.5, 0.5, -0.5, 0.5, 0.1, -0.2, 0.3, 1, -2, 0.5};
  std::vector<double> expected(10), computed(10);
  law(q.data(), expected.data());
  Evaluator<double> evaluator(program);
  evaluator(0.0, q.data(), computed.data());
  for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(computed[i], expected[i], 8 * kEpsilon) << i;
}

TEST(FreeInvariants, RestoreWhatATopKeeps) {
  Matrix3 full;
  full << 3, 0.2, -0.1, 0.2, 2, 0.3, -0.1, 0.3, 2.5;
  for (const Matrix3& inertia : {Matrix3(Vector3(1, 2, 3).asDiagonal()), Matrix3(Vector3(2, 2, 3).asDiagonal()), full})
    for (const Vector3& w : {Vector3(0.01, 3, 0.02), Vector3(1, 2, 3), Vector3(0, 0, 2)}) {
      const FreeInvariants invariants(kStart, w, inertia);
      Quaternion q = from_rotation_vector<double>(Vector3(1e-5, 2e-5, -1e-5)) * kStart;
      Vector3 moved = w + Vector3(1e-5, -2e-5, 3e-6);
      invariants.restore(q, moved);
      const double energy = w.dot(inertia * w);
      EXPECT_NEAR(moved.dot(inertia * moved), energy, 16 * kEpsilon * energy);
      EXPECT_LE((moved - w).norm(), 1e-4);  // of the size of the error, not a jump
      // about a principal axis only the energy can be kept, and with it the momentum but for the square of the error
      const Vector3 L = rotate<double>(kStart, inertia * w);
      const double tolerance = w.cross(inertia * w).norm() < 1e-12 ? 1e-8 : 16 * kEpsilon;
      EXPECT_LE((rotate<double>(q, inertia * moved) - L).norm(), tolerance * L.norm()) << w << inertia;
    }
}

TEST(FreeInvariants, LeaveAStateThatIsFarAlone) {
  const FreeInvariants invariants(kStart, Vector3(1, 2, 3), Vector3(1, 2, 3).asDiagonal());
  Quaternion q = kStart;
  Vector3 w(5, -3, 0);
  invariants.restore(q, w);
  EXPECT_EQ(w, Vector3(5, -3, 0));
}

}  // namespace
}  // namespace trajet
