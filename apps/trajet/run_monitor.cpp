#include "run_monitor.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <atomic>
#include <new>
#include <utility>

#include "memory_reserve.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

namespace {

/// What asks for the end of the program: Ctrl-C, `kill`, a batch system or `timeout`, a terminal that is closed.
constexpr int kEndingSignals[] = {SIGINT, SIGTERM, SIGHUP};

std::atomic<int> ending_signal{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler writes it");

void note_interrupt(int signal) { ending_signal.store(signal, std::memory_order_relaxed); }

void set_handler(void (*handler)(int), int flags) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  for (const int signal : kEndingSignals) {
    struct sigaction present = {};
    sigaction(signal, nullptr, &present);
    const bool is_nohup = signal == SIGHUP && present.sa_handler == SIG_IGN;
    if (!is_nohup) sigaction(signal, &action, nullptr);
  }
}

}  // namespace

void let_signals_end_runs() { set_handler(note_interrupt, static_cast<int>(SA_RESETHAND)); }

bool is_end_wanted() { return ending_signal.load(std::memory_order_relaxed) != 0; }

RunMonitor::RunMonitor() { let_signals_end_runs(); }

void RunMonitor::begin(const World& world) {
  start_ = world.epoch;
  end_ = world.epoch + world.duration;
  steps_ = 0;
  set_memory_aside();
  progress_.begin();
}

void RunMonitor::motion(const MotionPiece& piece) {
  if (piece.ends_step) ++steps_;
}

bool RunMonitor::interrupted(double time) {
  if (is_out_of_memory()) throw std::bad_alloc();
  if (progress_.is_due()) {
    std::string line = label_.empty() ? "" : label_ + ": ";
    const double done = (time - start_) / (end_ - start_);
    line += fmt::format("{:.0f} %, t = {:.6g} of {:.6g} s, {:.3g} steps/s", 100.0 * done, time, end_,
                        static_cast<double>(steps_) / progress_.seconds());
    progress_.show(std::move(line), done);
  }
  return is_end_wanted();
}

void let_signals_end_program() {
  set_handler(SIG_DFL, 0);
  if (const int signal = ending_signal.load(std::memory_order_relaxed); signal != 0) raise(signal);
}

}  // namespace trajet
