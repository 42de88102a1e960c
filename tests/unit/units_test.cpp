#include "trajet/io/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "trajet/error.hpp"

namespace trajet {
namespace {

double factor(const Unit& unit) { return unit.numerator / unit.denominator; }

std::string message_of(std::string_view unit) {
  try {
    parse_unit(unit);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Units, CommonOnesAgreeWithUdunits) {
  // Every name of the table, alone and in every kind of product and power.
  const std::vector<std::string> names = {
      "m",       "cm",    "mm",  "um",         "km",   "in",  "inch", "ft",   "foot", "feet", "yd",
      "yard",    "mile",  "s",   "ms",         "us",   "min", "h",    "hour", "kg",   "g",    "mg",
      "lb",      "grain", "N",   "kN",         "J",    "Hz",  "mph",  "knot", "rad",  "deg",  "degree",
      "degrees", "°",     "rev", "revolution", "turn", "rpm", "%",    "1"};
  std::vector<std::string> texts = names;
  for (const std::string& name : names) {
    texts.push_back(name + "/s");
    texts.push_back("kg " + name);
    texts.push_back("1/" + name);
    texts.push_back("m/s " + name);
    texts.push_back("m / s / " + name);
    texts.push_back("m.s." + name);
    if (name != "1") {
      texts.push_back(name + "^2");
      texts.push_back("kg*" + name + "^3");
      texts.push_back("kg " + name + "-2");
      texts.push_back("kg/" + name + "^-1");
    }
  }
  for (const std::string& text : texts) {
    const std::optional<Unit> common = detail::common_unit(text);
    ASSERT_TRUE(common.has_value()) << text;
    const Unit authority = detail::udunits_unit(text);
    EXPECT_EQ(common->dimension, authority.dimension) << text << ": " << describe(authority.dimension);
    // UDUNITS-2 writes a degree with 16 digits (1.6 ulp off) and multiplies factors one by one: up to 3 of them here,
    // cubed.
    EXPECT_NEAR(factor(*common) / factor(authority), 1.0, 4e-15) << text;
  }
}

TEST(Units, DecimalPrefixesAreExact) {
  const auto convert = [](double x, const char* text) {
    const Unit unit = parse_unit(text);
    return x * unit.numerator / unit.denominator;
  };
  EXPECT_EQ(convert(20, "cm"), 0.2);
  EXPECT_EQ(convert(35, "cm"), 0.35);
  EXPECT_EQ(convert(10, "ms"), 0.01);
  EXPECT_EQ(convert(36, "km/h"), 10.0);
  EXPECT_EQ(convert(180, "deg"), std::numbers::pi);
  EXPECT_EQ(convert(168, "grain"), 0.01088621688);  // 1 grain = 64.79891 mg by definition
}

TEST(Units, RareOnesComeFromUdunits) {
  EXPECT_FALSE(detail::common_unit("slug"));
  EXPECT_EQ(parse_unit("slug").dimension, kMass);
  EXPECT_NEAR(factor(parse_unit("furlong/day")), 201.168 / 86400, 1e-6);  // the US survey furlong: 2e-6 longer
  EXPECT_EQ(parse_unit("furlong/day").dimension, kSpeed);
  EXPECT_EQ(factor(parse_unit("kN m")), 1000.0);
  EXPECT_EQ(factor(parse_unit("Mm")), 1e6);
  EXPECT_EQ(parse_unit("K").dimension, (Dimension{{0, 0, 0, 0, 1}}));
}

TEST(Units, WhatIsNoMultipleOfSiIsAnError) {
  EXPECT_NE(message_of("degC").find("without an offset"), std::string::npos);
  EXPECT_NE(message_of("s since 2000-01-01").find("no multiple"), std::string::npos);
  EXPECT_NE(message_of("lg(re 1 mW)").find("no multiple"), std::string::npos);
  EXPECT_NE(message_of("parrots").find("unknown unit 'parrots'"), std::string::npos);
  EXPECT_NE(message_of("m^").find("unknown unit"), std::string::npos);
  EXPECT_NE(message_of(std::string(100000, 'm')).find("unknown unit"), std::string::npos);
}

TEST(Units, DimensionsHaveNames) {
  EXPECT_EQ(describe(kLength), "length [m]");
  EXPECT_EQ(describe(kTime), "time [s]");
  EXPECT_EQ(describe(parse_unit("kg^2 m").dimension), "[m kg^2]");
  EXPECT_TRUE(interchangeable(kAngle, kDimensionless));
  EXPECT_FALSE(interchangeable(kTime, parse_unit("Hz").dimension));
}

TEST(Units, QuantityIsNumberBlankUnit) {
  struct Case {
    const char* text;
    bool is_quantity;
    double number;
    const char* unit;
  };
  const Case cases[] = {
      {"500 m/s", true, 500, "m/s"}, {"-0.2 deg", true, -0.2, "deg"},
      {" +.5  m ", true, 0.5, "m"},  {"1e-3 kg", true, 1e-3, "kg"},
      {"3 1/s", true, 3, "1/s"},     {"90 °", true, 90, "°"},
      {"1e-400 m", true, 0, "m"},    {"2 * v0", false, 0, ""},
      {"2 - 3", false, 0, ""},       {"2 -3", false, 0, ""},
      {"v0", false, 0, ""},          {"500", false, 0, ""},
      {"500m", false, 0, ""},        {"", false, 0, ""},
      {"-", false, 0, ""},           {"[1, 0, 0]", false, 0, ""},
      {"inf m", false, 0, ""},       {"nan m", false, 0, ""},
  };
  for (const Case& c : cases) {
    const std::optional<QuantityText> quantity = split_quantity(c.text);
    ASSERT_EQ(quantity.has_value(), c.is_quantity) << c.text;
    if (!quantity) continue;
    EXPECT_EQ(quantity->number, c.number) << c.text;
    EXPECT_EQ(quantity->unit, c.unit) << c.text;
  }
  EXPECT_TRUE(std::isinf(split_quantity("1e400 m")->number));
}

}  // namespace
}  // namespace trajet
