#include "aim_choice.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "trajet/ensemble/flight_extremes.hpp"
#include "trajet/portable.hpp"
#include "trajet/sim/observer_list.hpp"
#include "trajet/sim/run.hpp"

namespace trajet {
namespace {

/// Two runs that differ in what the target does are the same until it is hit.
bool is_same_time(double a, double b) { return std::abs(a - b) <= 1e-9 * (1.0 + std::abs(a)); }

/// `time` is what people call `t`.
std::string cost_text(const AimTask& task) {
  const bool is_own =
      ranges::find(task.scene.parameters, "time", &NamedExpression::name) != task.scene.parameters.end();
  return task.minimise == "time" && !is_own ? "t" : task.minimise;
}

std::optional<ReportColumns> columns_of(const AimTask& task) {
  if (task.conditions.empty() && task.minimise.empty()) return std::nullopt;
  for (const std::string& condition : task.conditions) {
    const ReportColumns column({condition}, task.scene, {"--with"});
    if (column.is_word(0)) throw InputError({"--with"}, "'" + condition + "' is a word: hit == 'target' expected");
  }
  std::vector<std::string> texts = task.conditions;
  if (!task.minimise.empty()) {
    texts.push_back(cost_text(task));
    const ReportColumns column({texts.back()}, task.scene, {"--minimise"});
    if (column.is_word(0)) throw InputError({"--minimise"}, "'" + task.minimise + "' is a word, no number");
  }
  return ReportColumns(std::move(texts), task.scene, {"--with"});
}

}  // namespace

AimChoice::AimChoice(AimFlights& flights)
    : flights_(flights),
      varied_(flights.task().scene, flights.dimension(),
              [&](std::size_t i) -> const VariedQuantity& { return flights.task().unknowns[i].quantity; }),
      columns_(columns_of(flights.task())) {
  if (columns_) reader_ = std::make_unique<ReportColumns::Reader>(*columns_);
}

std::optional<AimChoice::Hit> AimChoice::hit_of(const AimRoot& root) {
  const AimTask& task = flights_.task();
  const Passage& passage = root.passage;
  Hit hit;
  hit.solution = {flights_.values(root.place), flights_.epoch() + passage.time, passage.position, passage.miss,
                  passage.bounces};
  const auto* target = std::get_if<std::string>(&task.target);
  std::optional<double> contact;  // s since the start
  if (target != nullptr) {
    const auto definition = ranges::find(task.scene.obstacles, *target, &ObstacleDefinition::name);
    int before = 0;
    for (const double time : flights_.at(root.place).contacts) {
      if (time > passage.time && !is_same_time(passage.time, time)) continue;
      contact = time;
      ++before;
    }
    if (before > 1 && definition->on_hit != OnHit::pass) return std::nullopt;
  }
  if (contact) {
    const RunResult result = run(varied_.with(hit.solution.parameters));
    const Impact* impact = nullptr;
    for (const Impact& each : result.impacts)
      if (each.with == *target && each.body == flights_.body() && is_same_time(each.elapsed, *contact)) impact = &each;
    if (impact == nullptr) return std::nullopt;
    hit.solution.time = impact->time;
    hit.solution.point = impact->point;
  }
  if (columns_) judge(root, contact, hit);
  return hit;
}

void AimChoice::judge(const AimRoot& root, std::optional<double> contact, Hit& hit) {
  const AimTask& task = flights_.task();
  const ExtremeList& extremes = columns_->extremes();
  ObservedWorld observed = make_observed_world(varied_.with(hit.solution.parameters), extremes);
  // the motion up to the hit: its impact counts
  const auto* target = std::get_if<std::string>(&task.target);
  const bool is_first = contact && is_same_time(flights_.at(root.place).contacts.front(), *contact);
  if (is_first)
    set_on_hit(observed.world, *target, OnHit::stop);
  else
    observed.world.duration = std::min(observed.world.duration, contact.value_or(root.passage.time));
  FlightExtremes flight(observed, extremes);
  ObserverList observers({extremes.empty() ? nullptr : &flight});
  const RunResult result = run(observed.world, &observers);
  const std::vector<Cell> cells = (*reader_)(result, flight.values());
  const auto number = [&](std::size_t i) {
    const auto* value = std::get_if<double>(&cells[i]);
    return value != nullptr ? *value : std::nan("");
  };
  for (std::size_t i = 0; i < task.conditions.size(); ++i)
    hit.fulfils_conditions &= number(i) != 0.0 && !std::isnan(number(i));
  if (task.minimise.empty()) return;
  const double cost = number(task.conditions.size());
  hit.cost = std::isnan(cost) ? INFINITY : cost;
}

void AimChoice::descend(AimRoot root, Hit hit, const std::function<bool()>& should_stop, Hit& best) {
  constexpr double kFirstStep = 0.02, kLastStep = 1e-9;
  constexpr double kDifference = 1e-6;
  const auto n = static_cast<Eigen::Index>(flights_.dimension());
  for (double step = kFirstStep; step > kLastStep && !should_stop();) {
    const MissFrame frame(root.passage.direction);
    LinearMiss model;
    if (!slopes_at(flights_, root.passage.label, root.place, kDifference, frame, model)) break;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(Eigen::MatrixXd(model.slope), Eigen::ComputeFullV);
    const int rank = model.rank();
    bool has_helped = false;
    for (Eigen::Index i = rank; i < n && !has_helped; ++i)
      for (const double direction : {1.0, -1.0}) {
        AimPlace there = root.place;
        for (Eigen::Index k = 0; k < n; ++k) {
          double& share = there[static_cast<std::size_t>(k)];
          share = std::clamp(share + direction * step * svd.matrixV()(k, i), 0.0, 1.0);
        }
        AimRoot next;
        if (refine_aim(flights_, root.passage.label, there, model, frame, next) != RootOutcome::root) continue;
        const std::optional<Hit> next_hit = hit_of(next);
        if (!next_hit || !next_hit->fulfils_conditions || !(next_hit->cost < hit.cost)) continue;
        root = std::move(next);
        hit = *next_hit;
        has_helped = true;
        break;
      }
    step *= has_helped ? 1.5 : 0.5;
  }
  if (hit.cost < best.cost) best = std::move(hit);
}

void AimChoice::choose(std::vector<AimRoot> roots, const std::function<bool()>& should_stop, AimResult& result) {
  struct Chosen {
    AimRoot root;
    Hit hit;
  };
  std::vector<Chosen> chosen;
  for (AimRoot& root : roots) {
    std::optional<Hit> hit = hit_of(root);
    if (!hit) continue;
    if (!hit->fulfils_conditions) {
      ++result.refused;
      continue;
    }
    chosen.push_back({std::move(root), std::move(*hit)});
  }
  if (flights_.task().minimise.empty()) {
    for (Chosen& each : chosen) {
      result.is_family |= each.root.is_family;
      result.solutions.push_back(std::move(each.hit.solution));
    }
    return;
  }
  std::stable_sort(chosen.begin(), chosen.end(),
                   [](const Chosen& a, const Chosen& b) { return a.hit.cost < b.hit.cost; });
  if (chosen.empty()) return;
  Hit best = chosen.front().hit;
  // of each family, from its best member on
  std::map<std::string, bool> labels;
  for (const Chosen& each : chosen)
    if (each.root.is_family && labels.try_emplace(each.root.passage.label, true).second)
      descend(each.root, each.hit, should_stop, best);
  result.solutions.push_back(std::move(best.solution));
}

}  // namespace trajet
