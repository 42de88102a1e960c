#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace trajet {

/// Calls its argument with each of some numbers, in any order, as often as it is called itself.
using NumberSource = std::function<void(const std::function<void(double)>&)>;

/// The quantiles of `count` numbers for some shares 0 … 1, exactly, in memory that does not grow with their number: the
/// numbers are gone through four times, and each time 16 more bits of the ones that are looked for are known. Between
/// two numbers linearly, as NumPy has it (Hyndman and Fan 1996, type 7). Without numbers they are not-a-number.
std::vector<double> quantiles(const NumberSource& source, std::uint64_t count, std::span<const double> shares);

}  // namespace trajet
