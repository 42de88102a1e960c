#include "trajet/io/units.hpp"

#include <udunits2.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <mutex>

#include "trajet/error.hpp"

namespace trajet {

namespace {

struct NamedDimension {
  Dimension dimension;
  std::string_view name;
};

constexpr NamedDimension kNamedDimensions[] = {
    {kDimensionless, "number without unit [1]"},
    {kLength, "length [m]"},
    {kMass, "mass [kg]"},
    {kTime, "time [s]"},
    {kSpeed, "speed [m/s]"},
    {kAcceleration, "acceleration [m/s^2]"},
    {kForce, "force [N]"},
    {kAngle, "angle [rad]"},
    {{{0, 0, -1}}, "frequency [1/s]"},
    {{{0, 0, -1, 0, 0, 0, 0, 1}}, "angular velocity [rad/s]"},
    {{{0, 0, -2, 0, 0, 0, 0, 1}}, "angular acceleration [rad/s^2]"},
    {{{2}}, "area [m^2]"},
    {{{3}}, "volume [m^3]"},
    {{{-3, 1}}, "density [kg/m^3]"},
    {{{1, 1, -1}}, "momentum [kg m/s]"},
    {{{2, 1}}, "moment of inertia [kg m^2]"},
    {{{2, 1, -2}}, "energy or torque [J]"},
    {{{2, 1, -3}}, "power [W]"},
    {{{-1, 1, -2}}, "pressure [Pa]"},
    {{{0, 1, -1}}, "mass flow [kg/s]"},
    {{{0, 1, -2}}, "stiffness [N/m]"},
    {{{0, 0, 0, 0, 1}}, "temperature [K]"},
};

constexpr std::string_view kBaseSymbols[Dimension::kBaseUnits] = {"m", "kg", "s", "A", "K", "mol", "cd", "rad"};

constexpr std::size_t kMaxUnitLength = 100;

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using UnitPointer = std::unique_ptr<ut_unit, FreeUnit>;

struct FreeSystem {
  void operator()(ut_system* system) const { ut_free_system(system); }
};
using SystemPointer = std::unique_ptr<ut_system, FreeSystem>;

/// The database with our three names added. UDUNITS-2 reads `mph` as milliphot, a brightness.
SystemPointer load_database() {
  ut_set_error_message_handler(ut_ignore);
  SystemPointer system(ut_read_xml(nullptr));
  if (system == nullptr) throw FileError("cannot read the units database of UDUNITS-2");
  constexpr const char* kAliases[][2] = {{"deg", "degree"}, {"rev", "revolution"}, {"mph", "mile/hour"}};
  for (const auto& [name, definition] : kAliases) {
    const UnitPointer unit(ut_parse(system.get(), definition, UT_UTF8));
    ut_map_name_to_unit(name, UT_UTF8, unit.get());
  }
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

[[noreturn]] void throw_unknown(std::string_view text) {
  throw InputError({},
                   "unknown unit '" + std::string(text) + "', a unit of UDUNITS-2 expected, such as m/s, km/h, deg");
}

bool is_blank(char c) { return c == ' ' || c == '\t'; }

}  // namespace

std::string describe(const Dimension& dimension) {
  for (const NamedDimension& named : kNamedDimensions)
    if (named.dimension == dimension) return std::string(named.name);
  std::string text;
  for (std::size_t i = 0; i < Dimension::kBaseUnits; ++i) {
    const int power = dimension.powers[i];
    if (power == 0) continue;
    text += (text.empty() ? "[" : " ") + std::string(kBaseSymbols[i]);
    if (power != 1) text += "^" + std::to_string(power);
  }
  return text + "]";
}

bool interchangeable(const Dimension& a, const Dimension& b) {
  Dimension c = a;
  c.powers.back() = b.powers.back();
  return c == b;
}

Unit detail::udunits_unit(std::string_view text) {
  if (text.size() > kMaxUnitLength) throw_unknown(text.substr(0, kMaxUnitLength));
  static std::mutex mutex;  // the parser of UDUNITS-2 has global state
  const std::lock_guard lock(mutex);
  static const SystemPointer database = load_database();
  const UnitPointer parsed(ut_parse(database.get(), std::string(text).c_str(), UT_UTF8));
  if (parsed == nullptr) throw_unknown(text);
  Unit unit;
  if (ut_accept_visitor(parsed.get(), &kVisitor, &unit) != UT_SUCCESS || !std::isfinite(unit.numerator))
    throw InputError({}, "'" + std::string(text) + "' is no multiple of SI units, a unit without an offset expected" +
                             (text.starts_with("deg") ? ", such as K" : ""));
  return unit;
}

Unit parse_unit(std::string_view text) {
  if (const std::optional<Unit> unit = detail::common_unit(text)) return *unit;
  return detail::udunits_unit(text);
}

std::optional<QuantityText> split_quantity(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  if (text.empty() || (text.front() != '.' && (text.front() < '0' || text.front() > '9'))) return std::nullopt;

  QuantityText quantity;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), quantity.number);
  if (error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range)
    quantity.number = std::strtod(std::string(text.data(), end).c_str(), nullptr);
  if (negative) quantity.number = -quantity.number;

  quantity.unit = text.substr(static_cast<std::size_t>(end - text.data()));
  if (quantity.unit.empty() || !is_blank(quantity.unit.front())) return std::nullopt;
  while (is_blank(quantity.unit.front())) quantity.unit.remove_prefix(1);
  constexpr std::string_view kOperators = "+-*/^<>=!&|,()[]";
  if (kOperators.find(quantity.unit.front()) != std::string_view::npos) return std::nullopt;
  return quantity;
}

}  // namespace trajet
