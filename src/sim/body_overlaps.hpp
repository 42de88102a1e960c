#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "trajet/geom/aabb.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/sim/run_observer.hpp"

namespace trajet {

/// Looks whether two bodies of a run, one of them with extent, are ever at one place: nothing else in a run notices,
/// since bodies do not meet each other.
///
/// It reads the pieces of the motion, in windows of time that all bodies' pieces cover. In each, a tree over the boxes
/// that the bodies sweep tells the pairs that may be near each other. Windows grow where bodies have few pieces in them
/// and meet few others, so that each piece costs the logarithm of the number of bodies. For a pair the window is halved
/// until the boxes around their centres are apart or the piece is short, and at its middle the solids themselves are
/// compared. Overlaps that last for less than the shortest pieces may be missed.
class BodyOverlaps {
 public:
  struct Overlap {
    double time;  ///< s, from which on the two are at one place
    int first;    ///< in World::bodies
    int second;
  };

  /// `world` outlives it.
  explicit BodyOverlaps(const World& world);

  /// Whether there are bodies that could overlap.
  static bool are_possible(const World& world);

  /// The motion goes on by this piece.
  void add(const MotionPiece& piece);
  /// The first overlap of the run, which has ended at this time, s.
  std::optional<Overlap> finish(double end_time);

  /// How many trees were made so far.
  long trees() const { return trees_; }

 private:
  // Times are counted from the run's start in its direction, s.
  struct Span {
    double from;
    double to;
  };
  struct Piece {
    Segment<> segment;
    double from;
    double to;
  };
  struct Found {
    double ahead;
    int first;
    int second;
  };

  double ahead(double t) const { return direction_ * t; }
  const Solid& solid(int body) const { return world_.bodies[static_cast<std::size_t>(body)].solid; }
  const std::deque<Piece>& pieces_of(int body) const;
  const Piece& piece_at(int body, double time) const;
  void count_behind();
  /// Makes the next window as long as suits what was found in the last one.
  void adapt_window();
  /// Looks on up to this time and forgets what is before.
  void look_on(double to);
  void look(Span window, int halvings);
  /// The first time within `span` at which the pair overlaps.
  std::optional<double> first_overlap(int first, int second, Span span, int halvings) const;
  bool overlap_at(int first, int second, double time) const;
  /// The box around a body's centre.
  Aabb swept(int body, Span span) const;

  const World& world_;
  double direction_;
  double shortest_window_;   // s
  double window_;            // s, how long the next one is
  bool is_crowded_ = false;  // the last one had to be halved
  std::size_t held_ = 0;     // pieces
  long trees_ = 0;
  double looked_to_ = 0.0;
  std::vector<std::deque<Piece>> pieces_;  // of each group
  int behind_ = 0;                         // groups whose bodies' pieces do not cover the next window
  std::vector<double> radii_;              // of each body, m
  std::vector<int> extended_;              // the bodies that have one
  std::optional<Found> found_;
};

}  // namespace trajet
