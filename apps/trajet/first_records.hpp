#pragma once

#include <cstddef>
#include <vector>

#include "trajet/sim/run_observer.hpp"

namespace trajet {

/// The first impacts and events of a run, and how many there were: what a person reads of them.
class FirstRecords : public RunObserver {
 public:
  /// A ball that bounces to rest has hundreds of impacts: the first tell the story, the reports have them all.
  static constexpr std::size_t kMost = 20;

  /// `takes_records`: nobody needs them all in the result.
  explicit FirstRecords(bool takes_records) : takes_records_(takes_records) {}

  RunWishes wishes() const override { return {.takes_records = takes_records_}; }
  void impact(const Impact& impact) override {
    if (++impact_count_ <= kMost) impacts_.push_back(impact);
  }
  void event(const EventRecord& event) override {
    if (++event_count_ <= kMost) events_.push_back(event);
  }

  const std::vector<Impact>& impacts() const { return impacts_; }
  const std::vector<EventRecord>& events() const { return events_; }
  std::size_t impact_count() const { return impact_count_; }
  std::size_t event_count() const { return event_count_; }

 private:
  bool takes_records_;
  std::vector<Impact> impacts_;
  std::vector<EventRecord> events_;
  std::size_t impact_count_ = 0;
  std::size_t event_count_ = 0;
};

}  // namespace trajet
