// One watch and one Segment after another: what counts as a crossing, and that it counts once.

#include "trajet/event/event_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "trajet/law/program_builder.hpp"

namespace trajet {
namespace {

constexpr double kExact = 0.0;

Program program_of(const std::string& formula) {
  Symbols symbols;
  symbols.set_input("t", 0);
  symbols.set_input("x", 1);
  ProgramBuilder builder(2);
  builder.add_output(builder.compile_scalar(Expression::parse(formula, {}), symbols));
  return builder.build();
}

Segment<> segment_of(double t0, double t1, const std::vector<double>& x) {
  Segment<> segment;
  segment.resize(1, static_cast<int>(x.size()) - 1);
  segment.set_interval(t0, t1);
  segment.error_bound().setZero();
  for (std::size_t k = 0; k < x.size(); ++k) segment.coefficients()(0, static_cast<Eigen::Index>(k)) = x[k];
  return segment;
}

EventWatch watch_from(const std::string& formula, CrossingDirection direction, double t, double x) {
  EventWatch watch(program_of(formula), direction);
  watch.restart(t, &x, &x, &kExact);
  return watch;
}

TEST(EventWatch, DirectionsAreToldApart) {
  const Segment<> up_and_down = segment_of(0.0, 4.0, {-3.0, 4.0, -1.0});  // zero at 1 and 3
  for (const auto direction : {CrossingDirection::rising, CrossingDirection::falling, CrossingDirection::any}) {
    EventWatch watch = watch_from("x", direction, 0.0, -3.0);
    watch.search(up_and_down, 0.0);
    ASSERT_TRUE(watch.next().found);
    const bool is_second = direction == CrossingDirection::falling;
    EXPECT_NEAR(watch.next().time, is_second ? 3.0 : 1.0, 1e-14);
    EXPECT_EQ(watch.next().direction, is_second ? -1 : 1);
  }
}

TEST(EventWatch, ACrossingAtAJointCountsOnce) {
  EventWatch watch = watch_from("x", CrossingDirection::any, 0.0, -1.0);
  watch.search(segment_of(0.0, 1.0, {-1.0, 1.0}), 0.0);
  ASSERT_TRUE(watch.next().found);  // the rate tells where it goes
  EXPECT_EQ(watch.next().time, 1.0);
  EXPECT_EQ(watch.next().direction, 1);
  watch.take();
  watch.search(segment_of(1.0, 2.0, {0.0, 1.0}), 1.0);
  EXPECT_FALSE(watch.next().found);
}

TEST(EventWatch, TheNextSegmentTellsWhereRateAndCurvatureDoNot) {
  EventWatch watch = watch_from("x", CrossingDirection::any, 0.0, -1.0);
  watch.search(segment_of(0.0, 1.0, {-1.0, 3.0, -3.0, 1.0}), 0.0);  // (t - 1)^3
  EXPECT_FALSE(watch.next().found);
  watch.search(segment_of(1.0, 2.0, {0.0, 0.0, 0.0, 1.0}), 1.0);
  ASSERT_TRUE(watch.next().found);
  EXPECT_EQ(watch.next().direction, 1);
}

TEST(EventWatch, AStartOnZeroAndATouchAreNone) {
  EventWatch start = watch_from("x", CrossingDirection::any, 0.0, 0.0);
  start.search(segment_of(0.0, 1.0, {0.0, 1.0}), 0.0);
  EXPECT_FALSE(start.next().found);
  EventWatch touch = watch_from("x", CrossingDirection::any, 0.0, 0.25);
  touch.search(segment_of(0.0, 1.0, {0.25, -1.0, 1.0}), 0.0);
  EXPECT_FALSE(touch.next().found);
}

TEST(EventWatch, WhatWasTakenDoesNotComeAgainWhereTheMotionIsRestarted) {
  EventWatch watch = watch_from("x", CrossingDirection::any, 0.0, -1.0 / 3.0);
  watch.search(segment_of(0.0, 2.0, {-1.0 / 3.0, 1.0}), 0.0);
  ASSERT_TRUE(watch.next().found);
  const double t = watch.next().time;
  watch.take();
  const double x = t - 1.0 / 3.0 - 1e-17;  // not quite zero, by rounding
  watch.restart(t, &x, &x, &kExact);
  watch.search(segment_of(t, 2.0, {x, 1.0}), t);
  EXPECT_FALSE(watch.next().found);
}

TEST(EventWatch, ACrossingThatWasNotTakenStaysTheNextOne) {
  EventWatch watch = watch_from("x", CrossingDirection::any, 0.0, -1.0);
  const Segment<> segment = segment_of(0.0, 2.0, {-1.0, 1.0});
  watch.search(segment, 0.0);
  const double zero = 0.0;
  watch.restart(1.0, &zero, &zero, &kExact);
  watch.search(segment_of(1.0, 2.0, {0.0, 1.0}), 1.0);
  EXPECT_TRUE(watch.next().found);
  EXPECT_EQ(watch.next().time, 1.0);
  // elsewhere it is forgotten
  const double before = -0.5;
  watch.restart(0.5, &before, &before, &kExact);
  EXPECT_FALSE(watch.next().found);
}

TEST(EventWatch, AJumpOfTheProgramIsACrossing) {
  EventWatch jump = watch_from("floor(x) - 1/2", CrossingDirection::any, 0.0, 0.5);
  jump.search(segment_of(0.0, 1.0, {0.5, 1.0}), 0.0);
  ASSERT_TRUE(jump.next().found);
  EXPECT_NEAR(jump.next().time, 0.5, 1e-15);
}

/// A watch on x whose motion jumps at 0.5 and goes on as the polynomial.
EventWatch::Crossing jump(double before, const std::vector<double>& motion, double rounding,
                          CrossingDirection direction = CrossingDirection::any) {
  EventWatch watch = watch_from("x", direction, 0.0, before);
  watch.restart(0.5, &before, &motion[0], &rounding);
  watch.search(segment_of(0.5, 1.0, motion), 0.5);
  return watch.next();
}

TEST(EventWatch, AJumpOfTheStateAcrossZeroIsACrossing) {
  for (const double sign : {-1.0, 1.0}) {
    const EventWatch::Crossing found = jump(-sign, {sign, sign}, 1e-15);
    ASSERT_TRUE(found.found);
    EXPECT_EQ(found.time, 0.5);
    EXPECT_EQ(found.direction, static_cast<int>(sign));
    EXPECT_EQ(jump(-sign, {sign, sign}, 1e-15, CrossingDirection::rising).found, sign > 0.0);
    EXPECT_FALSE(jump(2.0 * sign, {sign, sign}, 1e-15).found);
  }
}

TEST(EventWatch, OfAJumpOntoZeroTheMotionBehindItTells) {
  for (const double off : {-1e-16, 0.0, 1e-16}) {
    EXPECT_TRUE(jump(-1.0, {off, 1.0}, 1e-15).found);
    EXPECT_FALSE(jump(-1.0, {off, -1.0}, 1e-15).found);
    EXPECT_TRUE(jump(-1.0, {off}, 1e-15).found) << "a counter stays where it came to";
    EXPECT_FALSE(jump(off, {off}, 1e-15).found);
  }
}

TEST(EventWatch, WhatWasTakenIsNotTakenAgainByItsOwnJump) {
  EventWatch watch = watch_from("x", CrossingDirection::any, 0.0, -1.0);
  const double limit = 0.25, far = 0.5, back = -0.5;
  watch.restart(0.5, &back, &limit, &kExact);
  ASSERT_TRUE(watch.next().found);
  watch.take();
  watch.restart(0.5, &limit, &back, &kExact);
  EXPECT_FALSE(watch.next().found);
  watch.restart(0.5, &back, &far, &kExact);
  EXPECT_TRUE(watch.next().found) << "another has carried it across";
}

TEST(EventWatch, ACrossingThatAJumpCarriesBackDoesNotHappen) {
  for (const double to : {-0.5, 0.5}) {
    EventWatch watch = watch_from("x", CrossingDirection::rising, 0.0, -1.0);
    watch.search(segment_of(0.0, 2.0, {-1.0, 1.0}), 0.0);
    const double zero = 0.0;
    watch.restart(1.0, &zero, &to, &kExact);
    EXPECT_EQ(watch.next().found, to > 0.0);
  }
}

TEST(EventWatch, TheSearchBeginsWhereItIsAskedTo) {
  const Segment<> segment = segment_of(10.0, 14.0, {-3.0, 4.0, -1.0});  // zero at 11 and 13
  EventWatch watch = watch_from("x", CrossingDirection::any, 12.0, 1.0);
  watch.search(segment, 12.0);
  ASSERT_TRUE(watch.next().found);
  EXPECT_NEAR(watch.next().time, 13.0, 1e-14);
}

TEST(EventWatch, WhatHasNoValueIsPassedOver) {
  // the square root is not defined between 1 and 3
  EventWatch watch = watch_from("sqrt(x) - 1", CrossingDirection::any, 0.0, 3.0);
  watch.search(segment_of(0.0, 5.0, {3.0, -4.0, 1.0}), 0.0);
  ASSERT_TRUE(watch.next().found);
  EXPECT_EQ(watch.next().direction, -1);
  const double t = watch.next().time;
  EXPECT_NEAR(t, 2.0 - std::sqrt(2.0), 1e-14);
  watch.take();
  watch.search(segment_of(0.0, 5.0, {3.0, -4.0, 1.0}), t);
  ASSERT_TRUE(watch.next().found);
  EXPECT_EQ(watch.next().direction, 1);
  EXPECT_NEAR(watch.next().time, 2.0 + std::sqrt(2.0), 1e-14);
}

}  // namespace
}  // namespace trajet
