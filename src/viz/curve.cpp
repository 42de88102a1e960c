#include "trajet/viz/curve.hpp"

#include <algorithm>
#include <cmath>

namespace trajet {

namespace {

/// Points of a whole run: a picture is some 1000 pixels wide, half of them a panel.
constexpr double kPointsOfRun = 250.0;
/// Points of a piece, at least: a step of a method of high order can be the whole run, a bounce a hundredth of it.
constexpr int kPointsOfPiece = 8;

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

}  // namespace

Curve make_curve(const MotionRecord& record, int group) {
  Curve curve;
  const auto& pieces = record.pieces(group);
  if (pieces.empty()) return curve;
  const double shortest = std::abs(pieces.back().to - pieces.front().from) / kPointsOfRun;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto& piece = pieces[i];
    const double duration = piece.to - piece.from;
    const bool is_end = i == 0 || i + 1 == pieces.size();
    if (!is_end && std::abs(piece.to - curve.times.back()) < shortest) continue;
    add_point(curve, piece.segment, piece.from);
    const double wanted = std::ceil(std::abs(duration) / shortest);
    const int count = piece.segment.degree() <= 1 ? 1 : static_cast<int>(std::max<double>(wanted, kPointsOfPiece));
    for (int k = 1; k <= count; ++k)
      add_point(curve, piece.segment, piece.from + duration * (static_cast<double>(k) / count));
  }
  return curve;
}

}  // namespace trajet
