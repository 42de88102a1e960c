#include "run_monitor.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <atomic>
#include <new>
#include <utility>

#include "memory_reserve.hpp"
#include "message.hpp"
#include "terminal.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

namespace {

constexpr std::chrono::milliseconds kFirstShow{500};
constexpr std::chrono::milliseconds kShowInterval{100};

/// What asks for the end of the program: Ctrl-C, `kill`, a batch system or `timeout`, a terminal that is closed.
constexpr int kEndingSignals[] = {SIGINT, SIGTERM, SIGHUP};

std::atomic<int> ending_signal{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler writes it");

/// "45 s", "12 min", "3.4 h": as exact as a guess deserves.
std::string format_duration(double seconds) {
  if (seconds < 99.5) return fmt::format("{:.0f} s", seconds);
  if (seconds < 99.5 * 60.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

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

RunMonitor::RunMonitor() : shows_progress_(is_terminal(stderr)) {
  set_handler(note_interrupt, static_cast<int>(SA_RESETHAND));
}

RunMonitor::~RunMonitor() { clear(); }

void RunMonitor::clear() {
  if (has_shown_) tell("\r\033[K");
  has_shown_ = false;
}

void RunMonitor::begin(const World& world) {
  start_ = world.epoch;
  end_ = world.epoch + world.duration;
  steps_ = 0;
  set_memory_aside();
  began_ = Clock::now();
  next_show_ = began_ + kFirstShow;
}

void RunMonitor::motion(const MotionPiece& piece) {
  if (piece.ends_step) ++steps_;
}

bool RunMonitor::interrupted(double time) {
  if (is_out_of_memory()) throw std::bad_alloc();
  if (shows_progress_)
    if (const Clock::time_point now = Clock::now(); now >= next_show_) show(time, now);
  return ending_signal.load(std::memory_order_relaxed) != 0;
}

void RunMonitor::show(double time, Clock::time_point now) {
  const double elapsed = std::chrono::duration<double>(now - began_).count();
  const double done = (time - start_) / (end_ - start_);
  std::string line = label_.empty() ? "" : label_ + ": ";
  line += fmt::format("{:.0f} %, t = {:.6g} of {:.6g} s, {:.3g} steps/s", 100.0 * done, time, end_,
                      static_cast<double>(steps_) / elapsed);
  if (done > 0.0) line += fmt::format(", {} left", format_duration(elapsed * (1.0 / done - 1.0)));
  // a line that wraps could not be taken back
  const auto room = static_cast<std::size_t>(terminal_width(stderr) - 1);
  tell("\r{:.{}}\033[K", line, room);
  has_shown_ = true;
  next_show_ = now + kShowInterval;
}

void let_signals_end_program() {
  set_handler(SIG_DFL, 0);
  if (const int signal = ending_signal.load(std::memory_order_relaxed); signal != 0) raise(signal);
}

}  // namespace trajet
