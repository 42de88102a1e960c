#include "trajet/io/aim_json.hpp"

#include <utility>
#include <vector>

#include "record_json.hpp"

namespace trajet {
namespace {

using detail::Json;

Json parameters_json(const AimTask& task, const std::vector<double>& values) {
  Json result = Json::object();
  for (std::size_t i = 0; i < values.size(); ++i) result[task.unknowns[i].quantity.name] = values[i];
  return result;
}

}  // namespace

std::string name(AimStatus status) {
  switch (status) {
    case AimStatus::found:
      return "found";
    case AimStatus::unreachable:
      return "unreachable";
    case AimStatus::not_converged:
      return "not_converged";
  }
  return {};
}

std::string aim_json(const AimTask& task, const AimResult& result) {
  Json solutions = Json::array();
  for (const AimSolution& each : result.solutions)
    solutions.push_back({{"parameters", parameters_json(task, each.parameters)},
                         {"time", each.time},
                         {"point", detail::array(each.point)},
                         {"miss", each.miss},
                         {"bounces", each.bounces}});
  Json closest = nullptr;
  if (result.closest)
    closest = {{"parameters", parameters_json(task, result.closest->parameters)},
               {"miss", result.closest->miss},
               {"time", result.closest->time}};
  return detail::json_text(
      {{"status", name(result.status)}, {"solutions", std::move(solutions)}, {"closest", std::move(closest)}});
}

}  // namespace trajet
