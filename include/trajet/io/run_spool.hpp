#pragma once

#include <string>

#include "trajet/io/spool.hpp"
#include "trajet/sim/motion_record.hpp"
#include "trajet/sim/run_records.hpp"

namespace trajet {

/// Takes the impacts and events of a run: the memory that is needed does not grow with them.
class RecordSpool : public RunObserver, public RunRecords {
 public:
  /// `beside`: the file that is going to be made of them, see Spool.
  explicit RecordSpool(const std::string& beside) : spool_(beside, 2) {}

  RunWishes wishes() const override { return {.takes_records = true}; }
  void impact(const Impact& impact) override;
  void event(const EventRecord& event) override;

  void each_impact(const std::function<void(const Impact&)>& use) const override;
  void each_event(const std::function<void(const EventRecord&)>& use) const override;

 private:
  Spool spool_;
  std::string bytes_;
};

/// Keeps the motion of a run likewise. The pieces that are read have no error bounds.
class MotionSpool : public RunObserver, public RecordedMotion {
 public:
  /// The world is that of the run, and outlives the spool.
  MotionSpool(const std::string& beside, const World& world) : world_(world), spool_(beside, world.groups.size()) {}

  RunWishes wishes() const override { return {.motion = true}; }
  void motion(const MotionPiece& piece) override;

  const World& world() const override { return world_; }
  std::unique_ptr<Reader> read(int group) const override;

 private:
  const World& world_;
  Spool spool_;
  std::string bytes_;
};

}  // namespace trajet
