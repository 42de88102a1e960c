#pragma once

#include <array>

#include "trajet/math/bernstein.hpp"
#include "trajet/math/root_search.hpp"
#include "trajet/math/window_polynomial.hpp"

namespace trajet::detail {

/// g = s - sum |v_m| of a polynomial and up to three vectors of polynomials, as a function whose roots can be searched:
/// the separation of a pair of vertices that are rounded or spread.
///
/// The lengths themselves, not their squares: squares would lose half the digits of a gap that is nearly zero.
class RoundedGap {
 public:
  /// Enclosures on a piece; those of the derivatives by the piece's own parameter from 0 to 1.
  struct Piece {
    Range value{};
    Range rate{};
    Range curvature{};
  };

  /// `touch_tolerance`: values as small count as zero.
  RoundedGap(const WindowPolynomial& s, double begin, double end, double touch_tolerance)
      : s_(&s), begin_(begin), end_(end), touch_tolerance_(touch_tolerance) {}
  void subtract_length_of(const WindowVector& v) { lengths_[count_++] = &v; }
  void set_end(double end) { end_ = end; }

  double begin() const { return begin_; }
  double end() const { return end_; }
  Piece piece(double from, double to) const;
  Range value_range(const Piece& piece) const { return piece.value; }
  Range rate_range(const Piece& piece) const { return piece.rate; }
  Range curvature_range(const Piece& piece) const { return piece.curvature; }
  FunctionSample at(double u) const;

 private:
  const WindowPolynomial* s_;
  std::array<const WindowVector*, 3> lengths_{};
  std::size_t count_ = 0;
  double begin_;
  double end_;
  double touch_tolerance_;
};

}  // namespace trajet::detail
