#pragma once

#include <xsimd/xsimd.hpp>

#include "trajet/math/number.hpp"
#include "trajet/math/number_traits.hpp"

namespace trajet {

/// Several doubles that move together, one per SIMD lane: as many as the target machine's registers hold.
/// A law evaluated on Packs computes that many motions at once. Loading, storing and element functions are xsimd's.
using Pack = xsimd::batch<double>;
/// One truth value per lane.
using PackMask = xsimd::batch_bool<double>;

inline constexpr int kPackSize = static_cast<int>(Pack::size);

}  // namespace trajet

/// Comparisons and `where` for Packs, found beside the type.
namespace xsimd {

TRAJET_INLINE trajet::PackMask less(const trajet::Pack& a, const trajet::Pack& b) { return a < b; }
TRAJET_INLINE trajet::PackMask less_equal(const trajet::Pack& a, const trajet::Pack& b) { return a <= b; }
TRAJET_INLINE trajet::PackMask equal(const trajet::Pack& a, const trajet::Pack& b) { return a == b; }

TRAJET_INLINE trajet::Pack where(const trajet::PackMask& condition, const trajet::Pack& a, const trajet::Pack& b) {
  return select(condition, a, b);
}

TRAJET_INLINE trajet::Pack norm3(const trajet::Pack& x, const trajet::Pack& y, const trajet::Pack& z) {
  return sqrt(x * x + y * y + z * z);
}

}  // namespace xsimd

/// Eigen vectors of Packs.
template <>
struct Eigen::NumTraits<trajet::Pack> : trajet::NumberTraits<trajet::Pack, 1, 1, 1> {};
