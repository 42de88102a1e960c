#include "run_monitor.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <atomic>

#include "terminal.hpp"

namespace trajet {

namespace {

constexpr std::chrono::milliseconds kFirstShow{500};
constexpr std::chrono::milliseconds kShowInterval{100};

std::atomic<bool> is_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler writes it");

void note_interrupt(int) { is_interrupted.store(true, std::memory_order_relaxed); }

}  // namespace

RunMonitor::RunMonitor(CsvWriter* csv)
    : csv_(csv), shows_progress_(is_terminal(stderr)), next_show_(Clock::now() + kFirstShow) {
  struct sigaction action = {};
  action.sa_handler = note_interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
}

RunMonitor::~RunMonitor() {
  if (has_shown_) fmt::print(stderr, "\r\033[K");
}

void RunMonitor::sample(const Sample& sample) {
  if (csv_ != nullptr) csv_->sample(sample);
}

bool RunMonitor::interrupted(double time) {
  if (shows_progress_ && Clock::now() >= next_show_) {
    fmt::print(stderr, "\rt = {:<12.6g} s", time);
    has_shown_ = true;
    next_show_ = Clock::now() + kShowInterval;
  }
  return is_interrupted.load(std::memory_order_relaxed);
}

}  // namespace trajet
