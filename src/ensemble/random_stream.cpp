#include "trajet/ensemble/random_stream.hpp"

#include <Random123/philox.h>

#include <bit>

namespace trajet {

std::uint64_t random_bits(std::uint64_t seed, std::uint64_t index, std::uint32_t stream, RandomPurpose purpose) {
  const std::uint64_t what = (std::uint64_t{static_cast<std::uint32_t>(purpose)} << 32U) | stream;
  return r123::Philox2x64()({{index, what}}, {{seed}})[0];
}

double uniform_number(std::uint64_t seed, std::uint64_t index, std::uint32_t stream, RandomPurpose purpose) {
  // the middles of 2^52 equal parts, each of which a double holds
  const std::uint64_t part = random_bits(seed, index, stream, purpose) >> 12U;
  return (static_cast<double>(part) + 0.5) * 0x1p-52;
}

std::uint64_t permuted_index(std::uint64_t index, std::uint64_t count, std::uint64_t seed, std::uint32_t stream) {
  const unsigned half = (static_cast<unsigned>(std::bit_width(count - 1)) + 1U) / 2U;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1U;
  do {
    std::uint64_t left = index >> half, right = index & mask;
    for (std::uint64_t round = 0; round < 4; ++round) {
      const std::uint64_t mixed = random_bits(seed, right | (round << 60U), stream, RandomPurpose::permutation);
      const std::uint64_t next = left ^ (mixed & mask);
      left = right;
      right = next;
    }
    index = (left << half) | right;
  } while (index >= count);
  return index;
}

}  // namespace trajet
