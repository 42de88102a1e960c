#include "likely_units.hpp"

#include <algorithm>

#include "trajet/io/units.hpp"
#include "trajet/portable.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet::detail {

namespace {

struct LikelyUnit {
  std::string_view name;
  std::string_view meaning;
};

/// What people write elsewhere, and what it is here.
constexpr LikelyUnit kLikelyUnits[] = {
    {"nmi", "nautical_mile"},
    {"NM", "nautical_mile"},
    {"NMI", "nautical_mile"},
    {"naut", "nautical_mile"},
    {"kph", "km/h"},
    {"kmh", "km/h"},
    {"kmph", "km/h"},
    {"KPH", "km/h"},
    {"MPH", "mph"},
    {"mps", "m/s"},
    {"kps", "km/s"},
    {"fpm", "ft/min"},
    {"ftps", "ft/s"},
    {"FPS", "ft/s"},
    {"kn", "knot"},
    {"lbs", "lb"},
    {"yds", "yd"},
    {"hrs", "h"},
    {"mins", "min"},
    {"Nm", "N m"},
    {"ftlb", "ft lbf"},
    {"lbft", "lbf ft"},
    {"Wh", "W h"},
    {"kWh", "kW h"},
    {"G", "g0"},
    {"gee", "g0"},
    {"gs", "g0"},
    {"MOA", "moa"},
    {"MIL", "mil"},
    {"mils", "mil"},
    {"rot", "rev"},
    {"revs", "rev"},
    {"rads", "rad"},
    {"degs", "deg"},
    {"RPM", "rpm"},
    {"PS", "hp"},
    {"HP", "hp"},
    {"AU", "au"},
    {"stone", "lb"},
    {"dpt", "1/m"},
    {"Ma", "the speed of sound"},
};

}  // namespace

std::string likely_unit(std::string_view name) {
  const auto found = ranges::find(kLikelyUnits, name, &LikelyUnit::name);
  if (found != std::end(kLikelyUnits)) return "; did you mean " + std::string(found->meaning) + "?";
  return did_you_mean(name, common_unit_names());
}

}  // namespace trajet::detail
