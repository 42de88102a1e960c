#pragma once

#include <Eigen/Core>
#include <vector>

#include "trajet/math/block4.hpp"
#include "trajet/ode/structure.hpp"
#include "trajet/portable.hpp"

namespace trajet {

/// A law can change its branch this often at one instant before it counts as undecided there.
inline constexpr int kMaxBranchChanges = 8;

/// Where a System takes a state, and leaves its rate, in blocks of four lanes: a stepper whose state is in vector
/// registers needs one store and a load or two to cross over. There is room for a multiple of four blocks, 64 bytes
/// aligned; what lies in lanes of no component is not defined.
struct BlockBorder {
  std::vector<int> lanes{};  ///< for each component of the state; empty: the system has no such border
  Block4* state = nullptr;
  const Block4* rate = nullptr;
};

/// The problem dq/dt = g(q, t) as a run-time object: what a compiled scene hands to the integrators.
///
/// A C++ law that is a generic lambda needs none of this: the steppers take it directly.
class System {
 public:
  virtual ~System() = default;

  virtual int dimension() const = 0;

  /// dq = g(q, t). `q` and `dq` hold `dimension()` numbers and do not overlap.
  virtual void rate(double t, const double* q, double* dq) = 0;

  /// The border over which evaluate_blocks works; it stays as it is.
  virtual BlockBorder block_border() { return {}; }
  /// rate = g(state, t) at the border.
  virtual void evaluate_blocks(double /*t*/) {}

  /// The exact derivatives of g at (t, q): dg_dq(i, j) = d g_i / d q_j, (dimension x dimension), column-major, and
  /// dg_dt(i) = d g_i / dt. What has no derivative gives one of its one-sided derivatives or zero.
  virtual void jacobian(double t, const double* q, double* dg_dq, double* dg_dt) = 0;

  /// The Taylor coefficients of the solution through (t, q) up to (time)^order.
  ///
  /// `coefficients` is (dimension x order+1), column-major: column k belongs to (time - t)^k; column 0 is q.
  virtual void expand(double t, const double* q, int order, double* coefficients) = 0;
  /// The same in extended precision.
  virtual void expand(double t, const Extended* q, int order, Extended* coefficients) = 0;

  /// Whether the last expansion, in either precision, stays the solution's up to `duration` (s, either sign) later: the
  /// time until the law takes another branch (a comparison, abs, sign, min, max, floor, the next interval of a table),
  /// or `duration` if it does not. The next expansion, if it starts there, takes the branch behind it.
  virtual double duration_until_branch(double duration) = 0;

  /// The degree in time of every solution if the law makes it a polynomial whatever the state, else a negative number.
  virtual int polynomial_degree() const = 0;

  /// Which components the rate of each component depends on.
  virtual Structure structure() const = 0;
};

}  // namespace trajet
