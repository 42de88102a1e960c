#include "body_overlaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "trajet/event/path.hpp"
#include "trajet/geom/box_tree.hpp"
#include "trajet/geom/solid_overlap.hpp"
#include "trajet/portable.hpp"
#include "trajet/sim/state_at.hpp"

namespace trajet {
namespace {

constexpr double kWindows = 64.0;  // the shortest
/// Windows grow where each group has fewer pieces in them, and are short again where so many wait to be looked at.
constexpr std::size_t kFewPieces = 2;
constexpr std::size_t kManyPieces = 16;
/// A window in which a body may meet more others than that is halved, this often at most.
constexpr std::size_t kCrowd = 8;
constexpr int kWindowHalvings = 8;
/// How often the window is halved for a pair: of balls and points, and of others, whose comparison costs more.
constexpr int kRoundHalvings = 10;
constexpr int kHalvings = 6;

PlacedSolid place(const World& world, const World::Body& body, const Segment<>& segment, double t) {
  const Eigen::VectorXd q = state_at(world, body.group, segment, t);
  Matrix3 R_WB = rotation_matrix(body.q_WB);
  if (body.rotation) R_WB = body.rotation->layout.matrix(q.data() + body.rotation->offset);
  return {body.solid, body.slice().position(q), R_WB};
}

/// How far they reach, s ahead.
template <class Pieces>
double covered(const Pieces& pieces) {
  return pieces.empty() ? 0.0 : pieces.back().to;
}

double distance(const Aabb& a, const Aabb& b) {
  return (a.lower - b.upper).cwiseMax(b.lower - a.upper).cwiseMax(0.0).norm();
}

}  // namespace

BodyOverlaps::BodyOverlaps(const World& world)
    : world_(world),
      direction_(world.direction()),
      shortest_window_(std::abs(world.duration) / kWindows),
      window_(shortest_window_),
      pieces_(world.groups.size()) {
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    radii_.push_back(bounding_radius(world.bodies[i].solid));
    if (radii_.back() > 0.0) extended_.push_back(static_cast<int>(i));
  }
  count_behind();
}

bool BodyOverlaps::are_possible(const World& world) {
  const auto has_extent = [](const World::Body& body) { return bounding_radius(body.solid) > 0.0; };
  return world.bodies.size() > 1 && world.duration != 0.0 && ranges::any_of(world.bodies, has_extent);
}

const std::deque<BodyOverlaps::Piece>& BodyOverlaps::pieces_of(int body) const {
  return pieces_[static_cast<std::size_t>(world_.bodies[static_cast<std::size_t>(body)].group)];
}

void BodyOverlaps::count_behind() {
  behind_ = 0;
  for (std::size_t g = 0; g < pieces_.size(); ++g)
    if (!world_.groups[g].bodies.empty() && covered(pieces_[g]) < looked_to_ + window_) ++behind_;
}

void BodyOverlaps::add(const MotionPiece& piece) {
  if (found_ || world_.groups[static_cast<std::size_t>(piece.group)].bodies.empty()) return;
  std::deque<Piece>& pieces = pieces_[static_cast<std::size_t>(piece.group)];
  const bool was_behind = covered(pieces) < looked_to_ + window_;
  pieces.push_back({piece.segment, ahead(piece.from), ahead(piece.to)});
  if (++held_ >= kManyPieces * pieces_.size() && window_ > shortest_window_) {
    window_ = shortest_window_;
    count_behind();
  } else if (was_behind && covered(pieces) >= looked_to_ + window_) {
    --behind_;
  }
  while (behind_ == 0 && !found_) look_on(looked_to_ + window_);
}

std::optional<BodyOverlaps::Overlap> BodyOverlaps::finish(double end_time) {
  while (!found_ && looked_to_ < ahead(end_time)) look_on(std::min(looked_to_ + window_, ahead(end_time)));
  if (!found_) return std::nullopt;
  return Overlap{direction_ * found_->ahead, found_->first, found_->second};
}

void BodyOverlaps::look_on(double to) {
  is_crowded_ = false;
  look({looked_to_, to}, 0);
  looked_to_ = to;
  adapt_window();
  for (std::deque<Piece>& pieces : pieces_)
    for (; !pieces.empty() && pieces.front().to < to; --held_) pieces.pop_front();
  count_behind();
}

void BodyOverlaps::adapt_window() {
  std::size_t count = 0;
  for (const std::deque<Piece>& pieces : pieces_)
    count += static_cast<std::size_t>(ranges::lower_bound(pieces, looked_to_, {}, &Piece::from) - pieces.begin());
  if (is_crowded_) {
    window_ = std::max(shortest_window_, 0.5 * window_);
  } else if (count < kFewPieces * pieces_.size()) {
    window_ *= 2.0;
  }
}

void BodyOverlaps::look(Span window, int halvings) {
  ++trees_;
  std::vector<Aabb> boxes;
  boxes.reserve(extended_.size());
  for (const int body : extended_) boxes.push_back(grown(swept(body, window), radii_[static_cast<std::size_t>(body)]));
  const BoxTree tree(boxes);
  struct Pair {
    int first;
    int second;
  };
  std::vector<Pair> pairs;
  const std::size_t most = kCrowd * world_.bodies.size();
  for (int body = 0; body < static_cast<int>(world_.bodies.size()); ++body) {
    const double radius = radii_[static_cast<std::size_t>(body)];
    const bool are_few = tree.visit_overlapping(grown(swept(body, window), radius), [&](int index) {
      const int other = extended_[static_cast<std::size_t>(index)];
      // two extended bodies find each other
      if (other != body && (radius == 0.0 || body < other))
        pairs.push_back({std::min(body, other), std::max(body, other)});
      return pairs.size() <= most || halvings == kWindowHalvings;
    });
    if (are_few) continue;
    is_crowded_ = true;
    const double middle = 0.5 * (window.from + window.to);
    look({window.from, middle}, halvings + 1);
    if (!found_) look({middle, window.to}, halvings + 1);
    return;
  }
  // the shortest pieces are as short in long windows
  const double length = (window.to - window.from) / shortest_window_;
  const int further = std::max(0, static_cast<int>(std::lround(std::log2(length))));
  for (const auto [first, second] : pairs) {
    const Span span{window.from, found_ ? found_->ahead : window.to};
    const bool are_round = is_round(solid(first)) && is_round(solid(second));
    const std::optional<double> time =
        first_overlap(first, second, span, further + (are_round ? kRoundHalvings : kHalvings));
    if (time) found_ = Found{*time, first, second};
  }
}

std::optional<double> BodyOverlaps::first_overlap(int first, int second, Span span, int halvings) const {
  const double reach = radii_[static_cast<std::size_t>(first)] + radii_[static_cast<std::size_t>(second)];
  if (distance(swept(first, span), swept(second, span)) >= reach) return std::nullopt;
  const double middle = 0.5 * (span.from + span.to);
  if (halvings > 0) {
    const std::optional<double> early = first_overlap(first, second, {span.from, middle}, halvings - 1);
    return early ? early : first_overlap(first, second, {middle, span.to}, halvings - 1);
  }
  const std::array times{span.from, middle, span.to};
  const auto seen = ranges::find_if(times, [&](double time) { return overlap_at(first, second, time); });
  if (seen == times.end()) return std::nullopt;
  double with = *seen;
  double without = span.from;
  while (true) {
    const double between = 0.5 * (without + with);
    if (between <= without || between >= with) return with;
    (overlap_at(first, second, between) ? with : without) = between;
  }
}

const BodyOverlaps::Piece& BodyOverlaps::piece_at(int body, double time) const {
  const std::deque<Piece>& pieces = pieces_of(body);
  const auto found = ranges::lower_bound(pieces, time, {}, &Piece::to);
  return found == pieces.end() ? pieces.back() : *found;
}

bool BodyOverlaps::overlap_at(int first, int second, double time) const {
  const double t = direction_ * time;
  const auto placed = [&](int index) {
    return place(world_, world_.bodies[static_cast<std::size_t>(index)], piece_at(index, time).segment, t);
  };
  return overlap(placed(first), placed(second));
}

Aabb BodyOverlaps::swept(int body, Span span) const {
  const std::deque<Piece>& pieces = pieces_of(body);
  const int offset = world_.bodies[static_cast<std::size_t>(body)].offset;
  Aabb box;
  for (auto piece = ranges::lower_bound(pieces, span.from, {}, &Piece::to);
       piece != pieces.end() && piece->from <= span.to; ++piece) {
    const PointPath path(piece->segment, offset);
    const double origin = ahead(path.t0());
    const double from = direction_ * (std::max(span.from, piece->from) - origin);
    const double to = direction_ * (std::min(span.to, piece->to) - origin);
    for (int i = 0; i < 3; ++i) {
      const Range range = path.range(i, from, to);
      box.lower[i] = std::min(box.lower[i], range.lower);
      box.upper[i] = std::max(box.upper[i], range.upper);
    }
  }
  return box;
}

}  // namespace trajet
