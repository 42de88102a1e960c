#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "trajet/event/path.hpp"
#include "trajet/math/bernstein.hpp"
#include "trajet/math/interval.hpp"
#include "trajet/math/root_search.hpp"

namespace trajet {

/// g(t, x(t)) along a Path x, for any g, as a function whose roots can be searched.
///
/// `g` is a callable generic in its number type: g(t, x), t a number (s), x an Eigen vector of `Count` of them. It is
/// evaluated on IntervalJets only. On a piece of the path, Bernstein coefficients enclose the components and their
/// derivatives; the mean value form tightens what comes out. At one time the width of what comes out is the rounding
/// error.
template <int Count, class G>
class ComposedFunction {
 public:
  using Piece = IntervalJet;

  /// Between the times tau = `begin` and tau = `end` of the path. Refers to `path`. `touch_tolerance` (unit of g):
  /// values as small count as zero; what rounding needs is added. `may_be_undefined`: g may have gaps or poles.
  ComposedFunction(const Path<Count>& path, G g, double begin, double end, double touch_tolerance = 0.0,
                   bool may_be_undefined = false)
      : path_(path),
        g_(std::move(g)),
        begin_(begin),
        end_(end),
        touch_tolerance_(touch_tolerance),
        may_be_undefined_(may_be_undefined) {}

  double begin() const { return begin_; }
  double end() const { return end_; }
  bool may_be_undefined() const { return may_be_undefined_; }

  IntervalJet piece(double from, double to) const {
    IntervalJet f = evaluate(Interval::hull(from, to), [&](int i) { return enclose(path_.coefficients(i), from, to); });
    // over a pole the derivatives tell nothing
    if (std::isinf(f[0].lower()) || std::isinf(f[0].upper())) f[1] = f[2] = Interval::whole();
    const double middle = 0.5 * from + 0.5 * to;
    const IntervalJet center = at_time(middle);
    const Interval offset = Interval::hull(from, to) - Interval(middle);
    // f(t) is in f(m) + f'([from, to]) (t - m), and f' likewise with f'' = 2 f[2]
    f[1] = tightened(f[1], center[1] + 2.0 * f[2] * offset);
    f[0] = tightened(f[0], center[0] + f[1] * offset);
    return f;
  }
  Range value_range(const IntervalJet& piece) const { return range(piece[0]); }
  Range rate_range(const IntervalJet& piece) const { return range(piece[1]); }
  Range curvature_range(const IntervalJet& piece) const { return range(piece[2]); }

  FunctionSample at(double tau) const {
    const IntervalJet f = at_time(tau);
    const double error = 0.5 * width(f[0]);
    return {{median(f[0]), median(f[1]), 2.0 * median(f[2])}, error, std::max(3.0 * error, touch_tolerance_)};
  }

 private:
  static Range range(const Interval& x) { return {x.lower(), x.upper()}; }
  static Interval interval(const Range& r) { return {r.lower, r.upper}; }
  static Interval around(double x, double error) { return {x - error, x + error}; }

  /// Both enclose the same numbers. Not-a-number bounds, where a derivative is not finite, make an empty interval.
  static Interval tightened(const Interval& a, const Interval& b) { return empty(b) ? a : intersect(a, b); }

  template <class Component>
  IntervalJet evaluate(const Interval& tau, const Component& component) const {
    Eigen::Matrix<IntervalJet, Count, 1> x(path_.count());
    for (int i = 0; i < path_.count(); ++i) x[i] = component(i);
    return g_(IntervalJet::variable(tau + path_.t0()), x);
  }

  IntervalJet at_time(double tau) const {
    return evaluate(Interval(tau), [&](int i) {
      const MeasuredJet m = evaluate_polynomial(path_.coefficients(i), tau);
      const double error = BernsteinForm::roundings(path_.degree()) * kUnitRoundoff * m.magnitude;
      IntervalJet x(around(m.jet.value, error));
      x[1] = m.jet.rate;
      x[2] = 0.5 * m.jet.curvature;
      return x;
    });
  }

  static IntervalJet enclose(std::span<const double> coefficients, double from, double to) {
    const BernsteinForm form(coefficients, from, to);
    const Interval h = Interval(to) - Interval(from);
    IntervalJet x(interval(form.value_range()));
    if (form.is_nearly_straight()) {
      // differences of rounded coefficients over a short time say little of the derivatives
      std::array<double, kMaxPolynomialDegree + 1> derivative;
      std::ranges::copy(coefficients, derivative.begin());
      std::span<double> d(derivative.data(), coefficients.size());
      for (const int order : {1, 2}) {
        d = differentiate(d);
        // each differentiation rounds the coefficients once
        x[order] = interval(BernsteinForm(d, from, to).value_range(order)) / static_cast<double>(order);
      }
      return x;
    }
    x[1] = interval(form.first_difference_range()) / h;
    x[2] = interval(form.second_difference_range()) / (2.0 * square(h));
    return x;
  }

  /// Turns the coefficients of a polynomial into those of its derivative; a constant's is one zero.
  static std::span<double> differentiate(std::span<double> coefficients) {
    for (std::size_t k = 1; k < coefficients.size(); ++k)
      coefficients[k - 1] = static_cast<double>(k) * coefficients[k];
    if (coefficients.size() > 1) return coefficients.first(coefficients.size() - 1);
    coefficients[0] = 0.0;
    return coefficients;
  }

  const Path<Count>& path_;
  G g_;
  double begin_;
  double end_;
  double touch_tolerance_;
  bool may_be_undefined_;
};

}  // namespace trajet
