// Scenes that once went wrong, with what should come of them: from closed forms, or computed beside them here.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "scene_run.hpp"
#include "trajet/law/lookup_table.hpp"

namespace trajet {
namespace {

using test::number;
using test::run_text;

constexpr const char* kGround =
    "[[obstacle]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\non_hit = \"bounce\"\n";

std::vector<ImpactKind> kinds_of(const RunResult& result) {
  std::vector<ImpactKind> kinds;
  for (const Impact& impact : result.impacts) kinds.push_back(impact.kind);
  return kinds;
}

/// A ball that nothing pulls, between planes: a straight line from bounce to bounce.
struct FreeBall {
  struct Plane {
    const char* name;
    Vector3 point, normal;
    double restitution;
  };
  struct Hit {
    double time;
    const char* with;
  };

  static std::vector<Hit> hits(Vector3 r, Vector3 v, double radius, double end, const std::vector<Plane>& planes) {
    std::vector<Hit> all;
    for (double t = 0.0;;) {
      double first = end - t;
      const Plane* met = nullptr;
      for (const Plane& plane : planes) {
        const double speed = v.dot(plane.normal), height = (r - plane.point).dot(plane.normal) - radius;
        // what it slides along it does not meet
        if (speed < -1e-9 && -height / speed < first) first = -height / speed, met = &plane;
      }
      if (met == nullptr) return all;
      t += first;
      r += first * v;
      v -= (1.0 + met->restitution) * v.dot(met->normal) * met->normal;
      all.push_back({t, met->name});
    }
  }
};

TEST(ReportedScenes, ABallBetweenThreePlanesHitsWhatItMeets) {
  const Vector3 position(0.09772917708195683, 1.8114351839575433, 1.2085071365211064);
  const Vector3 velocity(-6.184045157534682, -1.6116652661854955, 1.9099102194647233);
  const std::vector<FreeBall::Plane> planes{{"w1",
                                             {-1.363985751278479, -0.2661297479335392, 2.0781525034448536},
                                             {0.5455943005113916, 0.10645189917341569, -0.8312610013779415},
                                             0.0},
                                            {"w2",
                                             {2.072381018349063, -0.5357586290937283, 1.2915880171858611},
                                             {-0.8289524073396253, 0.21430345163749132, -0.5166352068743445},
                                             0.9},
                                            {"w3",
                                             {-2.072381018349063, 0.5357586290937283, -1.2915880171858611},
                                             {0.8289524073396253, -0.21430345163749132, 0.5166352068743445},
                                             0.9}};
  const auto vector = [](const Vector3& v) {
    return "[" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + "]";
  };
  std::string text = "[[body]]\nname = \"p\"\nshape = \"sphere\"\nradius = 0.2\nposition = " + vector(position) +
                     "\nvelocity = " + vector(velocity) + "\n";
  for (const FreeBall::Plane& plane : planes)
    text += std::string("[[obstacle]]\nname = \"") + plane.name +
            "\"\nshape = \"plane\"\npoint = " + vector(plane.point) + "\nnormal = " + vector(plane.normal) +
            "\non_hit = \"bounce\"\nrestitution = " + number(plane.restitution) + "\n";
  const std::vector<FreeBall::Hit> exact = FreeBall::hits(position, velocity, 0.2, 4.0, planes);
  ASSERT_GT(exact.size(), 3u);
  for (const char* method : {"rodas5p", "taylor", "dopri5", "bdf", "trapezoid"}) {
    const RunResult result = run_text("[time]\nend = 4\nsample = 4\n[method]\nname = \"" + std::string(method) +
                                      "\"\nrtol = 1e-8\natol = 1e-8\n" + text);
    ASSERT_EQ(result.status, RunStatus::finished) << method << result.failure;
    ASSERT_EQ(result.impacts.size(), exact.size()) << method;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      EXPECT_EQ(result.impacts[i].with, exact[i].with) << method << i;
      EXPECT_NEAR(result.impacts[i].time, exact[i].time, 1e-7) << method << i;
    }
  }
}

TEST(ReportedScenes, WhatLiesOnTheGroundRests) {
  const RunResult result =
      run_text(std::string("[time]\nend = 1\n[[body]]\nname = \"p\"\nacceleration = [0, 0, -9.8]\n") + kGround);
  EXPECT_EQ(kinds_of(result), std::vector{ImpactKind::rest});
  EXPECT_EQ(test::final_of(result, "p").position, Vector3::Zero());
}

TEST(ReportedScenes, TwoPlanesWithoutRestitutionLeaveWhatLiesAlongBoth) {
  const RunResult result = run_text(
      "[time]\nend = 10\n[[body]]\nname = \"p\"\nposition = [1, 1, 1]\nvelocity = [-3, -3, -3]\n[[obstacle]]\nname = "
      "\"w0\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [-1, 0, 2]\non_hit = \"bounce\"\nrestitution = "
      "0\n[[obstacle]]\nname = \"w1\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [1, 2, -1]\non_hit = "
      "\"bounce\"\nrestitution = 0\n");
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  ASSERT_EQ(result.impacts.size(), 2u);
  for (const Impact& impact : result.impacts) EXPECT_NEAR(impact.time, 1.0 / 3.0, 1e-14);
  // along the edge (-4, 1, -2): 15/21 of it
  const Vector3 left = 15.0 / 21.0 * Vector3(-4.0, 1.0, -2.0);
  EXPECT_LT((test::final_of(result, "p").velocity - left).norm(), 1e-13);
  EXPECT_LT((test::final_of(result, "p").position - left * (10.0 - 1.0 / 3.0)).norm(), 1e-12);
}

TEST(ReportedScenes, AStepThatIsFarTooLongEnds) {
  const RunResult result = run_text(
      "[time]\nend = 4\nsample = 4\n[method]\nname = \"rk4\"\nstep = 0.4\n[[body]]\nname = \"p\"\nposition = "
      "[0.5075037683264276, 1.1072145105238809, -1.7936086237507514]\nvelocity = [-25.88502996986124, "
      "23.620421386229108, -6.647005516629579]\nacceleration = \"-0.3*norm(v)*v\"\n[[obstacle]]\nname = \"w3\"\nshape "
      "= \"plane\"\npoint = [2.2258241664087115, -0.35777952312869593, -1.0806019586604347]\nnormal = "
      "[-0.8903296665634847, 0.14311180925147837, 0.43224078346417394]\non_hit = \"bounce\"\nrestitution = "
      "0\n[[obstacle]]\nname = \"w4\"\nshape = \"plane\"\npoint = [0.7341784085840597, 2.2649009664537663, "
      "0.7623684650651386]\nnormal = [-0.2936713634336239, -0.9059603865815065, -0.3049473860260554]\non_hit = "
      "\"bounce\"\nrestitution = 0\n[[obstacle]]\nname = \"w5\"\nshape = \"plane\"\npoint = [-0.7341784085840597, "
      "-2.2649009664537663, -0.7623684650651386]\nnormal = [0.2936713634336239, 0.9059603865815065, "
      "0.3049473860260554]\non_hit = \"bounce\"\nrestitution = 0.3\n");
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_FALSE(result.failure.empty());
  EXPECT_LT(result.statistics.steps, 10000);
}

TEST(ReportedScenes, AWallThinnerThanRoundingIsHit) {
  const RunResult result = run_text(
      "[time]\nend = 2\n[[body]]\nname = \"p\"\nposition = [-1e5, 0, 0]\nvelocity = [1e5, 0, 0]\n[[obstacle]]\nname = "
      "\"a\"\nshape = \"box\"\ncenter = [0, 0, 0]\nsize = [1e-9, 1, 1]\non_hit = \"bounce\"\n");
  ASSERT_EQ(kinds_of(result), std::vector{ImpactKind::hit});
  EXPECT_NEAR(result.impacts[0].time, 1.0, 1e-13);
  EXPECT_NEAR(test::final_of(result, "p").position.x(), -1e5, 1e-6);
}

TEST(ReportedScenes, ABeadOnAShakenTableIsThrownOffAndComesBack) {
  for (const double frequency : {5.0, 10.0, 20.0}) {
    const RunResult result = run_text("[parameters]\nA = \"5 mm\"\nf = \"" + number(frequency) + " Hz\"" +
                                      "\n[time]\nend = 5\n[[body]]\nname = \"bead\"\nacceleration = \"[0, 0, -9.81 + "
                                      "A*(2*pi*f)^2*sin(2*pi*f*t)]\"\n" +
                                      kGround + "restitution = 0.5\n");
    ASSERT_EQ(result.status, RunStatus::finished) << frequency << result.failure;
    const double w = 2.0 * std::numbers::pi * frequency, most = 0.005 * w * w;
    const auto hits = test::impacts_of(result, ImpactKind::hit), leaves = test::impacts_of(result, ImpactKind::leave);
    ASSERT_FALSE(result.impacts.empty());
    EXPECT_EQ(result.impacts.front().kind, ImpactKind::rest);
    EXPECT_EQ(hits.empty(), most < 9.81) << frequency;
    if (most < 9.81) continue;
    ASSERT_FALSE(leaves.empty());
    EXPECT_NEAR(leaves.front()->time, std::asin(9.81 / most) / w, 1e-9);
    EXPECT_GT(hits.size(), 10u);
    for (const Impact& impact : result.impacts) EXPECT_GT(impact.position.z(), -1e-9);
  }
}

TEST(ReportedScenes, ARocketWaitsOnItsPadFliesAndLands) {
  Scene scene = parse_scene(
      std::string(
          "[time]\nend = \"60 s\"\n[parameters]\nt0 = 8\n[[body]]\nname = \"rocket\"\nacceleration = [0, 0, 0]\n") +
          kGround + "restitution = 0\n[[event]]\nname = \"apogee\"\nwhen = \"rocket.vz\"\ndirection = \"falling\"\n",
      "test.toml");
  scene.tables["thrust"] = std::make_shared<const LookupTable>(
      std::vector{0.0,   0.02,  0.04,  0.065, 0.085, 0.105, 0.119, 0.136, 0.153, 0.173, 0.187, 0.198, 0.207,
                  0.226, 0.258, 0.326, 0.422, 0.549, 0.665, 0.776, 0.863, 0.940, 0.991, 1.002, 1.010, 1.03},
      std::vector{0.0,   0.418, 1.673, 4.076, 6.69,  9.304, 11.496, 12.75, 11.916, 10.666, 9.304, 7.214, 5.645,
                  4.809, 4.182, 3.763, 3.554, 3.345, 3.345, 3.345,  3.345, 3.449,  3.449,  2.404, 1.254, 0.0});
  scene.bodies[0].acceleration = Expression::parse(
      "[0, 0, -9.80665 + where(t > t0 and t < t0 + 1.03, table(\"thrust\", max(0, min(t - t0, 1.03)))/0.07, 0)] - "
      "0.5*1.225*0.0003/0.07*norm(v)*v");
  for (const char* method : {"taylor", "dopri5", "dop853"}) {
    scene.method.name = method;
    const RunResult result = run(scene);
    ASSERT_EQ(result.status, RunStatus::finished) << method << result.failure;
    ASSERT_EQ(kinds_of(result), (std::vector{ImpactKind::rest, ImpactKind::leave, ImpactKind::hit, ImpactKind::rest}))
        << method;
    EXPECT_EQ(result.impacts[0].time, 0.0);
    // by Runge and Kutta's method with steps of 1e-4 s from where the thrust outgrows the weight on
    EXPECT_NEAR(result.impacts[1].time, 8.0260024, 1e-7) << method;
    EXPECT_NEAR(result.impacts[2].time, 18.4756465853, 1e-8) << method;
    ASSERT_EQ(result.events.size(), 1u);
    EXPECT_NEAR(result.events[0].time, 13.1995109384, 1e-8) << method;
    EXPECT_NEAR(test::final_of(result, "rocket").position.z(), 0.0, 1e-9);
  }
}

TEST(ReportedScenes, ALiftLeavesWhereItsForceOutgrowsTheWeight) {
  const RunResult result = run_text(
      std::string("[time]\nend = 3\n[[body]]\nname = \"b\"\nacceleration = \"[0, 0, -9.80665 + 300*sin(t)]\"\n") +
      kGround + "restitution = 0\n");
  ASSERT_EQ(kinds_of(result), (std::vector{ImpactKind::rest, ImpactKind::leave}));
  EXPECT_NEAR(result.impacts[1].time, std::asin(9.80665 / 300.0), 1e-13);
}

TEST(ReportedScenes, AShortPulseIsFelt) {
  const double width = 1e-4;
  const double exact = std::exp(-2.0) + std::exp(-1.0) * std::expm1(width) / width;
  for (const char* method : {"taylor", "dopri5", "dop853", "rodas5p", "bdf"}) {
    const RunResult result =
        run_text("[parameters]\nwidth = 1e-4\n[time]\nend = 2\n[method]\nname = \"" + std::string(method) +
                 "\"\n[[state]]\nname = \"u\"\nvalue = 1\nrate = \"-u + where(t > 1 and t < 1 + "
                 "width, 1/width, 0)\"\n");
    EXPECT_NEAR(test::state_of(result, "u"), exact, 1e-8) << method;
  }
}

TEST(ReportedScenes, BothEventsOfACornerHappenEveryTime) {
  const RunResult result = run_text(
      "[time]\nend = 10\n[[body]]\nname = \"p\"\nposition = [0.25, 0.25, 0]\nvelocity = [1, 1, 0]\n[[event]]\nname = "
      "\"right\"\nwhen = \"p.x - 1\"\ndirection = \"rising\"\nset = { p.x = \"p.x - 1\" }\n[[event]]\nname = "
      "\"top\"\nwhen = \"p.y - 1\"\ndirection = \"rising\"\nset = { p.y = \"p.y - 1\" }\n");
  EXPECT_EQ(result.events.size(), 20u);
  EXPECT_LT((test::final_of(result, "p").position - Vector3(0.25, 0.25, 0.0)).norm(), 1e-12);
}

std::string bead(double scale, const std::string& method) {
  return "[parameters]\nsc = " + number(scale) + "\n[time]\nend = 10\n[method]\n" + method +
         "[[body]]\nname = \"bead\"\nposition = [\"sc\", 0, 0]\nacceleration = \"-(2*pi)^2*r - "
         "0.1*v\"\n[[obstacle]]\nname = \"wall\"\nshape = \"plane\"\npoint = [\"-0.5*sc\", 0, 0]\nnormal = [1, 0, "
         "0]\non_hit = \"bounce\"\nrestitution = 0.9\n";
}

TEST(ReportedScenes, ABeadOfAnySizeHitsItsWallEightTimes) {
  for (const double scale : {1e-100, 1e-15, 1e-12, 1e-9, 1e-3, 1.0, 1e3, 1e12, 1e100})
    for (const char* method : {"taylor", "taylor-extended", "dopri5", "dop853", "rodas5p", "adams", "bdf"}) {
      const RunResult result = run_text(bead(scale, "name = \"" + std::string(method) + "\"\n"));
      ASSERT_EQ(result.status, RunStatus::finished) << scale << method << result.failure;
      EXPECT_EQ(result.impacts.size(), 8u) << scale << method;
      EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
    }
}

TEST(ReportedScenes, AToleranceCoarserThanTheMotionIsSaidAndInventsNoImpacts) {
  for (const char* method : {"taylor", "dopri5", "dop853", "rodas5p", "bdf"}) {
    const RunResult result = run_text(bead(1e-15, "name = \"" + std::string(method) + "\"\natol = 1e-12\n"));
    EXPECT_TRUE(result.status == RunStatus::failed || result.impacts.size() <= 8u) << method;
    if (result.status == RunStatus::failed) {
      EXPECT_NE(result.failure.find("finer tolerance"), std::string::npos) << result.failure;
    }
    ASSERT_EQ(result.warnings.size(), 1u) << method;
    EXPECT_TRUE(result.warnings.front().starts_with("atol = 1e-12 is coarser than the motion of body 'bead'"))
        << result.warnings.front();
  }
}

}  // namespace
}  // namespace trajet
