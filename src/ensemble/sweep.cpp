#include "trajet/ensemble/sweep.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <span>
#include <utility>

#include "trajet/ensemble/flight_extremes.hpp"
#include "trajet/sim/observer_list.hpp"
#include "trajet/sim/run.hpp"
#include "varied_scene.hpp"

namespace trajet {
namespace {

/// Ends a run that somebody wants ended.
class StopObserver : public RunObserver {
 public:
  explicit StopObserver(const std::function<bool()>& should_stop) : should_stop_(should_stop) {}
  RunWishes wishes() const override { return {}; }
  bool interrupted(double) override { return should_stop_(); }

 private:
  const std::function<bool()>& should_stop_;
};

/// The scene of a sweep's motions.
VariedScene varied_scene(const Sweep& sweep) {
  const SweepPlan& plan = sweep.plan();
  return {sweep.scene(), plan.quantity_count(),
          [&](std::size_t i) -> const VariedQuantity& { return plan.quantity(i); }};
}

}  // namespace

Sweep::Sweep(Scene scene, SweepPlan plan, std::vector<std::string> columns, const SourceLocation& columns_where)
    : scene_(std::move(scene)),
      plan_(std::move(plan)),
      columns_(columns.empty() ? default_columns(scene_) : std::move(columns), scene_, columns_where) {
  require_a_motion();
}

void Sweep::require_a_motion() const {
  std::optional<InputError> fault;
  for (const std::uint64_t index : {std::uint64_t{0}, plan_.count() / 2, plan_.count() - 1}) {
    try {
      make_world(variant(index));
      return;
    } catch (const InputError& error) {
      if (!fault) fault = error;
    }
  }
  throw InputError(*fault);
}

Scene Sweep::variant(std::uint64_t index) const {
  VariedScene varied = varied_scene(*this);
  std::vector<double> values(plan_.quantity_count());
  PlanValues values_of(plan_);
  values_of(index, values);
  return varied.with(values);
}

class Sweep::Worker::State {
 public:
  explicit State(const Sweep& sweep)
      : sweep_(sweep), varied_(varied_scene(sweep)), plan_values_(sweep.plan()), reader_(sweep.columns()) {}

  SweepRow compute(std::uint64_t index, const std::function<bool()>& should_stop) {
    SweepRow row{.index = index, .values = std::vector<double>(sweep_.plan().quantity_count())};
    plan_values_(index, row.values);
    const ExtremeList& extremes = sweep_.columns().extremes();
    RunResult result;
    std::vector<double> extreme_values;
    try {
      const ObservedWorld observed = make_observed_world(varied_.with(row.values), extremes);
      FlightExtremes flight(observed, extremes);
      StopObserver stop(should_stop);
      ObserverList observers({&stop, extremes.empty() ? nullptr : &flight});
      result = run(observed.world, &observers);
      extreme_values = flight.values();
    } catch (const InputError& error) {
      result.status = RunStatus::failed;
      result.failure = error.what();
    }
    row.status = result.status;
    row.failure = std::move(result.failure);
    if (const Impact* hit = first_hit(result)) row.hit = hit->with;
    row.cells = reader_(result, extreme_values);
    return row;
  }

 private:
  const Sweep& sweep_;
  VariedScene varied_;
  PlanValues plan_values_;
  ReportColumns::Reader reader_;
};

Sweep::Worker::Worker(const Sweep& sweep) : state_(std::make_unique<State>(sweep)) {}
Sweep::Worker::~Worker() = default;

SweepRow Sweep::Worker::operator()(std::uint64_t index, const std::function<bool()>& should_stop) {
  return state_->compute(index, should_stop);
}

void run_sweep(const Sweep& sweep, const SweepRange& range, const std::function<bool(SweepBlock&&)>& take,
               const std::function<bool()>& should_stop) {
  const auto threads = static_cast<std::size_t>(range.threads > 0 ? range.threads : tbb::info::default_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  tbb::enumerable_thread_specific<std::unique_ptr<Sweep::Worker>> workers;
  std::atomic<bool> is_over{false};
  const std::function<bool()> stops = [&] { return is_over.load(std::memory_order_relaxed) || should_stop(); };
  const std::uint64_t last = std::min(range.last, sweep.plan().count());
  std::uint64_t next = range.first;

  const auto next_block = [&](tbb::flow_control& control) {
    SweepBlock block{.first = next};
    if (next >= last || stops())
      control.stop();
    else
      block.rows.resize(std::min(range.block, last - next));
    next += block.rows.size();
    return block;
  };
  const auto compute = [&](SweepBlock block) {
    std::unique_ptr<Sweep::Worker>& worker = workers.local();
    if (!worker) worker = std::make_unique<Sweep::Worker>(sweep);
    for (std::size_t i = 0; i < block.rows.size(); ++i) {
      if (stops()) return SweepBlock{};
      block.rows[i] = (*worker)(block.first + i, stops);
      if (block.rows[i].status == RunStatus::interrupted) return SweepBlock{};
    }
    return block;
  };
  const auto hand_on = [&](SweepBlock block) {
    if (is_over) return;
    if (block.rows.empty() || !take(std::move(block))) is_over = true;
  };
  // as many blocks are on their way as keep all threads busy while an earlier one takes long
  tbb::parallel_pipeline(4 * threads,
                         tbb::make_filter<void, SweepBlock>(tbb::filter_mode::serial_in_order, next_block) &
                             tbb::make_filter<SweepBlock, SweepBlock>(tbb::filter_mode::parallel, compute) &
                             tbb::make_filter<SweepBlock, void>(tbb::filter_mode::serial_in_order, hand_on));
}

}  // namespace trajet
