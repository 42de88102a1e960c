#include <algorithm>
#include <cmath>

#include "simulation.hpp"

namespace trajet {
namespace {

bool is_hit(const ContactResult& contact) {
  return contact.status == ContactStatus::hit && contact.direction != ContactDirection::leaving;
}

}  // namespace

void Simulation::warn_of_tie(const Impact& impact, const std::string& body, const std::string& with) {
  const std::string text = "impacts of '" + impact.body + "' with '" + impact.with + "' and of '" + body + "' with '" +
                           with + "' are closer in time than their error bounds: which is first is decided by rounding";
  if (std::ranges::find(result_.warnings, text) == result_.warnings.end()) result_.warnings.push_back(text);
}

void Simulation::warn_of_hidden_ties(const Motion& moving, const Motion::Pair& handled, const Impact& impact) {
  for (const Motion::Pair& other : moving.pairs()) {
    if (&other == &handled || other.contact.status != ContactStatus::hit) continue;
    if (obstacle_of(handled).on_hit == OnHit::bounce && other.body != handled.body) continue;
    if (std::abs(other.contact.time - impact.time) <= impact.time_error_bound + other.contact.time_error_bound)
      warn_of_tie(impact, body_of(other).name, obstacle_of(other).name);
  }
}

std::vector<int> Simulation::met_at_once(const Motion& moving, int handled) const {
  const Motion::Pair& pair = moving.pair(handled);
  std::vector<int> met;
  for (int i = 0; i < static_cast<int>(moving.pairs().size()); ++i) {
    const Motion::Pair& other = moving.pair(i);
    if (i == handled || other.body != pair.body || other.contact.status != ContactStatus::hit) continue;
    const double resolution = pair.contact.time_resolution + other.contact.time_resolution;
    if (std::abs(other.contact.time - pair.contact.time) <= resolution) met.push_back(i);
  }
  return met;
}

int Simulation::bounce_at_once(const Motion& moving, int handled) const {
  const auto bounces = [&](int pair) {
    return obstacle_of(moving.pair(pair)).on_hit == OnHit::bounce && is_hit(moving.pair(pair).contact);
  };
  if (bounces(handled)) return handled;
  const std::vector<int> met = met_at_once(moving, handled);
  const auto found = std::ranges::find_if(met, bounces);
  return found != met.end() ? *found : handled;
}

bool Simulation::take_turned_away(const Motion& moving, int handled, const Impact& impact,
                                  const Eigen::VectorXd& before, const Eigen::VectorXd& rate,
                                  std::vector<Released>& known) {
  bool stops = false;
  for (const int index : met_at_once(moving, handled)) {
    const Motion::Pair& pair = moving.pair(index);
    const Vector3 velocity = rate.segment<3>(body_of(pair).offset);
    // of the two products of speeds and normals by which the bounce came about
    const double rounding = 16.0 * kUnitRoundoff * (velocity.norm() + impact.velocity_before.norm());
    if (velocity.dot(pair.contact.normal) < -rounding) continue;
    ContactMemory memory = pair.contact.memory;
    memory.side = pair.contact.side_before;
    memory.contact_time = impact.time;
    known.push_back({index, memory});
    const OnHit on_hit = obstacle_of(pair).on_hit;
    if (on_hit == OnHit::bounce && is_hit(pair.contact)) continue;
    record(describe(moving, {impact.time, Incident::Kind::contact, index}, before));
    stops = stops || (on_hit == OnHit::stop && is_hit(pair.contact));
  }
  return stops;
}

}  // namespace trajet
