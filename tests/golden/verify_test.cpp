#include <gtest/gtest.h>

#include "program.hpp"

namespace trajet {
namespace {

TEST(Verify, AgreesWithEveryPublishedValue) {
  const ProgramResult result = run_trajet({"verify"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out.find("DIFFERS"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("DETEST"), std::string::npos);
  EXPECT_NE(result.out.find("published values agree"), std::string::npos);
}

}  // namespace
}  // namespace trajet
