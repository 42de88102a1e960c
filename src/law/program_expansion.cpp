#include "trajet/law/program_expansion.hpp"

#include <cassert>
#include <limits>
#include <type_traits>
#include <utility>

#include "block_rows.hpp"
#include "hidden_poles.hpp"
#include "program_branches.hpp"
#include "recurrence_step.hpp"
#include "trajet/law/time_branches.hpp"

#include "trajet/portable.hpp"

namespace trajet {

namespace {

/// Orders up to here have sums of their own without loops: enough for a relative tolerance of 1e-16.
constexpr int kUnrolledOrders = 28;

}  // namespace

template <class T>
ProgramExpansionT<T>::ProgramExpansionT(Program program)
    : program_(std::move(program)), row_count_(program_.slot_count) {
  assert(program_.input_count == dimension() + 1);
  end_state_.resize(program_.outputs.size());
  end_tolerance_.resize(program_.outputs.size());
  const std::vector<bool> hides_poles = detail::find_hidden_poles(program_);
  const std::vector<bool> time_slots = find_time_slots(program_);
  for (std::size_t i = 0; i < program_.instructions.size(); ++i) {
    const Instruction& instruction = program_.instructions[i];
    const int own = row_count_;
    row_count_ += detail::scratch_count(instruction.opcode);
    const auto branch = find_branch(instruction, own, hides_poles[i]);
    branch_of_.push_back(branch ? static_cast<int>(branches_.size()) : -1);
    if (!branch) continue;
    branches_.push_back(*branch);
    branches_.back().is_by_time = branches_by_time(instruction, time_slots);
  }
  if constexpr (std::is_same_v<T, double>) {
    if (auto blocks = detail::bundle(program_)) blocks_ = std::make_unique<detail::BlockRows>(std::move(*blocks));
  }
}

template <class T>
ProgramExpansionT<T>::~ProgramExpansionT() = default;

template <class T>
auto ProgramExpansionT<T>::find_branch(const Instruction& instruction, int own, bool hides_pole)
    -> std::optional<Branch> {
  Branch branch;
  switch (instruction.opcode) {
    case Opcode::min:
    case Opcode::max:
    case Opcode::less:
    case Opcode::less_equal:
      branch.kind = Branch::Kind::sign;
      branch.function = own;
      return branch;
    case Opcode::abs:
    case Opcode::sign:
      branch.kind = Branch::Kind::sign;
      branch.function = instruction.a;
      return branch;
    case Opcode::atan2:
      branch.kind = Branch::Kind::sign;
      branch.function = instruction.a;
      return branch;
    case Opcode::divide:
    case Opcode::constant_over:
      if (!hides_pole) return std::nullopt;
      branch.kind = Branch::Kind::sign;
      branch.function = instruction.opcode == Opcode::divide ? instruction.b : instruction.a;
      return branch;
    case Opcode::equal:
      branch.kind = Branch::Kind::nonzero;
      branch.function = own;
      return branch;
    case Opcode::where:
      branch.kind = Branch::Kind::nonzero;
      branch.function = instruction.a;
      return branch;
    case Opcode::norm:
    case Opcode::sqrt:
      branch.kind = Branch::Kind::positive;
      branch.function = instruction.result;
      return branch;
    case Opcode::asin:
    case Opcode::acos:
      branch.kind = Branch::Kind::positive;
      branch.function = own;  // sqrt(1 - a^2)
      return branch;
    case Opcode::floor:
    case Opcode::table:
    case Opcode::tan:
      branch.kind = Branch::Kind::interval;
      branch.function = instruction.a;
      return branch;
    default:
      return std::nullopt;
  }
}

template <class T>
void ProgramExpansionT<T>::reserve(int order) {
  if (order < stride_) return;
  stride_ = order + 1;
  rows_.assign(static_cast<std::size_t>(row_count_) * static_cast<std::size_t>(stride_), T(0.0));
  for (const Program::Constant& constant : program_.constants) row(constant.slot)[0] = constant.value.as<T>();
  place_rows();
}

template <class T>
void ProgramExpansionT<T>::set_constant(std::int32_t slot, double value) {
  for (Program::Constant& constant : program_.constants)
    if (constant.slot == slot) constant.value = value;
  if (stride_ > 0) row(slot)[0] = static_cast<T>(value);
  if (blocks_) blocks_->set_constant(slot, value);
}

template <class T>
void ProgramExpansionT<T>::place_rows() {
  steps_.clear();
  int own = program_.slot_count;
  for (std::size_t i = 0; i < program_.instructions.size(); ++i) {
    const Instruction& instruction = program_.instructions[i];
    const bool is_table = instruction.opcode == Opcode::table;  // whose b is no slot
    Step step{.opcode = instruction.opcode,
              .constant = instruction.constant.as<T>(),
              .a = row(instruction.a),
              .b = is_table ? nullptr : row(instruction.b),
              .c = row(instruction.c),
              .result = row(instruction.result),
              .own = {},
              .table = is_table ? program_.tables[static_cast<std::size_t>(instruction.b)].get() : nullptr,
              .branch = branch_of_[i]};
    for (int k = 0; k < detail::scratch_count(instruction.opcode); ++k)
      step.own[static_cast<std::size_t>(k)] = row(own++);
    steps_.push_back(step);
  }
  if constexpr (std::is_same_v<T, double>) {
    if (blocks_) blocks_->place_series(stride_, [this](int slot) { return row(slot); });
  }
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
  is_in_blocks_ = expand_in_blocks(q, order, coefficients);
  if (is_in_blocks_) return;
  for (int i = 0; i < dim; ++i) row(1 + i)[0] = q[i];
  for_each_order(order, [&](auto n) {
    run(n);
    return true;
  });
  for (int i = 0; i < dim; ++i) {
    const T* series = row(1 + i);
    double power = 1.0;  // (ds/dt)^k
    for (int k = 0; k <= order; ++k, power *= row_direction_) coefficients[k * dim + i] = power * series[k];
  }
}

template <class T>
template <class Run>
bool ProgramExpansionT<T>::for_each_order(int order, Run&& run) {
  int n = 0;
  bool goes_on = true;
  if constexpr (std::is_same_v<T, double>) {
    [&]<int... N>(std::integer_sequence<int, N...>) {
      // stops at the order asked for: && ends the chain
      static_cast<void>(((N < order && (n = N + 1, goes_on = run(std::integral_constant<int, N>()))) && ...));
    }
    (std::make_integer_sequence<int, kUnrolledOrders>());
  }
  for (; goes_on && n < order; ++n) goes_on = run(n);
  return goes_on;
}

template <class T>
template <class Order>
TRAJET_INLINE void ProgramExpansionT<T>::run_step(const Step& step, Order n) {
  if (step.branch >= 0 && detail::may_hide_pole(step.opcode)) {
    Branch& pole = branches_[static_cast<std::size_t>(step.branch)];
    decide_sign(pole, n);
    if (pole.starts_at_zero) {
      step.result[n] = std::numeric_limits<T>::quiet_NaN();  // no series begins at a pole
      return;
    }
  }
  if (detail::common_step(step, n)) return;
  if (step.branch >= 0) {
    run_branch(step, branches_[static_cast<std::size_t>(step.branch)], n);
  } else {
    detail::smooth_step(step, n);
  }
}

template <class T>
template <class Order>
void ProgramExpansionT<T>::run(Order n) {
  for (const Step& step : steps_) run_step(step, n);
  // dq/ds = dq/dt / (ds/dt), ds/dt = +-1:  q[n+1] = (ds/dt) rate[n] / (n+1)
  const T factor = row_direction_ * (T(1.0) / (n + 1));
  const std::int32_t* rate = program_.outputs.data();
  for (int i = 0; i < dimension(); ++i) row(1 + i)[n + 1] = factor * row(rate[i])[n];
}

template <class T>
template <class Order>
bool ProgramExpansionT<T>::run_blocks(Order n) {
  const auto scalar = [this, n](int index) { run_step(steps_[static_cast<std::size_t>(index)], n); };
  const T factor = row_direction_ * (T(1.0) / (n + 1));
  const bool is_regular = blocks_->run(n, factor, scalar);
  for (const int i : blocks_->program().single)
    row(1 + i)[n + 1] = factor * row(program_.outputs[static_cast<std::size_t>(i)])[n];
  return is_regular;
}

template <class T>
bool ProgramExpansionT<T>::expand_in_blocks(const T* q, int order, T* coefficients) {
  if constexpr (std::is_same_v<T, double>) {
    if (!blocks_) return false;
    for (std::size_t i = 0; i < branch_of_.size(); ++i) {
      if (branch_of_[i] < 0 || program_.instructions[i].opcode != Opcode::norm) continue;
      Branch& branch = branches_[static_cast<std::size_t>(branch_of_[i])];
      if (branch.forced_sign) return false;  // it starts where it vanishes
      branch.sign = 1.0;
      branch.starts_at_zero = false;
    }
    blocks_->set_state(q);
    for (const int i : blocks_->program().single) row(1 + i)[0] = q[i];
    if (!for_each_order(order, [&](auto n) { return run_blocks(n); })) return false;
    blocks_->write_state(order, dimension(), row_direction_, coefficients);
    for (const int i : blocks_->program().single) {
      double power = 1.0;
      for (int k = 0; k <= order; ++k, power *= row_direction_)
        coefficients[k * dimension() + i] = power * row(1 + i)[k];
    }
    return true;
  }
  return false;
}

template <class T>
void ProgramExpansionT<T>::unpack_state() {
  if constexpr (std::is_same_v<T, double>) {
    blocks_->unpack_state(order_, [this](int component) { return row(1 + component); });
  }
}

template class ProgramExpansionT<double>;
template class ProgramExpansionT<Extended>;

}  // namespace trajet
