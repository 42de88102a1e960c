#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "trajet/portable.hpp"

namespace trajet {
namespace detail {

/// log2(x) for finite x >= 0, within 0.003 above the smallest normal number; -1023 for zero.
///
/// A step size needs no more: an exact logarithm and exponential would cost a tenth of a step of a small system. And
/// these few lines round alike on every machine, which the C library's pow does not promise.
inline double rough_log2(double x) {
  const auto bits = bit_cast<std::uint64_t>(x);
  const auto exponent = static_cast<std::int64_t>(bits >> 52) - 1023;
  const double f = bit_cast<double>((bits & 0x000f'ffff'ffff'ffffULL) | 0x3ff0'0000'0000'0000ULL) - 1.0;
  // log2(1 + f) = f + f (1 - f) r(f), r linear through the Chebyshev nodes of [0, 1]: error 2.5e-3.
  return static_cast<double>(exponent) + (f + f * (1.0 - f) * (0.42894708 - 0.15819143 * f));
}

/// 2^y for -1000 < y < 1000, within 0.0004 relative.
inline double rough_exp2(double y) {
  const double floor_y = std::floor(y);
  const double f = y - floor_y;
  const double scale = bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::int64_t>(floor_y) + 1023) << 52);
  // 2^f = 1 + f + f (1 - f) r(f), as above: error 3.1e-4.
  return scale * (1.0 + f - f * (1.0 - f) * (0.30525418 + 0.07920415 * f));
}

}  // namespace detail

/// The smallest step that is worth trying at time `t`: below it, t + h is mostly rounding.
inline double smallest_step(double t) {
  return std::max(16.0 * std::numeric_limits<double>::epsilon() * std::abs(t), std::numeric_limits<double>::min());
}

/// A limit this little farther than the step is reached in one: the alternative is a tiny last step.
inline constexpr double kLandingStretch = 1.01;

/// Where a step from `t` towards `t_limit` has to end at the latest if none may be longer than `max_step`, but for what
/// time resolves.
inline double step_limit(double t, double t_limit, double max_step) {
  const double longest = std::max(max_step, smallest_step(t));
  return std::abs(t_limit - t) > longest ? t + std::copysign(longest, t_limit - t) : t_limit;
}

/// Chooses the next step from the errors of the last two: Gustafsson's proportional-integral controller,
/// [HairerWanner1996] IV.2:
///
///     h_new = h * safety * err_n^(-alpha) * err_{n-1}^beta,  alpha = 1/k - 0.75 beta
///
/// where an error estimate behaves as h^k and is 1 at the tolerance. The integral part keeps the steps from swinging
/// where stability, not accuracy, limits them.
class StepController {
 public:
  /// \param error_power  k: the estimate behaves as h^k.
  explicit StepController(int error_power)
      : beta_(0.2 / error_power), alpha_(1.0 / error_power - 0.75 * beta_), alpha_rejected_(1.0 / error_power) {}

  /// Forgets the errors of the past.
  void reset() {
    log_previous_ = kLogErrorFloor;
    rejected_ = false;
  }

  /// By how much to multiply the step after one of error `error` <= 1 was accepted.
  double accepted(double error) { return accepted_log2(detail::rough_log2(error)); }

  /// The same for log2(error) <= 0.
  double accepted_log2(double log_error) {
    const double log_previous = log_previous_;
    const bool after_rejection = rejected_;
    log_previous_ = log_error;
    rejected_ = false;
    // Nearly right, and not about to be wrong if it grows once more as it just did: keep the step. The processor then
    // foresees it and starts on the next one before the error is known.
    if (log_error >= kLogKeepFrom && log_error <= kLogKeepTo && 2.0 * log_error <= kLogKeepTo + log_previous)
      return 1.0;
    const double log_factor = kLogSafety - alpha_ * log_error + beta_ * std::max(log_previous, kLogErrorFloor);
    // A step that follows a rejection must not grow: it would be rejected again.
    return detail::rough_exp2(std::clamp(log_factor, kLogSmallest, after_rejection ? 0.0 : kLogLargest));
  }

  /// By how much to multiply the step after one of error `error` > 1, or not finite, was rejected.
  double rejected(double error) {
    if (std::isfinite(error)) return rejected_log2(detail::rough_log2(error));
    rejected_ = true;
    return 0.1;  // no error to go by: leave the neighbourhood of the singularity fast
  }

  /// The same for log2(error) > 0 of a finite error.
  double rejected_log2(double log_error) {
    rejected_ = true;
    return detail::rough_exp2(std::max(kLogSafety - alpha_rejected_ * log_error, kLogSmallest));
  }

 private:
  static constexpr double kLogSafety = -0.15200309344504997;     // log2(0.9)
  static constexpr double kLogSmallest = -2.3219280948873623;    // log2(0.2)
  static constexpr double kLogLargest = 3.3219280948873623;      // log2(10)
  static constexpr double kLogKeepFrom = -1.3219280948873623;    // log2(0.4): a better step is a tenth longer at most
  static constexpr double kLogKeepTo = -0.07400058144377693;     // log2(0.95)
  static constexpr double kLogErrorFloor = -13.287712379549449;  // log2(1e-4): one lucky step must not rule the next

  double beta_;
  double alpha_;
  double alpha_rejected_;
  double log_previous_ = kLogErrorFloor;
  bool rejected_ = false;
};

}  // namespace trajet
