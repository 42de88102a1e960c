#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "trajet/math/number.hpp"
#include "trajet/math/number_traits.hpp"
#include "trajet/portable.hpp"

namespace trajet {

/// A number type that computes no value but what the value depends on: the set of inputs that have gone into it.
///
/// A law evaluated on it tells its structure (ode/structure.hpp). Read off the formula: `x - x` depends on x.
class Dependence {
 public:
  Dependence() = default;
  /// A constant: depends on nothing.
  Dependence(double) {}  // NOLINT(google-explicit-constructor)
  static Dependence on(int input) {
    Dependence d;
    d.inputs_ = {input};
    d.is_input_ = true;
    return d;
  }

  /// The inputs that it depends on, in increasing order.
  const std::vector<int>& inputs() const { return inputs_; }
  /// The input that it is, untouched by any operation.
  std::optional<int> input() const { return is_input_ ? std::optional(inputs_.front()) : std::nullopt; }

  Dependence& operator+=(const Dependence& b) { return *this = *this + b; }
  Dependence& operator-=(const Dependence& b) { return *this = *this + b; }
  Dependence& operator*=(const Dependence& b) { return *this = *this + b; }
  Dependence& operator/=(const Dependence& b) { return *this = *this + b; }
  /// What any operation on two numbers depends on: all that they depend on.
  friend Dependence operator+(const Dependence& a, const Dependence& b) {
    Dependence both;
    both.inputs_.reserve(a.inputs_.size() + b.inputs_.size());
    ranges::set_union(a.inputs_, b.inputs_, std::back_inserter(both.inputs_));
    return both;
  }
  friend Dependence operator-(const Dependence& a, const Dependence& b) { return a + b; }
  friend Dependence operator*(const Dependence& a, const Dependence& b) { return a + b; }
  friend Dependence operator/(const Dependence& a, const Dependence& b) { return a + b; }
  friend Dependence operator-(const Dependence& a) { return transcendental(a); }

  /// Any function of one number.
  static Dependence transcendental(Dependence a) {
    a.is_input_ = false;
    return a;
  }

 private:
  std::vector<int> inputs_;
  bool is_input_ = false;
};

/// The answer to a comparison of two Dependences. As a bool it is false, and what a law computes behind an `if` is then
/// one branch of several: who evaluates a law has to look at `met`.
struct DependenceComparison {
  Dependence operands;
  explicit operator bool() const {
    met = true;
    return false;
  }
  static inline thread_local bool met = false;
};

inline DependenceComparison operator<(const Dependence& a, const Dependence& b) { return {a + b}; }
inline DependenceComparison operator<=(const Dependence& a, const Dependence& b) { return {a + b}; }
inline DependenceComparison operator>(const Dependence& a, const Dependence& b) { return {a + b}; }
inline DependenceComparison operator>=(const Dependence& a, const Dependence& b) { return {a + b}; }
inline DependenceComparison operator==(const Dependence& a, const Dependence& b) { return {a + b}; }
inline DependenceComparison operator!=(const Dependence& a, const Dependence& b) { return {a + b}; }
inline DependenceComparison less(const Dependence& a, const Dependence& b) { return {a + b}; }
inline DependenceComparison less_equal(const Dependence& a, const Dependence& b) { return {a + b}; }
inline DependenceComparison equal(const Dependence& a, const Dependence& b) { return {a + b}; }
inline Dependence where(const DependenceComparison& condition, const Dependence& a, const Dependence& b) {
  return condition.operands + (a + b);
}

#define TRAJET_DEPENDENCE(function) \
  inline Dependence function(const Dependence& x) { return Dependence::transcendental(x); }
TRAJET_DEPENDENCE(sqrt)
TRAJET_DEPENDENCE(cbrt)
TRAJET_DEPENDENCE(exp)
TRAJET_DEPENDENCE(log)
TRAJET_DEPENDENCE(log10)
TRAJET_DEPENDENCE(sin)
TRAJET_DEPENDENCE(cos)
TRAJET_DEPENDENCE(tan)
TRAJET_DEPENDENCE(asin)
TRAJET_DEPENDENCE(acos)
TRAJET_DEPENDENCE(atan)
TRAJET_DEPENDENCE(sinh)
TRAJET_DEPENDENCE(cosh)
TRAJET_DEPENDENCE(tanh)
TRAJET_DEPENDENCE(abs)
TRAJET_DEPENDENCE(sign)
TRAJET_DEPENDENCE(floor)
TRAJET_DEPENDENCE(square)
#undef TRAJET_DEPENDENCE
inline Dependence atan2(const Dependence& y, const Dependence& x) { return y + x; }
inline Dependence min(const Dependence& a, const Dependence& b) { return a + b; }
inline Dependence max(const Dependence& a, const Dependence& b) { return a + b; }
inline Dependence pow(const Dependence& x, const Dependence& y) { return x + y; }
inline Dependence norm3(const Dependence& x, const Dependence& y, const Dependence& z) { return x + y + z; }

}  // namespace trajet

template <>
struct Eigen::NumTraits<trajet::Dependence> : trajet::NumberTraits<trajet::Dependence, 1, 1, 1> {};
