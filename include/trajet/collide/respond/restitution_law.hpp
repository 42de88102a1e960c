#pragma once

#include <memory>
#include <utility>

#include "trajet/law/program.hpp"

namespace trajet {

/// How much of the normal speed an impact leaves: a constant, or a function of the speed of approach u >= 0, m/s, or
/// the geometric mean of two of those.
class RestitutionLaw {
 public:
  RestitutionLaw(double constant = 1.0)
      : constant_(constant) {}  // NOLINT(google-explicit-constructor): a number is one
  /// Its first input is not read, the second is u.
  explicit RestitutionLaw(Program of_speed) : of_speed_(std::make_shared<const Program>(std::move(of_speed))) {}

  static RestitutionLaw mean(const RestitutionLaw& a, const RestitutionLaw& b);

  bool is_constant(double value) const { return !of_speed_ && !factors_ && constant_ == value; }
  /// At speed u: it may lie outside of 0 and 1 where it is not constant.
  double at(double u) const;
  /// The derivative by u of (1 + e(u)) u, the change of the normal speed.
  double change_rate(double u) const;

 private:
  /// The derivative of e by u.
  double slope(double u) const;

  double constant_ = 1.0;
  std::shared_ptr<const Program> of_speed_{};  // of a hundred thousand obstacles few have one
  std::shared_ptr<const std::pair<RestitutionLaw, RestitutionLaw>> factors_{};  // of a mean
};

}  // namespace trajet
