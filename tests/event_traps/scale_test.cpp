// The same motion in nanometres and in light years, in picoseconds and in ages: what happens is the same.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "event_traps/tolerated_methods.hpp"
#include "scene_run.hpp"

namespace trajet {
namespace {

using test::number;
using test::run_text;
using test::ToleratedWay;
using Real = long double;

/// A bead on a damped spring beside a wall that it bounces off: x'' = -w^2 x - c x' + g, a wall at x = -d. In closed
/// form from bounce to bounce.
struct Bead {
  Real w, c, g, d, restitution, x, v;

  struct Bounce {
    Real time, speed_before, speed_after;
  };
  struct Motion {
    std::vector<Bounce> bounces;
    Real x, v;
    Real margin;  // of what decides whether it comes to the wall: a height over it, or a speed towards it
  };

  Motion exact(Real end) const {
    Motion motion{{}, x, v, 1.0L};
    const Real middle = g / (w * w), turning = std::sqrt(w * w - c * c / 4);
    for (Real start = 0;;) {
      const Real a = motion.x - middle, b = (motion.v + c / 2 * a) / turning;
      const auto place = [&](Real t) {
        return middle + std::exp(-c / 2 * t) * (a * std::cos(turning * t) + b * std::sin(turning * t));
      };
      const auto speed = [&](Real t) {
        return std::exp(-c / 2 * t) *
               ((turning * b - c / 2 * a) * std::cos(turning * t) - (turning * a + c / 2 * b) * std::sin(turning * t));
      };
      const Real step = 0.01L / w;
      Real before = 0, after = 0;
      bool is_above = start == 0;
      for (Real t = 0; after == 0 && start + t < end; t += step) {
        const Real height = place(t + step) + d;
        is_above = is_above || height > 1e-3L;
        if (height <= 0 && is_above) before = t, after = t + step;
        if (speed(t) < 0 && speed(t + step) >= 0) motion.margin = std::min(motion.margin, std::abs(height));
      }
      if (after != 0)
        for (int i = 0; i < 70; ++i) {
          const Real half = (before + after) / 2;
          (place(half) + d > 0 ? before : after) = half;
        }
      if (after == 0 || start + after >= end) {
        const Real rest = end - start;
        motion.x = place(rest);
        motion.v = speed(rest);
        return motion;
      }
      motion.margin = std::min({motion.margin, -speed(after), std::abs(end - start - after)});
      motion.bounces.push_back({start + after, -speed(after), -restitution * speed(after)});
      motion.x = -d;
      motion.v = motion.bounces.back().speed_after;
      start += after;
    }
  }
};

std::vector<ToleratedWay> ways_for(double end) {
  std::vector<ToleratedWay> ways{{{"taylor", "name = \"taylor\"\n"}, 1e-9},
                                 {{"taylor-extended", "name = \"taylor-extended\"\n"}, 1e-9},
                                 {{"dopri5", "name = \"dopri5\"\n"}, 1e-8},
                                 {{"dop853", "name = \"dop853\"\n"}, 1e-8},
                                 {{"rodas5p", "name = \"rodas5p\"\nrtol = 1e-10\n"}, 1e-6},
                                 {{"adams", "name = \"adams\"\n"}, 1e-6},
                                 {{"bdf", "name = \"bdf\"\nrtol = 1e-10\n"}, 1e-4},
                                 {{"bs32", "name = \"bs32\"\nrtol = 1e-8\n"}, 1e-4},
                                 {{"rosenbrock23", "name = \"rosenbrock23\"\nrtol = 1e-7\n"}, 2e-3},
                                 {{"trapezoid", "name = \"trapezoid\"\nrtol = 1e-7\n"}, 2e-3},
                                 {{"tr-bdf2", "name = \"tr-bdf2\"\nrtol = 1e-7\n"}, 2e-3}};
  for (const auto& [name, tolerance] : std::initializer_list<std::pair<const char*, double>>{
           {"rk4", 1e-5}, {"rk4-3/8", 1e-5}, {"gauss6", 1e-7}, {"series", 1e-5}, {"rk4-doubling", 1e-4}})
    ways.push_back({test::fixed(name, end / 1000.0), tolerance});
  return ways;
}

/// A random bead whose bounces are decided by far more than what methods are off by.
class Case {
 public:
  explicit Case(std::mt19937& random) : random_(random) {
    do {
      bead = {uniform(0.7, 1.5), uniform(0.0, 0.3), uniform(-0.2, 0.3), uniform(0.3, 0.9),
              uniform(0.3, 1.0), uniform(0.2, 1.2), uniform(-1.0, 1.0)};
      if (uniform(0.0, 1.0) < 0.3) bead.v = 0;
      motion = bead.exact(kEnd);
    } while (motion.bounces.empty() || motion.margin < 0.03L);
    normal = Vector3(uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0)).normalized();
    if (uniform(0.0, 1.0) < 0.3) normal = Vector3::UnitX();
  }

  /// In units of a length (m) and a time (s).
  std::string text(double length, double time, const std::string& method) const {
    const auto n = [](Real value) { return number(static_cast<double>(value)); };
    const auto vector = [](const Vector3& v) {
      return "[" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + "]";
    };
    const auto along = [&](Real value) { return vector(static_cast<double>(value) * normal); };
    return "[time]\nend = " + n(kEnd * time) + "\n[method]\n" + method +
           "[[body]]\nname = \"bead\"\nposition = " + along(bead.x * length) +
           "\nvelocity = " + along(bead.v * length / time) + "\nacceleration = \"-" + n(bead.w * bead.w / time / time) +
           "*r - " + n(bead.c / time) + "*v + " + along(bead.g * length / time / time) +
           "\"\n[[obstacle]]\nname = \"wall\"\nshape = \"plane\"\npoint = " + along(-bead.d * length) +
           "\nnormal = " + vector(normal) + "\non_hit = \"bounce\"\nrestitution = " + n(bead.restitution) + "\n";
  }

  static constexpr double kEnd = 20.0;
  Bead bead{};
  Bead::Motion motion{};
  Vector3 normal{};

 private:
  double uniform(double a, double b) { return a + (b - a) * (static_cast<double>(random_()) / 4294967296.0); }
  std::mt19937& random_;
};

TEST(Scales, ImpactsAreTheSameInEveryUnit) {
  std::mt19937 random(15);
  std::uniform_real_distribution<> power(-12.0, 12.0);
  std::size_t bounces = 0;
  for (std::size_t i = 0; i < 1200; ++i) {
    const Case the(random);
    const double length = std::pow(10.0, power(random));
    const double time = i % 2 == 0 ? 1.0 : std::pow(10.0, power(random));
    const std::vector<ToleratedWay> ways = ways_for(Case::kEnd * time);
    const ToleratedWay& way = ways[i % ways.size()];
    const std::string text = the.text(length, time, way.way.lines);
    SCOPED_TRACE(text);
    const RunResult result = run_text(text);
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
    ASSERT_EQ(result.impacts.size(), the.motion.bounces.size());
    for (std::size_t k = 0; k < result.impacts.size(); ++k) {
      const Bead::Bounce& exact = the.motion.bounces[k];
      const Impact& impact = result.impacts[k];
      ASSERT_EQ(impact.kind, ImpactKind::hit);
      ASSERT_NEAR(impact.time / time, static_cast<double>(exact.time), 100.0 * way.tolerance);
      const double unit = length / time;
      ASSERT_NEAR(impact.velocity_before.norm() / unit, static_cast<double>(exact.speed_before), 100.0 * way.tolerance);
      ASSERT_NEAR(impact.velocity_after.norm() / unit, static_cast<double>(exact.speed_after), 100.0 * way.tolerance);
      ++bounces;
    }
    const BodyState& final = test::final_of(result, "bead");
    ASSERT_NEAR(final.position.dot(the.normal) / length, static_cast<double>(the.motion.x), 100.0 * way.tolerance);
    ASSERT_NEAR(final.velocity.dot(the.normal) * time / length, static_cast<double>(the.motion.v),
                100.0 * way.tolerance);
  }
  EXPECT_GT(bounces, 1500u);
}

}  // namespace
}  // namespace trajet
