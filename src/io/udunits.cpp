#include <udunits2.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <mutex>
#include <string>

#include "likely_units.hpp"
#include "trajet/error.hpp"
#include "trajet/io/units.hpp"
#include "trajet/portable.hpp"

namespace trajet::detail {

namespace {

/// UDUNITS-2's symbols of the base units, in the order of Dimension.
constexpr std::string_view kBaseSymbols[Dimension::kBaseUnits] = {"m", "kg", "s", "A", "K", "mol", "cd", "rad"};

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using UnitPointer = std::unique_ptr<ut_unit, FreeUnit>;

struct FreeSystem {
  void operator()(ut_system* system) const { ut_free_system(system); }
};
using SystemPointer = std::unique_ptr<ut_system, FreeSystem>;

SystemPointer load_database() {
  ut_set_error_message_handler(ut_ignore);
  SystemPointer system(ut_read_xml(nullptr));
  if (system == nullptr) throw FileError("cannot read the units database of UDUNITS-2");
  return system;
}

/// Collects factor and dimension of a unit; its functions refuse what is no multiple of SI units.
ut_status visit_product(const ut_unit*, int count, const ut_unit* const* basic_units, const int* powers, void* result) {
  Unit& unit = *static_cast<Unit*>(result);
  for (int i = 0; i < count; ++i) {
    std::size_t base = 0;
    const std::string_view symbol = ut_get_symbol(basic_units[i], UT_UTF8);
    while (base < Dimension::kBaseUnits && kBaseSymbols[base] != symbol) ++base;
    if (base == Dimension::kBaseUnits) return UT_VISIT_ERROR;
    unit.dimension.powers[base] = static_cast<std::int16_t>(unit.dimension.powers[base] + powers[i]);
  }
  return UT_SUCCESS;
}

ut_status visit_basic(const ut_unit* basic_unit, void* result) {
  const int power = 1;
  return visit_product(nullptr, 1, &basic_unit, &power, result);
}

ut_status visit_galilean(const ut_unit*, double scale, const ut_unit* underlying, double offset, void* result);

ut_status refuse_timestamp(const ut_unit*, const ut_unit*, double, void*) { return UT_VISIT_ERROR; }
ut_status refuse_logarithm(const ut_unit*, double, const ut_unit*, void*) { return UT_VISIT_ERROR; }

const ut_visitor kVisitor = {visit_basic, visit_product, visit_galilean, refuse_timestamp, refuse_logarithm};

ut_status visit_galilean(const ut_unit*, double scale, const ut_unit* underlying, double offset, void* result) {
  if (offset != 0.0) return UT_VISIT_ERROR;
  Unit& unit = *static_cast<Unit*>(result);
  unit.numerator *= scale;
  unit.exact_factor *= static_cast<Extended>(scale);
  return ut_accept_visitor(underlying, &kVisitor, result);
}

/// Whether the database knows the name as it stands, without a prefix.
bool is_listed(const ut_system* system, const std::string& name) {
  return UnitPointer(ut_get_unit_by_name(system, name.c_str())) != nullptr ||
         UnitPointer(ut_get_unit_by_symbol(system, name.c_str())) != nullptr;
}

/// What SI puts prefixes before. UDUNITS-2 puts them before everything.
constexpr std::string_view kTakePrefixes[] = {
    "m",   "g", "s",  "A", "K", "mol", "cd", "rad", "sr", "Hz", "N",   "Pa", "J", "W", "C",  "V",   "F",   "Ω",
    "ohm", "S", "Wb", "T", "H", "lm",  "lx", "Bq",  "Gy", "Sv", "kat", "l",  "L", "t", "eV", "bar", "cal", "sec"};
constexpr std::string_view kSymbolsOfPrefixes[] = {"da", "Y", "Z", "E", "P", "T", "G", "M", "k", "h", "d",
                                                   "c",  "m", "µ", "μ", "u", "n", "p", "f", "a", "z", "y"};
constexpr std::string_view kNamesOfPrefixes[] = {"deca",  "deka", "yotta", "zetta", "exa",  "peta",  "tera",
                                                 "giga",  "mega", "kilo",  "hecto", "deci", "centi", "milli",
                                                 "micro", "nano", "pico",  "femto", "atto", "zepto", "yocto"};

/// Whether a name that the database does not list is a prefix before what takes one.
bool has_proper_prefix(const ut_system* system, std::string_view name) {
  const auto rest_behind = [&](std::string_view prefix) {
    return name.starts_with(prefix) ? name.substr(prefix.size()) : std::string_view();
  };
  return ranges::any_of(kSymbolsOfPrefixes,
                        [&](std::string_view p) {
                          return ranges::find(kTakePrefixes, rest_behind(p)) != std::end(kTakePrefixes);
                        }) ||
         ranges::any_of(kNamesOfPrefixes, [&](std::string_view p) {
           const std::string rest(rest_behind(p));
           return !rest.empty() && is_listed(system, rest);
         });
}

[[noreturn]] void refuse_accident(const std::string& name, const Unit& unit) {
  char digits[32];
  const double factor = unit.numerator / unit.denominator;
  const char* end = std::to_chars(digits, digits + sizeof digits, factor, std::chars_format::general, 6).ptr;
  throw InputError({}, "'" + name + "' is no unit here: UDUNITS-2 reads it as a prefix before another unit, " +
                           std::string(static_cast<const char*>(digits), end) + " times the SI unit of " +
                           describe(unit.dimension) + likely_unit(name));
}

}  // namespace

std::optional<Unit> udunits_unit(std::string_view name) {
  static std::mutex mutex;  // the parser of UDUNITS-2 has global state
  const std::lock_guard lock(mutex);
  static const SystemPointer database = load_database();
  // Its parser gets single names only: it loses memory where a text with several words is no unit.
  const UnitPointer parsed(ut_parse(database.get(), std::string(name).c_str(), UT_UTF8));
  if (parsed == nullptr) return std::nullopt;
  Unit unit;
  if (ut_accept_visitor(parsed.get(), &kVisitor, &unit) != UT_SUCCESS)
    throw InputError(
        {}, "the unit '" + std::string(name) + "' is no multiple of an SI unit, one without an offset expected");
  const std::string text(name);
  const bool is_accident = !is_listed(database.get(), text) && !has_proper_prefix(database.get(), text);
  if (is_accident || text == "PS") refuse_accident(text, unit);
  return unit;
}

}  // namespace trajet::detail
