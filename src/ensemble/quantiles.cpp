#include "trajet/ensemble/quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trajet/portable.hpp"

namespace trajet {
namespace {

constexpr unsigned kBitsOfPass = 16;
constexpr std::size_t kBins = std::size_t{1} << kBitsOfPass;
constexpr std::uint64_t kSign = std::uint64_t{1} << 63U;

/// Whole numbers in the order of the doubles.
std::uint64_t key_of(double value) {
  const auto bits = bit_cast<std::uint64_t>(value);
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

double value_of(std::uint64_t key) { return bit_cast<double>((key & kSign) != 0 ? key & ~kSign : ~key); }

/// One number that is looked for: what is known of it, and how many of those that begin alike are smaller.
struct Sought {
  std::uint64_t rank = 0;
  std::uint64_t prefix = 0;
};

}  // namespace

std::vector<double> quantiles(const NumberSource& source, std::uint64_t count, std::span<const double> shares) {
  std::vector<double> result(shares.size(), std::numeric_limits<double>::quiet_NaN());
  if (count == 0) return result;
  std::vector<Sought> sought;
  for (const double share : shares) {
    const double place = share * static_cast<double>(count - 1);
    const auto below = std::min(static_cast<std::uint64_t>(place), count - 1);
    sought.push_back({below});
    sought.push_back({std::min(below + 1, count - 1)});
  }
  for (unsigned known = 0; known < 64; known += kBitsOfPass) {
    const auto begin_of = [known](std::uint64_t key) { return known == 0 ? 0 : key >> (64 - known); };
    // the beginnings looked for are few: a histogram of what comes behind each of them
    std::vector<std::uint64_t> beginnings;
    for (const Sought& each : sought) beginnings.push_back(each.prefix);
    std::sort(beginnings.begin(), beginnings.end());
    beginnings.erase(std::unique(beginnings.begin(), beginnings.end()), beginnings.end());
    std::vector<std::uint64_t> bins(beginnings.size() * kBins);
    const auto bins_of = [&](std::uint64_t beginning) {
      const auto place = std::lower_bound(beginnings.begin(), beginnings.end(), beginning);
      const bool is_sought = place != beginnings.end() && *place == beginning;
      return is_sought ? bins.data() + static_cast<std::size_t>(place - beginnings.begin()) * kBins : nullptr;
    };
    source([&](double value) {
      const std::uint64_t key = key_of(value);
      if (std::uint64_t* histogram = bins_of(begin_of(key)))
        ++histogram[(key >> (64 - known - kBitsOfPass)) & (kBins - 1)];
    });
    for (Sought& each : sought) {
      const std::uint64_t* histogram = bins_of(each.prefix);
      std::uint64_t bin = 0;
      while (each.rank >= histogram[bin]) each.rank -= histogram[bin++];
      each.prefix = (each.prefix << kBitsOfPass) | bin;
    }
  }
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double place = shares[i] * static_cast<double>(count - 1);
    const double low = value_of(sought[2 * i].prefix), high = value_of(sought[2 * i + 1].prefix);
    result[i] = low + (high - low) * (place - std::floor(place));
  }
  return result;
}

}  // namespace trajet
