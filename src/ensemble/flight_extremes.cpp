#include "trajet/ensemble/flight_extremes.hpp"

#include <cmath>
#include <utility>

#include "trajet/event/composed_function.hpp"
#include "trajet/event/extreme.hpp"
#include "trajet/event/program_function.hpp"

namespace trajet {

ObservedWorld make_observed_world(Scene scene, const ExtremeList& extremes) {
  const std::size_t own_events = scene.events.size();
  // an event's `when` is what an extreme's formula is: a program over the state of a group
  for (std::size_t i = 0; i < extremes.size(); ++i)
    scene.events.push_back({.name = "extreme " + std::to_string(i + 1),
                            .when = extremes[i].formula,
                            .where = extremes[i].formula.where()});
  ObservedWorld result{make_world(scene)};
  std::vector<World::Event>& events = result.world.events;
  for (std::size_t i = own_events; i < events.size(); ++i)
    result.observed.push_back({events[i].group, std::move(events[i].when)});
  events.resize(own_events);
  for (World::Group& group : result.world.groups)
    std::erase_if(group.events, [&](int event) { return event >= static_cast<int>(own_events); });
  return result;
}

/// One formula along the motion. The smallest value is the largest one of the opposite.
class FlightExtremes::Watch {
 public:
  Watch(const ObservedWorld::Observed& observed, bool is_largest)
      : group(observed.group),
        is_largest_(is_largest),
        inputs_(read_components(observed.value)),
        state_(static_cast<std::size_t>(observed.value.input_count - 1)),
        enclosures_(observed.value) {}

  void follow(const MotionPiece& piece) {
    const Segment<>& segment = piece.segment;
    const Path<Eigen::Dynamic> path(segment, inputs_);
    const ProgramFunction value{&enclosures_, &inputs_, &state_};
    const auto signed_value = [&](const IntervalJet& t, const auto& x) {
      const IntervalJet result = value(t, x);
      return is_largest_ ? result : -result;
    };
    const ComposedFunction<Eigen::Dynamic, decltype(signed_value)> function(
        path, signed_value, piece.from - segment.t0(), piece.to - segment.t0(), 0.0, true);
    best_ = std::max(best_, largest_value(function));
  }

  double value() const {
    if (std::isinf(best_)) return std::nan("");
    return is_largest_ ? best_ : -best_;
  }

  const int group;

 private:
  bool is_largest_;
  std::vector<int> inputs_;
  std::vector<IntervalJet> state_;
  Evaluator<IntervalJet> enclosures_;
  double best_ = -INFINITY;
};

FlightExtremes::FlightExtremes(const ObservedWorld& world, const ExtremeList& extremes) {
  for (std::size_t i = 0; i < extremes.size(); ++i)
    watches_.push_back(std::make_unique<Watch>(world.observed[i], extremes[i].is_largest));
}

FlightExtremes::~FlightExtremes() = default;

void FlightExtremes::motion(const MotionPiece& piece) {
  for (const auto& watch : watches_)
    if (watch->group == piece.group) watch->follow(piece);
}

std::vector<double> FlightExtremes::values() const {
  std::vector<double> values;
  for (const auto& watch : watches_) values.push_back(watch->value());
  return values;
}

}  // namespace trajet
