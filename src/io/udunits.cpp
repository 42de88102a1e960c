#include <udunits2.h>

#include <memory>
#include <mutex>
#include <string>

#include "trajet/error.hpp"
#include "trajet/io/units.hpp"

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
    unit.dimension.powers[base] += powers[i];
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
  static_cast<Unit*>(result)->numerator *= scale;
  return ut_accept_visitor(underlying, &kVisitor, result);
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
  return unit;
}

}  // namespace trajet::detail
