#include "trajet/study/compare.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "carried_orientations.hpp"
#include "error_meter.hpp"
#include "trajet/portable.hpp"
#include "trajet/sim/observer_list.hpp"
#include "trajet/sim/run.hpp"

namespace trajet {
namespace {

constexpr long kDefaultStepCounts[] = {10, 40, 160};
constexpr double kDefaultRtols[] = {1e-3, 1e-6, 1e-9};
/// Near the rounding of an integration over many steps; less cannot be had in double precision.
constexpr double kReferenceTolerance = 1e-13;
/// A reference of given steps takes so many times as many as the finest row: at order 4 its error is 1/65536 of that
/// row's.
constexpr long kReferenceRefinement = 16;
/// A run as short as this is measured again: the first one also fills the processor's caches.
constexpr double kShortRun = 0.02;  // s
constexpr int kMostTimedRuns = 5;

/// A method with all that it is told.
struct Way {
  const MethodInfo* method;
  MethodOptions options;
};

bool is_adaptive(const MethodInfo& method) { return method.control == StepControl::adaptive; }

/// Lays out and runs a comparison.
class ComparisonRun {
 public:
  ComparisonRun(const Scene& scene, const ComparePlan& plan, CompareObserver& observer)
      : scene_(scene), plan_(plan), observer_(observer), base_(check_base()) {}

  World check() const {
    static_cast<void>(lay_out());
    if (!uses_closed_forms()) static_cast<void>(reference_candidates());
    return base_;
  }

  Comparison compare() {
    result_.scene = base_.scene;
    result_.title = base_.title;
    result_.epoch = base_.epoch;
    result_.duration = base_.duration;
    result_.parameters = base_.parameters;
    result_.warnings = base_.warnings;
    for (const World::Body& body : base_.bodies) result_.turns = result_.turns || body.rotation;
    const std::vector<Way> ways = lay_out();
    find_reference();
    for (std::size_t i = 0; i < ways.size() && !result_.interrupted; ++i) add_row(ways[i], i, ways.size());
    return std::move(result_);
  }

 private:
  /// The scene's numbers: what is wrong with them is no compared method's fault. It need not give a step.
  World check_base() const {
    MethodOptions method = scene_.method;
    if (!method.step && method.steps.empty()) method.step = method.max_step.value_or(1.0);
    return world(method);
  }

  World world(const MethodOptions& method) const {
    Scene scene = scene_;
    scene.method = method;
    return make_world(scene);
  }

  const MethodInfo& method(const std::string& name, const SourceLocation& where) const {
    const MethodInfo* found = find_method(name);
    if (found == nullptr) found = find_nearest_method(name);
    if (found == nullptr) {
      MethodOptions unknown;
      unknown.name = name;
      unknown.where = where;
      static_cast<void>(world(unknown));  // throws, with the nearest name
      throw std::logic_error("an unknown method made a World");
    }
    return *found;
  }

  std::vector<const MethodInfo*> compared_methods() const {
    std::vector<const MethodInfo*> chosen;
    for (const std::string& name : plan_.methods) {
      const MethodInfo& found = method(name, plan_.methods_where);
      if (ranges::find(chosen, &found) == chosen.end()) chosen.push_back(&found);
    }
    if (plan_.methods.empty())
      for (const MethodInfo& each : methods()) chosen.push_back(&each);
    return chosen;
  }

  /// None where no body turns.
  std::vector<const OrientationInfo*> compared_orientations() const {
    const bool turns = ranges::any_of(base_.bodies, [](const World::Body& body) { return body.rotation.has_value(); });
    if (!plan_.orientations.empty() && !turns) throw InputError(plan_.orientations_where, "no body of the scene turns");
    std::vector<const OrientationInfo*> chosen;
    for (const OrientationWay way : plan_.orientations)
      if (ranges::find(chosen, &orientation_info(way)) == chosen.end()) chosen.push_back(&orientation_info(way));
    if (chosen.empty()) chosen.push_back(turns ? &orientation_info(scene_.method.orientation) : nullptr);
    return chosen;
  }

  MethodOptions options(const MethodInfo& method) const {
    MethodOptions options = scene_.method;
    options.name = method.name;
    options.where = plan_.methods_where;
    options.order = std::min(options.order, method.max_order);
    return options;
  }

  MethodOptions with_steps(const MethodInfo& method, long count) const {
    MethodOptions told = options(method);
    told.step = std::abs(base_.duration) / static_cast<double>(count);
    told.steps.clear();
    return told;
  }

  /// Without an absolute tolerance in the scene, the relative one holds for values of 1 SI unit and below.
  MethodOptions with_tolerance(const MethodInfo& method, const Expression& rtol) const {
    MethodOptions told = options(method);
    told.rtol = rtol;
    if (!told.atol) told.atol = rtol;
    return told;
  }

  /// Every method with every way of carrying orientations.
  std::vector<Way> lay_out() const {
    std::vector<Way> ways;
    for (const Way& way : lay_out_methods())
      for (const OrientationInfo* orientation : compared_orientations()) {
        ways.push_back(way);
        if (orientation == nullptr || plan_.orientations.empty()) continue;
        ways.back().options.orientation = orientation->way;
        ways.back().options.orientation_where = plan_.orientations_where;
      }
    return ways;
  }

  std::vector<Way> lay_out_methods() const {
    std::vector<Way> ways;
    for (const MethodInfo* method : compared_methods()) {
      if (is_adaptive(*method)) {
        for (const Expression& rtol : rtols()) ways.push_back({method, with_tolerance(*method, rtol)});
      } else if (plan_.step_counts.empty() && (scene_.method.step || !scene_.method.steps.empty())) {
        add_given_steps(*method, options(*method), ways);
      } else {
        for (const long count : step_counts()) add_given_steps(*method, with_steps(*method, count), ways);
      }
    }
    return ways;
  }

  /// A method that divides its steps has an accuracy besides.
  void add_given_steps(const MethodInfo& method, MethodOptions told, std::vector<Way>& ways) const {
    if (method.control == StepControl::fixed) {
      ways.push_back({&method, std::move(told)});
      return;
    }
    for (const Expression& rtol : rtols()) {
      told.rtol = rtol;
      ways.push_back({&method, told});
    }
  }

  std::span<const long> step_counts() const {
    return plan_.step_counts.empty() ? std::span<const long>(kDefaultStepCounts) : plan_.step_counts;
  }

  std::vector<Expression> rtols() const {
    if (!plan_.rtols.empty()) return plan_.rtols;
    if (scene_.method.rtol) return {*scene_.method.rtol};
    return {std::begin(kDefaultRtols), std::end(kDefaultRtols)};
  }

  bool has_closed_forms() const { return !base_.exact.empty() || !base_.exact_rotations.empty(); }

  bool uses_closed_forms() const {
    if (plan_.reference == "exact" && !has_closed_forms())
      throw InputError(plan_.reference_where, "the scene has no closed forms, [exact], to compare with");
    return plan_.reference == "exact" || (plan_.reference.empty() && has_closed_forms());
  }

  void find_reference() {
    if (uses_closed_forms()) {
      result_.reference_name = "exact";
      for (const World::ClosedForm& closed_form : base_.exact) result_.components.push_back(closed_form.name);
      for (const World::ClosedRotation& closed_form : base_.exact_rotations) {
        const std::string& body = base_.bodies[static_cast<std::size_t>(closed_form.body)].name;
        if (closed_form.orientation) result_.components.push_back(body + ".orientation");
        if (closed_form.angular_velocity) result_.components.push_back(body + ".w");
      }
      result_.reference = std::make_shared<ClosedFormReference>(base_);
      warn_of_another_start();
      return;
    }
    for (const World::Body& body : base_.bodies) {
      for (const char* part : {".r", ".v"}) result_.components.push_back(body.name + part);
      if (body.rotation)
        for (const char* part : {".orientation", ".w"}) result_.components.push_back(body.name + part);
    }
    for (const World::ExtraState& state : base_.states) result_.components.push_back(state.name);
    std::string failure;
    for (const MethodInfo* candidate : reference_candidates())
      if (record_reference(*candidate, failure) || result_.interrupted) return;
    throw InputError(plan_.reference_where, "no reference to compare with: " + failure);
  }

  /// The one that was asked for; else error-controlled ones: those that are not compared first, the highest order
  /// that they have or can take first.
  std::vector<const MethodInfo*> reference_candidates() const {
    if (!plan_.reference.empty()) return {&method(plan_.reference, plan_.reference_where)};
    const std::vector<const MethodInfo*> compared = compared_methods();
    const auto rank = [&](const MethodInfo* method) {
      const bool is_compared = ranges::find(compared, method) != compared.end();
      return std::pair(is_compared, -std::max(method->order, method->max_order));
    };
    std::vector<const MethodInfo*> candidates;
    for (const MethodInfo& each : methods())
      if (is_adaptive(each)) candidates.push_back(&each);
    ranges::stable_sort(candidates, {}, rank);
    return candidates;
  }

  bool record_reference(const MethodInfo& method, std::string& failure) {
    MethodOptions told;
    if (is_adaptive(method)) {
      told = with_tolerance(method, kReferenceTolerance);
      told.atol = std::min(kReferenceTolerance, scene_.method.atol ? base_atol() : kReferenceTolerance);
    } else {
      told = with_steps(method, kReferenceRefinement * ranges::max(step_counts()));
    }
    told.where = plan_.reference_where;
    const auto recorded = std::make_shared<RecordedReference>();
    ObserverList relay({recorded.get(), observer_.begin_reference(std::string(method.name))});
    try {
      const World world = this->world(told);
      const RunResult run = trajet::run(world, &relay);
      result_.interrupted = run.status == RunStatus::interrupted;
      failure = std::string(method.name) + ": " + run.failure;
      if (run.status == RunStatus::failed) return false;
      result_.reference_rtol = is_adaptive(method) ? std::optional(world.step_options.rtol) : std::nullopt;
      result_.reference_atol = is_adaptive(method) ? std::optional(world.step_options.atol) : std::nullopt;
      if (!is_adaptive(method)) result_.reference_step = world.step_options.step;
    } catch (const InputError& error) {
      if (!plan_.reference.empty()) throw;
      failure = std::string(method.name) + ": " + error.message();
      return false;
    }
    result_.reference_name = method.name;
    result_.reference = recorded;
    return true;
  }

  double base_atol() const { return world(with_tolerance(*base_.method, kReferenceTolerance)).step_options.atol; }

  /// A closed form that does not begin where the motion begins belongs to another motion.
  void warn_of_another_start() {
    for (const World::ClosedForm& closed_form : base_.exact)
      warn_of_another_start(closed_form.name, closed_form.group, closed_form.offset,
                            static_cast<int>(closed_form.value.outputs.size()));
    for (const World::ClosedRotation& closed_form : base_.exact_rotations) {
      const World::Body& body = base_.bodies[static_cast<std::size_t>(closed_form.body)];
      const int size = body.rotation->layout.size();
      if (closed_form.orientation)
        warn_of_another_start(body.name + ".orientation", body.group, body.rotation->offset, size);
      if (closed_form.angular_velocity)
        warn_of_another_start(body.name + ".w", body.group, body.rotation->offset + size, 3);
    }
  }

  void warn_of_another_start(const std::string& name, int group, int offset, int size) {
    constexpr double kTolerance = 1e-9;  // well above the rounding of a formula, well below what is meant
    const Eigen::VectorXd& start = base_.groups[static_cast<std::size_t>(group)].start;
    Eigen::VectorXd exact;
    result_.reference->state(group, 0.0, exact);
    align_orientations(base_, group, exact, start);
    const auto own = start.segment(offset, size);
    if ((exact.segment(offset, size) - own).cwiseAbs().maxCoeff() > kTolerance * (1.0 + own.cwiseAbs().maxCoeff()))
      result_.warnings.push_back("the closed form of '" + name + "' does not begin where the scene does");
  }

  void add_row(const Way& way, std::size_t index, std::size_t count) {
    ComparisonRow row;
    row.method = way.method->name;
    if (compared_orientations().front() != nullptr) row.orientation = orientation_info(way.options.orientation).name;
    try {
      const World world = this->world(way.options);
      row.step = world.step_options.step;
      if (way.method->control != StepControl::fixed) row.rtol = world.step_options.rtol;
      if (is_adaptive(*way.method)) row.atol = world.step_options.atol;
      measure(world, row, observer_.begin_row(row, index, count));
    } catch (const ReferenceError&) {
      throw;
    } catch (const InputError& error) {  // the method does not suit the law
      row.failure = error.message();
    }
    if (row.status == RunStatus::interrupted)
      result_.interrupted = true;
    else
      result_.rows.push_back(std::move(row));
  }

  void measure(const World& world, ComparisonRow& row, RunObserver* onlooker) const {
    ErrorMeter meter(*result_.reference, base_);
    ObserverList observers({&meter, onlooker});
    const RunResult run = trajet::run(world, &observers);
    row.status = run.status;
    row.failure = run.failure;
    row.elapsed = run.elapsed;
    row.impacts = run.impacts.size();
    row.statistics = run.statistics;
    if (!row.succeeded()) return;
    row.compared_until = meter.compared_until();
    row.at_end = meter.at_end();
    row.at_samples = meter.at_samples();
    row.at_nodes = meter.at_nodes();
    row.rotation_at_end = meter.rotation_at_end();
    row.rotation_at_samples = meter.rotation_at_samples();
    row.rotation_history = meter.rotation_history();
    for (int i = 1; i < kMostTimedRuns && row.statistics.wall_seconds < kShortRun; ++i)
      row.statistics.wall_seconds = std::min(row.statistics.wall_seconds, trajet::run(world).statistics.wall_seconds);
  }

  const Scene& scene_;
  const ComparePlan& plan_;
  CompareObserver& observer_;
  World base_;
  Comparison result_;
};

}  // namespace

World check(const Scene& scene, const ComparePlan& plan) {
  CompareObserver unobserved;
  return ComparisonRun(scene, plan, unobserved).check();
}

Comparison compare(const Scene& scene, const ComparePlan& plan, CompareObserver* observer) {
  CompareObserver unobserved;
  return ComparisonRun(scene, plan, observer != nullptr ? *observer : unobserved).compare();
}

}  // namespace trajet
