#include "event_hold.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "instant.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/math/polynomial.hpp"

namespace trajet {
namespace {

/// What the event's `set` adds to the state.
Eigen::VectorXd change_by_set(const World::Event& event, double t, const Eigen::VectorXd& q) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(event.targets.size()));
  Evaluator<double> evaluate(event.set);
  evaluate(t, q.data(), values.data());
  Eigen::VectorXd change = Eigen::VectorXd::Zero(q.size());
  for (std::size_t i = 0; i < event.targets.size(); ++i)
    change[event.targets[i]] = values[static_cast<Eigen::Index>(i)] - q[event.targets[i]];
  return change;
}

double value_of(const Program& program, double t, const Eigen::VectorXd& q) {
  double value = 0.0;
  Evaluator<double> evaluate(program);
  evaluate(t, q.data(), &value);
  return value;
}

/// The border's function, its rate and how its rate reacts to the direction, in a state.
std::array<double, 3> border_values(const Program& border, double t, const Eigen::VectorXd& q) {
  std::array<double, 3> values{};
  Evaluator<double> evaluate(border);
  evaluate(t, q.data(), values.data());
  return values;
}

/// Of what the set changes, the components to which the border's rate reacts; where it changes nothing any more, of
/// what it sets.
Eigen::VectorXd acting_part(const Program& law, const World::Event& event, double t, const Eigen::VectorXd& q,
                            const Eigen::VectorXd& change) {
  Eigen::VectorXd part = Eigen::VectorXd::Zero(change.size()), effects = part;
  for (const int i : event.targets) {
    const auto held = hold_on_border(law, event.when, Eigen::VectorXd::Unit(change.size(), i));
    if (!held) continue;
    effects[i] = border_values(held->border, t, q)[2];
    if (effects[i] != 0.0) part[i] = change[i];
  }
  return part.isZero(0.0) ? effects.stableNormalized() : part.stableNormalized();
}

}  // namespace

bool hold_at_limit(const World& world, int event_index, int crossing_direction, Instant& instant) {
  const World::Event& event = world.events[static_cast<std::size_t>(event_index)];
  const double t = instant.time();
  const Eigen::VectorXd change = change_by_set(event, t, instant.q);
  const Program law = instant.course().held_law().with(instant.contacts, instant.holds);
  const Eigen::VectorXd direction = acting_part(law, event, t, instant.q, change);
  if (direction.isZero(0.0)) return false;
  const std::optional<HeldLaw> held = hold_on_border(law, event.when, direction);
  if (!held) return false;
  const auto [value, rate, effect] = border_values(held->border, t, instant.q);
  Eigen::VectorXd limit = instant.q - (rate / effect) * direction;
  const double pull = value_of(held->pull, t, limit);
  if (!(pull * crossing_direction > 0.0)) return false;
  // what the set still changes in the limit does not come to an end
  constexpr double kRest = 1e-6;  // of the last change
  constexpr double kRoundings = 16.0;
  limit += change_by_set(event, t, limit);
  const Eigen::ArrayXd left = change_by_set(event, t, limit).array().abs();
  const Eigen::ArrayXd rounding = kRest * change.array().abs() + kRoundings * kUnitRoundoff * limit.array().abs();
  if (!(left <= rounding).all()) return false;

  // several holds at once must not let each other go
  std::vector<EventHold> holds = instant.holds;
  holds.push_back({event_index, -crossing_direction, direction, held->border});
  const Program together = instant.course().held_law().with(instant.contacts, holds);
  for (const EventHold& each : holds) {
    const auto alone =
        hold_on_border(together, world.events[static_cast<std::size_t>(each.event)].when, each.direction);
    constexpr double kHeld = 1e-9;  // of the pull
    if (!alone || std::abs(value_of(alone->pull, t, limit)) > kHeld * std::abs(pull)) return false;
  }
  instant.q = limit;
  instant.holds = std::move(holds);
  return true;
}

}  // namespace trajet
