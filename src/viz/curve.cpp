#include "trajet/viz/curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "trajet/portable.hpp"

namespace trajet {

namespace {

/// Points of a whole run before those that make no difference are dropped: a panel is some 500 pixels wide.
constexpr double kPointsOfRun = 1000.0;
/// Points of a piece, at least: a step of a method of high order can be the whole run, a bounce a hundredth of it.
constexpr int kPointsOfPiece = 8;
/// A line may pass a curve by this part of what its axis shows: half a pixel of a panel.
constexpr double kBend = 1e-3;
/// An interval between two of these points is halved so many times at most, while there are not so many points.
constexpr int kMostHalvings = 5;
constexpr std::size_t kMostPoints = 8000;
/// What varies less than this, against its size, varies by rounding.
constexpr double kRounding = 1e-9;
/// A line takes the place of so many points at most.
constexpr std::size_t kLongestLine = 200;

/// Components of the state that are drawn together against one axis, or their rates.
struct Drawn {
  int first, count;
  bool is_rate;
  int vector_first = first, vector_count = count;  // of the vector that they are part of, which gives their size
  /// What the axis spans if it shows the motion up to a point of the coarse curve, or from there on, whichever is less:
  /// the beginning of a motion that runs away is visible beside another one.
  std::vector<double> extents{};

  double value(const Curve& curve, std::size_t point, int i) const { return component(curve, point, first + i); }
  /// Of the vector.
  double size(const Curve& curve, std::size_t point) const {
    double largest = 0.0;
    for (int i = 0; i < vector_count; ++i)
      largest = std::max(largest, std::abs(component(curve, point, vector_first + i)));
    return largest;
  }

 private:
  double component(const Curve& curve, std::size_t point, int index) const {
    return (is_rate ? curve.rates : curve.states)[point][static_cast<std::size_t>(index)];
  }
};

std::vector<Drawn> drawn_components(const World& world, int group) {
  std::vector<Drawn> drawn;
  for (const World::Body& body : world.bodies) {
    if (body.group != group) continue;
    const BodySlice slice = body.slice();
    // paths have an axis for each coordinate
    for (int i = 0; i < 3; ++i) drawn.push_back({slice.position_index() + i, 1, false, slice.position_index(), 3});
    drawn.insert(drawn.end(), {{slice.velocity_index(), 3, false}, {slice.velocity_index(), 3, true}});
    if (body.rotation) drawn.push_back({slice.angular_velocity_index(), 3, false});
  }
  for (const World::ExtraState& state : world.states)
    if (state.group == group) drawn.push_back({state.offset, 1, false});
  return drawn;
}

void add_point(Curve& curve, const Segment<>& segment, double t) {
  std::vector<double> state, rate;
  for (int i = 0; i < segment.dimension(); ++i) {
    state.push_back(segment.value(i, t));
    rate.push_back(segment.derivative(i, t));
  }
  curve.times.push_back(t);
  curve.states.push_back(std::move(state));
  curve.rates.push_back(std::move(rate));
}

/// Part of a piece, between two neighbouring points of a curve.
struct Interval {
  const Segment<>* segment;
  double from, to;
};

/// The extents of what is drawn, up to each point of a curve and from there on, of the two the lesser.
std::vector<double> extents(const Drawn& drawn, const Curve& curve) {
  const std::size_t count = curve.times.size();
  std::vector<double> result(count);
  double low = 0.0, high = 0.0, size = 0.0;
  const auto begin = [&] {
    low = std::numeric_limits<double>::infinity();
    high = -low;
    size = 0.0;
  };
  const auto include = [&](std::size_t point) {
    size = std::max(size, drawn.size(curve, point));
    for (int i = 0; i < drawn.count; ++i) {
      const double value = drawn.value(curve, point, i);
      low = std::min(low, value);
      high = std::max(high, value);
    }
    return std::max(high - low, kRounding * size);
  };
  begin();
  for (std::size_t point = 0; point < count; ++point) result[point] = include(point);
  begin();
  for (std::size_t point = count; point-- > 0;) result[point] = std::min(result[point], include(point));
  return result;
}

/// What makes a line through points look smooth, and what of them is too much.
class Refinement {
 public:
  Refinement(std::vector<Drawn> drawn, const Curve& coarse) : drawn_(std::move(drawn)), times_(coarse.times) {
    for (Drawn& each : drawn_) each.extents = extents(each, coarse);
  }

  /// Adds the points behind `from`, up to `to`.
  void add(Curve& curve, const Interval& interval, int halvings = 0) const {
    const double middle = interval.from + 0.5 * (interval.to - interval.from);
    if (halvings < kMostHalvings && curve.times.size() < kMostPoints && bends(interval, middle)) {
      add(curve, {interval.segment, interval.from, middle}, halvings + 1);
      add(curve, {interval.segment, middle, interval.to}, halvings + 1);
    } else {
      add_point(curve, *interval.segment, interval.to);
    }
  }

  /// The curve without the points that lines between the others pass closely.
  Curve thinned(Curve curve) const {
    std::size_t kept = 0, next = 0;  // the last point of the result, and what of the curve has not been looked at
    const std::size_t count = curve.times.size();
    std::vector<std::size_t> chosen;
    for (; next < count; kept = next++) {
      if (!chosen.empty())
        while (next + 1 < count && next - kept < kLongestLine && is_line(curve, kept, next + 1)) ++next;
      chosen.push_back(next);
    }
    Curve result;
    for (const std::size_t point : chosen) {
      result.times.push_back(curve.times[point]);
      result.states.push_back(std::move(curve.states[point]));
      result.rates.push_back(std::move(curve.rates[point]));
    }
    return result;
  }

 private:
  /// The point of the coarse curve at a time, or the one before.
  std::size_t coarse_point(double t) const {
    const bool is_backward = times_.back() < times_.front();
    const auto behind =
        ranges::partition_point(times_, [&](double each) { return is_backward ? each >= t : each <= t; });
    return behind == times_.begin() ? 0 : static_cast<std::size_t>(behind - times_.begin()) - 1;
  }

  bool bends(const Interval& interval, double middle) const {
    const Segment<>& segment = *interval.segment;
    const std::size_t point = coarse_point(interval.to);
    return ranges::any_of(drawn_, [&](const Drawn& each) {
      for (int i = each.first; i < each.first + each.count; ++i) {
        const auto value = [&](double t) { return each.is_rate ? segment.derivative(i, t) : segment.value(i, t); };
        if (std::abs(0.5 * (value(interval.from) + value(interval.to)) - value(middle)) > kBend * each.extents[point])
          return true;
      }
      return false;
    });
  }

  /// Whether the line between two points passes those in between.
  bool is_line(const Curve& curve, std::size_t from, std::size_t to) const {
    const double duration = curve.times[to] - curve.times[from];
    if (duration == 0.0) return false;
    const std::size_t coarse = coarse_point(curve.times[to]);
    return ranges::all_of(drawn_, [&](const Drawn& each) {
      for (std::size_t point = from + 1; point < to; ++point)
        for (int i = 0; i < each.count; ++i) {
          const double part = (curve.times[point] - curve.times[from]) / duration;
          const double start = each.value(curve, from, i), end = each.value(curve, to, i);
          if (!(std::abs(start + part * (end - start) - each.value(curve, point, i)) <=
                0.5 * kBend * each.extents[coarse]))
            return false;
        }
      return true;
    });
  }

  std::vector<Drawn> drawn_;
  std::vector<double> times_;  // of the coarse curve
};

}  // namespace

Curve make_curve(const MotionRecord& record, int group) {
  Curve coarse;
  const auto& pieces = record.pieces(group);
  if (pieces.empty()) return coarse;
  const double shortest = std::abs(pieces.back().to - pieces.front().from) / kPointsOfRun;
  std::vector<Interval> intervals;  // of each point but the first ones of pieces, whose intervals are empty
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto& piece = pieces[i];
    const double duration = piece.to - piece.from;
    const bool is_end = i == 0 || i + 1 == pieces.size();
    if (!is_end && std::abs(piece.to - coarse.times.back()) < shortest) continue;
    add_point(coarse, piece.segment, piece.from);
    intervals.push_back({&piece.segment, piece.from, piece.from});
    const double wanted = std::ceil(std::abs(duration) / shortest);
    const int count = piece.segment.degree() <= 1 ? 1 : static_cast<int>(std::max<double>(wanted, kPointsOfPiece));
    for (int k = 1; k <= count; ++k) {
      const double t = piece.from + duration * (static_cast<double>(k) / count);
      intervals.push_back({&piece.segment, coarse.times.back(), t});
      add_point(coarse, piece.segment, t);
    }
  }

  const Refinement refinement(drawn_components(record.world(), group), coarse);
  Curve curve;
  for (const Interval& interval : intervals) {
    if (interval.from == interval.to)
      add_point(curve, *interval.segment, interval.to);
    else
      refinement.add(curve, interval);
  }
  return refinement.thinned(std::move(curve));
}

}  // namespace trajet
