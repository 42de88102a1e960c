#pragma once

#include <cassert>
#include <cmath>

#include "trajet/law/program_builder.hpp"
#include "trajet/math/number_traits.hpp"

namespace trajet {

/// A number that stands for a computation: a law written for any number type, evaluated on ProgramNumbers, becomes part
/// of the Program that a ProgramBuilder builds. So the equations of motion that C++ programs call are those of the
/// scenes.
///
/// A plain constant, or a node of a builder, which must outlive it. All nodes that meet are of one builder.
class ProgramNumber {
 public:
  ProgramNumber() = default;
  ProgramNumber(double value) : value_(value) {}  // NOLINT(google-explicit-constructor): a number is a constant
  ProgramNumber(ProgramBuilder& builder, int node) : builder_(&builder), node_(node) {}

  /// An output of the program that the builder has opened again.
  static ProgramNumber output_of_base(ProgramBuilder& builder, int index) {
    return {builder, builder.output_of_base(index)};
  }

  /// The node of the builder that has this value.
  int node(ProgramBuilder& builder) const {
    assert(builder_ == nullptr || builder_ == &builder);
    return builder_ == nullptr ? builder.constant_node(value_) : node_;
  }

  friend ProgramNumber operator+(const ProgramNumber& a, const ProgramNumber& b) {
    return combine(Opcode::add, a, b, a.value_ + b.value_);
  }
  friend ProgramNumber operator-(const ProgramNumber& a, const ProgramNumber& b) {
    return combine(Opcode::subtract, a, b, a.value_ - b.value_);
  }
  friend ProgramNumber operator*(const ProgramNumber& a, const ProgramNumber& b) {
    return combine(Opcode::multiply, a, b, a.value_ * b.value_);
  }
  friend ProgramNumber operator/(const ProgramNumber& a, const ProgramNumber& b) {
    return combine(Opcode::divide, a, b, a.value_ / b.value_);
  }
  friend ProgramNumber operator-(const ProgramNumber& a) { return combine(Opcode::negate, a, a, -a.value_); }
  ProgramNumber& operator+=(const ProgramNumber& b) { return *this = *this + b; }
  ProgramNumber& operator-=(const ProgramNumber& b) { return *this = *this - b; }
  ProgramNumber& operator*=(const ProgramNumber& b) { return *this = *this * b; }
  friend ProgramNumber sin(const ProgramNumber& a) { return combine(Opcode::sin, a, a, std::sin(a.value_)); }
  friend ProgramNumber cos(const ProgramNumber& a) { return combine(Opcode::cos, a, a, std::cos(a.value_)); }
  friend ProgramNumber sqrt(const ProgramNumber& a) { return combine(Opcode::sqrt, a, a, std::sqrt(a.value_)); }

 private:
  static ProgramNumber combine(Opcode opcode, const ProgramNumber& a, const ProgramNumber& b, double value) {
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
struct Eigen::NumTraits<trajet::ProgramNumber> : trajet::NumberTraits<trajet::ProgramNumber, 1, 1, 1> {};
