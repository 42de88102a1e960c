#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "likely_units.hpp"
#include "trajet/error.hpp"
#include "trajet/io/units.hpp"
#include "trajet/portable.hpp"

namespace trajet {

namespace {

/// Reads a unit: product = factor { [blank | "." | "*" | "·" | "/"] factor }; factor = (name | "(" product ")")
/// [power].
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : rest_(text) {
    if (text.size() > kMaxLength) fail("a unit of at most " + std::to_string(kMaxLength) + " bytes expected");
  }

  Unit parse() {
    const Unit unit = product();
    if (!rest_.empty()) fail("'" + std::string(rest_) + "' is not expected in a unit");
    const double factor = unit.numerator / unit.denominator;
    if (!std::isnormal(factor) || !std::isnormal(unit.numerator)) fail("the unit is beyond the range of a double");
    return unit;
  }

 private:
  static constexpr std::size_t kMaxLength = 100;  // also bounds the depth of the recursion

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError({}, message + " (a unit such as m/s, km/h, kg m^2, deg)");
  }

  bool take(std::string_view sign) {
    if (!rest_.starts_with(sign)) return false;
    rest_.remove_prefix(sign.size());
    return true;
  }

  void skip_blanks() {
    while (rest_.starts_with(' ') || rest_.starts_with('\t')) rest_.remove_prefix(1);
  }

  Unit product() {
    Unit unit;
    bool divides = false;
    while (true) {
      skip_blanks();
      const Unit factor = factor_without_power();
      const int exponent = power();
      multiply(unit, factor, divides ? -exponent : exponent);
      skip_blanks();
      if (rest_.empty() || rest_.front() == ')') return unit;
      divides = take("/");
      if (divides) continue;
      if (rest_.starts_with("**")) fail("'**' is no sign of a power here, write ^: m/s^2");
      if (!take("*") && !take(".")) take("·");
    }
  }

  Unit factor_without_power() {
    if (take("1")) return {};
    if (take("(")) {
      const Unit unit = product();
      if (!take(")")) fail("a closing parenthesis is missing");
      return unit;
    }
    const std::string_view name = take_name();
    if (name.empty()) fail(rest_.empty() ? "the name of a unit is missing" : "'" + std::string(rest_) + "' is no unit");
    if (const Unit* unit = detail::common_unit(name)) return *unit;
    if (const std::optional<Unit> unit = detail::udunits_unit(name)) return *unit;
    fail("unknown unit '" + std::string(name) + "'" + detail::likely_unit(name));
  }

  /// Takes letters, `_` and what is not ASCII up to a sign of power; or one of the signs `%`, `'`, `"`.
  std::string_view take_name() {
    std::size_t length = 0;
    while (length < rest_.size() && is_name_byte(rest_[length]) && !starts_sign(rest_.substr(length))) ++length;
    // the one name that ends in a digit
    if (rest_.substr(0, length) == "g" && rest_.substr(1).starts_with('0')) length = 2;
    if (length == 0 && !rest_.empty() && (rest_[0] == '%' || rest_[0] == '\'' || rest_[0] == '"')) length = 1;
    const std::string_view name = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return name;
  }

  /// Takes `^2`, `2`, `-2`, `²`, `⁻²`; 1 if there is none.
  int power() {
    const bool has_caret = take("^");
    const bool is_superscript = starts_sign(rest_) && !rest_.starts_with("·");
    const bool is_negative = take("-") || take("⁻");
    constexpr int kMaxPower = 8;
    for (int digit = 1; digit <= kMaxPower; ++digit) {
      const bool found = is_superscript ? take(kSuperscripts[static_cast<std::size_t>(digit)])
                                        : take(std::string_view(&"0123456789"[digit], 1));
      if (found) return is_negative ? -digit : digit;
    }
    if (has_caret || is_negative || is_superscript) fail("a power from 1 to 8 expected");
    return 1;
  }

  static constexpr std::array<std::string_view, 9> kSuperscripts{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸"};

  static bool starts_sign(std::string_view text) {
    const auto starts = [text](std::string_view sign) { return text.starts_with(sign); };
    return starts("⁻") || starts("·") || ranges::any_of(kSuperscripts, starts);
  }

  static bool is_name_byte(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || static_cast<unsigned char>(c) >= 0x80;
  }

  /// `product` times `factor` to the `exponent`.
  static void multiply(Unit& product, const Unit& factor, int exponent) {
    for (int i = 0; i < exponent; ++i) {
      product.numerator *= factor.numerator;
      product.denominator *= factor.denominator;
      product.exact_factor *= factor.exact_factor;
    }
    for (int i = 0; i > exponent; --i) {
      product.numerator *= factor.denominator;
      product.denominator *= factor.numerator;
      product.exact_factor /= factor.exact_factor;
    }
    product.dimension = trajet::product(product.dimension, factor.dimension, exponent);
  }

  std::string_view rest_;
};

}  // namespace

Unit parse_unit(std::string_view text) { return UnitParser(text).parse(); }

}  // namespace trajet
