// Solids that stay on flat faces: what their contacts keep, and the closed forms that are known of them.

#include <gtest/gtest.h>

#include <cmath>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::number;

constexpr double kGravity = 9.81;

std::string vector(const Vector3& v) { return "[" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + "]"; }

/// A box of 2 kg on a plane through the origin.
std::string box_scene(double end, const Vector3& size, const std::string& body, const Vector3& normal, double friction,
                      double restitution = 0.0) {
  return "[time]\nend = " + number(end) + "\n[[body]]\nname = \"box\"\nshape = \"box\"\nsize = " + vector(size) +
         "\nmass = 2\nforce = [0, 0, " + number(-2.0 * kGravity) + "]\n" + body +
         "[[obstacle]]\nname = \"floor\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = " + vector(normal) +
         "\non_hit = \"bounce\"\nrestitution = " + number(restitution) + "\nfriction = " + number(friction) + "\n";
}

TEST(LastingSolids, ABoxRestsWhereItStands) {
  const RunResult result =
      test::run_text(box_scene(100.0, {0.2, 0.4, 0.6}, "position = [0, 0, 0.3]\n", Vector3::UnitZ(), 0.4));
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  ASSERT_EQ(result.contacts.size(), 1u);
  EXPECT_EQ(result.contacts[0].mode, ImpactKind::rest);
  const BodyState& box = test::final_of(result, "box");
  EXPECT_NEAR((box.position - Vector3(0, 0, 0.3)).norm(), 0.0, 1e-14);
  EXPECT_NEAR(box.velocity.norm(), 0.0, 1e-14);
}

TEST(LastingSolids, ABoxThatSlidesStopsAfterTheWayOfAPoint) {
  const Vector3 velocity(1, 0.5, 0);
  const RunResult result = test::run_text(box_scene(
      2.0, {0.2, 0.4, 0.1}, "position = [0, 0, 0.05]\nvelocity = " + vector(velocity) + "\n", Vector3::UnitZ(), 0.4));
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  ASSERT_EQ(result.contacts.size(), 2u);
  EXPECT_EQ(result.contacts[0].mode, ImpactKind::slide);
  EXPECT_EQ(result.contacts[1].mode, ImpactKind::rest);
  const double stop = velocity.norm() / (0.4 * kGravity);
  EXPECT_NEAR(result.contacts[1].from, stop, 1e-13);
  const BodyState& box = test::final_of(result, "box");
  EXPECT_NEAR((box.position - Vector3(0, 0, 0.05) - 0.5 * stop * velocity).norm(), 0.0, 1e-13);
  EXPECT_NEAR(box.angular_velocity.norm(), 0.0, 1e-12);
}

// On an incline a box sticks below the angle of friction and slides above it; a tall one tips where the line of gravity
// leaves its base, tan(angle) > width / height.
TEST(LastingSolids, OnAnInclineABoxSticksSlidesOrTips) {
  const double angle = 0.4;
  const Vector3 normal(-std::sin(angle), 0, std::cos(angle)), down(-std::cos(angle), 0, -std::sin(angle));
  const std::string turned = "orientation = {axis = [0, 1, 0], angle = " + number(-angle) + "}\n";
  struct Case {
    double height, friction;
    ImpactKind mode;
  };
  for (const Case& c :
       {Case{0.2, 0.5, ImpactKind::rest}, Case{0.2, 0.3, ImpactKind::slide}, Case{1.2, 0.5, ImpactKind::roll}}) {
    SCOPED_TRACE(number(c.height) + " " + number(c.friction));
    const double end = 0.2;
    const RunResult result =
        test::run_text(box_scene(end, {0.4, 0.3, c.height},
                                 "position = " + vector(0.5 * c.height * normal) + "\n" + turned, normal, c.friction));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    ASSERT_EQ(result.contacts.size(), 1u);
    EXPECT_EQ(result.contacts[0].mode, c.mode);
    const BodyState& box = test::final_of(result, "box");
    const double pull = kGravity * (std::sin(angle) - c.friction * std::cos(angle));
    const double speed = c.mode == ImpactKind::slide ? pull * end : 0.0;
    if (c.mode != ImpactKind::roll) {
      EXPECT_NEAR((box.velocity - speed * down).norm(), 0.0, 1e-13);
    }
    // it turns about the lower edge, without loss
    if (c.mode == ImpactKind::roll) {
      const double inertia = 2.0 * (0.16 + c.height * c.height) / 12.0;
      const double energy = box.velocity.squaredNorm() + 0.5 * inertia * box.angular_velocity.squaredNorm() +
                            2.0 * kGravity * box.position.z();
      EXPECT_GT(box.angular_velocity.norm(), 0.1);
      EXPECT_NEAR(energy, kGravity * c.height * std::cos(angle), 1e-12);
    }
  }
}

// Housner's block: it rocks from edge to edge, and each impact leaves 1 - 3/2 sin^2(alpha) of its angular velocity,
// tan(alpha) = width / height, until it stands.
TEST(LastingSolids, ARockingBlockLosesWhatItsShapeSaysAndStands) {
  const double b = 0.1, h = 0.4, tilt = 0.1;
  // turned about its edge at x = b
  const Vector3 place(b - b * std::cos(tilt) + h * std::sin(tilt), 0, h * std::cos(tilt) + b * std::sin(tilt));
  const RunResult result = test::run_text(box_scene(
      20.0, {2.0 * b, 0.4, 2.0 * h},
      "position = " + vector(place) + "\norientation = {axis = [0, 1, 0], angle = 0.1}\n", Vector3::UnitZ(), 0.8));
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  const double kept = 1.0 - 1.5 * b * b / (b * b + h * h);
  const auto hits = test::impacts_of(result, ImpactKind::hit);
  ASSERT_GT(hits.size(), 20u);
  for (const Impact* hit : hits)
    EXPECT_NEAR(hit->angular_velocity_after.norm() / hit->angular_velocity_before.norm(), kept, 1e-9);
  EXPECT_EQ(result.contacts.back().mode, ImpactKind::rest);
  EXPECT_FALSE(result.contacts.back().to.has_value());
  EXPECT_NEAR(test::final_of(result, "box").position.z(), h, 1e-11);
  // quarter of a period from the tilt: (1/p) acosh(1/(1 - tilt/alpha)) for small angles, here to a percent
  const double alpha = std::atan(b / h), p = std::sqrt(0.75 * kGravity / std::hypot(b, h));
  EXPECT_NEAR(hits[0]->time, std::acosh(1.0 / (1.0 - tilt / alpha)) / p, 0.01 * hits[0]->time);
}

// Energy never grows, nothing sinks, and the same throw ends alike. Where a run ends because trajet cannot follow how
// corners stick and slide, it says so.
TEST(LastingSolids, ThrownDiceComeToRestOrSayWhyNot) {
  int at_rest = 0;
  constexpr int kThrows = 12;
  for (int k = 0; k < kThrows; ++k) {
    SCOPED_TRACE(k);
    const double a = 1.0 + 0.7 * k;
    const std::string text =
        "[time]\nend = 4\nsample = 0.01\n[[body]]\nname = \"die\"\nshape = \"box\"\nsize = [0.016, 0.016, 0.016]\n"
        "mass = 0.005\nforce = [0, 0, " +
        number(-0.005 * kGravity) +
        "]\nposition = [0, 0, 0.2]\nvelocity = " + vector({0.6 * std::cos(a), 0.6 * std::sin(a), 0.1}) +
        "\nangular_velocity = " + vector({20.0 * std::sin(3.0 * a), 31.0 * std::cos(5.0 * a), 13.0}) +
        "\n[[obstacle]]\nname = \"table\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"
        "on_hit = \"bounce\"\nrestitution = 0.4\nfriction = 0.35\n";
    struct Energy : RunObserver {
      double last = 1e300, grown = 0.0;
      void sample(const Sample& sample) override {
        const BodyState& die = sample.bodies[0];
        const double inertia = 0.005 * 0.016 * 0.016 / 6.0;
        const double energy = 0.0025 * die.velocity.squaredNorm() + 0.5 * inertia * die.angular_velocity.squaredNorm() +
                              0.005 * kGravity * die.position.z();
        grown = std::max(grown, energy - last);
        last = energy;
      }
    } energy;
    const RunResult result = test::run_text(text, &energy);
    // of 1e-2 J, by the tolerance of the steps
    EXPECT_LE(energy.grown, 1e-10);
    if (result.status == RunStatus::failed) {
      EXPECT_FALSE(result.failure.empty());
      continue;
    }
    ++at_rest;
    EXPECT_EQ(result.contacts.back().mode, ImpactKind::rest);
    const BodyState& die = test::final_of(result, "die");
    EXPECT_NEAR(die.position.z(), 0.008, 1e-9);
    EXPECT_NEAR(die.velocity.norm(), 0.0, 1e-9);
    // of an error that was carried through slides whose direction turns
    ASSERT_TRUE(die.position_error_bound.has_value());
    EXPECT_TRUE(std::isfinite(*die.position_error_bound));
  }
  // measured: 12 of these 12; of 80 random throws 70
  EXPECT_GE(at_rest, kThrows - 3) << at_rest;
}

}  // namespace
}  // namespace trajet
