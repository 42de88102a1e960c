#include "trajet/law/lookup_table.hpp"

#include <cmath>
#include <stdexcept>

namespace trajet {
namespace {

/// The slope at an end point from the slopes s0, s1 of the two nearest intervals of widths h0, h1: the parabola's
/// through the three points, limited so that the cubic stays monotone.
double end_slope(double h0, double h1, double s0, double s1) {
  const double slope = ((2.0 * h0 + h1) * s0 - h0 * s1) / (h0 + h1);
  if (slope * s0 <= 0.0) return 0.0;
  if (s0 * s1 <= 0.0 && std::abs(slope) > 3.0 * std::abs(s0)) return 3.0 * s0;
  return slope;
}

/// The slope at an inner point: a weighted harmonic mean of its neighbours', zero at an extremum [FritschButland1984].
double inner_slope(double h0, double h1, double s0, double s1) {
  if (s0 * s1 <= 0.0) return 0.0;
  const double w0 = h0 + 2.0 * h1, w1 = 2.0 * h0 + h1;
  return (w0 + w1) / (w0 / s0 + w1 / s1);
}

}  // namespace

LookupTable::LookupTable(const std::vector<double>& x, const std::vector<double>& y)
    : last_(x.empty() ? 0.0 : x.back()) {
  const std::size_t n = x.size();
  if (n < 2 || y.size() != n) throw std::invalid_argument("a table needs at least two points");
  std::vector<double> width(n - 1), secant(n - 1), slope(n);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    width[i] = x[i + 1] - x[i];
    secant[i] = (y[i + 1] - y[i]) / width[i];
    if (!(width[i] > 0.0) || !std::isfinite(secant[i])) throw std::invalid_argument("the x of a table must rise");
  }
  slope.front() = n == 2 ? secant[0] : end_slope(width[0], width[1], secant[0], secant[1]);
  slope.back() = n == 2 ? secant[0] : end_slope(width[n - 2], width[n - 3], secant[n - 2], secant[n - 3]);
  for (std::size_t i = 1; i + 1 < n; ++i) slope[i] = inner_slope(width[i - 1], width[i], secant[i - 1], secant[i]);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    // Hermite's cubic: value and slope at both ends
    const double h = width[i], d0 = slope[i], d1 = slope[i + 1], s = secant[i];
    cells_.push_back({x[i], y[i], d0, (3.0 * s - 2.0 * d0 - d1) / h, (d0 + d1 - 2.0 * s) / (h * h)});
  }
}

}  // namespace trajet
