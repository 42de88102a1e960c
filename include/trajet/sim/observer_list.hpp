#pragma once

#include <algorithm>
#include <initializer_list>
#include <utility>
#include <vector>

#include "trajet/portable.hpp"
#include "trajet/sim/run_observer.hpp"

namespace trajet {

/// Several observers as one: each hears of what it wishes, and any of them can end the run.
class ObserverList : public RunObserver {
 public:
  /// They outlive the list; null pointers are left out.
  explicit ObserverList(std::vector<RunObserver*> observers) : observers_(std::move(observers)) {
    std::erase(observers_, nullptr);
  }

  RunWishes wishes() const override {
    RunWishes all;
    for (const RunObserver* each : observers_) {
      all.motion |= each->wishes().motion;
      all.samples |= each->wishes().samples;
      all.takes_records |= each->wishes().takes_records;
    }
    return all;
  }
  void begin(const World& world) override {
    for (RunObserver* each : observers_) each->begin(world);
  }
  void motion(const MotionPiece& piece) override {
    for (RunObserver* each : observers_)
      if (each->wishes().motion) each->motion(piece);
  }
  void sample(const Sample& sample) override {
    for (RunObserver* each : observers_)
      if (each->wishes().samples) each->sample(sample);
  }
  void impact(const Impact& impact) override {
    for (RunObserver* each : observers_) each->impact(impact);
  }
  void event(const EventRecord& event) override {
    for (RunObserver* each : observers_) each->event(event);
  }
  bool interrupted(double time) override {
    return ranges::any_of(observers_, [time](RunObserver* each) { return each->interrupted(time); });
  }

 private:
  std::vector<RunObserver*> observers_;
};

}  // namespace trajet
