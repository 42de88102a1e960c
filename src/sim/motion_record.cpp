#include "trajet/sim/motion_record.hpp"

namespace trajet {

namespace {

class MemoryReader : public RecordedMotion::Reader {
 public:
  explicit MemoryReader(const std::vector<RecordedPiece>& pieces) : pieces_(pieces) {}
  const RecordedPiece* next() override { return next_ < pieces_.size() ? &pieces_[next_++] : nullptr; }

 private:
  const std::vector<RecordedPiece>& pieces_;
  std::size_t next_ = 0;
};

}  // namespace

void MotionRecord::begin(const World& world) {
  world_ = world;
  pieces_.assign(world.groups.size(), {});
}

void MotionRecord::motion(const MotionPiece& piece) {
  pieces_[static_cast<std::size_t>(piece.group)].push_back({piece.segment, piece.from, piece.to});
}

std::unique_ptr<RecordedMotion::Reader> MotionRecord::read(int group) const {
  return std::make_unique<MemoryReader>(pieces(group));
}

}  // namespace trajet
