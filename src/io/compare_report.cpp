#include "trajet/io/compare_report.hpp"

#include <utility>

#include "csv_field.hpp"
#include "json_text.hpp"
#include "trajet/sim/names.hpp"
#include "trajet/version.hpp"

namespace trajet {

namespace {

using detail::Json;

Json value(const std::optional<double>& number) { return number ? Json(*number) : Json(nullptr); }

/// One row; its keys are the columns of the CSV too.
Json object(const ComparisonRow& row, const Comparison& comparison) {
  Json object{{"method", row.method},
              {"step", value(row.step)},
              {"rtol", value(row.rtol)},
              {"atol", value(row.atol)},
              {"status", name(row.status)},
              {"failure", row.failure.empty() ? Json(nullptr) : Json(row.failure)},
              {"end_time", comparison.epoch + row.elapsed},
              {"compared_until", comparison.epoch + row.compared_until},
              {"error_at_end", value(row.at_end.state)},
              {"max_error", value(row.at_samples.state)},
              {"max_error_at_nodes", value(row.at_nodes.state)},
              {"position_error_at_end", value(row.at_end.position)},
              {"max_position_error", value(row.at_samples.position)},
              {"max_position_error_at_nodes", value(row.at_nodes.position)},
              {"law_evaluations", row.statistics.law_evaluations},
              {"steps", row.statistics.steps},
              {"rejected_steps", row.statistics.rejected_steps},
              {"impacts", row.impacts},
              {"wall_seconds", row.statistics.wall_seconds},
              {"orientation", row.orientation.empty() ? Json(nullptr) : Json(row.orientation)}};
  if (comparison.turns) {
    object["determinant_at_end"] = value(row.rotation_at_end.determinant);
    object["quaternion_norm_at_end"] = value(row.rotation_at_end.norm);
    object["angle_error_at_end"] = value(row.rotation_at_end.angle_rad);
    object["max_angle_error"] = value(row.rotation_at_samples.angle_rad);
    object["max_energy_drift"] = value(row.rotation_at_samples.energy);
    object["max_momentum_drift"] = value(row.rotation_at_samples.momentum);
  }
  return object;
}

/// A value as a cell.
std::string cell(const Json& value) {
  if (value.is_null()) return "";
  return value.is_string() ? detail::csv_field(value.get<std::string>()) : value.dump();
}

}  // namespace

std::string compare_json(const Comparison& comparison) {
  Json parameters = Json::object(), rows = Json::array();
  for (const NamedValue& parameter : comparison.parameters) parameters[parameter.name] = parameter.value;
  for (const ComparisonRow& row : comparison.rows) rows.push_back(object(row, comparison));
  return detail::json_text({{"trajet", kVersion},
                            {"scene", comparison.scene},
                            {"title", comparison.title},
                            {"start_time", comparison.epoch},
                            {"end_time", comparison.epoch + comparison.duration},
                            {"parameters", parameters},
                            {"reference",
                             {{"name", comparison.reference_name},
                              {"rtol", value(comparison.reference_rtol)},
                              {"atol", value(comparison.reference_atol)},
                              {"step", value(comparison.reference_step)}}},
                            {"components", comparison.components},
                            {"rows", rows},
                            {"warnings", comparison.warnings},
                            {"interrupted", comparison.interrupted}});
}

std::string compare_csv(const Comparison& comparison) {
  std::string text, separator;
  const Json columns = object(ComparisonRow{}, comparison);
  for (const auto& [column, ignored] : columns.items()) text += std::exchange(separator, ",") + column;
  text += "\n";
  for (const ComparisonRow& row : comparison.rows) {
    separator.clear();
    const Json cells = object(row, comparison);
    for (const auto& [column, content] : cells.items()) text += std::exchange(separator, ",") + cell(content);
    text += "\n";
  }
  return text;
}

}  // namespace trajet
