#include "trajet/ensemble/distribution.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

namespace trajet {

double normal_quantile(double u) { return -std::sqrt(2.0) * boost::math::erfc_inv(2.0 * u); }

double normal_share(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

Distribution Distribution::normal(double mean, double deviation) { return {Kind::normal, mean, deviation}; }

Distribution Distribution::uniform(double low, double high) { return {Kind::uniform, low, high}; }

Distribution Distribution::lognormal(double mean, double deviation) {
  // ln X ~ N(m, s²): E X = exp(m + s²/2), Var X = (exp(s²) - 1) (E X)²
  const double spread = deviation / mean;
  const double variance = std::log1p(spread * spread);
  return {Kind::lognormal, std::log(mean) - 0.5 * variance, std::sqrt(variance)};
}

Distribution Distribution::truncated(double mean, double deviation, double low, double high) {
  Distribution result(Kind::truncated, mean, deviation);
  double from = (low - mean) / deviation, to = (high - mean) / deviation;
  result.low_ = low;
  result.high_ = high;
  result.is_upper_ = from > 0.0;
  if (result.is_upper_) {
    const double lower = from;
    from = -to;
    to = -lower;
  }
  result.low_share_ = normal_share(from);
  result.share_ = normal_share(to) - result.low_share_;
  return result;
}

double Distribution::quantile(double u) const {
  switch (kind_) {
    case Kind::normal:
      return a_ + b_ * normal_quantile(u);
    case Kind::uniform:
      return a_ + (b_ - a_) * u;
    case Kind::lognormal:
      return std::exp(a_ + b_ * normal_quantile(u));
    case Kind::truncated: {
      const double share = low_share_ + share_ * (is_upper_ ? 1.0 - u : u);
      const double z = normal_quantile(share);
      return std::clamp(a_ + b_ * (is_upper_ ? -z : z), low_, high_);
    }
  }
  return a_;
}

}  // namespace trajet
