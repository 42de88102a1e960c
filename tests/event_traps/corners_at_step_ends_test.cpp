// The corners of a polytope looked at where steps end, as the course does: good in time where nothing happens within a
// step, and blind to what does.

#include <gtest/gtest.h>

#include <cmath>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::number;
using test::run_text;

std::string tumble(const std::string& method, const std::string& locate, double spin) {
  return "[time]\nend = 1\n[method]\n" + method + "locate = \"" + locate +
         "\"\n[[body]]\nname = \"box\"\nshape = \"box\"\nsize = [0.4, 0.3, 0.2]\nmass = 1\nposition = [0, 0, 2]\n"
         "angular_velocity_body = [" +
         number(0.3 * spin) + ", " + number(spin) +
         ", 0.1]\nacceleration = [0, 0, -9.8]\n[[obstacle]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, 0, 0]\n"
         "normal = [0, 0, 1]\n";
}

const std::string kFine = "name = \"rk4\"\nstep = 0.005\n";

TEST(CornersAtStepEnds, MeetTheGroundWhenTheSolidDoesWhereNothingHappensWithinAStep) {
  for (const double spin : {0.5, 3.0, 7.0}) {
    const RunResult exact = run_text(tumble(kFine, "polynomial", spin));
    ASSERT_EQ(exact.impacts.size(), 1u);
    for (const char* locate : {"interpolation", "subdivision"}) {
      const RunResult seen = run_text(tumble(kFine, locate, spin));
      ASSERT_EQ(seen.impacts.size(), 1u) << locate;
      // 3.2 ends within 1e-9 m of the surface, some 1e-10 s; 3.1 takes the mean of two rates for all between, which
      // is off by h^2 |g''| / 8, over a rate of more than 3 m/s: corners turn with at most 7.3 rad/s at 0.27 m
      const double bound = locate[0] == 's' ? 1e-9 : 0.005 * 0.005 * (9.8 + 0.27 * 7.4 * 7.4) / (8.0 * 3.0);
      EXPECT_NEAR(seen.impacts[0].time, exact.impacts[0].time, bound) << locate;
      ASSERT_TRUE(seen.impacts[0].touched);
      EXPECT_EQ(seen.impacts[0].touched->of_body, Feature::vertex);
    }
  }
}

TEST(CornersAtStepEnds, MissACornerThatDipsInAndOutWithinAStep) {
  // a step of the series method is about a radian long: some corners are in and out again within it
  int missed = 0;
  for (int spin = 40; spin < 200; spin += 5) {
    const RunResult exact = run_text(tumble("", "polynomial", spin));
    const RunResult seen = run_text(tumble("", "subdivision", spin));
    ASSERT_EQ(exact.impacts.size(), 1u);
    ASSERT_EQ(seen.impacts.size(), 1u);
    EXPECT_GT(seen.impacts[0].time, exact.impacts[0].time - 1e-9);
    if (seen.impacts[0].time > exact.impacts[0].time + 1e-6) ++missed;
  }
  EXPECT_GT(missed, 3);
}

}  // namespace
}  // namespace trajet
