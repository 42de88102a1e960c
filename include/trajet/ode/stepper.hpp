#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "trajet/ode/segment.hpp"
#include "trajet/portable.hpp"

namespace trajet {

/// What became of one attempt to advance.
enum class StepStatus {
  ok,              ///< the state moved on by one accepted step
  step_too_small,  ///< the tolerance cannot be met: the step shrank below the resolution of time
  not_finite,      ///< the law gives infinity or not-a-number and no smaller step helps
};

/// What the work has cost so far.
struct StepStatistics {
  long steps = 0;              ///< accepted steps
  long rejected_steps = 0;     ///< attempts that missed the tolerance
  long law_evaluations = 0;    ///< evaluations of the law; an expansion into a series or a Jacobian counts once
  double proposed_step = 0.0;  ///< s; the step that rk4-doubling would choose next, 0: the method says nothing
};

/// What a user may choose of a method. Each method reads what concerns it.
struct StepOptions {
  double rtol = 1e-12;  ///< tolerance relative to each component, error-controlled methods
  double atol = 1e-12;  ///< absolute tolerance in each component's unit, error-controlled methods
  /// The absolute tolerance of each component, instead of `atol`, each > 0; the owner may change it between steps.
  /// Null: `atol` for all.
  std::shared_ptr<const std::vector<double>> component_atol{};
  /// s, > 0. Fixed-step methods: the step, required unless `nodes`; rk4-doubling: the output interval; quadrature: the
  /// longest step; others: the first step.
  std::optional<double> step{};
  /// s, > 0; no step is longer. A fixed step must not be.
  double max_step = std::numeric_limits<double>::infinity();
  std::vector<double> nodes{};  ///< fixed-step methods: the times of the step ends, for unequal steps
  int order = 0;                ///< series methods: the order; 0 lets the method choose
};

/// The absolute tolerance of a component. Never 0, so that a component that stays at 0 meets it.
inline double absolute_tolerance(const StepOptions& options, Eigen::Index component) {
  const auto* each = options.component_atol.get();
  const auto place = static_cast<std::size_t>(component);
  return std::max(each != nullptr && place < each->size() ? (*each)[place] : options.atol,
                  std::numeric_limits<double>::min());
}

/// Throws std::invalid_argument for tolerances, or a longest step, that an error-controlled method cannot keep.
inline void check_step_control(const StepOptions& options) {
  if (!(options.rtol >= 0.0 && options.atol >= 0.0 && options.rtol + options.atol > 0.0))
    throw std::invalid_argument("`rtol` and `atol` must not be negative, and not both zero");
  if (!(options.max_step > 0.0)) throw std::invalid_argument("`max_step` must be positive");
}

/// A method at work on one system: it holds the current time and state and moves them on, one accepted step at a time.
///
/// - `start(t, q)` begins, or begins anew after the state was changed from outside (a bounce).
/// - `advance(t_limit)` makes one accepted step towards `t_limit`, in either direction of time, never beyond it, and
///   lands on it exactly: `time() == t_limit`.
/// - `warnings()`, which not every method has, says in sentences what a user should know.
/// - `fill_segment(segment)` writes the last step as a Segment. It costs only where it is called.
/// - `amend(q)`, which a method may lack: see AnyStepper.
template <class S>
concept Stepper = requires(S& stepper, const S& fixed, double t, const typename S::State& q,
                           Segment<S::kDimension>& segment) {
  stepper.start(t, q);
  { stepper.advance(t) } -> std::same_as<StepStatus>;
  stepper.fill_segment(segment);
  { fixed.time() } -> std::convertible_to<double>;
  { fixed.state() } -> std::convertible_to<const typename S::State&>;
  { fixed.statistics() } -> std::convertible_to<const StepStatistics&>;
};

/// A Stepper of run-time dimension behind an interface, as the registry of methods makes them.
class AnyStepper {
 public:
  using State = Eigen::VectorXd;
  using ExtendedState = Eigen::VectorX<Extended>;
  static constexpr int kDimension = Eigen::Dynamic;

  virtual ~AnyStepper() = default;
  virtual void start(double t, const State& q) = 0;
  virtual StepStatus advance(double t_limit) = 0;
  virtual void fill_segment(Segment<>& segment) = 0;
  virtual double time() const = 0;
  virtual const State& state() const = 0;
  virtual const StepStatistics& statistics() const = 0;
  /// Replaces the state at the current time by one that differs little and means the same, such as a quaternion of unit
  /// length again: the steps go on as they would have. False, and nothing is done, where the method would lose what
  /// it has computed ahead or remembers. The last step's Segment is gone.
  virtual bool amend(const State&) { return false; }
  /// Whether the state is carried in extended precision from step to step.
  virtual bool is_extended() const { return false; }
  /// `start` with a state in extended precision, where it is carried so.
  virtual void start_extended(double t, const ExtendedState& q) { start(t, q.cast<double>()); }
  /// The state `tau` (s) behind the start of the last step, in the precision in which it is carried; none where the
  /// step is known in double precision only.
  virtual std::optional<ExtendedState> extended_state(Extended /*tau*/) const { return std::nullopt; }
  /// What a user should know of the work so far: sentences, each once.
  virtual std::vector<std::string> warnings() const = 0;
};

}  // namespace trajet
