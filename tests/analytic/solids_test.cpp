#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "scene_run.hpp"
#include "trajet/rigid/free_rotation.hpp"

namespace trajet {
namespace {

using test::final_of;
using test::run_text;
using test::Way;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// A body "b" with the lines given, moved in the way given.
RunResult run_body(const std::string& body, const std::string& orientation, const Way& way, double end,
                   RunObserver* observer = nullptr, int samples = 8) {
  return run_text("[time]\nend = " + test::number(end) + "\nsample = " + test::number(end / samples) + "\n[method]\n" +
                      way.lines + "orientation = \"" + orientation +
                      "\"\nmax_steps = 3000000\n[[body]]\nname = \"b\"\n" + body,
                  observer);
}

double angle_between(const Quaternion& a, const Quaternion& b) {
  return to_rotation_vector(a.normalized() * b.normalized().conjugate()).norm();
}

// F76 and the same for other steps: |det R| = (1 + (w h)^2)^n.
TEST(Solids, MatrixStretchesAsTheNotesSay) {
  const std::string box = "shape = \"box\"\nsize = [1, 2, 3]\nangular_velocity = [0, 0, \"pi/10\"]\n";
  struct {
    double step, end, determinant;
  } const cases[] = {{0.5, 0.5, 1.02467401100272}, {0.5, 1.0, 1.04995682882441}, {0.5, 10.0, 1.62822502404812}};
  for (const auto& c : cases) {
    const BodyState b = final_of(run_body(box, "matrix", test::fixed("euler", c.step), c.end), "b");
    EXPECT_NEAR(b.rotation_matrix.determinant(), c.determinant, 1e-13)
        << c.step << " " << c.end;  // of the printed digits
  }
  for (const double step : {0.1, 0.01})
    for (const double end : {1.0, 10.0}) {
      const BodyState b = final_of(run_body(box, "matrix", test::fixed("euler", step), end), "b");
      const double n = std::round(end / step), w = std::numbers::pi / 10;
      const double expected = std::pow(1.0 + std::pow(w * step, 2), n);
      EXPECT_NEAR(b.rotation_matrix.determinant(), expected, 4 * n * kEpsilon);
    }
}

// F100 … F105: the soccer ball, w = (0, 1, 1), after 10 s by Euler's method with steps of 0.1 s.
TEST(Solids, SoccerBallOfTheNotes) {
  const std::string ball =
      "shape = \"soccer-ball\"\nradius = 0.11\nvelocity = [1, 1, 1]\nangular_velocity = [0, 1, 1]\n";
  const Way euler = test::fixed("euler", 0.1);
  const Vector3 w(0, 1, 1);
  const auto turned_by = [&](const Quaternion& q) {
    return std::remainder(2.0 * std::atan2(q.vec().dot(w.normalized()), q.w()) - 10.0 * w.norm(),
                          2.0 * std::numbers::pi);
  };
  const BodyState raw = final_of(run_body(ball, "quaternion", euler, 10.0), "b");
  EXPECT_NEAR(raw.orientation.norm(), 1.28322581493537, 1e-14);
  EXPECT_NEAR(raw.rotation_matrix.determinant(), std::pow(1.28322581493537, 6), 1e-13);  // sizes grow by |q|^2
  const BodyState unit = final_of(run_body(ball, "quaternion-normalized", euler, 10.0), "b");
  EXPECT_NEAR(unit.orientation.norm(), 1.0, kEpsilon);
  EXPECT_NEAR(turned_by(unit.orientation), -0.0234997669214770, 1e-14);
  // a constant angular velocity is exact in exponential coordinates, whatever the method
  for (const char* way : {"rotation-vector", "exact"}) {
    const BodyState b = final_of(run_body(ball, way, euler, 10.0), "b");
    EXPECT_NEAR(turned_by(b.orientation), 0.0, 100 * kEpsilon) << way;
    EXPECT_LE((b.position - Vector3(10, 10, 10)).norm(), 1e-13);
  }
}

/// w(t) = (cos t, sin t, 1/2): in the world's frame R = Rz(t) exp(t (w_0 - e_z)~), in the body's
/// R = exp(t (w_0 + e_z)~) Rz(-t), as their derivatives show.
Quaternion moving_axis(Frame frame, double t) {
  const Vector3 w0(1, 0, 0.5), z(0, 0, 1);
  const auto turn = [t](const Vector3& w) { return from_rotation_vector<double>(w * t); };
  return frame == Frame::world ? turn(z) * turn(w0 - z) : turn(w0 + z) * turn(-z);
}

std::string moving_axis_law(Frame frame) {
  const std::string suffix = frame == Frame::world ? "" : "_body";
  return "angular_velocity" + suffix + " = [1, 0, 0.5]\nangular_acceleration" + suffix +
         " = [\"-sin(t)\", \"cos(t)\", 0]\n";
}

TEST(Solids, MovingAxisTellsTheFramesApart) {
  for (const Frame frame : {Frame::world, Frame::body})
    for (const char* way : {"quaternion-normalized", "quaternion", "matrix", "rotation-vector"}) {
      const RunResult result = run_body(moving_axis_law(frame), way, test::controlled("taylor", 1e-14), 7.0);
      EXPECT_LE(angle_between(final_of(result, "b").orientation, moving_axis(frame, 7.0)), 1e-12) << way;
    }
  EXPECT_GT(angle_between(moving_axis(Frame::world, 7.0), moving_axis(Frame::body, 7.0)), 0.1);
}

const char* const kTop = "inertia = [1, 2, 3]\nangular_velocity_body = [0.01, 3, 0.02]\n";
const Vector3 kTopMoments(1, 2, 3), kTopStart(0.01, 3, 0.02);

/// The angular velocity in the body's frame.
Vector3 w_body(const BodyState& b) {
  return rotate<double>(b.orientation.normalized().conjugate(), b.angular_velocity);
}

TEST(Solids, AsymmetricTopWithinItsTolerance) {
  // near its intermediate axis, where errors used to grow e-fold every 0.6 s
  const FreeRotation exact(Quaternion::Identity(), kTopStart, kTopMoments.asDiagonal());
  struct {
    const char* method;
    std::vector<double> reached;  // below, steps are too many
  } const cases[] = {{"taylor", {1e-6, 1e-8, 1e-10, 1e-11, 1e-12, 1e-13}},
                     {"dopri5", {1e-6, 1e-8, 1e-10, 1e-11, 1e-12, 1e-13}},
                     {"dop853", {1e-6, 1e-8, 1e-10, 1e-11, 1e-12, 1e-13}},
                     {"rodas5p", {1e-6, 1e-8, 1e-10, 1e-11}},
                     {"bs32", {1e-6, 1e-8}}};
  for (const auto& c : cases)
    for (const char* way : {"quaternion-normalized", "rotation-vector"})
      for (const double tolerance : c.reached) {
        const BodyState b = final_of(run_body(kTop, way, test::controlled(c.method, tolerance), 100.0), "b");
        // measured below the tolerance; but for rounding at 1e-13, up to 1.3e-13, and for order 3, up to 3.7 times
        const double bound = (tolerance < 1e-12 ? 3.0 : c.method == std::string("bs32") ? 10.0 : 1.0) * tolerance;
        EXPECT_LE((w_body(b) - exact.w_WB_B(100.0)).norm(), bound) << c.method << " " << way << " " << tolerance;
        EXPECT_LE(angle_between(b.orientation, exact.q_WB(100.0)), bound) << c.method << " " << way << " " << tolerance;
      }
  // in extended precision; the closed form itself is rounded to 4e-14
  const Way extended = test::controlled("taylor-extended", 1e-15);
  const BodyState b = final_of(run_body(kTop, "quaternion-normalized", extended, 100.0), "b");
  EXPECT_LE((w_body(b) - exact.w_WB_B(100.0)).norm(), 1e-13);
  EXPECT_LE(angle_between(b.orientation, exact.q_WB(100.0)), 1e-13);
}

TEST(Solids, AsymmetricTopAfterAHundredFlips) {
  const FreeRotation exact(Quaternion::Identity(), kTopStart, kTopMoments.asDiagonal());
  const double end = 740.0;  // a flip takes 7.3 s
  const BodyState b = final_of(run_body(kTop, "quaternion-normalized", test::controlled("taylor", 1e-12), end), "b");
  EXPECT_LE((w_body(b) - exact.w_WB_B(end)).norm(), 1e-9);
  EXPECT_LE(angle_between(b.orientation, exact.q_WB(end)), 1e-9);
}

TEST(Solids, ClosedFormGoesWhereIntegratorsCannot) {
  const Way euler = test::fixed("euler", 1.0);  // the method has no part in it
  const BodyState b = final_of(run_body(kTop, "exact", euler, 100.0), "b");
  // forty digits, see free_rotation_test
  EXPECT_LE((w_body(b) - Vector3(-0.74460917354858401024, -2.9061412867696736775, 0.43032655094037028355)).norm(),
            1e-13);
}

/// Largest deviations over the samples of a free top.
struct Drift : RunObserver {
  explicit Drift(const Vector3& moments, const Vector3& w) : I(moments), L0(I.cwiseProduct(w)), energy0(w.dot(L0)) {}
  void sample(const Sample& sample) override {
    const BodyState& b = sample.bodies[0];
    const Vector3 w = w_body(b);
    unit = std::max(unit, std::abs(b.orientation.norm() - 1.0));
    energy = std::max(energy, std::abs(w.dot(I.cwiseProduct(w)) / energy0 - 1.0));
    momentum =
        std::max(momentum, (rotate<double>(b.orientation.normalized(), I.cwiseProduct(w)) - L0).norm() / L0.norm());
  }
  Vector3 I, L0;
  double energy0, unit = 0.0, energy = 0.0, momentum = 0.0;
};

TEST(Solids, EnergyAndMomentumOfATopAtTightTolerance) {
  for (const char* way : {"quaternion-normalized", "rotation-vector", "exact"}) {
    Drift drift(kTopMoments, kTopStart);
    run_body(kTop, way, test::controlled("taylor", 1e-13), 100.0, &drift, 1000);
    EXPECT_LE(drift.energy, 1e-12) << way;
    EXPECT_LE(drift.momentum, 1e-12) << way;
    EXPECT_LE(drift.unit, 4 * kEpsilon) << way;
  }
}

const char* const kSlowTop = "inertia = [1, 2, 2.5]\nangular_velocity_body = [0.3, 1, 0.5]\n";
const Vector3 kSlowTopMoments(1, 2, 2.5), kSlowTopStart(0.3, 1, 0.5);

// The Lie-group way and the normalised quaternion put each state back to its energy and momentum.
TEST(Solids, EnergyAndMomentumStayOverAMillionSteps) {
  for (const char* way : {"quaternion-normalized", "rotation-vector"}) {
    Drift drift(kSlowTopMoments, kSlowTopStart);
    const RunResult result = run_body(kSlowTop, way, test::fixed("midpoint", 0.1), 1e5, &drift, 10000);
    EXPECT_EQ(result.statistics.steps, 1000000);
    EXPECT_LE(drift.energy, 1e-14) << way;
    EXPECT_LE(drift.momentum, 1e-14) << way;
  }
}

// Nothing is put back here. Energy, |L| and |q| are quadratic in the state, which the method keeps but for rounding;
// the momentum in the world is cubic in it, and oscillates with the method's error, h^6.
TEST(Solids, TheSymplecticMethodKeepsEnergyAndMomentumOverAMillionSteps) {
  Drift drift(kSlowTopMoments, kSlowTopStart);
  const RunResult result = run_body(kSlowTop, "quaternion", test::fixed("gauss6", 0.05), 5e4, &drift, 10000);
  EXPECT_EQ(result.statistics.steps, 1000000);
  EXPECT_LE(drift.energy, 1e-14);    // measured 2.7e-15
  EXPECT_LE(drift.unit, 1e-14);      // measured 3.1e-15
  EXPECT_LE(drift.momentum, 1e-12);  // measured 8.4e-13, from the first to the last tenth of the run
}

// What is left where energy and momentum are kept is the error along the orbit. It grows with time, not with its
// square.
TEST(Solids, TheErrorAlongTheOrbitGrowsWithTime) {
  struct Largest : RunObserver {
    void sample(const Sample& sample) override {
      const double error = (w_body(sample.bodies[0]) - exact.w_WB_B(sample.time)).norm();
      whole = std::max(whole, error);
      if (sample.time <= 200.0) first_tenth = std::max(first_tenth, error);
    }
    FreeRotation exact{Quaternion::Identity(), kSlowTopStart, Matrix3(kSlowTopMoments.asDiagonal())};
    double first_tenth = 0.0, whole = 0.0;
  };
  for (const char* method : {"rk4", "series", "gauss6", "rk4-doubling", "rosenbrock23"})
    for (const char* way : {"quaternion-normalized", "rotation-vector"}) {
      Largest error;
      // rk4-doubling: the two halves of each step agree at this tolerance
      const std::string tolerance =
          method == std::string("rosenbrock23") ? "rtol = 1e-4\natol = 1e-4\n" : "rtol = 1.0\n";
      run_body(kSlowTop, way, {"", test::fixed(method, 0.2).lines + tolerance}, 2000.0, &error, 10000);
      EXPECT_NEAR(error.whole / error.first_tenth, 10.0, 1.5) << method << " " << way;
    }
}

// Over intervals in which the body turns more than once, rotation vectors have to be changed among the sub-steps.
TEST(Solids, StepDoublingCarriesRotationVectorsAsWellAsQuaternions) {
  const FreeRotation exact(Quaternion::Identity(), kSlowTopStart, Matrix3(kSlowTopMoments.asDiagonal()));
  for (const double step : {1.0, 2.0, 4.0}) {
    const auto error = [&](const char* orientation) {
      const Way way{"", test::fixed("rk4-doubling", step).lines + "rtol = 1e-9\n"};
      const RunResult result = run_body(kSlowTop, orientation, way, 40.0);
      EXPECT_EQ(result.status, RunStatus::finished) << result.failure;
      return angle_between(final_of(result, "b").orientation, exact.q_WB(40.0));
    };
    EXPECT_LE(error("rotation-vector"), 20.0 * error("quaternion")) << step;
  }
}

/// Tops with published solutions, as bodies of a scene in every way.
TEST(Solids, PublishedTops) {
  struct {
    const char* body;
    double end;
    Vector3 w_B;
    double error;
  } const cases[] = {
      // NASA TM-2015-218675, case 2: all ways differ by 4e-10 deg/s from what it prints
      {"inertia = [0.001894220, 0.006211019, 0.007194665]\n"
       "angular_velocity_body = [\"10 deg/s\", \"20 deg/s\", \"30 deg/s\"]\n",
       30.0, Vector3(12.6183907757, -17.3974747619, 31.1195888868) * (std::numbers::pi / 180.0),
       5e-10 * std::numbers::pi / 180.0},
      // Hipparchus, TestProblem8, near its separatrix: comes back after a period
      {"inertia = [\"3/8\", \"1/2\", \"5/8\"]\nangular_velocity_body = [5, 0, 4]\n", 6.861525571809244,
       Vector3(5, 0, 4), 2e-13},
  };
  for (const auto& c : cases)
    for (const char* way : {"quaternion-normalized", "rotation-vector", "quaternion", "matrix", "exact"}) {
      const BodyState b = final_of(run_body(c.body, way, test::controlled("taylor", 1e-15), c.end), "b");
      const Vector3 w =
          way == std::string("matrix") ? Vector3(b.rotation_matrix.transpose() * b.angular_velocity) : w_body(b);
      EXPECT_LE((w - c.w_B).norm(), c.error) << way << ", " << c.end << " s";
    }
}

// The "Boxes" of the benchmark of Gazebo's engines, whose errors are about 1e-2 at steps of 1 ms: 10 kg, 10 s.
TEST(Solids, BoxesOfTheEngineBenchmark) {
  const std::string box =
      "shape = \"box\"\nsize = [0.1, 0.4, 0.9]\nmass = 10\nvelocity = [-2, 2, 8]\nangular_velocity = [0.1, 5, 0.1]\n";
  const Vector3 moments = 10.0 / 12 * Vector3(0.4 * 0.4 + 0.9 * 0.9, 0.9 * 0.9 + 0.1 * 0.1, 0.1 * 0.1 + 0.4 * 0.4);
  for (const char* way : {"quaternion-normalized", "rotation-vector", "matrix", "quaternion"}) {
    Drift drift(moments, Vector3(0.1, 5, 0.1));
    const RunResult result = run_body(box, way, test::controlled("taylor", 1e-12), 10.0, &drift);
    EXPECT_LE(drift.energy, 1e-11) << way;
    EXPECT_LE(drift.momentum, 1e-11) << way;
    EXPECT_LE((final_of(result, "b").position - Vector3(-20, 20, 80)).norm(), 1e-12);
  }
}

TEST(Solids, DefaultIsAUnitQuaternionOverAMillionSteps) {
  struct : RunObserver {
    void sample(const Sample& sample) override {
      largest = std::max(largest, std::abs(sample.bodies[0].orientation.norm() - 1.0));
    }
    double largest = 0.0;
  } norm;
  // Euler's method at a tenth of a radian a step: without the cure |q| would be 10^543
  const RunResult result =
      run_body("angular_velocity = [0, 0.06, 0.08]\n", "quaternion-normalized", test::fixed("euler", 1.0), 1e6, &norm);
  EXPECT_EQ(result.statistics.steps, 1000000);
  EXPECT_LE(norm.largest, 1e-15);
}

// A heavy symmetric top on its tip, fast: the torque is R^T-dependent; energy, L_z and w_3 are constant.
TEST(Solids, HeavyTopKeepsWhatItMust) {
  const std::string top =
      "inertia = [2, 2, 1]\norientation = {axis = [1, 0, 0], angle = 0.5}\nangular_velocity_body = [0.1, 0.2, 20]\n"
      "torque = \"cross([Rxz, Ryz, Rzz], [0, 0, -9.8])\"\n";
  const Vector3 I(2, 2, 1);
  const auto invariants = [&](const BodyState& b) {
    const Vector3 w = w_body(b);
    const Vector3 L = rotate<double>(b.orientation.normalized(), I.cwiseProduct(w));
    return Vector3(0.5 * w.dot(I.cwiseProduct(w)) + 9.8 * b.rotation_matrix(2, 2), L.z(), w.z());
  };
  struct : RunObserver {
    void sample(const Sample& sample) override { samples.push_back(sample.bodies[0]); }
    std::vector<BodyState> samples;
  } kept;
  for (const char* way : {"quaternion-normalized", "quaternion", "matrix", "rotation-vector"}) {
    kept.samples.clear();
    run_body(top, way, test::controlled("taylor", 1e-13), 4.0, &kept);
    const Vector3 start = invariants(kept.samples.front());
    for (const BodyState& b : kept.samples)
      EXPECT_LE((invariants(b) - start).norm(), 1e-10) << way;  // of 200, measured 5e-12
  }
}

// F7: velocity and acceleration of a point are the derivatives of its position.
TEST(Solids, PointsMoveAsTheirDerivativesSay) {
  const std::string body =
      "inertia = [1, 2, 2.5]\nposition = [1, 2, 3]\nvelocity = [0, 1, 0]\nacceleration = [0, 0, -9.8]\n"
      "angular_velocity = [1, -2, 0.5]\ntorque = [0, \"sin(t)\", 1]\npoints = {tip = [0.3, -0.2, 0.5]}\n";
  const auto tip = [&](double t) {
    return final_of(run_body(body, "quaternion-normalized", test::controlled("taylor", 1e-14), t), "b").points[0];
  };
  const double t = 1.5, h = 1e-3;
  const PointState at = tip(t), before = tip(t - h), after = tip(t + h);
  // central differences: h^2/6 times a third derivative, below 100
  EXPECT_LE(((after.position - before.position) / (2 * h) - at.velocity).norm(), 100 * h * h / 6);
  EXPECT_LE(((after.velocity - before.velocity) / (2 * h) - at.acceleration).norm(), 1000 * h * h / 6);
}

// A force off the centre is the force and its torque.
TEST(Solids, ForceAtAPointGivesItsTorque) {
  const std::string start =
      "inertia = [1, 2, 2.5]\nmass = 2\nangular_velocity_body = [1, -2, 0.5]\nforce = [\"sin(t)\", 1, 0.5]\n";
  const Way way = test::controlled("taylor", 1e-13);
  const BodyState a = final_of(run_body(start + "force_point = [0.1, 0.2, -0.3]\n", "matrix", way, 2.0), "b");
  const BodyState b =
      final_of(run_body(start + "torque = \"cross([0.1*Rxx + 0.2*Rxy - 0.3*Rxz, 0.1*Ryx + 0.2*Ryy - 0.3*Ryz, "
                                "0.1*Rzx + 0.2*Rzy - 0.3*Rzz], [sin(t), 1, 0.5])\"\n",
                        "quaternion-normalized", way, 2.0),
               "b");
  EXPECT_LE((a.angular_velocity - b.angular_velocity).norm(), 1e-11);
  EXPECT_LE(angle_between(a.orientation, b.orientation), 1e-11);
}

// The same body in a frame of its own that is turned: nothing in the world changes.
TEST(Solids, FullInertiaIsThatOfTurnedAxes) {
  const Quaternion q_BP = from_rotation_vector<double>(Vector3(0.4, -0.3, 0.8));
  const Matrix3 I = rotation_matrix(q_BP) * Vector3(1, 2, 2.5).asDiagonal() * rotation_matrix(q_BP).transpose();
  std::string rows;
  for (int i = 0; i < 3; ++i)
    rows += "[" + test::number(I(i, 0)) + ", " + test::number(I(i, 1)) + ", " + test::number(I(i, 2)) + "], ";
  const Quaternion back = q_BP.conjugate();
  const std::string q = "orientation = {quaternion = [" + test::number(back.w()) + ", " + test::number(back.x()) +
                        ", " + test::number(back.y()) + ", " + test::number(back.z()) + "]}\n";
  const std::string spin = "angular_velocity = [1, -2, 0.5]\ntorque = [0, 0.3, \"-wz\"]\n";
  const Way way = test::controlled("taylor", 1e-13);
  const BodyState a = final_of(run_body("inertia = [1, 2, 2.5]\n" + spin, "quaternion-normalized", way, 3.0), "b");
  const BodyState b =
      final_of(run_body("inertia = [" + rows + "]\n" + q + spin, "quaternion-normalized", way, 3.0), "b");
  EXPECT_LE((a.angular_velocity - b.angular_velocity).norm(), 1e-11);
  EXPECT_LE(angle_between(a.orientation * q_BP.conjugate(), b.orientation), 1e-11);
}

}  // namespace
}  // namespace trajet
