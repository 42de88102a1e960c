#pragma once

#include <cassert>
#include <cmath>

#include "trajet/law/program_builder.hpp"
#include "trajet/math/number_traits.hpp"

namespace trajet {

/// A number that stands for a computation: a law written for any number type, evaluated on Terms, becomes part of the
/// Program that a ProgramBuilder builds. So the equations of motion that C++ programs call are those of the scenes.
///
/// A Term is a plain constant, or a node of a builder, which must outlive it. All nodes that meet are of one builder.
class Term {
 public:
  Term() = default;
  Term(double value) : value_(value) {}  // NOLINT(google-explicit-constructor): a number is a term
  Term(ProgramBuilder& builder, int node) : builder_(&builder), node_(node) {}

  /// The node of the builder that has this value.
  int node(ProgramBuilder& builder) const {
    assert(builder_ == nullptr || builder_ == &builder);
    return builder_ == nullptr ? builder.constant_node(value_) : node_;
  }

  friend Term operator+(const Term& a, const Term& b) { return combine(Opcode::add, a, b, a.value_ + b.value_); }
  friend Term operator-(const Term& a, const Term& b) { return combine(Opcode::subtract, a, b, a.value_ - b.value_); }
  friend Term operator*(const Term& a, const Term& b) { return combine(Opcode::multiply, a, b, a.value_ * b.value_); }
  friend Term operator/(const Term& a, const Term& b) { return combine(Opcode::divide, a, b, a.value_ / b.value_); }
  friend Term operator-(const Term& a) { return combine(Opcode::negate, a, a, -a.value_); }
  Term& operator+=(const Term& b) { return *this = *this + b; }
  Term& operator-=(const Term& b) { return *this = *this - b; }
  Term& operator*=(const Term& b) { return *this = *this * b; }
  friend Term sqrt(const Term& a) { return combine(Opcode::sqrt, a, a, std::sqrt(a.value_)); }

 private:
  static Term combine(Opcode opcode, const Term& a, const Term& b, double value) {
    ProgramBuilder* builder = a.builder_ != nullptr ? a.builder_ : b.builder_;
    if (builder == nullptr) return value;
    return {*builder, builder->combine(opcode, a.node(*builder), b.node(*builder))};
  }

  ProgramBuilder* builder_ = nullptr;  // none: a constant
  int node_ = 0;
  double value_ = 0.0;
};

}  // namespace trajet

template <>
struct Eigen::NumTraits<trajet::Term> : trajet::NumberTraits<trajet::Term, 1, 1, 1> {};
