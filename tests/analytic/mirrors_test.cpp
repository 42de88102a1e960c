// A billiard among circular mirrors: problem 2 of SIAM's 100-digit challenge [BornemannEtAl2004]. Fourteen reflections
// make the rounding of the start 1e10 times as large.

#include <gtest/gtest.h>

#include <limits>

#include "scene_run.hpp"

namespace trajet::test {
namespace {

/// Unit speed east from (1/2, 1/10), mirrors of radius 1/3 at the points of the lattice, 10 s.
RunResult among_mirrors(const std::string& method) {
  std::string scene = "[time]\nend = 10\n[method]\nname = \"" + method + R"("
[[body]]
name = "p"
position = ["1/2", "1/10", 0]
velocity = [1, 0, 0]
)";
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j)
      scene += "[[obstacle]]\nname = \"m" + std::to_string(i + 3) + std::to_string(j + 3) +
               "\"\nshape = \"sphere\"\nradius = \"1/3\"\non_hit = \"bounce\"\ncenter = [" + std::to_string(i) + ", " +
               std::to_string(j) + ", 0]\n";
  return run_text(scene);
}

constexpr double kPublishedDistance = 0.995262919443354;  // from the origin at t = 10

TEST(Mirrors, TheFinalErrorBoundTellsWhatReflectionsMakeOfRounding) {
  const RunResult result = among_mirrors("taylor");
  ASSERT_EQ(result.status, RunStatus::finished);
  EXPECT_EQ(result.impacts.size(), 14u);
  const BodyState& p = final_of(result, "p");
  const double error = std::abs(p.position.norm() - kPublishedDistance);
  EXPECT_GT(error, 1e-7);  // measured: 4.2e-6, with how sums are rounded
  EXPECT_LT(error, *p.position_error_bound);
  EXPECT_LT(*p.position_error_bound, 100.0 * error);
  // reflections spread the times too
  EXPECT_GT(result.impacts.back().time_error_bound, 1e-7);
  EXPECT_LT(result.impacts.front().time_error_bound, 1e-14);
}

TEST(Mirrors, ExtendedPrecisionIsCarriedThroughReflections) {
  if (std::numeric_limits<long double>::digits < 64) return;  // no wider than double on this machine
  const RunResult result = among_mirrors("taylor-extended");
  ASSERT_EQ(result.status, RunStatus::finished);
  const BodyState& p = final_of(result, "p");
  const double error = std::abs(p.position.norm() - kPublishedDistance);
  EXPECT_LT(error, 1e-9);  // that of doubles over 2048 is 2e-9
  EXPECT_LT(error, *p.position_error_bound);
  EXPECT_LT(*p.position_error_bound, 1e-6);
}

}  // namespace
}  // namespace trajet::test
