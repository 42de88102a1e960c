#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>

#include "trajet/math/bernstein.hpp"
#include "trajet/math/polynomial.hpp"

namespace trajet {

enum class RootKind {
  crossing,    ///< the sign changes
  touch,       ///< value and rate vanish together within the tolerance, the sign stays
  unresolved,  ///< neither a root nor its absence can be shown here
  undefined,   ///< from here on the function is not finite; only of functions that may be so
};

/// A time at which a function is zero within its tolerance. `begin` to `end` is the direction of travel.
struct Root {
  double time;
  double error_bound;  ///< half width of the times at which the function is within its tolerance of zero
  RootKind kind;
  int sign_before;  ///< -1 or +1; at the begin of the search: where the function came from by its derivatives, 0
                    ///< unknown
  int sign_after;   ///< -1 or +1; at the end of the search: where the function goes by its derivatives, 0 unknown
  bool at_begin;    ///< the function is within its tolerance of zero from the begin of the search to this root
  bool at_end;      ///< ... from this root to the end of the search
};

enum class SearchStatus {
  complete,          ///< all roots were visited
  stopped,           ///< the visitor wanted no more
  identically_zero,  ///< within the tolerance of zero all the time; nothing was visited
  unresolved,        ///< gave up at a root of kind `unresolved`; what comes behind it is unknown
};

/// A function at one time.
struct FunctionSample {
  Jet jet;
  double value_error;  ///< bound of the rounding error of jet.value
  /// Values as small count as zero. At least three times the rounding error of the enclosures near this time, so that
  /// every piece small enough is either definitely not zero or zero within twice the tolerance.
  double tolerance;
};

/// What a function must offer to have its roots searched between begin() and end(), which may be less than begin().
///
/// - `piece(a, b)` holds enclosures between the times a and b: `value_range`, `rate_range` and `curvature_range`
///   enclose the function and its derivatives there; of the derivatives only the signs matter, so that each may carry a
///   positive factor.
/// - `at(t)` evaluates at one time.
/// - `may_be_undefined()`, if it has that: whether it may have gaps and poles. They are then passed over, else what is
///   not finite is unresolved.
template <class F>
concept EnclosedFunction = requires(const F& f, const typename F::Piece& piece, double t) {
  { f.begin() } -> std::convertible_to<double>;
  { f.end() } -> std::convertible_to<double>;
  { f.piece(t, t) } -> std::convertible_to<typename F::Piece>;
  { f.value_range(piece) } -> std::convertible_to<Range>;
  { f.rate_range(piece) } -> std::convertible_to<Range>;
  { f.curvature_range(piece) } -> std::convertible_to<Range>;
  { f.at(t) } -> std::convertible_to<FunctionSample>;
};

namespace detail {

inline bool excludes_zero(const Range& range) { return range.lower > 0.0 || range.upper < 0.0; }

/// Zero counts as positive, so that every sign change belongs to exactly one of two neighbouring pieces.
inline bool differ_in_sign(double a, double b) { return (a < 0.0) != (b < 0.0); }

/// The root of a function between `a` and `b`, at which its signs differ: Newton's steps inside a shrinking bracket.
///
/// `evaluate(t, value, rate)` gives the function and its derivative. Ends when no double is left between the bracket's
/// ends, or when a step no longer moves.
template <class Evaluate>
double refine_root(double a, double value_a, double b, double value_b, Evaluate&& evaluate) {
  if (value_a == 0.0) return a;
  if (value_b == 0.0) return b;
  // t = a - f(a) (b - a) / (f(b) - f(a)), the secant's root
  double t = a - value_a * ((b - a) / (value_b - value_a));
  double last_width = std::abs(b - a);
  // Every third step at least halves the bracket, down from any double to its neighbour.
  constexpr int kMaxSteps = 300;
  for (int step = 0; step < kMaxSteps; ++step) {
    if (!(std::min(a, b) < t && t < std::max(a, b))) t = 0.5 * a + 0.5 * b;
    if (t == a || t == b) break;
    double value;
    double rate;
    evaluate(t, value, rate);
    if (value == 0.0) return t;
    if (differ_in_sign(value, value_a)) {
      b = t;
      value_b = value;
    } else {
      a = t;
      value_a = value;
    }
    // t' = t - f(t) / f'(t)
    double next = t - value / rate;
    // a rate far beyond the bracket's own, as next to a corner, tells nothing of where the root is
    constexpr double kSteep = 64.0;
    const bool is_steep = !(std::abs(rate) * std::abs(b - a) <= kSteep * std::abs(value_b - value_a));
    if (next == t && !is_steep) return t;
    if (step % 3 == 2) {
      const double width = std::abs(b - a);
      if (width > 0.5 * last_width) next = 0.5 * a + 0.5 * b;
      last_width = width;
    }
    t = next;
  }
  return std::abs(value_a) < std::abs(value_b) ? a : b;
}

/// The search of `visit_roots`. Feeds a sequence of marks, in the order of travel, to a small machine: at each mark the
/// function is definitely negative, definitely positive, or zero within the tolerance. A root is a maximal run of zero
/// marks; the definite signs on its two sides tell a crossing from a touch.
template <EnclosedFunction F, class Visitor>
class RootSearch {
 public:
  RootSearch(const F& function, Visitor& visit) : function_(function), visit_(visit) {
    if constexpr (requires { function.may_be_undefined(); }) has_gaps_ = function.may_be_undefined();
  }

  SearchStatus run() {
    const typename F::Piece whole = function_.piece(function_.begin(), function_.end());
    const Point begin = point(function_.begin());
    const Point end = point(function_.end());
    const double tolerance = std::max(begin.tolerance, end.tolerance);
    if (!has_gaps_ && !std::isfinite(tolerance)) {
      give_up(begin.time, end.time);
      return status_;
    }
    if (is_definite(function_.value_range(whole), tolerance)) return SearchStatus::complete;
    flat_enough_ = 2.0 * tolerance;
    mark(begin);
    search(whole, begin, end, 0);
    if (!stopped_) leave_gap(std::numeric_limits<double>::infinity());
    if (!stopped_ && cluster_) {
      if (cluster_->at_begin) return SearchStatus::identically_zero;
      close_cluster(sign_beyond(end, +1.0), true);
    }
    return status_;
  }

 private:
  using Piece = typename F::Piece;

  struct Point : FunctionSample {
    double time;
  };

  /// Neighbouring marks at which the function is zero within the tolerance.
  struct Cluster {
    double first_time;
    double last_time;
    bool at_begin;
    std::optional<Point> crossing;  ///< where the computed sign changes
    Point closest;                  ///< an extremum if there is one, else the first mark
    bool closest_is_extremum;
  };

  // A simple root takes a few pieces; only a function whose enclosures never decide comes near these limits.
  static constexpr int kMaxDepth = 60;
  static constexpr int kMaxPieces = 1 << 16;

  Point point(double t) const {
    Point at{function_.at(t), t};
    if (has_gaps_ && !(std::isfinite(at.tolerance) && std::isfinite(at.jet.value))) {
      at.jet.value = std::numeric_limits<double>::quiet_NaN();
      at.tolerance = 0.0;
    }
    return at;
  }
  bool is_in_gap(const Point& at) const { return has_gaps_ && std::isnan(at.jet.value); }

  static bool is_definite(const Range& range, double tolerance) {
    return range.lower > tolerance || range.upper < -tolerance;
  }
  static bool is_within(const Range& range, double tolerance) {
    return range.lower >= -tolerance && range.upper <= tolerance;
  }

  /// `left` is already marked; marks all up to and including `right`.
  void search(const Piece& piece, const Point& left, const Point& right, int depth) {
    ++pieces_;
    const Range value = function_.value_range(piece);
    const bool has_gap = is_in_gap(left) || is_in_gap(right);
    if (has_gap && std::isnan(value.lower)) return mark(right);  // nowhere defined
    if (!has_gap) {
      if (is_definite(value, std::max(left.tolerance, right.tolerance)))
        return mark_definite(value.lower > 0.0 ? 1 : -1, right);
      if (is_within(value, 2.0 * std::min(left.tolerance, right.tolerance))) return mark_flat(left, right);
      if (excludes_zero(function_.rate_range(piece))) return mark_monotone(left, right);
      if (excludes_zero(function_.curvature_range(piece))) return mark_curved(left, right);
    }

    const double middle_time = 0.5 * left.time + 0.5 * right.time;
    if (depth == kMaxDepth || middle_time == left.time || middle_time == right.time) {
      return has_gap ? mark(right) : mark_smallest(value, left, right);
    }
    if (pieces_ > kMaxPieces) return give_up(left.time, right.time);
    const Point middle = point(middle_time);
    search(function_.piece(left.time, middle_time), left, middle, depth + 1);
    if (!stopped_) search(function_.piece(middle_time, right.time), middle, right, depth + 1);
  }

  void mark_monotone(const Point& left, const Point& right) {
    if (differ_in_sign(left.jet.value, right.jet.value)) mark_crossing(left, right);
    mark(right);
  }

  void mark_curved(const Point& left, const Point& right) {
    if (!differ_in_sign(left.jet.rate, right.jet.rate)) return mark_monotone(left, right);
    if (stays_off_zero(left, right)) return mark_definite(left.jet.value > 0.0 ? 1 : -1, right);
    const double time = refine_root(left.time, left.jet.rate, right.time, right.jet.rate,
                                    [this](double t, double& value, double& rate) {
                                      const Jet jet = function_.at(t).jet;
                                      value = jet.rate;
                                      rate = jet.curvature;
                                    });
    const Point extremum = point(time);
    if (differ_in_sign(left.jet.value, extremum.jet.value)) mark_crossing(left, extremum);
    mark(extremum, true);
    if (!stopped_) mark_monotone(extremum, right);
  }

  /// Whether a function that is curved one way, with an extremum between the ends, certainly has no zero there: where it
  /// bends towards zero its ends bound it, else the tangents there do.
  static bool stays_off_zero(const Point& left, const Point& right) {
    const double tolerance = std::max(left.tolerance, right.tolerance);
    const double sign = left.jet.value > 0.0 ? 1.0 : -1.0;
    const double at_left = sign * left.jet.value, at_right = sign * right.jet.value;
    if (!(at_left > tolerance && at_right > tolerance)) return false;
    const double width = right.time - left.time;
    const double down = sign * left.jet.rate * width, up = sign * right.jet.rate * width;
    if (down >= 0.0) return true;
    // of the tangents' crossing; rates are rounded
    constexpr double kMargin = 1e-6;
    const double drop = down * (at_right - up - at_left) / (down - up);
    return at_left + drop - kMargin * (std::abs(drop) + std::abs(up)) > tolerance;
  }

  /// All within twice the tolerance. A convex function that vanishes inside is within the tolerance in the middle.
  void mark_flat(const Point& left, const Point& right) {
    if (differ_in_sign(left.jet.value, right.jet.value)) mark_crossing(left, right);
    const double middle = 0.5 * left.time + 0.5 * right.time;
    if (!cluster_has_crossing()) mark(point(middle));
    if (!stopped_) mark(right);
  }

  /// A piece that cannot be halved: a jump, or flat to all that the whole interval's rounding tells, or undecided.
  void mark_smallest(const Range& value, const Point& left, const Point& right) {
    const bool is_jump = differ_in_sign(left.jet.value, right.jet.value);
    // where a time cannot be told from that of a jump, both its values are possible
    const double undecided = std::max({flat_enough_, left.tolerance, right.tolerance});
    if (!is_jump && !is_within(value, undecided)) return give_up(left.time, right.time);
    if (is_jump) {
      mark_crossing(left, right);
    } else {
      extend_cluster(right, false);
    }
    mark(right);
  }

  void give_up(double from, double to) {
    if (cluster_) from = cluster_->first_time;
    cluster_.reset();
    visit_(Root{0.5 * from + 0.5 * to, 0.5 * std::abs(to - from), RootKind::unresolved, last_sign_, 0, false, false});
    status_ = SearchStatus::unresolved;
    stopped_ = true;
  }

  void mark_crossing(const Point& left, const Point& right) {
    const double time = refine_root(left.time, left.jet.value, right.time, right.jet.value,
                                    [this](double t, double& value, double& rate) {
                                      const Jet jet = function_.at(t).jet;
                                      value = jet.value;
                                      rate = jet.rate;
                                    });
    const Point crossing = point(time);
    extend_cluster(crossing, false);
    if (!cluster_->crossing) cluster_->crossing = crossing;
  }

  void mark(const Point& at, bool is_extremum = false) {
    if (is_in_gap(at)) return mark_gap(at);
    leave_gap(at.time);
    if (std::abs(at.jet.value) <= at.tolerance) {
      extend_cluster(at, is_extremum);
    } else {
      mark_definite(at.jet.value > 0.0 ? 1 : -1, at);
    }
  }

  void mark_gap(const Point& at) {
    cluster_.reset();
    if (!gap_begin_) gap_begin_ = last_definite_time_.value_or(at.time);
  }

  /// What was before a gap says nothing about what comes behind, but over a pole, where only rounding makes a gap, the
  /// function jumps.
  void leave_gap(double time) {
    if (!gap_begin_) return;
    constexpr double kPole = 1e-12;
    if (std::abs(time - *gap_begin_) > kPole * std::abs(function_.end() - function_.begin())) {
      last_sign_ = 0;
      visit_root({*gap_begin_, 0.0, RootKind::undefined, 0, 0, false, false});
    }
    gap_begin_.reset();
  }

  void mark_definite(int sign, const Point& at) {
    if (last_sign_ * sign < 0 && !cluster_) extend_cluster(at, false);
    if (cluster_) close_cluster(sign, false);
    last_sign_ = sign;
    last_definite_time_ = at.time;
  }

  bool cluster_has_crossing() const { return cluster_ && cluster_->crossing; }

  void extend_cluster(const Point& at, bool is_extremum) {
    if (!cluster_) {
      cluster_ = Cluster{at.time, at.time, last_sign_ == 0, std::nullopt, at, is_extremum};
    } else if (is_extremum && !cluster_->closest_is_extremum) {
      cluster_->closest = at;
      cluster_->closest_is_extremum = true;
    }
    cluster_->last_time = at.time;
  }

  void close_cluster(int sign_after, bool at_end) {
    const Cluster& c = *cluster_;
    const int sign_before = c.at_begin ? sign_beyond(point(function_.begin()), -1.0) : last_sign_;
    const bool is_crossing = sign_before * sign_after < 0;
    const Point& place = is_crossing && c.crossing ? *c.crossing : c.closest;
    visit_root({place.time, error_bound(place, c), is_crossing ? RootKind::crossing : RootKind::touch, sign_before,
                sign_after, c.at_begin, at_end});
    cluster_.reset();
  }

  void visit_root(const Root& root) {
    if (visit_(root)) return;
    status_ = SearchStatus::stopped;
    stopped_ = true;
  }

  /// At a crossing |f'| dt <= rounding error; at an extremum |f''| dt^2 / 2 <= tolerance; never less than the run of
  /// zeros.
  double error_bound(const Point& place, const Cluster& cluster) const {
    const double by_rate = place.value_error / std::abs(place.jet.rate);
    const double by_curvature = std::sqrt(2.0 * place.tolerance / std::abs(place.jet.curvature));
    const double width = std::abs(cluster.last_time - cluster.first_time);
    const double bound = std::min(by_rate, by_curvature);
    return (std::isfinite(bound) ? std::max(bound, width) : width) + 2.0 * kUnitRoundoff * std::abs(place.time);
  }

  /// The sign that a function within the tolerance of zero at an end of the search has beyond it, by its derivatives
  /// there.
  int sign_beyond(const Point& at, double direction) const {
    const double forward = function_.end() < function_.begin() ? -direction : direction;
    const double rate = forward * at.jet.rate;
    const double curvature = at.jet.curvature;
    // With f'^2 <= 2 |f''| tolerance the extremum lies within the tolerance of zero: the rate does not count.
    const double deciding = rate * rate > 2.0 * std::abs(curvature) * at.tolerance ? rate : curvature;
    return deciding > 0.0 ? 1 : deciding < 0.0 ? -1 : 0;
  }

  const F& function_;
  Visitor& visit_;
  bool has_gaps_ = false;
  std::optional<double> gap_begin_;
  std::optional<double> last_definite_time_;
  std::optional<Cluster> cluster_;
  double flat_enough_ = 0.0;
  int last_sign_ = 0;
  int pieces_ = 0;
  bool stopped_ = false;
  SearchStatus status_ = SearchStatus::complete;
};

}  // namespace detail

/// Visits the roots of `function` between its begin and its end, both included, in the order of travel.
///
/// On each piece the enclosures decide: no root; monotone, so at most one, which bracketed Newton finds to the last
/// bits; or curved one way, so that the extremum tells two roots from a touch and from none; otherwise the piece is
/// halved. Roots closer together than the function can be told from zero count as one: a crossing where the signs on
/// the two sides differ, else a touch. So the triple root of (t - a)^3 is one crossing.
///
/// `visit(const Root&) -> bool` returns whether to go on.
template <EnclosedFunction F, class Visitor>
SearchStatus visit_roots(const F& function, Visitor&& visit) {
  return detail::RootSearch<F, std::remove_reference_t<Visitor>>(function, visit).run();
}

}  // namespace trajet
