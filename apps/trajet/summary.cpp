#include "summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "terminal.hpp"
#include "text_table.hpp"
#include "trajet/portable.hpp"
#include "trajet/sim/names.hpp"

namespace trajet {

namespace {

std::string format(const Vector3& v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x(), v.y(), v.z()); }

std::string format(const Quaternion& q) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}, {:.6g})", q.w(), q.x(), q.y(), q.z());
}

/// A time that many `elapsed` seconds after the start, which may be off by `bound`: with ten digits of what has
/// elapsed, whatever the clock shows, as far as they hold.
std::string format_time(double time, double elapsed, double bound = 0.0) {
  constexpr int kDigits = 10, kFewestDigits = 3, kMostDigits = 17;
  const double known = std::log10(std::abs(elapsed) / bound);  // infinite or not a number where all are
  const int of_elapsed = known < kDigits ? std::max(kFewestDigits, static_cast<int>(std::ceil(known))) : kDigits;
  const double ratio = elapsed != 0.0 ? std::abs(time / elapsed) : 1.0;
  const int digits = ratio > 10.0 ? of_elapsed + static_cast<int>(std::log10(ratio)) : of_elapsed;
  return fmt::format("{:.{}g}", time, std::min(digits, kMostDigits));
}

std::string more_rows(std::size_t count) {
  if (count <= FirstRecords::kMost) return {};
  return fmt::format("  … and {} more\n", count - FirstRecords::kMost);
}

std::string impact_table(const FirstRecords& records, int width) {
  TextTable table{{"time [s]", "body", "with", "kind", "point [m]", "speed before [m/s]", "after"}};
  for (const Impact& impact : records.impacts())
    table.push_back({format_time(impact.time, impact.elapsed, impact.time_error_bound), impact.body, impact.with,
                     std::string(name(impact.kind)), format(impact.point),
                     fmt::format("{:.6g}", impact.velocity_before.norm()),
                     fmt::format("{:.6g}", impact.velocity_after.norm())});
  return format_table(table, {.width = width}) + more_rows(records.impact_count());
}

std::string event_table(const FirstRecords& records, int width) {
  TextTable table{{"time [s]", "event", "direction"}};
  for (const EventRecord& event : records.events()) {
    const std::string what = event.law.empty() ? event.event : event.event + ": " + event.law;
    table.push_back({format_time(event.time, event.elapsed), what, event.direction < 0 ? "falling" : "rising"});
  }
  return format_table(table, {.width = width}) + more_rows(records.event_count());
}

std::string final_state(const Sample& final, int width) {
  std::string text;
  if (!final.bodies.empty()) {
    TextTable table{{"at the end", "position [m]", "velocity [m/s]"}};
    for (const BodyState& body : final.bodies)
      table.push_back({body.body, format(body.position), format(body.velocity)});
    text += format_table(table, {.width = width});
  }
  if (ranges::any_of(final.bodies, &BodyState::turns)) {
    TextTable table{{"at the end", "orientation (w, x, y, z)", "angular velocity [rad/s]"}};
    for (const BodyState& body : final.bodies)
      if (body.turns) table.push_back({body.body, format(body.orientation), format(body.angular_velocity)});
    text += "\n" + format_table(table, {.width = width});
  }
  for (const NamedValue& state : final.states) text += fmt::format("  {} = {:.10g}\n", state.name, state.value);
  return text;
}

std::string cost(const RunStatistics& statistics) {
  return fmt::format("steps: {} (rejected: {}), law evaluations: {}, time: {:.3g} ms\n", statistics.steps,
                     statistics.rejected_steps, statistics.law_evaluations, 1e3 * statistics.wall_seconds);
}

}  // namespace

std::string summary(const RunResult& result, const FirstRecords& records, bool color, int width) {
  const bool is_good = result.status == RunStatus::finished || result.status == RunStatus::stopped;
  const Style style = is_good ? Style::green : result.status == RunStatus::failed ? Style::red : Style::yellow;
  std::string text;
  if (!result.title.empty()) text += styled(result.title, Style::bold, color) + "\n";
  text += fmt::format("{} at t = {} s (method {})\n", styled(name(result.status), style, color),
                      format_time(result.end_time, result.elapsed), result.method);
  if (records.impact_count() > 0) text += "\n" + impact_table(records, width);
  if (records.event_count() > 0) text += "\n" + event_table(records, width);
  if (records.impact_count() == 0 || !result.final.states.empty()) text += "\n" + final_state(result.final, width);
  return text + "\n" + cost(result.statistics);
}

}  // namespace trajet
