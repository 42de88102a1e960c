#pragma once

#include <algorithm>
#include <optional>

#include "trajet/event/law_branches.hpp"
#include "trajet/scene/program_system.hpp"

namespace trajet {

/// A law with its choices or, in their place, the branches that were found for it.
class SwitchedSystem final : public System {
 public:
  /// `whole`, with the choices, must outlive it; `pinned` is the same law without.
  SwitchedSystem(ProgramSystem& whole, const Program& pinned) : whole_(&whole), pinned_(pinned), law_(&whole) {}
  SwitchedSystem(const SwitchedSystem&) = delete;
  SwitchedSystem& operator=(const SwitchedSystem&) = delete;

  void take_whole() { law_ = whole_; }
  void take_branches(const LawBranches& branches) {
    law_ = &pinned_;
    for (const LawBranches::PinValue& pin : branches.pins()) pinned_.set_constant(pin.slot, pin.value);
    if (branches.sliding().empty()) return;
    law_ = &sliding_.emplace(branches.sliding_law());
    keep_within_piece();
  }
  bool is_whole() const { return law_ == whole_; }
  /// What t alone decides, it decides as in the whole law.
  void keep_within_piece() {
    if (!is_whole()) law_->keep_within(whole_->earliest(), whole_->latest());
  }
  double within_piece(double t) const { return std::clamp(t, whole_->earliest(), whole_->latest()); }

  int dimension() const override { return whole_->dimension(); }
  void rate(double t, const double* q, double* dq) override { law_->rate(t, q, dq); }
  void jacobian(double t, const double* q, double* dg_dq, double* dg_dt) override {
    law_->jacobian(t, q, dg_dq, dg_dt);
  }
  void expand(double t, const double* q, int order, double* coefficients) override {
    law_->expand(t, q, order, coefficients);
  }
  void expand(double t, const Extended* q, int order, Extended* coefficients) override {
    law_->expand(t, q, order, coefficients);
  }
  double duration_until_branch(double duration) override { return law_->duration_until_branch(duration); }
  int polynomial_degree() const override { return whole_->polynomial_degree(); }
  Structure structure() const override { return whole_->structure(); }

 private:
  ProgramSystem* whole_;
  ProgramSystem pinned_;
  std::optional<ProgramSystem> sliding_;
  ProgramSystem* law_;
};

}  // namespace trajet
