#include "aim_flights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "trajet/portable.hpp"
#include "trajet/sim/run.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet {
namespace {

/// What a hit may miss by, of the distance flown: rounding, and what the method's tolerance leaves undecided.
constexpr double kRoundingShare = 1e-11;
constexpr double kToleranceShare = 10.0;
constexpr double kMostTolerance = 1e-5;

double method_tolerance(const World& world) {
  return world.method->control == StepControl::fixed ? 0.0 : std::min(world.step_options.rtol, kMostTolerance);
}

}  // namespace

const Passage* AimFlight::passage(const std::string& label) const {
  const auto found = ranges::find(passages, label, &Passage::label);
  return found == passages.end() ? nullptr : &*found;
}

const Passage* AimFlight::nearest() const {
  const auto found = std::min_element(passages.begin(), passages.end(),
                                      [](const Passage& a, const Passage& b) { return a.miss < b.miss; });
  return found == passages.end() ? nullptr : &*found;
}

std::string aimed_body(const AimTask& task) {
  const std::vector<BodyDefinition>& bodies = task.scene.bodies;
  std::vector<std::string_view> known;
  for (const BodyDefinition& each : bodies) known.push_back(each.name);
  if (bodies.empty()) throw InputError({"--hit"}, "the scene has no body");
  if (task.body.empty() && bodies.size() == 1) return bodies.front().name;
  if (task.body.empty())
    throw InputError({"--body"}, "the scene has several bodies: the name of the one that shall hit expected");
  if (ranges::find(bodies, task.body, &BodyDefinition::name) == bodies.end())
    throw InputError({"--body"}, "the scene has no body '" + task.body + "'" + did_you_mean(task.body, known));
  return task.body;
}

void set_on_hit(World& world, const std::string& target, OnHit on_hit) {
  for (std::size_t i = 0; i < world.obstacles.size(); ++i) {
    if (world.obstacles[i].name != target) continue;
    world.obstacles[i].surface.on_hit = on_hit;
    for (auto& [pair, surface] : world.obstacle_pairs)
      if (pair.second == static_cast<int>(i)) surface.on_hit = on_hit;
  }
}

AimFlights::AimFlights(const AimTask& task)
    : task_(task),
      body_(aimed_body(task)),
      varied_(task.scene, task.unknowns.size(),
              [&](std::size_t i) -> const VariedQuantity& { return task.unknowns[i].quantity; }) {
  constexpr std::size_t kMost = 4;
  if (task.unknowns.empty()) throw InputError({"--vary"}, "nothing to be found: --vary NAME=LOW:HIGH expected");
  if (task.unknowns.size() > kMost) throw InputError({"--vary"}, "more than 4 unknowns");
  for (const AimUnknown& unknown : task.unknowns)
    if (!(unknown.low < unknown.high))
      throw InputError({"--vary " + unknown.quantity.name}, "the low end must lie below the high one");
  AimPoint::check(task.scene, task.target, {"--hit"});
  const World world = make_world(task.scene);  // what is wrong in the scene as it stands, is said
  if (world.duration < 0.0) throw InputError(task.scene.time.end->where(), "aiming goes forward in time only");
  epoch_ = world.epoch;
}

std::vector<double> AimFlights::values(const AimPlace& place) const {
  std::vector<double> values;
  for (std::size_t i = 0; i < place.size(); ++i) {
    const AimUnknown& unknown = task_.unknowns[i];
    const double share = place[i];
    values.push_back(share <= 0.0   ? unknown.low
                     : share >= 1.0 ? unknown.high
                                    : unknown.low + share * (unknown.high - unknown.low));
  }
  return values;
}

const AimFlight& AimFlights::at(const AimPlace& place) {
  const auto found = flights_.find(place);
  return found != flights_.end() ? found->second : flights_.emplace(place, compute(place)).first->second;
}

AimFlight AimFlights::compute(const AimPlace& place) {
  AimFlight flight{.start_miss = std::numeric_limits<double>::infinity()};
  const auto fail = [&](const std::string& why) {
    ++failed_;
    if (failure_.empty()) failure_ = why;
  };
  World world;
  try {
    world = make_world(varied_.with(values(place)));
  } catch (const InputError& error) {
    fail(error.what());
    return flight;
  }
  const auto* target = std::get_if<std::string>(&task_.target);
  if (target != nullptr) set_on_hit(world, *target, OnHit::pass);
  const auto body = ranges::find(world.bodies, body_, &World::Body::name);
  FlightRecord record(body->group);
  const RunResult result = run(world, &record);
  if (result.status == RunStatus::failed) fail(result.failure);

  AimPoint point(world, task_.target);
  flight.passages = find_passages(world, result, record.pieces(), static_cast<int>(body - world.bodies.begin()), point);
  flight.end_time = result.elapsed;
  flight.ends_by_clock = result.status == RunStatus::finished;
  for (const Impact& impact : result.impacts)
    if (target != nullptr && impact.kind == ImpactKind::hit && impact.body == body_ && impact.with == *target)
      flight.contacts.push_back(impact.elapsed);
  if (record.pieces().empty()) return flight;
  const RecordedPiece& first = record.pieces().front();
  const Segment<3> start = point.relative(first.segment, body->offset, first.from, first.to);
  Eigen::Vector3d at_start = start.state(first.from);
  flight.start_miss = at_start.norm();
  double size = flight.start_miss;
  for (int i = 0; i < 3; ++i) size = std::max(size, std::abs(first.segment.value(body->offset + i, first.from)));
  flight.tolerance = (kRoundingShare + kToleranceShare * method_tolerance(world)) * size;
  return flight;
}

}  // namespace trajet
