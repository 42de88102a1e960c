#include "trajet/math/branch.hpp"

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
  const std::optional<Root> root = first_root(std::span(reflected).first(rest.size()), 0.0, std::abs(duration));
  if (!root) return none;
  return {direction * root->time, 0, -sign_at_start};
}

}  // namespace trajet
