#pragma once

#include <functional>

#include "trajet/sim/run_result.hpp"

namespace trajet {

/// The impacts and the events of a run, each kind in the order of the run, wherever they are kept.
class RunRecords {
 public:
  virtual ~RunRecords() = default;
  virtual void each_impact(const std::function<void(const Impact&)>& use) const = 0;
  virtual void each_event(const std::function<void(const EventRecord&)>& use) const = 0;
};

/// Those that a result holds, which outlives this.
class ResultRecords : public RunRecords {
 public:
  explicit ResultRecords(const RunResult& result) : result_(result) {}
  void each_impact(const std::function<void(const Impact&)>& use) const override {
    for (const Impact& impact : result_.impacts) use(impact);
  }
  void each_event(const std::function<void(const EventRecord&)>& use) const override {
    for (const EventRecord& event : result_.events) use(event);
  }

 private:
  const RunResult& result_;
};

}  // namespace trajet
