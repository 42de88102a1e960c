// Runs whose clock starts far from zero: times have few digits there, which is said.

#include <gtest/gtest.h>

#include "scene_run.hpp"

namespace trajet {
namespace {

bool warns_of_clock(double start, double duration) {
  const RunResult result = test::run_text("[time]\nstart = " + test::number(start) +
                                          "\nend = " + test::number(start + duration) + "\n[[body]]\nname = \"b\"\n");
  for (const std::string& warning : result.warnings)
    if (warning.find("s apart") != std::string::npos) return true;
  return false;
}

TEST(Clock, AStartWithTooFewDigitsForTheRunIsWarnedOf) {
  EXPECT_FALSE(warns_of_clock(0.0, 1e-9));
  EXPECT_FALSE(warns_of_clock(0.0, 1e9));
  EXPECT_FALSE(warns_of_clock(1e3, 10.0));  // 1.1e-13 s
  EXPECT_FALSE(warns_of_clock(1e8, 1e5));   // 1.5e-8 s
  EXPECT_TRUE(warns_of_clock(1e8, 10.0));
  EXPECT_TRUE(warns_of_clock(1.7e9, 10.0));  // 2.4e-7 s
  EXPECT_TRUE(warns_of_clock(-1.7e9, 10.0));
}

}  // namespace
}  // namespace trajet
