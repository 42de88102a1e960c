#pragma once

#include <string>
#include <vector>

#include "aim_point.hpp"
#include "trajet/sim/motion_record.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

/// A time at which a body is nearest to a target: of one leg of its motion between two impacts, or at the end of a leg
/// that still comes nearer.
struct Passage {
  /// What the body has bounced off before, and what made that move; then the number of the passage in its leg. Passages
  /// of one label depend smoothly on what is changed in the scene.
  std::string label{};
  /// From the target to the body, at right angles to `direction`, m; at the end of a leg, where it would be if the body
  /// went straight on.
  Vector3 residual{0, 0, 0};
  Vector3 direction{1, 0, 0};  ///< unit: of the motion of the body as the target sees it
  double miss = 0.0;           ///< m: the least distance
  double time = 0.0;           ///< s since the start
  Vector3 position{0, 0, 0};   ///< of the body, m, world
  int bounces = 0;             ///< of the body before
  bool is_end = false;         ///< the leg ends before it is nearest
};

/// The motion of one group of bodies, as it was handed on.
class FlightRecord : public RunObserver {
 public:
  explicit FlightRecord(int group) : group_(group) {}
  RunWishes wishes() const override { return {.motion = true}; }
  void motion(const MotionPiece& piece) override {
    if (piece.group == group_) pieces_.push_back({piece.segment, piece.from, piece.to});
  }
  const std::vector<RecordedPiece>& pieces() const { return pieces_; }

 private:
  int group_;
  std::vector<RecordedPiece> pieces_;
};

/// All passages of a body, World::bodies[body], in the order of time. `pieces`: the motion of its group. Behind a
/// hundred impacts of the body no more are looked for.
std::vector<Passage> find_passages(const World& world, const RunResult& result,
                                   const std::vector<RecordedPiece>& pieces, int body, AimPoint& target);

}  // namespace trajet
