#include "trajet/law/program_jacobian.hpp"

#include <algorithm>
#include <cstddef>

namespace trajet {

ProgramJacobian::ProgramJacobian(const Program& program)
    : evaluator_(program), state_(static_cast<std::size_t>(program.input_count - 1)), rate_(program.outputs.size()) {}

void ProgramJacobian::operator()(double t, const double* q, double* dg_dq, double* dg_dt) {
  const int dimension = static_cast<int>(state_.size());
  const std::size_t rows = rate_.size();
  // direction j < dimension is q_j, direction `dimension` is time
  for (int first = 0; first <= dimension; first += Number::kDirections) {
    const int end = std::min(first + Number::kDirections, dimension + 1);
    for (int j = 0; j < dimension; ++j) {
      Number& x = state_[static_cast<std::size_t>(j)];
      x = j >= first && j < end ? Number::variable(q[j], j - first) : Number(q[j]);
    }
    const Number time = dimension < end ? Number::variable(t, dimension - first) : Number(t);
    evaluator_(time, state_.data(), rate_.data());
    for (int j = first; j < end; ++j) {
      double* column = j < dimension ? dg_dq + static_cast<std::size_t>(j) * rows : dg_dt;
      for (std::size_t i = 0; i < rows; ++i) column[i] = rate_[i].derivative(j - first);
    }
  }
}

}  // namespace trajet
