#include "trajet/rigid/body_point_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "scene_run.hpp"
#include "trajet/math/bernstein.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
const Vector3 kPoint(0.3, -0.2, 0.5);
constexpr double kFar = 40.0;  // m; how far the body comes

/// Looks at each step of a body that flies and turns.
struct Onlooker : RunObserver {
  void begin(const World& w) override { world = &w; }

  void motion(const MotionPiece& piece) override {
    const World::Body& body = world->bodies[0];
    const OrientationLayout& layout = body.rotation->layout;
    const BodyPointPath path(piece.segment, body.offset, body.rotation->offset, layout, kPoint);
    EXPECT_EQ(path.t0(), piece.segment.t0());
    EXPECT_EQ(path.t1(), piece.segment.t1());
    const auto degree = static_cast<Eigen::Index>(piece.segment.degree());
    if (layout.way == OrientationWay::matrix) {
      EXPECT_EQ(path.numerator().cols(), degree + 1);
    } else if (layout.way != OrientationWay::rotation_vector) {
      EXPECT_EQ(path.numerator().cols(), 3 * degree + 1);
      EXPECT_EQ(path.denominator().size(), 2 * degree + 1);
    }
    const std::span<const double> denominator(path.denominator().data(),
                                              static_cast<std::size_t>(path.denominator().size()));
    const Range range = BernsteinForm(denominator, 0.0, path.t1() - path.t0()).value_range();
    smallest_denominator = std::min(smallest_denominator, range.lower);
    for (int k = 0; k <= 16; ++k) {
      const double t = piece.from + (piece.to - piece.from) * k / 16.0, tau = t - path.t0();
      const Eigen::VectorXd q = piece.segment.state(t);
      const Matrix3 R = layout.rotation(q.data() + body.rotation->offset);
      off = std::max(off, (path.position(tau) - (q.segment<3>(body.offset) + R * kPoint)).norm());
      const Quaternion reported = layout.quaternion(piece.state(t).data() + body.rotation->offset);
      if (layout.way != OrientationWay::matrix) unit = std::max(unit, std::abs(reported.norm() - 1.0));
      const double h = 1e-5 * (path.t1() - path.t0());
      const Vector3 difference = (path.position(tau + h) - path.position(tau - h)) / (2.0 * h);
      velocity_off = std::max(velocity_off, (path.velocity(tau) - difference).norm());
    }
    const double from = piece.from - path.t0(), to = piece.to - path.t0();
    if (end_position) {
      position_jump = std::max(position_jump, (path.position(from) - *end_position).norm());
      velocity_jump = std::max(velocity_jump, (path.velocity(from) - *end_velocity).norm());
    }
    end_position = path.position(to);
    end_velocity = path.velocity(to);
    ++steps;
  }

  const World* world = nullptr;
  std::optional<Vector3> end_position, end_velocity;
  double off = 0.0, velocity_off = 0.0, unit = 0.0, position_jump = 0.0, velocity_jump = 0.0,
         smallest_denominator = 1.0;
  int steps = 0;
};

std::string scene(const std::string& method, const std::string& way) {
  return "[time]\nend = 3\n[method]\n" + method + "orientation = \"" + way +
         "\"\n[[body]]\nname = \"b\"\nposition = [1, 2, 3]\nvelocity = [1, 0, 2]\nacceleration = [0, 0, -9.8]\n"
         "inertia = [1, 2, 2.5]\nangular_velocity = [1, -2, 0.5]\ntorque = [0, \"sin(t)\", \"Rxx\"]\n";
}

const char* const kMethods[] = {"euler", "rk4", "dopri5", "dop853", "taylor", "gauss6", "rodas5p"};

Onlooker look(const std::string& method, const std::string& way) {
  Onlooker onlooker;
  test::run_text(scene("name = \"" + method + "\"\nstep = 0.05\nrtol = 1e-7\natol = 1e-7\n", way), &onlooker);
  EXPECT_GE(onlooker.steps, 3) << method;
  return onlooker;
}

TEST(BodyPointPath, IsTheDenseOutputToRounding) {
  for (const char* method : kMethods)
    for (const char* way : {"quaternion-normalized", "quaternion", "matrix", "rotation-vector"}) {
      const Onlooker onlooker = look(method, way);
      EXPECT_LE(onlooker.off, 4 * kEpsilon * kFar) << method << " " << way;
      EXPECT_LE(onlooker.velocity_off, 1e-6) << method << " " << way;  // the differences' own error, measured 7e-8
      EXPECT_GT(onlooker.smallest_denominator, 0.4) << method << " " << way;
    }
}

// A quaternion divided by its length at the end of a step is the same rotation, and so is its rate.
TEST(BodyPointPath, GoesOnSmoothlyFromStepToStep) {
  for (const char* method : kMethods)
    for (const char* way : {"quaternion-normalized", "quaternion", "matrix", "rotation-vector"}) {
      const Onlooker onlooker = look(method, way);
      EXPECT_LE(onlooker.position_jump, 4 * kEpsilon * kFar) << method << " " << way;
      // the rates at the ends are those of the law with these, to rounding; with the series method to its tolerance
      const std::string name = method;
      const double bound = name == "rk4" || name == "dopri5" || name == "dop853" ? 1e-12
                           : name == "taylor"                                    ? 1e-7
                                                                                 : 1.0;
      EXPECT_LE(onlooker.velocity_jump, bound) << method << " " << way;
    }
}

TEST(BodyPointPath, TheReportedOrientationIsUnitWithinSteps) {
  for (const char* method : kMethods)
    for (const char* way : {"quaternion-normalized", "rotation-vector"})
      EXPECT_LE(look(method, way).unit, 2 * kEpsilon) << method << " " << way;
}

}  // namespace
}  // namespace trajet
