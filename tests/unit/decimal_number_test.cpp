// Numbers of texts: the nearest double, the digits beyond it, the end of the number, what is out of range.

#include "trajet/text/decimal_number.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trajet {
namespace {

TEST(DecimalNumber, EndsWhereTheTextGoesOn) {
  const auto number = leading_number("9.81 m/s^2");
  ASSERT_TRUE(number);
  EXPECT_EQ(number->value, 9.81);
  EXPECT_EQ(number->length, 4u);
  EXPECT_FALSE(number->is_out_of_range);
  EXPECT_FALSE(leading_number("m/s"));
  EXPECT_FALSE(leading_number(""));
  EXPECT_EQ(leading_number("1e")->length, 1u);
}

TEST(DecimalNumber, KeepsTheDigitsThatADoubleLoses) {
  const auto number = leading_number("0.1");
  ASSERT_TRUE(number);
  EXPECT_EQ(number->value, 0.1);
  EXPECT_EQ(number->exact, 0.1L);
}

TEST(DecimalNumber, OutOfRangeIsZeroOrInfinity) {
  EXPECT_TRUE(leading_number("1e400")->is_out_of_range);
  EXPECT_EQ(leading_number("1e400")->value, std::numeric_limits<double>::infinity());
  EXPECT_EQ(leading_number("-1e400")->value, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(leading_number("1e-400")->value, 0.0);
}

TEST(DecimalNumber, AFiniteNumberIsTheWholeText) {
  EXPECT_EQ(finite_number("-2.5e3"), -2500.0);
  EXPECT_FALSE(finite_number("2.5 "));
  EXPECT_FALSE(finite_number("inf"));
  EXPECT_FALSE(finite_number("1e400"));
}

}  // namespace
}  // namespace trajet
