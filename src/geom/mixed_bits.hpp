#pragma once

#include <cstdint>

namespace trajet::detail {

/// A well-mixed number of 64 bits (the last steps of MurmurHash3).
inline std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdU;
  x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53U;
  return x ^ (x >> 33);
}

}  // namespace trajet::detail
