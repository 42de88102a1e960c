#pragma once

#include <cstdint>

namespace trajet {

/// What random numbers of a plan are drawn for. Purposes must not share numbers.
enum class RandomPurpose : std::uint32_t { sample, permutation, scramble, bootstrap };

/// A number between 0 and 1, neither of them, that is random over seeds, indices and streams, and the same wherever,
/// whenever and in whatever order it is drawn: the Philox function with ten rounds (Salmon 2011) of its arguments.
double uniform_number(std::uint64_t seed, std::uint64_t index, std::uint32_t stream,
                      RandomPurpose purpose = RandomPurpose::sample);

/// 64 random bits, in the same way.
std::uint64_t random_bits(std::uint64_t seed, std::uint64_t index, std::uint32_t stream, RandomPurpose purpose);

/// Where the place `index` of 0 … count - 1 goes in a random order of them: a bijection that needs no memory, a cipher
/// of four Feistel rounds on the next even power of 2, walked until it is back within (Black and Rogaway 2002).
std::uint64_t permuted_index(std::uint64_t index, std::uint64_t count, std::uint64_t seed, std::uint32_t stream);

}  // namespace trajet
