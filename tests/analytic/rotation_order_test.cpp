#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "scene_run.hpp"
#include "trajet/ode/registry.hpp"
#include "trajet/rigid/free_rotation.hpp"
#include "trajet/rigid/orientation.hpp"

namespace trajet {
namespace {

/// A body whose orientation and angular velocity are known at all times.
struct Attitude {
  Quaternion q_WB;
  Vector3 w_WB_W;
};
struct Turning {
  std::string body;
  Attitude (*exact)(double t);
};

Quaternion turn(const Vector3& w, double t) { return from_rotation_vector<double>(w * t); }

// The axis moves, w = (cos t, sin t, 1/2), and its rate is taken from the orientation, so that neither can be had
// without the other. In the world, R = Rz(t) exp(t b~) with b = w_0 - e_z keeps Rz(t) b = R b, so that
// dw/dt = e_z x w = e_z x R b. In the body, R = exp(t c~) Rz(-t) with c = w_0 + e_z keeps Rz(t) c = R^T c, so that
// w = R^T c - e_z, dw/dt = e_z x R^T c; the torque is I dw/dt + w x I w, I = (1, 2, 2.5).
const Vector3 kZ(0, 0, 1), kAxis(1, 0, 0.5);

Attitude driven_in_world(double t) { return {turn(kZ, t) * turn(kAxis - kZ, t), rotate<double>(turn(kZ, t), kAxis)}; }
Attitude driven_in_body(double t) {
  const Quaternion q = turn(kAxis + kZ, t) * turn(-kZ, t);
  return {q, rotate<double>(q, rotate<double>(turn(kZ, t), kAxis))};
}

// Free asymmetric tops by Jacobi's elliptic functions: several, since keeping energy and momentum makes the leading
// term of the error small at one time or another.
template <int K>
Attitude free_top(double t) {
  static const Vector3 starts[] = {{0.7, 1.1, -0.9}, {1.2, 0.6, 0.7}, {-0.4, 1.2, 1.0}};
  static const FreeRotation closed_form(Quaternion::Identity(), starts[K], Matrix3(Vector3(1, 2, 2.5).asDiagonal()));
  return {closed_form.q_WB(t), closed_form.w_WB_W(t)};
}

const std::vector<Turning> kDrivenInWorld{
    {"angular_velocity = [1, 0, 0.5]\nangular_acceleration = [\"-(Ryx - 0.5*Ryz)\", \"Rxx - 0.5*Rxz\", 0]\n",
     driven_in_world}};
const std::vector<Turning> kDrivenInBody{
    {"inertia = [1, 2, 2.5]\nangular_velocity_body = [1, 0, 0.5]\n"
     "torque_body = \"[-(Rxy + 1.5*Rzy), 2*(Rxx + 1.5*Rzx), 0] + cross([Rxx + 1.5*Rzx, Rxy + 1.5*Rzy, "
     "Rxz + 1.5*Rzz - 1], [Rxx + 1.5*Rzx, 2*(Rxy + 1.5*Rzy), 2.5*(Rxz + 1.5*Rzz - 1)])\"\n",
     driven_in_body}};
const std::vector<Turning> kFree{{"inertia = [1, 2, 2.5]\nangular_velocity_body = [0.7, 1.1, -0.9]\n", free_top<0>},
                                 {"inertia = [1, 2, 2.5]\nangular_velocity_body = [1.2, 0.6, 0.7]\n", free_top<1>},
                                 {"inertia = [1, 2, 2.5]\nangular_velocity_body = [-0.4, 1.2, 1.0]\n", free_top<2>}};

struct Problem {
  const char* name;
  const std::vector<Turning>& turnings;
};
const Problem kProblems[] = {
    {"driven in the world", kDrivenInWorld}, {"driven in the body", kDrivenInBody}, {"free", kFree}};
const char* const kWays[] = {"quaternion-normalized", "quaternion", "matrix", "rotation-vector"};

std::string scene(const Turning& turning, const std::string& way, const std::string& method, double end) {
  return "[time]\nend = " + test::number(end) + "\n[method]\n" + method + "orientation = \"" + way +
         "\"\n[[body]]\nname = \"b\"\n" + turning.body;
}

/// The largest error of an orientation, rad, or an angular velocity, rad/s. `steps` is how many the method must make.
double error(const std::vector<Turning>& turnings, const std::string& way, const std::string& method, double end,
             std::optional<long> steps = std::nullopt) {
  double largest = 0.0;
  for (const Turning& turning : turnings) {
    const RunResult result = test::run_text(scene(turning, way, method, end));
    EXPECT_EQ(result.status, RunStatus::finished) << result.failure;
    EXPECT_EQ(result.statistics.steps, steps.value_or(result.statistics.steps));
    const BodyState& b = test::final_of(result, "b");
    const Attitude exact = turning.exact(end);
    largest = std::max({largest, to_rotation_vector(b.orientation.normalized() * exact.q_WB.conjugate()).norm(),
                        (b.angular_velocity - exact.w_WB_W).norm()});
  }
  return largest;
}

/// The lines of [method]; no tolerance of this size rejects a step. `order`: 0 is the method's own.
std::string method_lines(const MethodInfo& method, double step, int order) {
  return "name = \"" + std::string(method.name) + "\"\nstep = " + test::number(step) + "\nrtol = 1e3\natol = 1e3\n" +
         (order == 0 ? "" : "order = " + std::to_string(order) + "\n");
}

/// Those to try: the method's own order, or a few of a series.
std::vector<int> orders(const MethodInfo& method) {
  if (method.max_order == 0) return {method.order};
  return {2, 3, 4, 6, 8};
}

bool chooses_its_order(const MethodInfo& method) { return method.order == 0 && method.max_order == 0; }

TEST(RotationOrder, OfMethodsOfGivenStepsOverARun) {
  int count = 0;
  for (const MethodInfo& method : methods()) {
    if (method.control == StepControl::adaptive || method.find_unsuitable != nullptr) continue;
    ++count;
    for (const int order : orders(method))
      for (const Problem& problem : kProblems)
        for (const char* way : kWays) {
          // the error is a thousandth to a billionth, well above rounding
          const double step = order == 1 ? 1.0 / 512 : order <= 3 ? 1.0 / 64 : order <= 5 ? 1.0 / 16 : 1.0 / 8;
          const auto at = [&](double h) {
            return error(problem.turnings, way, method_lines(method, h, method.max_order == 0 ? 0 : order), 2.0);
          };
          EXPECT_NEAR(std::log2(at(step) / at(step / 2)), order, 0.2)
              << method.name << " of order " << order << ", " << way << ", " << problem.name;
        }
  }
  EXPECT_EQ(count, 8);
}

// Error-controlled methods choose their steps; the first one is given here, and is the whole run.
TEST(RotationOrder, OfErrorControlledMethodsOverAStep) {
  int count = 0;
  for (const MethodInfo& method : methods()) {
    if (method.control != StepControl::adaptive || method.find_unsuitable != nullptr) continue;
    if (chooses_its_order(method)) continue;
    ++count;
    for (const int order : orders(method))
      for (const Problem& problem : kProblems)
        for (const char* way : kWays) {
          const double step = order <= 3 ? 1.0 / 32 : order <= 5 ? 1.0 / 16 : 5.0 / 16;
          const auto at = [&](double h) {
            return error(problem.turnings, way, method_lines(method, h, method.max_order == 0 ? 0 : order), h, 1);
          };
          EXPECT_NEAR(std::log2(at(step) / at(step / 2)), order + 1, 0.45)
              << method.name << " of order " << order << ", " << way << ", " << problem.name;
        }
  }
  EXPECT_EQ(count, 9);
}

// Where the order is chosen from the tolerance, or changes from step to step, the error follows the tolerance.
TEST(RotationOrder, WhereTheMethodChoosesItTheErrorFollowsTheTolerance) {
  int count = 0;
  for (const MethodInfo& method : methods()) {
    if (method.order != 0 || method.control != StepControl::adaptive || method.find_unsuitable != nullptr) continue;
    ++count;
    for (const Problem& problem : kProblems)
      for (const char* way : kWays) {
        const auto at = [&](double tolerance) {
          return error(problem.turnings, way, test::controlled(std::string(method.name), tolerance).lines, 10.0);
        };
        // as a power of the tolerance over five decades: measured from 0.66 to 1.17
        EXPECT_NEAR(std::log10(at(1e-5) / at(1e-10)) / 5.0, 0.95, 0.3)
            << method.name << ", " << way << ", " << problem.name;
      }
  }
  EXPECT_EQ(count, 4);
}

// No method moves the closed form by more than rounding, whatever its step.
TEST(RotationOrder, ClosedFormsAreExactWithEveryMethod) {
  for (const MethodInfo& method : methods()) {
    if (method.find_unsuitable != nullptr) continue;
    EXPECT_LE(error(kFree, "exact", method_lines(method, 0.5, 0), 2.0), 1e-14) << method.name;
  }
}

// The rate of an orientation depends on the orientation: neither a method that integrates over time alone nor one that
// moves positions and velocities in turn goes with any way of carrying it.
TEST(RotationOrder, MethodsThatNoWaySuitsAreErrorsInTheirPlace) {
  const struct {
    const char* body;
    const char* place;
    bool has_law;
  } cases[] = {
      {"angular_velocity = [1, 0, 0.5]\nangular_acceleration = [0, 0, \"t\"]\n", "test.toml:12:25: error: ", true},
      {"inertia = [1, 2, 2.5]\nangular_velocity = [1, 0, 0.5]\ntorque_body = [0, 0, 1]\n",
       "test.toml:13:16: error: ", true},
      {"inertia = [1, 2, 2.5]\nangular_velocity = [1, 0, 0.5]\n", "test.toml:10:8: error: ", false},
  };
  int count = 0;
  for (const MethodInfo& method : methods()) {
    if (method.find_unsuitable == nullptr) continue;
    ++count;
    for (const OrientationInfo& way : orientation_ways())
      for (const auto& c : cases) {
        if (way.way == OrientationWay::exact && c.has_law) continue;
        const std::string text = scene({c.body, nullptr}, std::string(way.name), method_lines(method, 0.1, 0), 1.0);
        try {
          test::run_text(text);
          ADD_FAILURE() << method.name << " goes with " << way.name;
        } catch (const InputError& error) {
          const std::string expected = c.place + ("method '" + std::string(method.name)) +
                                       "' cannot integrate this: the rotation of body 'b' depends on ";
          EXPECT_TRUE(std::string(error.what()).starts_with(expected)) << error.what();
        }
      }
  }
  EXPECT_EQ(count, 4);
}

}  // namespace
}  // namespace trajet
