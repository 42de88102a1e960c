#pragma once

#include <cstddef>
#include <vector>

#include "trajet/sim/motion_record.hpp"

namespace trajet {

/// Finds, of the pieces of a motion, the one on which a time lies, in about the same time however many there are.
///
/// The span is divided into as many slots as there are pieces, and each slot knows the pieces that begin in it; of
/// many, as where bounces accumulate, halving finds the one.
class PieceIndex {
 public:
  PieceIndex() = default;
  /// The pieces in the order of the run; `direction`: 1, or -1 for a run backward in time.
  PieceIndex(const std::vector<RecordedPiece>& pieces, double direction);

  /// The last piece that begins at `t` or before, in the run's direction: at a joint the one behind it. The first one
  /// where there is none. There must be a piece.
  std::size_t find(double t) const;

 private:
  std::size_t slot(double from) const;

  double direction_ = 1.0;
  double scale_ = 0.0;              // slots a second
  std::vector<double> begins_;      // of the pieces, times the direction: they grow
  std::vector<std::size_t> first_;  // of each slot: how many pieces begin in earlier ones
};

}  // namespace trajet
