#include "aim_summary.hpp"

#include <fmt/format.h>

#include <numbers>

#include "terminal.hpp"
#include "text_table.hpp"

namespace trajet {
namespace {

double degrees(double angle_rad) { return angle_rad * (180.0 / std::numbers::pi); }

}  // namespace

std::string describe_values(const std::vector<ShownUnknown>& unknowns, const std::vector<double>& values) {
  std::string text;
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    text += fmt::format("{}{} = {:.9g}", i == 0 ? "" : ", ", unknowns[i].name, values[i]);
    if (unknowns[i].is_in_degrees) text += fmt::format(" ({:.9g} deg)", degrees(values[i]));
  }
  return text;
}

std::string aim_text(const std::string& title, const std::vector<ShownUnknown>& unknowns, const AimResult& result,
                     bool color, int width) {
  std::string text;
  if (!title.empty()) text += styled(title, Style::bold, color) + "\n";
  if (result.status == AimStatus::found)
    text += fmt::format("{}: {} solution{}", styled("found", Style::green, color), result.solutions.size(),
                        result.solutions.size() == 1 ? "" : "s");
  else
    text += styled(result.status == AimStatus::unreachable ? "unreachable" : "not converged", Style::red, color);
  text += fmt::format(" ({} motions)\n\n", result.motions);

  TextTable table(1);
  for (const ShownUnknown& unknown : unknowns) {
    table[0].push_back(unknown.name);
    if (unknown.is_in_degrees) table[0].emplace_back("[deg]");
  }
  const auto start_row = [&](const std::vector<double>& values) {
    std::vector<std::string> row;
    for (std::size_t i = 0; i < values.size(); ++i) {
      row.push_back(fmt::format("{:.10g}", values[i]));
      if (unknowns[i].is_in_degrees) row.push_back(fmt::format("{:.10g}", degrees(values[i])));
    }
    return row;
  };
  const std::size_t keys = table[0].size();
  if (result.status == AimStatus::found) {
    table[0].insert(table[0].end(), {"time [s]", "point [m]", "miss [m]", "bounces"});
    for (const AimSolution& each : result.solutions) {
      std::vector<std::string> row = start_row(each.parameters);
      row.insert(row.end(), {fmt::format("{:.10g}", each.time),
                             fmt::format("({:.6g}, {:.6g}, {:.6g})", each.point.x(), each.point.y(), each.point.z()),
                             fmt::format("{:.1e}", each.miss), fmt::format("{}", each.bounces)});
      table.push_back(std::move(row));
    }
  } else if (result.closest) {
    table[0].insert(table[0].end(), {"nearest at [s]", "miss [m]"});
    std::vector<std::string> row = start_row(result.closest->parameters);
    row.insert(row.end(), {fmt::format("{:.10g}", result.closest->time), fmt::format("{:.6g}", result.closest->miss)});
    table.push_back(std::move(row));
  }
  return table.size() > 1 ? text + format_table(table, {.keys = keys, .width = width}) : text;
}

std::string aim_failure(const std::vector<ShownUnknown>& unknowns, const AimResult& result) {
  if (!result.closest)
    return "no motion in the ranges could be computed" + (result.failure.empty() ? "" : ": " + result.failure);
  const ClosestApproach& closest = *result.closest;
  const std::string nearest = fmt::format("the nearest motion has {}, at t = {:.9g} s",
                                          describe_values(unknowns, closest.parameters), closest.time);
  std::string text;
  if (result.status == AimStatus::not_converged)
    text = fmt::format(
        "{}: the numbers have not come nearer than {:.6g} m, which does not tell whether the target can be "
        "hit; {}",
        result.is_interrupted ? "interrupted" : "not converged", closest.miss, nearest);
  else if (result.refused > 0)
    text = fmt::format("{} hit{}, but not with what --with asks for", result.refused, result.refused == 1 ? "" : "s");
  else
    text = fmt::format("out of reach by {:.6g} m: {}", closest.miss, nearest);
  if (closest.ends_by_clock)
    text += "; it was still coming nearer there, at the end of the run: a later --end may bring it to the target";
  if (!result.failure.empty()) text += "; some motions failed, the first of them: " + result.failure;
  return text;
}

}  // namespace trajet
