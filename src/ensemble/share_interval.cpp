#include "trajet/ensemble/share_interval.hpp"

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

namespace trajet {

ShareInterval exact_share_interval(std::uint64_t hits, std::uint64_t count, double confidence) {
  ShareInterval interval;
  if (count == 0) return interval;
  const auto k = static_cast<double>(hits), n = static_cast<double>(count);
  const double tail = 0.5 * (1.0 - confidence);
  if (hits > 0) interval.low = boost::math::ibeta_inv(k, n - k + 1.0, tail);
  if (hits < count) interval.high = boost::math::ibetac_inv(k + 1.0, n - k, tail);
  return interval;
}

ShareInterval anytime_share_interval(std::uint64_t hits, std::uint64_t count, double confidence) {
  ShareInterval interval;
  if (count == 0) return interval;
  const auto k = static_cast<double>(hits), n = static_cast<double>(count);
  using boost::math::lgamma;
  // ln of the mixture, the integral of p^k (1-p)^(n-k) over 0 … 1
  const double mixture = lgamma(k + 1.0) + lgamma(n - k + 1.0) - lgamma(n + 2.0);
  const double least = mixture + std::log(1.0 - confidence);
  const auto is_inside = [&](double p) {
    const double hit = hits > 0 ? k * std::log(p) : 0.0, missed = hits < count ? (n - k) * std::log1p(-p) : 0.0;
    return hit + missed > least;
  };
  // the likelihood rises up to k/n and falls behind it
  const auto border = [&](double inside, double outside) {
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (inside + outside);
      (is_inside(middle) ? inside : outside) = middle;
    }
    return outside;
  };
  const double share = k / n;
  if (hits > 0) interval.low = border(share, 0.0);
  if (hits < count) interval.high = border(share, 1.0);
  return interval;
}

}  // namespace trajet
