#include "trajet/math/branch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "trajet/math/number.hpp"
#include "trajet/math/roots.hpp"

namespace trajet {
namespace {

/// sum over k >= 1 of |series[k]| |h|^k: how far the function can move from its start
double largest_change(std::span<const double> series, double h) {
  double sum = 0.0;
  for (std::size_t k = series.size() - 1; k >= 1; --k) sum = (sum + std::abs(series[k])) * std::abs(h);
  return sum;
}

/// How far, up to `duration` > 0, a truncated series can tell where its function is zero: as long as its last two terms
/// are small beside the largest one before them. Beyond its radius of convergence its zeros mean nothing.
double told_duration(std::span<const double> series, double duration) {
  constexpr double kSmall = 0.01;
  constexpr double kShorter = 0.7;
  constexpr int kMaxTries = 200;
  if (series.size() < 4) return duration;
  for (int tries = 0; tries < kMaxTries; ++tries, duration *= kShorter) {
    double power = 1.0, largest = 0.0, last = 0.0;
    for (std::size_t k = 0; k < series.size(); ++k, power *= duration) {
      const double term = std::abs(series[k]) * power;
      if (k + 2 < series.size()) {
        largest = std::max(largest, term);
      } else {
        last += term;
      }
    }
    if (!(last > kSmall * largest)) break;  // nor where any of it is not a number
  }
  return duration;
}

}  // namespace

BranchTime first_sign_change(std::span<const double> series, double sign, bool starts_at_zero, double duration) {
  const BranchTime none{duration, -1, 0.0};
  if (series.empty() || sign != sign || duration != duration) return none;
  const double direction = duration < 0.0 ? -1.0 : 1.0;
  if (!starts_at_zero && sign != 0.0 && std::abs(series[0]) > largest_change(series, duration)) return none;

  // f(t) = t^first * rest(t), where rest(0) is not zero
  std::size_t first = starts_at_zero ? 1 : 0;
  while (first < series.size() && series[first] == 0.0) ++first;
  if (first == series.size()) return none;
  const std::span<const double> rest = series.subspan(first);
  const double sign_of_power = first % 2 == 1 ? direction : 1.0;
  const double sign_at_start = trajet::sign(rest[0]) * sign_of_power;
  if (first > 0 && sign_at_start != sign) return {0.0, 0, sign_at_start};
  if (std::abs(rest[0]) > largest_change(rest, duration)) return none;

  // the search runs forward in time: reflected where the motion runs backward
  std::array<double, kMaxPolynomialDegree + 1> reflected;
  for (std::size_t k = 0; k < rest.size(); ++k) reflected[k] = k % 2 == 1 ? direction * rest[k] : rest[k];
  const double told = told_duration(rest, std::abs(duration));
  const std::optional<Root> root = first_root(std::span(reflected).first(rest.size()), 0.0, told);
  if (!root) return told < std::abs(duration) ? BranchTime{direction * told, -1, 0.0} : none;
  return {direction * root->time, 0, -sign_at_start};
}

}  // namespace trajet
