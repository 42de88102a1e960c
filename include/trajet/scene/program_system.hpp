#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "trajet/law/evaluate.hpp"
#include "trajet/law/program.hpp"
#include "trajet/law/program_expansion.hpp"
#include "trajet/law/program_jacobian.hpp"
#include "trajet/law/rate_evaluator.hpp"
#include "trajet/ode/system.hpp"
#include "trajet/portable.hpp"

namespace trajet {

/// A compiled law as the problem dq/dt = g(q, t): the program's inputs are t and q, its outputs dq.
class ProgramSystem : public System {
 public:
  explicit ProgramSystem(const Program& program) : expansion_(program), evaluator_(expansion_.program()) {}
  ProgramSystem(const ProgramSystem&) = delete;
  ProgramSystem& operator=(const ProgramSystem&) = delete;

  int dimension() const override { return expansion_.dimension(); }
  const Program& program() const { return expansion_.program(); }
  /// The law is asked for what it is between these two times, s, within which no branch changes by t alone: outside it
  /// goes on as at the nearer one, so that it is on one branch up to the very end of a step.
  void keep_within(double first, double last) {
    earliest_ = std::min(first, last);
    latest_ = std::max(first, last);
    leaves_branches_by_time_ = true;
    expansion_.leave_branches_by_time();
  }
  /// What `keep_within` has said last; without end if it has not.
  double earliest() const { return earliest_; }
  double latest() const { return latest_; }
  /// From now on the constant in a slot of the law is this one.
  void set_constant(std::int32_t slot, double value) {
    expansion_.set_constant(slot, value);
    evaluator_.set_constant(slot, value);
    if (extended_) extended_->set_constant(slot, value);
    if (jacobian_) jacobian_->set_constant(slot, value);
  }
  void rate(double t, const double* q, double* dq) override { evaluator_(within(t), q, dq); }
  BlockBorder block_border() override {
    if (evaluator_.lanes().empty()) return {};
    return {evaluator_.lanes(), evaluator_.state(), evaluator_.rate()};
  }
  void evaluate_blocks(double t) override { evaluator_.evaluate_blocks(within(t)); }
  void jacobian(double t, const double* q, double* dg_dq, double* dg_dt) override {
    if (!jacobian_) jacobian_.emplace(expansion_.program());
    (*jacobian_)(within(t), q, dg_dq, dg_dt);
  }
  void expand(double t, const double* q, int order, double* coefficients) override {
    expansion_.expand(within(t), q, order, coefficients);
    extended_was_last_ = false;
  }
  void expand(double t, const Extended* q, int order, Extended* coefficients) override {
    if (!extended_) extended_.emplace(expansion_.program());
    if (leaves_branches_by_time_) extended_->leave_branches_by_time();
    extended_->expand(within(t), q, order, coefficients);
    extended_was_last_ = true;
  }
  double duration_until_branch(double duration) override {
    return extended_was_last_ ? extended_->duration_until_branch(duration) : expansion_.duration_until_branch(duration);
  }
  int polynomial_degree() const override { return trajet::polynomial_degree(expansion_.program()); }
  Structure structure() const override { return structure_of(expansion_.program()); }

  /// The structure of a compiled law.
  static Structure structure_of(const Program& program) {
    Evaluator<Dependence> evaluator(program);
    const auto law = [&evaluator](const Dependence& t, const auto& q, auto& dq) { evaluator(t, q.data(), dq.data()); };
    return trajet::structure_of(law, static_cast<int>(program.outputs.size()));
  }

 private:
  double within(double t) const { return std::clamp(t, earliest_, latest_); }

  double earliest_ = -std::numeric_limits<double>::infinity();
  double latest_ = std::numeric_limits<double>::infinity();
  bool leaves_branches_by_time_ = false;
  ProgramExpansion expansion_;
  std::optional<ProgramExpansionT<Extended>> extended_;  // made when first asked for
  bool extended_was_last_ = false;
  RateEvaluator evaluator_;
  std::optional<ProgramJacobian> jacobian_;  // made when first asked for: most methods never do
};

}  // namespace trajet
