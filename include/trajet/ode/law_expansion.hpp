#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "trajet/math/branch.hpp"
#include "trajet/math/polynomial_degree.hpp"
#include "trajet/math/replay_functions.hpp"
#include "trajet/portable.hpp"

namespace trajet {

/// Taylor expansion of the solutions of dq/dt = law(t, q), a law that is a C++ callable generic in its number type.
///
/// `law(t, q, dq)` gets a scalar t and Eigen vectors q and dq, of double or of Replay numbers. It may branch on
/// comparisons; what it computes must depend on nothing else that changes. `T`, double or Extended, is the type of
/// the coefficients.
template <class Law, int Dim, class T = double>
class LawExpansion {
 public:
  using Number = T;
  using State = Eigen::Matrix<double, Dim, 1>;
  using NumberState = Eigen::Matrix<T, Dim, 1>;

  LawExpansion(Law law, int dimension) : law_(std::move(law)), dimension_(dimension) {
    tape_.grow(1 + dimension + kFirstCapacity);
  }

  TRAJET_INLINE int dimension() const {
    if constexpr (Dim == Eigen::Dynamic) return dimension_;
    return Dim;
  }

  TRAJET_INLINE void rate(double t, const State& q, State& dq) const { law_(t, q, dq); }

  /// Taylor coefficients of the solution through (t, q) up to (time - t)^order, order <= kMaxOrder.
  /// `coefficients` is (dimension x order+1) or wider, column-major; column 0 becomes q.
  void expand(double t, const NumberState& q, int order, T* coefficients) {
    if (t != branch_time_) tape_.forced_signs().clear();
    start(t, q, coefficients);
    for (int used = replay<0>(coefficients); used > tape_.capacity(); used = replay<0>(coefficients)) {
      tape_.grow(used);
      start(t, q, coefficients);
    }
    replay_rest(order, coefficients, std::make_integer_sequence<int, ReplayTape<T>::kMaxOrder - 1>());
    order_ = order;
    start_time_ = t;
  }

  /// See System::duration_until_branch.
  double duration_until_branch(double duration) {
    BranchTime first{duration, -1, 0.0};
    std::array<double, ReplayTape<T>::kMaxOrder> room;
    for (std::size_t i = 0; i < tape_.branches().size(); ++i) {
      const auto& branch = tape_.branches()[i];
      const bool starts_at_zero = i < tape_.forced_signs().size() && tape_.forced_signs()[i] != 0.0;
      const BranchTime time = first_sign_change(detail::in_doubles(tape_.slot(branch.slot), order_, room), branch.sign,
                                                starts_at_zero, first.duration);
      if (time.index >= 0)
        first = {time.duration, static_cast<int>(i), time.sign_after};
      else if (time.duration != first.duration)
        first = time;
    }
    if (first.index < 0) return first.duration;
    tape_.forced_signs().assign(tape_.branches().size(), 0.0);
    tape_.forced_signs()[static_cast<std::size_t>(first.index)] = first.sign_after;
    branch_time_ = start_time_ + first.duration;
    return first.duration;
  }

  /// See System::polynomial_degree.
  int polynomial_degree() const {
    using DegreeState = Eigen::Matrix<PolynomialDegree, Dim, 1>;
    constexpr int kHighest = ReplayTape<T>::kMaxOrder;
    DegreeState q(dimension()), dq(dimension());
    for (int i = 0; i < dimension(); ++i) q[i] = PolynomialDegree::of(0);
    // each pass carries degrees one operation of integration further: a polynomial of degree d is complete after d
    // passes
    for (int pass = 0; pass <= kHighest + 1; ++pass) {
      for (int i = 0; i < dimension(); ++i) dq[i] = PolynomialDegree();
      DegreeComparison::met = false;
      law_(PolynomialDegree::of(1), q, dq);
      if (DegreeComparison::met) return -1;
      bool changed = false;
      int highest = 0;
      for (int i = 0; i < dimension(); ++i) {
        if (dq[i].degree() >= kHighest) return -1;
        const int degree = dq[i].degree() + 1;
        changed = changed || degree > q[i].degree();
        q[i] = PolynomialDegree::of(std::max(degree, q[i].degree()));
        highest = std::max(highest, q[i].degree());
      }
      if (!changed) return highest;
    }
    return -1;
  }

 private:
  static constexpr int kFirstCapacity = 24;  // slots for a small law; others get more at the first expansion

  void start(double t, const NumberState& q, T* coefficients) {
    tape_.branches().clear();
    T* time = tape_.slot(0);
    std::fill(time, time + ReplayTape<T>::kStride, T(0.0));
    time[0] = t;
    time[1] = 1.0;
    for (int i = 0; i < dimension(); ++i) coefficients[i] = tape_.slot(1 + i)[0] = q[i];
  }

  /// One order of every operation of the law; order + 1 of the state. Returns the number of slots used.
  template <int Order>
  TRAJET_FLATTEN int replay(T* coefficients) {
    using Operand = Replay<T, Order>;
    T* const base = tape_.slot(0);
    ReplayPass<T> pass{&tape_, 1 + dimension(), 0, tape_.capacity()};
    Eigen::Matrix<Operand, Dim, 1> q(dimension()), dq(dimension());
    for (int i = 0; i < dimension(); ++i) q[i] = Operand(&pass, base, 1 + i);
    law_(Operand(&pass, base, 0), q, dq);
    if (Order == 0 && pass.next_slot > pass.capacity) return pass.next_slot;
    T* next = coefficients + static_cast<std::ptrdiff_t>(Order + 1) * dimension();
    for (int i = 0; i < dimension(); ++i) {
      const T rate = Order == 0 ? dq[i].newest() : dq[i].coefficient();
      next[i] = q[i].coefficients()[Order + 1] = rate * (T(1.0) / (Order + 1));
    }
    return pass.next_slot;
  }

  template <int... Order>
  TRAJET_INLINE void replay_rest(int order, T* coefficients, std::integer_sequence<int, Order...>) {
    // stops at the order asked for: && ends the chain
    static_cast<void>(((Order + 1 < order && (replay<Order + 1>(coefficients), true)) && ...));
  }

  Law law_;
  int dimension_;
  int order_ = 0;
  double start_time_ = 0.0;
  double branch_time_ = std::numeric_limits<double>::quiet_NaN();
  ReplayTape<T> tape_;
};

}  // namespace trajet
