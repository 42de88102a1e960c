#include "trajet/sim/motion_record.hpp"

namespace trajet {

void MotionRecord::begin(const World& world) {
  world_ = world;
  pieces_.assign(world.groups.size(), {});
}

void MotionRecord::motion(const MotionPiece& piece) {
  pieces_[static_cast<std::size_t>(piece.group)].push_back({piece.segment, piece.from, piece.to});
}

}  // namespace trajet
