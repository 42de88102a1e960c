#pragma once

#include <optional>
#include <vector>

#include "trajet/scene/world.hpp"
#include "trajet/sim/run_observer.hpp"

namespace trajet {

/// Keeps the whole motion of a run: what moved, and all pieces of its way.
class MotionRecord : public RunObserver {
 public:
  struct Piece {
    Segment<> segment;
    double from = 0.0;  ///< s since the start, as all times of the Segment
    double to = 0.0;
  };

  RunWishes wishes() const override { return {.motion = true}; }
  void begin(const World& world) override;
  void motion(const MotionPiece& piece) override;

  /// What moved. The run must have begun.
  const World& world() const { return *world_; }
  /// The pieces of World::groups[group], in the order of the run; none where the run ended at its start.
  const std::vector<Piece>& pieces(int group) const { return pieces_[static_cast<std::size_t>(group)]; }

 private:
  std::optional<World> world_;
  std::vector<std::vector<Piece>> pieces_;
};

}  // namespace trajet
