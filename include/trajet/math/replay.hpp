#pragma once

#include <Eigen/Core>
#include <vector>

#include "trajet/math/force_inline.hpp"
#include "trajet/math/number_traits.hpp"
#include "trajet/math/recurrences.hpp"

namespace trajet {

/// The power series of everything that a law computes, one slot of coefficients per operation, filled one order at a
/// time.
///
/// A law is called once per order on `Replay` numbers. Each operation, in the order in which the law performs them,
/// owns the next slot and computes only its coefficient of the current order, from the slots of its operands: an
/// expansion of order N costs O(N^2) per operation. Once the law is inlined, the slots' addresses are constants.
template <class T>
class ReplayTape {
 public:
  static constexpr int kMaxOrder = 26;
  /// Coefficients of a slot, then one place for what an operation keeps between orders.
  static constexpr int kStride = kMaxOrder + 2;

  /// A point where a law may take another branch: the slot of the function whose sign decides, and the sign taken.
  struct Branch {
    int slot;
    double sign;
  };

  T* slot(int index) { return storage_.data() + static_cast<std::ptrdiff_t>(index) * kStride; }
  const T* slot(int index) const { return storage_.data() + static_cast<std::ptrdiff_t>(index) * kStride; }
  int capacity() const { return static_cast<int>(storage_.size()) / kStride; }
  void grow(int slots) { storage_.resize(static_cast<std::size_t>(slots) * kStride); }

  /// The branches met by the last replay of order 0, in order.
  std::vector<Branch>& branches() { return branches_; }
  /// Signs to take instead of those of the values, by the branch's index; 0: look at the value.
  std::vector<double>& forced_signs() { return forced_signs_; }

 private:
  std::vector<T> storage_;
  std::vector<Branch> branches_;
  std::vector<double> forced_signs_;
};

/// One pass of a law over a tape: the next free slot.
template <class T>
struct ReplayPass {
  ReplayTape<T>* tape;
  int next_slot;
  int next_branch = 0;
  /// Slots of the tape. An order-0 pass that needs more only counts them, in `next_slot`, and is run again.
  int capacity;
};

template <class T, int N>
class Replay;

namespace detail {
template <class T, int N>
double comparison_sign(const Replay<T, N>& a, const Replay<T, N>& b);
template <class T, int N>
Replay<T, N> greater_of(const Replay<T, N>& a, const Replay<T, N>& b);
template <class T, int N>
Replay<T, N> angle_of(const Replay<T, N>& y, const Replay<T, N>& x);
}  // namespace detail

/// The number type that a law meets during the replay of order N: a slot of the tape, or a constant.
template <class T, int N>
class Replay {
 public:
  static constexpr std::integral_constant<int, N> kOrder{};

  Replay() = default;
  TRAJET_INLINE Replay(Factor<T> constant) : constant_(constant) {}  // NOLINT(google-explicit-constructor)
  TRAJET_INLINE Replay(ReplayPass<T>* pass, T* base, int slot) : pass_(pass), base_(base), slot_(slot) {}

  TRAJET_INLINE bool is_constant() const { return pass_ == nullptr; }
  TRAJET_INLINE Factor<T> constant() const { return constant_; }
  TRAJET_INLINE ReplayPass<T>* pass() const { return pass_; }
  TRAJET_INLINE int slot() const { return slot_; }
  /// Its coefficients so far.
  TRAJET_INLINE T* coefficients() const { return base_ + static_cast<std::ptrdiff_t>(slot_) * ReplayTape<T>::kStride; }
  /// Another slot of the same tape.
  TRAJET_INLINE Replay neighbour(int slot) const { return Replay(pass_, base_, slot); }

  /// The coefficient of the current order.
  TRAJET_INLINE T newest() const {
    if (is_constant()) return T(constant_);
    return coefficients()[N];
  }
  /// That of a constant is zero beyond order 0.
  TRAJET_INLINE T coefficient() const {
    if (is_constant()) return T(0.0);
    return coefficients()[N];
  }

  TRAJET_INLINE Replay& operator+=(const Replay& b) { return *this = *this + b; }
  TRAJET_INLINE Replay& operator-=(const Replay& b) { return *this = *this - b; }
  TRAJET_INLINE Replay& operator*=(const Replay& b) { return *this = *this * b; }
  TRAJET_INLINE Replay& operator/=(const Replay& b) { return *this = *this / b; }

  /// The next slot of the tape of `of`, whose newest coefficient is `compute(coefficients of the slot)`.
  template <class Compute>
  TRAJET_INLINE static Replay record(const Replay& of, const Compute& compute) {
    const int slot = of.pass_->next_slot++;
    if (N == 0 && slot >= of.pass_->capacity) [[unlikely]]
      return of.neighbour(0);
    const Replay result = of.neighbour(slot);
    T* coefficients = result.coefficients();
    coefficients[N] = compute(coefficients);
    return result;
  }

  /// Two slots of functions that are computed together by `compute(first, second)`; returns the first.
  template <class Compute>
  TRAJET_INLINE static Replay record_pair(const Replay& of, const Compute& compute) {
    const int slot = of.pass_->next_slot;
    of.pass_->next_slot += 2;
    if (N == 0 && slot + 1 >= of.pass_->capacity) [[unlikely]]
      return of.neighbour(0);
    const Replay result = of.neighbour(slot);
    compute(result.coefficients(), of.neighbour(slot + 1).coefficients());
    return result;
  }

  friend TRAJET_INLINE Replay operator-(const Replay& a) {
    if (a.is_constant()) return Replay(-a.constant_);
    return record(a, [&](T*) { return -a.newest(); });
  }
  friend TRAJET_INLINE Replay operator+(const Replay& a, const Replay& b) {
    if (a.is_constant() && b.is_constant()) return Replay(a.constant_ + b.constant_);
    if (a.is_constant()) return b.plus(a.constant_);
    if (b.is_constant()) return a.plus(b.constant_);
    return record(a, [&](T*) { return a.newest() + b.newest(); });
  }
  friend TRAJET_INLINE Replay operator-(const Replay& a, const Replay& b) {
    if (a.is_constant() && b.is_constant()) return Replay(a.constant_ - b.constant_);
    if (b.is_constant()) return a.plus(-b.constant_);
    if (a.is_constant()) return record(b, [&](T*) { return N == 0 ? a.constant_ - b.newest() : -b.newest(); });
    return record(a, [&](T*) { return a.newest() - b.newest(); });
  }
  friend TRAJET_INLINE Replay operator*(const Replay& a, const Replay& b) {
    if (a.is_constant() && b.is_constant()) return Replay(a.constant_ * b.constant_);
    if (a.is_constant()) return b.times(a.constant_);
    if (b.is_constant()) return a.times(b.constant_);
    if (a.slot_ == b.slot_) return record(a, [&](T*) { return recurrence::square<T>(a.coefficients(), kOrder); });
    return record(a, [&](T*) { return recurrence::multiply<T>(a.coefficients(), b.coefficients(), kOrder); });
  }
  friend TRAJET_INLINE Replay operator/(const Replay& a, const Replay& b) {
    if (b.is_constant()) {
      if (a.is_constant()) return Replay(a.constant_ / b.constant_);
      // a division at every order would lengthen the chain of dependent operations; the value itself stays exact
      return record(a, [&](T*) { return N == 0 ? a.newest() / b.constant_ : a.newest() * (1.0 / b.constant_); });
    }
    return record(b, [&](T* c) {
      const T a_n = N == 0 ? a.newest() : a.coefficient();
      return recurrence::divide<T>(a_n, b.coefficients(), c, kOrder);
    });
  }

  // Functions of two numbers are friends, so that either may be a plain number.
  friend TRAJET_INLINE bool operator<(const Replay& a, const Replay& b) { return detail::comparison_sign(a, b) < 0.0; }
  friend TRAJET_INLINE bool operator>(const Replay& a, const Replay& b) { return detail::comparison_sign(a, b) > 0.0; }
  friend TRAJET_INLINE bool operator<=(const Replay& a, const Replay& b) {
    return detail::comparison_sign(a, b) <= 0.0;
  }
  friend TRAJET_INLINE bool operator>=(const Replay& a, const Replay& b) {
    return detail::comparison_sign(a, b) >= 0.0;
  }
  friend TRAJET_INLINE bool operator==(const Replay& a, const Replay& b) {
    return detail::comparison_sign(a, b) == 0.0;
  }
  friend TRAJET_INLINE bool less(const Replay& a, const Replay& b) { return a < b; }
  friend TRAJET_INLINE bool less_equal(const Replay& a, const Replay& b) { return a <= b; }
  friend TRAJET_INLINE bool equal(const Replay& a, const Replay& b) { return a == b; }
  friend TRAJET_INLINE Replay where(bool condition, const Replay& a, const Replay& b) { return condition ? a : b; }
  friend TRAJET_INLINE Replay max(const Replay& a, const Replay& b) { return detail::greater_of(a, b); }
  friend TRAJET_INLINE Replay min(const Replay& a, const Replay& b) { return -detail::greater_of(-a, -b); }
  friend TRAJET_INLINE Replay atan2(const Replay& y, const Replay& x) { return detail::angle_of(y, x); }

 private:
  TRAJET_INLINE Replay plus(Factor<T> constant) const {
    return record(*this, [&](T*) { return N == 0 ? newest() + constant : newest(); });
  }
  TRAJET_INLINE Replay times(Factor<T> constant) const {
    return record(*this, [&](T*) { return newest() * constant; });
  }

  ReplayPass<T>* pass_ = nullptr;
  T* base_ = nullptr;  // of the tape: one address for all, so that the compiler sees which coefficients are the same
  int slot_ = -1;
  Factor<T> constant_ = 0.0;
};

namespace detail {

/// The sign on which a branch is decided; records where its function lives. Only at order 0 is anything decided: later
/// orders repeat that decision, whatever has become of the values.
template <class T, int N>
TRAJET_INLINE double branch_sign(const Replay<T, N>& x) {
  ReplayPass<T>* pass = x.pass();
  ReplayTape<T>& tape = *pass->tape;
  const auto index = static_cast<std::size_t>(pass->next_branch++);
  if (N > 0) return tape.branches()[index].sign;
  double value = trajet::sign(x.coefficients()[0]);
  if (index < tape.forced_signs().size() && tape.forced_signs()[index] != 0.0) value = tape.forced_signs()[index];
  tape.branches().push_back({x.slot(), value});
  return value;
}

template <class T, int N>
TRAJET_INLINE double comparison_sign(const Replay<T, N>& a, const Replay<T, N>& b) {
  const Replay<T, N> difference = a - b;
  if (difference.is_constant()) return trajet::sign(difference.constant());
  return branch_sign(difference);
}

}  // namespace detail

}  // namespace trajet

/// Eigen vectors of Replay numbers.
template <class T, int N>
struct Eigen::NumTraits<trajet::Replay<T, N>> : trajet::NumberTraits<trajet::Replay<T, N>, 1, 4, 16> {};
