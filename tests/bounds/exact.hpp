#pragma once

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace trajet::test {

/// Exact: every double is one.
using Rational = boost::multiprecision::cpp_rational;
/// A hundred digits, with the functions of <cmath>: as good as exact beside a double.
using Real = boost::multiprecision::cpp_bin_float_100;

/// sum_k coefficients[k] t^k, by Horner's rule in the number type of t.
template <class Number>
Number evaluate(std::span<const double> coefficients, const Number& t) {
  Number sum(0);
  for (std::size_t k = coefficients.size(); k-- > 0;) sum = sum * t + Number(coefficients[k]);
  return sum;
}
template <class Number>
Number evaluate_rate(std::span<const double> coefficients, const Number& t) {
  Number sum(0);
  for (std::size_t k = coefficients.size(); k-- > 1;)
    sum = sum * t + Number(coefficients[k]) * static_cast<int>(k);
  return sum;
}

/// The root of a function near `guess`, where its sign changes within `reach`: by bisection, to 60 digits.
template <class Function>
Real root_near(const Function& f, double guess, double reach) {
  Real a = Real(guess) - reach;
  Real b = Real(guess) + reach;
  const bool is_negative = f(a) < 0;
  if (is_negative == (f(b) < 0)) return std::numeric_limits<double>::quiet_NaN();
  for (int step = 0; step < 120; ++step) {
    const Real middle = (a + b) / 2;
    ((f(middle) < 0) == is_negative ? a : b) = middle;
  }
  return (a + b) / 2;
}

/// The coverage of a bound: the largest |error| / bound of many cases. Above 1 the bound is none; far below, it is
/// worth little.
class Coverage {
 public:
  void add(double error, double bound, const std::string& what = "") {
    if (error == 0.0) return;
    const double ratio = error / bound;
    if (ratio <= largest_) return;
    largest_ = ratio;
    what_ = what;
  }
  double largest() const { return largest_; }
  /// The case that came closest.
  const std::string& what() const { return what_; }

 private:
  double largest_ = 0.0;
  std::string what_;
};

/// The same numbers on every machine.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double a, double b) {
    const auto high = static_cast<double>(engine_());
    const auto low = static_cast<double>(engine_());
    return a + (b - a) * (high * 0x1p-32 + low * 0x1p-64);
  }
  int integer(int a, int b) { return a + static_cast<int>(engine_() % static_cast<std::uint32_t>(b - a + 1)); }
  double sign() { return engine_() % 2 == 0 ? 1.0 : -1.0; }
  /// Of either sign, its logarithm equally distributed.
  double scaled(double smallest, double largest) {
    return sign() * std::exp(uniform(std::log(smallest), std::log(largest)));
  }
  std::vector<double> coefficients(int degree, double size = 1.0) {
    std::vector<double> c;
    for (int k = 0; k <= degree; ++k) c.push_back(size * uniform(-1.0, 1.0));
    return c;
  }

 private:
  std::mt19937 engine_;
};

}  // namespace trajet::test
