#pragma once

#include <cstdint>
#include <cstring>
#include <limits>

#include "trajet/math/force_inline.hpp"

namespace trajet {

/// Four doubles that are computed with at once, lane by lane: a 3-vector and a spare lane, a quaternion. A number type
/// for the recurrences of power series (math/recurrences.hpp), so that one sum of products serves a vector's
/// components.
///
/// The compiler maps it to one register with AVX, to two with SSE2; the results are the same. It goes by reference
/// where a call is not inlined: how vectors are passed by value depends on the instruction set.
struct Block4 {
  static constexpr int kLanes = 4;
  typedef double Lanes __attribute__((vector_size(kLanes * sizeof(double))));
  typedef std::int64_t Bits __attribute__((vector_size(kLanes * sizeof(double))));

  Block4() = default;
  TRAJET_INLINE explicit Block4(const Lanes& value) : lanes(value) {}
  TRAJET_INLINE explicit Block4(double all) : lanes{all, all, all, all} {}
  TRAJET_INLINE Block4(double x, double y, double z, double w) : lanes{x, y, z, w} {}

  /// From and to four numbers beside each other in memory.
  TRAJET_INLINE static Block4 loaded(const double* x) {
    Block4 result;
    std::memcpy(&result.lanes, x, sizeof(Lanes));
    return result;
  }
  TRAJET_INLINE void store(double* x) const { std::memcpy(x, &lanes, sizeof(Lanes)); }

  TRAJET_INLINE explicit Block4(const Bits& bits) : lanes(reinterpret_cast<Lanes>(bits)) {}

  TRAJET_INLINE double operator[](int lane) const { return lanes[lane]; }
  /// Lane i becomes the one whose number the bits of source[i] are.
  TRAJET_INLINE Block4 permuted(const Block4& source) const {
    const Bits from = reinterpret_cast<Bits>(source.lanes);
#if defined(__GNUC__) && !defined(__clang__)
    return Block4(__builtin_shuffle(lanes, from));  // one instruction with AVX-512
#else
    return {lanes[from[0]], lanes[from[1]], lanes[from[2]], lanes[from[3]]};
#endif
  }
  TRAJET_INLINE Block4& operator+=(const Block4& b) {
    lanes += b.lanes;
    return *this;
  }
  friend TRAJET_INLINE Block4 operator+(const Block4& a, const Block4& b) { return Block4(a.lanes + b.lanes); }
  friend TRAJET_INLINE Block4 operator-(const Block4& a, const Block4& b) { return Block4(a.lanes - b.lanes); }
  friend TRAJET_INLINE Block4 operator*(const Block4& a, const Block4& b) { return Block4(a.lanes * b.lanes); }
  friend TRAJET_INLINE Block4 operator/(const Block4& a, const Block4& b) { return Block4(a.lanes / b.lanes); }
  friend TRAJET_INLINE Block4 abs(const Block4& a) {
    return Block4(reinterpret_cast<Bits>(a.lanes) & std::numeric_limits<std::int64_t>::max());
  }
  /// b where a lane of a is not a number.
  friend TRAJET_INLINE Block4 max(const Block4& a, const Block4& b) {
    return Block4(a.lanes > b.lanes ? a.lanes : b.lanes);
  }
  friend TRAJET_INLINE Block4 operator*(double a, const Block4& b) { return Block4(a * b.lanes); }

  Lanes lanes;
};

}  // namespace trajet
