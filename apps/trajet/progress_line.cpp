#include "progress_line.hpp"

#include <fmt/format.h>

#include "message.hpp"
#include "terminal.hpp"

namespace trajet {
namespace {

constexpr std::chrono::milliseconds kFirstShow{500};
constexpr std::chrono::milliseconds kShowInterval{100};

}  // namespace

std::string format_duration(double seconds) {
  if (seconds < 99.5) return fmt::format("{:.0f} s", seconds);
  if (seconds < 99.5 * 60.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

ProgressLine::ProgressLine() : is_shown_(is_terminal(stderr)) { begin(); }

void ProgressLine::begin() {
  began_ = Clock::now();
  next_show_ = began_ + kFirstShow;
}

double ProgressLine::seconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

void ProgressLine::show(std::string line, double done) {
  if (done > 0.0) line += fmt::format(", {} left", format_duration(seconds() * (1.0 / done - 1.0)));
  // a line that wraps could not be taken back
  const auto room = static_cast<std::size_t>(terminal_width(stderr) - 1);
  tell("\r{:.{}}\033[K", line, room);
  has_shown_ = true;
  next_show_ = Clock::now() + kShowInterval;
}

void ProgressLine::clear() {
  if (has_shown_) tell("\r\033[K");
  has_shown_ = false;
}

}  // namespace trajet
