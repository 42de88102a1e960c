#include "trajet/ode/step_grid.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace trajet {
namespace {

StepGrid grid_of(double step, double start) {
  StepOptions options;
  options.step = step;
  StepGrid grid(options);
  grid.start(start);
  return grid;
}

StepGrid grid_of_nodes(std::vector<double> nodes) {
  StepOptions options;
  options.nodes = std::move(nodes);
  return StepGrid(options);
}

TEST(StepGrid, NodesAreMultiplesWithoutAccumulatedRounding) {
  StepGrid grid = grid_of(0.1, 0.25);
  double t = 0.25;
  for (int k = 1; k <= 1000; ++k) {
    t = grid.next(t, 1e3);
    // One rounding more or less where product and sum are fused; a thousand sums would be off by 1e-12.
    ASSERT_NEAR(t, 0.25 + k * 0.1, std::numeric_limits<double>::epsilon() * t);
  }
}

TEST(StepGrid, BackwardNodesAreMultiplesToo) {
  StepGrid grid = grid_of(0.1, 0.0);
  double t = 0.0;
  for (int k = 1; k <= 10; ++k) {
    t = grid.next(t, -100.0);
    ASSERT_EQ(t, -(k * 0.1));
  }
}

TEST(StepGrid, LastStepIsShortened) {
  StepGrid grid = grid_of(0.4, 0.0);
  EXPECT_EQ(grid.next(0.0, 1.0), 0.4);
  EXPECT_EQ(grid.next(0.4, 1.0), 0.8);
  EXPECT_EQ(grid.next(0.8, 1.0), 1.0);
}

TEST(StepGrid, RoundingMakesNoTinyStep) {
  // 10 * 0.1 rounds to 1 but 3 * 0.1 to more than 0.3: neither limit may leave a step of 1e-17 behind.
  StepGrid grid = grid_of(0.1, 0.0);
  EXPECT_EQ(grid.next(0.0, 0.3), 0.1);
  EXPECT_EQ(grid.next(0.1, 0.3), 0.2);
  EXPECT_EQ(grid.next(0.2, 0.3), 0.3);
  StepGrid longer = grid_of(0.1, 0.0);
  EXPECT_EQ(longer.next(0.0, 0.1 + 1e-11), 0.1 + 1e-11);
}

TEST(StepGrid, InterruptionDoesNotMoveTheNodes) {
  StepGrid grid = grid_of(0.5, 0.0);
  EXPECT_EQ(grid.next(0.0, 0.2), 0.2);
  EXPECT_EQ(grid.next(0.2, 10.0), 0.5);
  EXPECT_EQ(grid.next(0.5, 10.0), 1.0);
}

TEST(StepGrid, TurningRoundBeginsANewGrid) {
  StepGrid grid = grid_of(0.5, 0.0);
  EXPECT_EQ(grid.next(0.0, 0.75), 0.5);
  EXPECT_EQ(grid.next(0.5, 0.75), 0.75);
  EXPECT_EQ(grid.next(0.75, -10.0), 0.25);
  EXPECT_EQ(grid.next(0.25, -10.0), -0.25);
}

TEST(StepGrid, StartBeginsANewGrid) {
  StepGrid grid = grid_of(0.5, 0.0);
  EXPECT_EQ(grid.next(0.0, 10.0), 0.5);
  grid.start(0.7);
  EXPECT_EQ(grid.next(0.7, 10.0), 1.2);
}

TEST(StepGrid, GivenNodesAreMetInBothDirections) {
  StepGrid grid = grid_of_nodes({1.0, 1.5, 4.0});
  grid.start(0.0);
  EXPECT_EQ(grid.next(0.0, 10.0), 1.0);
  EXPECT_EQ(grid.next(1.0, 10.0), 1.5);
  EXPECT_EQ(grid.next(1.5, 3.0), 3.0);
  EXPECT_EQ(grid.next(3.0, 10.0), 4.0);
  EXPECT_EQ(grid.next(4.0, 10.0), 10.0);
  EXPECT_EQ(grid.next(10.0, 0.0), 4.0);
  EXPECT_EQ(grid.next(4.0, 0.0), 1.5);
  EXPECT_EQ(grid.next(1.5, 0.0), 1.0);
  EXPECT_EQ(grid.next(1.0, 0.0), 0.0);
}

TEST(StepGrid, GivenNodesMayBeNamedBackward) {
  StepGrid grid = grid_of_nodes({4.0, 1.5, 1.0});
  EXPECT_EQ(grid.next(5.0, 0.0), 4.0);
  EXPECT_EQ(grid.next(4.0, 0.0), 1.5);
}

TEST(StepGrid, LimitNextToAGivenNodeReplacesIt) {
  StepGrid grid = grid_of_nodes({1.0, 2.0, 3.0});
  const double early = 2.0 - 1e-12;
  EXPECT_EQ(grid.next(1.0, early), early);
  EXPECT_EQ(grid.next(early, 10.0), 3.0);
  const double late = 2.0 + 1e-12;
  EXPECT_EQ(grid.next(1.0, late), late);
}

TEST(StepGrid, WrongOptionsAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(StepGrid(StepOptions{}), std::invalid_argument);
  EXPECT_THROW(grid_of(0.0, 0.0), std::invalid_argument);
  EXPECT_THROW(grid_of(-1.0, 0.0), std::invalid_argument);
  EXPECT_THROW(grid_of(nan, 0.0), std::invalid_argument);
  EXPECT_THROW(grid_of(std::numeric_limits<double>::infinity(), 0.0), std::invalid_argument);
  EXPECT_THROW(grid_of_nodes({1.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(grid_of_nodes({1.0, 3.0, 2.0}), std::invalid_argument);
  EXPECT_THROW(grid_of_nodes({1.0, nan}), std::invalid_argument);
  EXPECT_THROW(StepGrid({.step = 0.2, .max_step = 0.1}), std::invalid_argument);
  EXPECT_THROW(StepGrid({.max_step = 0.5, .nodes = {1.0, 1.5, 2.1}}), std::invalid_argument);
}

}  // namespace
}  // namespace trajet
