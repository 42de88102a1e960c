// on_hit = "stick": the body stays where it has hit, and moves as the obstacle does.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "body_scene.hpp"
#include "scene_run.hpp"

namespace trajet {
namespace {

using test::error_of;
using test::final_of;
using test::impacts_of;
using test::number;
using test::run_text;

const std::string kWall =
    "[[obstacle]]\nname = \"wall\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [-1, 0, 0]\non_hit = \"stick\"\n";

TEST(Stick, ABallStaysAndTheRunGoesOn) {
  const RunResult result = run_text(
      "[time]\nend = 4\n[[body]]\nname = \"mud\"\nshape = \"sphere\"\nradius = 0.1\nmass = 0.5\nposition = [-2.1, 0, "
      "1]\n"
      "velocity = [2, 0, 3]\nangular_velocity = [1, 2, 3]\nacceleration = [0, 0, -1]\n"
      "[[body]]\nname = \"other\"\nvelocity = [0, 1, 0]\nposition = [-5, 0, 0]\n[[state]]\nname = \"q\"\nvalue = "
      "1\nrate = "
      "\"-q\"\n[[event]]\nname = \"late\"\nwhen = \"t - 3\"\n" +
      kWall);
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  ASSERT_EQ(result.impacts.size(), 1u);
  const Impact& impact = result.impacts[0];
  EXPECT_EQ(impact.kind, ImpactKind::stick);
  EXPECT_NEAR(impact.time, 1.0, 1e-14);
  EXPECT_EQ(impact.with, "wall");
  EXPECT_LE((impact.velocity_before - Vector3(2, 0, 2)).norm(), 1e-13);
  EXPECT_EQ(impact.velocity_after, Vector3(0, 0, 0));
  EXPECT_EQ(impact.angular_velocity_after, Vector3(0, 0, 0));
  EXPECT_LE((impact.impulse - Vector3(-1, 0, -1)).norm(), 1e-13);
  ASSERT_EQ(result.contacts.size(), 1u);
  EXPECT_EQ(result.contacts[0].mode, ImpactKind::stick);
  EXPECT_NEAR(result.contacts[0].from, 1.0, 1e-14);
  EXPECT_FALSE(result.contacts[0].to);
  const BodyState& mud = final_of(result, "mud");
  EXPECT_LE((mud.position - Vector3(-0.1, 0, 3.5)).norm(), 1e-13);
  EXPECT_EQ(mud.position, impact.position);
  EXPECT_EQ(mud.velocity, Vector3(0, 0, 0));
  EXPECT_EQ(mud.acceleration, Vector3(0, 0, 0));
  EXPECT_EQ(mud.angular_velocity, Vector3(0, 0, 0));
  EXPECT_NEAR(final_of(result, "other").position.y(), 4.0, 1e-13);
  EXPECT_NEAR(test::state_of(result, "q"), std::exp(-4.0), 1e-12);
  ASSERT_EQ(result.events.size(), 1u);
  EXPECT_NEAR(result.events[0].time, 3.0, 1e-13);
}

// A point, a ball and a box on a board that rises and turns: what is fixed in it moves as p(t) = c + u t + R(t) s.
TEST(Stick, BodiesMoveAsTheObstacleDoes) {
  const char* const bodies[] = {
      "position = [-2, 0, 0]\n", "shape = \"sphere\"\nradius = 0.1\nposition = [-2, 0.1, 0.2]\n",
      "shape = \"box\"\nsize = [0.2, 0.1, 0.3]\nmass = 2\nposition = [-2, 0, 0.1]\nangular_velocity = [1, 3, -2]\n",
      "shape = \"disk\"\nradius = 0.2\nmass = 2\nposition = [-2, 0, 0.1]\nangular_velocity = [1, 3, -2]\n"};
  const char* const boards[] = {
      "center = [0, 0, 0]\nvelocity = [0, 0.1, 0.5]\nangular_velocity = [0, 0, 0.7]\n",
      "center = [0, \"0.1*t\", \"0.5*t\"]\norientation = {axis = [0, 0, 1], angle = \"0.7*t\"}\n"};
  for (const char* body : bodies)
    for (const char* board : boards)
      for (const char* way : {"quaternion-normalized", "matrix", "rotation-vector", "exact"}) {
        const RunResult result = run_text("[time]\nend = 3\n[method]\norientation = \"" + std::string(way) +
                                          "\"\n[[body]]\nname = \"b\"\nvelocity = [4, 0, 0]\n" + body +
                                          "[[obstacle]]\nname = \"board\"\nshape = \"box\"\nsize = [0.2, 3, 3]\non_hit "
                                          "= \"stick\"\n" +
                                          board);
        ASSERT_EQ(result.status, RunStatus::finished) << body << board << result.failure;
        ASSERT_EQ(result.impacts.size(), 1u) << body << board << way;
        const Impact& impact = result.impacts[0];
        ASSERT_EQ(impact.kind, ImpactKind::stick);
        const Vector3 u(0, 0.1, 0.5), w(0, 0, 0.7);
        const double t = impact.time;
        const auto turned = [&](double angle) { return Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix(); };
        const Vector3 arm = turned(0.7 * (3.0 - t)) * (impact.position - t * u);
        const BodyState& b = final_of(result, "b");
        EXPECT_LE((b.position - (3.0 * u + arm)).norm(), 1e-11) << body << board << way;
        EXPECT_LE((b.velocity - (u + w.cross(arm))).norm(), 1e-11) << body << board << way;
        EXPECT_LE((b.acceleration - w.cross(w.cross(arm))).norm(), 1e-11) << body << board << way;
        EXPECT_LE((b.angular_velocity - w).norm(), 1e-11) << body << board << way;
        EXPECT_LE((impact.velocity_after - (u + w.cross(Vector3(impact.position - t * u)))).norm(), 1e-12);
        ASSERT_TRUE(b.position_error_bound);
        EXPECT_LE((b.position - (3.0 * u + arm)).norm(), *b.position_error_bound + 1e-13);
      }
}

TEST(Stick, OrientationIsKeptAgainstTheObstacle) {
  const auto at = [&](double end) {
    return final_of(
        run_text(
            "[time]\nend = " + number(end) +
            "\n[[body]]\nname = \"b\"\nshape = \"box\"\nsize = [0.2, 0.1, 0.3]\nmass = 2\nposition = [-1, 0, 0.1]\n"
            "velocity = [4, 0, 0]\nangular_velocity = [1, 3, -2]\n[[obstacle]]\nname = \"board\"\nshape = \"box\"\n"
            "size = [0.2, 3, 3]\ncenter = [0, 0, 0]\norientation = {axis = [1, 2, 2], angle = \"sin(t)\"}\non_hit = "
            "\"stick\"\n"),
        "b");
  };
  const auto board = [](double t) { return Eigen::AngleAxisd(std::sin(t), Vector3(1, 2, 2) / 3.0).toRotationMatrix(); };
  const Matrix3 first = board(1.0).transpose() * at(1.0).rotation_matrix;
  const Matrix3 later = board(2.5).transpose() * at(2.5).rotation_matrix;
  EXPECT_LE((first - later).norm(), 1e-11);
}

TEST(Stick, PairsSayItOfOneBody) {
  const RunResult result = run_text(
      "[time]\nend = 3\n[[body]]\nname = \"gum\"\nposition = [-1, 0, 0]\nvelocity = [1, 0, 0]\n[[body]]\nname = "
      "\"ball\"\nposition = [-1, 1, 0]\nvelocity = [1, 0, 0]\n[[obstacle]]\nname = \"wall\"\nshape = \"plane\"\npoint "
      "= "
      "[0, 0, 0]\nnormal = [-1, 0, 0]\non_hit = \"bounce\"\n[[pair]]\nof = [\"gum\", \"wall\"]\non_hit = \"stick\"\n");
  EXPECT_LE(final_of(result, "gum").position.norm(), 1e-13);
  EXPECT_NEAR(final_of(result, "ball").position.x(), -2.0, 1e-13);
}

TEST(Stick, AnEventThatSetsTheBodyLetsItGo) {
  const RunResult result = run_text(
      "[time]\nend = 4\n[[body]]\nname = \"b\"\nshape = \"sphere\"\nradius = 0.1\nposition = [-1.1, 0, 0]\nvelocity = "
      "[1, "
      "0, 0]\n[[event]]\nname = \"pull\"\nwhen = \"t - 2\"\nset = {b.v = [-3, 0, 1]}\n" +
      kWall);
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  ASSERT_EQ(result.impacts.size(), 2u);
  EXPECT_EQ(result.impacts[1].kind, ImpactKind::leave);
  EXPECT_NEAR(result.impacts[1].time, 2.0, 1e-13);
  ASSERT_EQ(result.contacts.size(), 1u);
  EXPECT_NEAR(result.contacts[0].to.value(), 2.0, 1e-13);
  EXPECT_LE((final_of(result, "b").position - Vector3(-6.1, 0, 2)).norm(), 1e-12);
}

// What sticks is as firm as what it sticks to: an elastic ball comes back from it.
TEST(Stick, OthersBounceOffIt) {
  for (const char* mass : {"", "mass = 3\n"}) {
    const RunResult result = run_text(
        "[time]\nend = 4\n[[body]]\nname = \"b\"\nshape = \"sphere\"\nradius = 0.1\nposition = [-1.1, 0, 0]\nvelocity "
        "= "
        "[1, 0, 0]\n" +
        std::string(mass) +
        "[[body]]\nname = \"ball\"\nshape = \"sphere\"\nradius = 0.1\nmass = 1\nposition = [-2.3, 0, 0]\nvelocity = "
        "[1, "
        "0, 0]\n" +
        kWall);
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    const auto hits = impacts_of(result, ImpactKind::hit);
    ASSERT_EQ(hits.size(), 1u);
    EXPECT_NEAR(hits[0]->time, 2.0, 1e-13);
    EXPECT_NEAR(final_of(result, "ball").position.x(), -2.3, 1e-12);
    EXPECT_NEAR(final_of(result, "b").position.x(), -0.1, 1e-13);
  }
}

// In a corner it sticks to what it meets first; of two at once it sticks, whatever the other is.
TEST(Stick, AtOneInstantItGoesBeforeABounce) {
  for (const bool first : {true, false}) {
    const std::string floor =
        "[[obstacle]]\nname = \"floor\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\non_hit = "
        "\"bounce\"\n";
    const RunResult result = run_text(
        "[time]\nend = 4\n[[body]]\nname = \"b\"\nshape = \"sphere\"\nradius = 0.25\nposition = [-1.25, 0, "
        "1.25]\nvelocity "
        "= [1, 0, -1]\n" +
        (first ? kWall + floor : floor + kWall));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    ASSERT_EQ(impacts_of(result, ImpactKind::stick).size(), 1u);
    EXPECT_LE((final_of(result, "b").position - Vector3(-0.25, 0, 0.25)).norm(), 1e-13);
  }
}

// Pressed on it at the start.
TEST(Stick, WhatLiesOnItSticks) {
  for (const char* body : {"shape = \"sphere\"\nradius = 0.5\n", "shape = \"box\"\nsize = [1, 1, 1]\nmass = 1\n"}) {
    const RunResult result =
        run_text("[time]\nend = 1\n[[body]]\nname = \"b\"\nposition = [0, 0, 0.5]\nacceleration = [1, 0, -9.81]\n" +
                 std::string(body) +
                 "[[obstacle]]\nname = \"floor\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\non_hit = "
                 "\"stick\"\n");
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    EXPECT_EQ(final_of(result, "b").position, Vector3(0, 0, 0.5)) << body;
    EXPECT_EQ(impacts_of(result, ImpactKind::stick).size(), 1u);
  }
}

TEST(Stick, BodiesDoNotStickToEachOther) {
  const std::string message = error_of(
      "[time]\nend = 1\n[[body]]\nname = \"a\"\nmass = 1\n[[body]]\nname = \"b\"\nshape = \"sphere\"\nradius = "
      "0.1\nmass = "
      "1\nposition = [1, 0, 0]\n[[pair]]\nof = [\"a\", \"b\"]\non_hit = \"stick\"\n");
  EXPECT_TRUE(message.starts_with("s:13:6")) << message;
  EXPECT_NE(message.find("cannot stick to each other"), std::string::npos) << message;
}

}  // namespace
}  // namespace trajet
