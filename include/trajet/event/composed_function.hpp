#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "trajet/event/path.hpp"
#include "trajet/event/polynomial_enclosure.hpp"
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
    IntervalJet f =
        evaluate(Interval::hull(from, to), [&](int i) { return enclose_polynomial(path_.coefficients(i), from, to); });
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

  /// Both enclose the same numbers. Not-a-number bounds, where a derivative is not finite, make an empty interval.
  static Interval tightened(const Interval& a, const Interval& b) { return empty(b) ? a : intersect(a, b); }

  template <class Component>
  IntervalJet evaluate(const Interval& tau, const Component& component) const {
    Eigen::Matrix<IntervalJet, Count, 1> x(path_.count());
    for (int i = 0; i < path_.count(); ++i) x[i] = component(i);
    return g_(IntervalJet::variable(tau + path_.t0()), x);
  }

  IntervalJet at_time(double tau) const {
    return evaluate(Interval(tau), [&](int i) { return enclose_polynomial(path_.coefficients(i), tau); });
  }

  const Path<Count>& path_;
  G g_;
  double begin_;
  double end_;
  double touch_tolerance_;
  bool may_be_undefined_;
};

}  // namespace trajet
