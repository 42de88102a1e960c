#pragma once

#include <vector>

#include "trajet/law/evaluate.hpp"
#include "trajet/law/program.hpp"
#include "trajet/math/dual.hpp"

namespace trajet {

/// The Jacobian of a program whose outputs are dq/dt of its inputs behind t, by dual numbers: exact up to rounding.
///
/// The program runs once for every eight directions, of which there are one more than inputs of the state.
class ProgramJacobian {
 public:
  /// Keeps a pointer to the program.
  explicit ProgramJacobian(const Program& program);

  /// At (t, q): dg_dq(i, j) = d output_i / d q_j  // (dimension x dimension), column-major
  /// and dg_dt(i) = d output_i / dt.
  void operator()(double t, const double* q, double* dg_dq, double* dg_dt);
  /// From now on the constant in a slot is another one than the program's.
  void set_constant(std::int32_t slot, double value) { evaluator_.set_constant(slot, value); }

 private:
  using Number = Dual<8>;

  Evaluator<Number> evaluator_;
  std::vector<Number> state_;
  std::vector<Number> rate_;
};

}  // namespace trajet
