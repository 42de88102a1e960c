#include "sweep_summary.hpp"

#include <fmt/format.h>

#include "terminal.hpp"
#include "text_table.hpp"

namespace trajet {
namespace {

std::string number(double value) { return fmt::format("{:.6g}", value); }

std::string column_table(const SweepSummary& summary, int width) {
  TextTable table{{"", "mean", "sd", "min", "5 %", "median", "95 %", "max"}};
  bool is_partial = false;
  for (const SweepSummary::Column& column : summary.columns) is_partial |= column.numbers.count() < summary.tally.count;
  if (is_partial) table.front().emplace_back("in");
  for (const SweepSummary::Column& column : summary.columns) {
    const RunningStatistics& numbers = column.numbers;
    table.push_back({column.name, number(numbers.mean()), numbers.count() > 1 ? number(numbers.deviation()) : "",
                     number(numbers.min()), number(column.quantiles[1]), number(column.quantiles[3]),
                     number(column.quantiles[5]), number(numbers.max())});
    if (is_partial) table.back().push_back(fmt::format("{}", numbers.count()));
  }
  return format_table(table, {.first_number = 1, .width = width});
}

std::string hit_table(const SweepSummary& summary, int width) {
  TextTable table{{"hit first", "motions", "share", "95 % sure between", "and"}};
  for (const SweepSummary::Hit& hit : summary.hits)
    table.push_back({hit.name, fmt::format("{}", hit.count), fmt::format("{:.4g} %", 100.0 * hit.share),
                     fmt::format("{:.4g} %", 100.0 * hit.ci95.low), fmt::format("{:.4g} %", 100.0 * hit.ci95.high)});
  return format_table(table, {.first_number = 1, .width = width});
}

std::string dispersion_table(const SweepSummary& summary, int width) {
  TextTable table{
      {"first impact on", "mean point [m]", "sd along axes [m]", "CEP 50 % [m]", "90 %", "50 % about center"}};
  for (const SweepSummary::Hit& hit : summary.hits) {
    if (!hit.dispersion) continue;
    const Dispersion& spread = *hit.dispersion;
    table.push_back(
        {hit.name, fmt::format("({:.6g}, {:.6g}, {:.6g})", spread.mean.x(), spread.mean.y(), spread.mean.z()),
         fmt::format("{:.4g} x {:.4g}", spread.major_deviation, spread.minor_deviation),
         fmt::format("{:.4g}", spread.about_mean[0].radius), fmt::format("{:.4g}", spread.about_mean[1].radius),
         hit.about_aim ? fmt::format("{:.4g}", (*hit.about_aim)[0].radius) : ""});
  }
  return table.size() > 1 ? "\n" + format_table(table, {.width = width}) : "";
}

}  // namespace

std::string sweep_text(const std::string& title, const SweepSummary& summary, bool color, int width) {
  std::string text;
  if (!title.empty()) text += styled(title, Style::bold, color) + "\n";
  text += fmt::format("{} motions", summary.tally.count);
  if (summary.tally.failed > 0)
    text += ", " + styled(fmt::format("{} failed", summary.tally.failed), Style::red, color);
  text += "\n";
  if (!summary.columns.empty()) text += "\n" + column_table(summary, width);
  if (!summary.hits.empty()) text += "\n" + hit_table(summary, width) + dispersion_table(summary, width);
  return text;
}

}  // namespace trajet
