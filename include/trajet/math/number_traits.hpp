#pragma once

#include <Eigen/Core>
#include <limits>

namespace trajet {

/// What Eigen wants to know of a real number type that is built from doubles, to hold it in vectors and matrices: the
/// base of its specialisation of Eigen::NumTraits. The costs are in operations on doubles.
template <class Number, int kReadCost, int kAddCost, int kMulCost>
struct NumberTraits : Eigen::GenericNumTraits<double> {
  using Real = Number;
  using NonInteger = Number;
  using Nested = Number;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = kReadCost,
    AddCost = kAddCost,
    MulCost = kMulCost
  };
  static Number epsilon() { return Number(std::numeric_limits<double>::epsilon()); }
  static Number dummy_precision() { return Number(1e-12); }
  static int digits10() { return std::numeric_limits<double>::digits10; }
};

}  // namespace trajet
