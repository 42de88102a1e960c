#include "run_keeper.hpp"

namespace trajet {

RunKeeper::RunKeeper(const World& world, const std::string& beside, bool keeps_motion, bool has_figure)
    : first_records_(!has_figure) {
  if (has_figure) {
    motion_.emplace();
    return;
  }
  if (!beside.empty()) record_spool_.emplace(beside);
  if (keeps_motion) motion_spool_.emplace(beside, world);
}

std::vector<RunObserver*> RunKeeper::observers() {
  return {&first_records_, record_spool_ ? &*record_spool_ : nullptr, motion_spool_ ? &*motion_spool_ : nullptr,
          motion_ ? &*motion_ : nullptr};
}

const RunRecords& RunKeeper::records(const RunResult& result) {
  if (record_spool_) return *record_spool_;
  return result_records_.emplace(result);
}

const RecordedMotion& RunKeeper::motion() const {
  if (motion_spool_) return *motion_spool_;
  return *motion_;
}

}  // namespace trajet
