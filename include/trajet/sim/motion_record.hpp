#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "trajet/scene/world.hpp"
#include "trajet/sim/run_observer.hpp"

namespace trajet {

/// The motion of one group between two times, which lie on the Segment.
struct RecordedPiece {
  Segment<> segment;
  double from = 0.0;  ///< s since the start, as all times of the Segment
  double to = 0.0;
};

/// The whole motion of a run, wherever it is kept: what moved, and all pieces of its way.
class RecordedMotion {
 public:
  /// Reads the pieces of one group one after another, in the order of the run.
  class Reader {
   public:
    virtual ~Reader() = default;
    /// The next piece, until the next call; null behind the last one.
    virtual const RecordedPiece* next() = 0;
  };

  virtual ~RecordedMotion() = default;
  /// What moved. The run must have begun.
  virtual const World& world() const = 0;
  /// Of World::groups[group]; no pieces where the run ended at its start. The motion outlives the reader.
  virtual std::unique_ptr<Reader> read(int group) const = 0;
};

/// Keeps the whole motion of a run in memory.
class MotionRecord : public RunObserver, public RecordedMotion {
 public:
  using Piece = RecordedPiece;

  RunWishes wishes() const override { return {.motion = true}; }
  void begin(const World& world) override;
  void motion(const MotionPiece& piece) override;

  const World& world() const override { return *world_; }
  std::unique_ptr<Reader> read(int group) const override;
  /// The pieces of World::groups[group], in the order of the run; none where the run ended at its start.
  const std::vector<Piece>& pieces(int group) const { return pieces_[static_cast<std::size_t>(group)]; }

 private:
  std::optional<World> world_;
  std::vector<std::vector<Piece>> pieces_;
};

}  // namespace trajet
