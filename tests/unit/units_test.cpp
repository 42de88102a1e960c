#include "trajet/io/units.hpp"

#include <gtest/gtest.h>
#include <udunits2.h>

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

/// UDUNITS-2 on its own: the factor of a text and whether the dimension is that of `unit`.
class Udunits {
 public:
  Udunits() {
    ut_set_error_message_handler(ut_ignore);
    system_ = ut_read_xml(nullptr);
    for (const auto& [name, definition] : {std::pair{"deg", "degree"},
                                           {"rev", "revolution"},
                                           {"mph", "mile/hour"},
                                           {"fps", "foot/second"},
                                           {"moa", "arc_minute"}}) {
      ut_unit* unit = ut_parse(system_, definition, UT_UTF8);
      ut_map_name_to_unit(name, UT_UTF8, unit);
      ut_free(unit);
    }
  }
  ~Udunits() { ut_free_system(system_); }
  Udunits(const Udunits&) = delete;
  Udunits& operator=(const Udunits&) = delete;

  /// How many of `base`, a product of base units, `text` is; NaN if it is something else.
  double factor(const std::string& text, const std::string& base) {
    ut_unit* from = ut_parse(system_, text.c_str(), UT_UTF8);
    ut_unit* to = ut_parse(system_, base.c_str(), UT_UTF8);
    cv_converter* converter = ut_get_converter(from, to);
    const double factor = converter == nullptr ? std::nan("") : cv_convert_double(converter, 1.0);
    cv_free(converter);
    ut_free(from);
    ut_free(to);
    return factor;
  }

 private:
  ut_system* system_;
};

std::string base_units(const Dimension& dimension) {
  constexpr const char* kSymbols[] = {"m", "kg", "s", "A", "K", "mol", "cd", "rad"};
  std::string text = "1";
  for (std::size_t i = 0; i < Dimension::kBaseUnits; ++i)
    text += std::string(" ") + kSymbols[i] + "^" + std::to_string(dimension.powers[i]);
  return text;
}

TEST(Units, AgreeWithUdunits) {
  // Each name alone and in every kind of product and power. Those before `dyne` are the common ones.
  const std::vector<std::string> names = {
      "m",       "cm",    "mm",  "um",         "km",   "in",  "inch", "ft",   "foot", "feet",    "yd",
      "yard",    "mile",  "s",   "ms",         "us",   "min", "h",    "hour", "kg",   "g",       "mg",
      "lb",      "grain", "N",   "kN",         "J",    "Hz",  "mph",  "knot", "rad",  "deg",     "degree",
      "degrees", "°",     "rev", "revolution", "turn", "rpm", "%",    "mrad", "moa",  "fps",     "dyne",
      "K",       "µm",    "Mm",  "Pa",         "W",    "lbf", "mol",  "cd",   "T",    "furlong", "fortnight"};
  Udunits authority;
  int common = 0;
  for (const std::string& name : names) {
    if (detail::common_unit(name)) ++common;
    std::vector<std::string> texts = {name,
                                      name + "/s",
                                      "1/" + name,
                                      "m/s " + name,
                                      "m / s / " + name,
                                      "m.s." + name,
                                      name + "^2",
                                      "kg*" + name + "^3",
                                      "kg/" + name + "^-1",
                                      "kg/(m " + name + ")",
                                      "(" + name + "/s)^2",
                                      name + "²"};
    if (name != "%" && name != "°") texts.push_back("kg " + name + "-2 m2");
    for (const std::string& text : texts) {
      const Unit unit = parse_unit(text);
      // UDUNITS-2 writes a degree with 16 digits (1.6 ulp off) and multiplies factor by factor: here up to three times.
      EXPECT_NEAR(factor(unit) / authority.factor(text, base_units(unit.dimension)), 1.0, 4e-15) << text;
    }
  }
  EXPECT_EQ(common, 43);  // without those that UDUNITS-2 knows six digits of (slug) or as something else (g0, mil)
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
  EXPECT_DOUBLE_EQ(convert(1, "slug ft/s^2"), convert(1, "lbf"));
}

TEST(Units, WhatIsNoMultipleOfSiIsAnError) {
  EXPECT_NE(message_of("degC").find("'degC' is no multiple"), std::string::npos);
  EXPECT_NE(message_of("s since 2000-01-01").find("unknown unit 'since'"), std::string::npos);
  EXPECT_NE(message_of("lg(re 1 mW)").find("unknown unit 'lg'"), std::string::npos);
  EXPECT_NE(message_of("kg parrots/s").find("unknown unit 'parrots'"), std::string::npos);
  EXPECT_NE(message_of("km^8 km^8 km^8 km^8 km^8 km^8 km^8 km^8 km^8 km^8 km^8 km^8 km^8 km^8").find("range"),
            std::string::npos);
  EXPECT_NE(message_of(std::string(100000, 'm')).find("at most"), std::string::npos);
  for (const char* text :
       {"", "m^", "m^0", "m^9", "m^1.5", "m-", "m/", "/m", "m+s", "(m", "m)", "()", "10 m", "m**2", "²"})
    EXPECT_NE(message_of(text), "no error") << text;
}

TEST(Units, OfSightsAndOfFlight) {
  EXPECT_DOUBLE_EQ(factor(parse_unit("moa")), std::numbers::pi / 10800);
  EXPECT_EQ(factor(parse_unit("mil")), 1e-3);
  EXPECT_EQ(parse_unit("mil").dimension, kAngle);
  EXPECT_EQ(factor(parse_unit("g0")), 9.80665);
  EXPECT_EQ(parse_unit("g0").dimension, kAcceleration);
  EXPECT_EQ(parse_unit("fps").dimension, kSpeed);
  EXPECT_EQ(parse_unit("g").dimension, kMass);
}

TEST(Units, PrefixesBeforeWhatTakesNoneAreRefused) {
  for (const auto& [name, meaning] :
       {std::pair{"nmi", "nautical_mile"}, {"kph", "km/h"}, {"PS", "hp"}, {"dpt", ""}, {"kft", ""}, {"Mmin", ""}}) {
    EXPECT_NE(message_of(name).find(std::string("'") + name + "' is no unit here: UDUNITS-2 reads it as a prefix"),
              std::string::npos)
        << message_of(name);
    EXPECT_NE(message_of(name).find(meaning), std::string::npos) << message_of(name);
  }
  EXPECT_NE(message_of("nmi").find("1.60934e-06 times the SI unit of length [m]"), std::string::npos);
  for (const char* name : {"kmh", "lbs", "Nm", "kWh", "G"})
    EXPECT_NE(message_of(name).find("; did you mean "), std::string::npos) << message_of(name);
  EXPECT_NE(message_of("m/s**2").find("write ^"), std::string::npos);
  // SI's own
  for (const char* name : {"nm", "Mm", "kPa", "mbar", "kcal", "MeV", "mHz", "ml", "daN", "kilometer", "microsecond",
                           "milliradian", "kilofeet", "µm", "Gs", "msec", "mT", "hPa", "nautical_mile"})
    EXPECT_EQ(message_of(name), "no error") << name;
}

TEST(Units, FactorsInExtendedPrecision) {
  EXPECT_EQ(parse_unit("deg").exact_factor, std::numbers::pi_v<long double> / 180);
  EXPECT_EQ(parse_unit("km/h").exact_factor, 1000.0L / 3600.0L);
  EXPECT_EQ(parse_unit("ms^2").exact_factor, (1.0L / 1000.0L) * (1.0L / 1000.0L));
}

TEST(Units, SuperscriptsArePowers) {
  EXPECT_EQ(parse_unit("m·s⁻²").dimension, kAcceleration);
  EXPECT_EQ(factor(parse_unit("km³")), 1e9);
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
      {"1 and c", false, 0, ""},     {"0 or (c)", false, 0, ""},
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
