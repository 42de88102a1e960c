#include "foreign_words.hpp"

#include <algorithm>
#include <span>

#include "trajet/portable.hpp"

namespace trajet::detail {
namespace {

/// What other languages write, and what to write here.
struct ForeignWord {
  std::string_view name;
  std::string_view ours;
};

constexpr ForeignWord kFunctions[] = {
    {"ln", "log(x)"},       {"lg", "log10(x)"},          {"if", "where(c, a, b)"},    {"iif", "where(c, a, b)"},
    {"length", "norm(v)"},  {"mag", "norm(v)"},          {"magnitude", "norm(v)"},    {"normalize", "unit(v)"},
    {"fabs", "abs(x)"},     {"sgn", "sign(x)"},          {"mod", "x - y*floor(x/y)"}, {"fmod", "x - y*floor(x/y)"},
    {"ceil", "-floor(-x)"}, {"round", "floor(x + 0.5)"}, {"square", "x^2"},           {"arcsin", "asin(x)"},
    {"arccos", "acos(x)"},  {"arctan", "atan(x)"},       {"arctan2", "atan2(y, x)"},  {"interp", "table(\"FILE\", x)"},
    {"deg", "x*180/pi"},    {"rad", "x*pi/180"},         {"radians", "x*pi/180"},     {"degrees", "x*180/pi"},
};

constexpr ForeignWord kConstants[] = {
    {"e", "exp(1)"}, {"tau", "2*pi"}, {"PI", "pi"}, {"Pi", "pi"}, {"π", "pi"}, {"true", "1"}, {"false", "0"},
};

/// In SI units. What may as well be the name of a quantity, such as g or m, is none of them.
constexpr ForeignWord kUnits[] = {
    {"g0", "9.80665"}, {"deg", "pi/180"}, {"degree", "pi/180"}, {"degrees", "pi/180"}, {"moa", "pi/10800"},
    {"mil", "0.001"},  {"mrad", "0.001"}, {"rad", "1"},         {"rpm", "pi/30"},      {"rev", "2*pi"},
    {"km", "1000"},    {"cm", "0.01"},    {"mm", "0.001"},      {"ft", "0.3048"},      {"inch", "0.0254"},
    {"ms", "0.001"},   {"kg", "1"},       {"lb", "0.45359237"}, {"mph", "0.44704"},
};

std::string_view ours_of(std::span<const ForeignWord> words, std::string_view name) {
  const auto found = ranges::find(words, name, &ForeignWord::name);
  return found == words.end() ? std::string_view() : found->ours;
}

}  // namespace

std::string remedy_for_function(std::string_view name) {
  const std::string_view ours = ours_of(kFunctions, name);
  return ours.empty() ? "" : ": write " + std::string(ours);
}

std::string remedy_for_name(std::string_view name) {
  if (const std::string_view ours = ours_of(kConstants, name); !ours.empty()) return ": write " + std::string(ours);
  const std::string_view si = ours_of(kUnits, name);
  return si.empty() ? ""
                    : ": formulas are in SI units, write " + std::string(si) + " or give a parameter the value \"1 " +
                          std::string(name) + "\"";
}

}  // namespace trajet::detail
