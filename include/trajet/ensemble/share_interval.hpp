#pragma once

#include <cstdint>

namespace trajet {

/// Where a share lies, by what was counted.
struct ShareInterval {
  double low = 0.0;
  double high = 1.0;
};

/// Of `hits` among `count` independent motions: it holds the true share with a probability of at least `confidence`,
/// whatever the share, near 0 and 1 too (Clopper and Pearson 1934).
ShareInterval exact_share_interval(std::uint64_t hits, std::uint64_t count, double confidence = 0.95);

/// The same for somebody who looks after every motion and stops when he likes: with at least that probability it holds
/// the true share at all times together. The shares p at which the mixture of p^k (1-p)^(n-k) over all p, evenly, is
/// less than 1 / (1 - confidence) times that of p itself (Ville's inequality; Robbins 1970).
ShareInterval anytime_share_interval(std::uint64_t hits, std::uint64_t count, double confidence = 0.95);

}  // namespace trajet
