#include "trajet/law/program_expansion.hpp"

#include <cassert>
#include <utility>

#include "program_branches.hpp"
#include "recurrence_step.hpp"

namespace trajet {

template <class T>
ProgramExpansionT<T>::ProgramExpansionT(Program program)
    : program_(std::move(program)), row_count_(program_.slot_count) {
  assert(program_.input_count == dimension() + 1);
  end_state_.resize(program_.outputs.size());
  end_tolerance_.resize(program_.outputs.size());
  for (const Instruction& instruction : program_.instructions) {
    Step step{instruction, row_count_, -1};
    row_count_ += detail::scratch_count(instruction.opcode);
    const auto branch_on = [&](typename Branch::Kind kind, int function) {
      step.branch = static_cast<int>(branches_.size());
      Branch branch;
      branch.kind = kind;
      branch.function = function;
      branches_.push_back(branch);
    };
    switch (instruction.opcode) {
      case Opcode::min:
      case Opcode::max:
      case Opcode::less:
      case Opcode::less_equal:
        branch_on(Branch::Kind::sign, step.scratch);
        break;
      case Opcode::abs:
      case Opcode::sign:
        branch_on(Branch::Kind::sign, instruction.a);
        break;
      case Opcode::equal:
        branch_on(Branch::Kind::nonzero, step.scratch);
        break;
      case Opcode::where:
        branch_on(Branch::Kind::nonzero, instruction.a);
        break;
      case Opcode::norm:
      case Opcode::sqrt:
        branch_on(Branch::Kind::positive, instruction.result);
        break;
      case Opcode::floor:
      case Opcode::table:
        branch_on(Branch::Kind::interval, instruction.a);
        break;
      default:
        break;
    }
    steps_.push_back(step);
  }
  ++row_count_;  // behind the last instruction, so that the first row of its own exists even where it needs none
}

template <class T>
void ProgramExpansionT<T>::reserve(int order) {
  if (order < stride_) return;
  stride_ = order + 1;
  rows_.assign(static_cast<std::size_t>(row_count_) * static_cast<std::size_t>(stride_), T(0.0));
  for (const Program::Constant& constant : program_.constants) row(constant.slot)[0] = constant.value;
}

template <class T>
void ProgramExpansionT<T>::expand(double t, const T* q, int order, T* coefficients) {
  assert(order >= 1 && order <= kMaxOrder);
  reserve(order);
  if (!continues_at(t, q)) forget_forced_branches();
  order_ = order;
  start_ = t;
  row_direction_ = direction_;
  const int dim = dimension();
  row(0)[0] = t;
  row(0)[1] = row_direction_;
  for (int i = 0; i < dim; ++i) row(1 + i)[0] = q[i];
  for (int n = 0; n < order; ++n) {
    for (const Step& step : steps_) run(step, n);
    // dq/ds = dq/dt / (ds/dt), ds/dt = +-1:  q[n+1] = (ds/dt) rate[n] / (n+1)
    for (int i = 0; i < dim; ++i) {
      row(1 + i)[n + 1] = row_direction_ * row(program_.outputs[static_cast<std::size_t>(i)])[n] / (n + 1);
    }
  }
  double power = 1.0;  // (ds/dt)^k
  for (int k = 0; k <= order; ++k, power *= row_direction_) {
    for (int i = 0; i < dim; ++i) coefficients[k * dim + i] = power * row(1 + i)[k];
  }
}

template <class T>
void ProgramExpansionT<T>::run(const Step& step, int n) {
  if (step.branch >= 0) return run_branch(step, branches_[static_cast<std::size_t>(step.branch)], n);
  detail::smooth_step(
      step.instruction, [this](int slot) { return row(slot); }, row(step.scratch), row(step.scratch + 1), n);
}

template class ProgramExpansionT<double>;
template class ProgramExpansionT<long double>;

}  // namespace trajet
