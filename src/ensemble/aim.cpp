#include "trajet/ensemble/aim.hpp"

#include <algorithm>
#include <utility>

#include "aim_choice.hpp"
#include "aim_search.hpp"

namespace trajet {
namespace {

ClosestApproach approach_at(AimFlights& flights, const AimPlace& place) {
  const AimFlight& flight = flights.at(place);
  ClosestApproach closest{.parameters = flights.values(place), .miss = flight.start_miss, .time = flights.epoch()};
  const Passage* nearest = flight.nearest();
  if (nearest == nullptr || nearest->miss > flight.start_miss) return closest;
  closest.miss = nearest->miss;
  closest.time = flights.epoch() + nearest->time;
  closest.is_end = nearest->is_end && nearest->time == flight.end_time;
  closest.ends_by_clock = closest.is_end && flight.ends_by_clock;
  return closest;
}

}  // namespace

AimResult aim(const AimTask& task, const std::function<bool()>& should_stop) {
  AimFlights flights(task);
  AimChoice choice(flights);
  AimResult result;
  AimRoots found = find_aim_roots(flights, should_stop);
  choice.choose(std::move(found.roots), should_stop, result);
  std::sort(result.solutions.begin(), result.solutions.end(),
            [](const AimSolution& a, const AimSolution& b) { return a.parameters < b.parameters; });

  if (!result.solutions.empty()) {
    result.status = AimStatus::found;
    const auto best = std::min_element(result.solutions.begin(), result.solutions.end(),
                                       [](const AimSolution& a, const AimSolution& b) { return a.miss < b.miss; });
    result.closest = ClosestApproach{.parameters = best->parameters, .miss = best->miss, .time = best->time};
  } else {
    const AimPlace closest = find_closest(flights, should_stop);
    if (!closest.empty()) result.closest = approach_at(flights, closest);
    const bool is_unknown = found.has_stalled || found.is_incomplete || closest.empty();
    result.status = is_unknown ? AimStatus::not_converged : AimStatus::unreachable;
  }
  result.motions = flights.count();
  result.failure = flights.failure();
  result.is_interrupted = should_stop();
  return result;
}

}  // namespace trajet
