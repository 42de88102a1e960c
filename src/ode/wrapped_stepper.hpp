#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trajet/ode/stepper.hpp"
#include "trajet/portable.hpp"

namespace trajet::detail {

/// Any Stepper of run-time dimension behind the interface.
template <Stepper S>
class WrappedStepper final : public AnyStepper {
 public:
  /// Makes the stepper of `arguments`, in place.
  template <class... Arguments>
  explicit WrappedStepper(Arguments&&... arguments) : stepper_(std::forward<Arguments>(arguments)...) {}

  void start(double t, const State& q) override { stepper_.start(t, q); }
  StepStatus advance(double t_limit) override { return stepper_.advance(t_limit); }
  void fill_segment(Segment<>& segment) override { stepper_.fill_segment(segment); }
  double time() const override { return stepper_.time(); }
  const State& state() const override { return stepper_.state(); }
  const StepStatistics& statistics() const override { return stepper_.statistics(); }
  bool amend(const State& q) override {
    if constexpr (requires {
                    { stepper_.amend(q) } -> std::same_as<bool>;
                  }) {
      return stepper_.amend(q);
    } else if constexpr (requires { stepper_.amend(q); }) {
      stepper_.amend(q);
      return true;
    } else {
      return false;
    }
  }
  bool is_extended() const override {
    return requires { stepper_.extended_state(0.0L); };
  }
  void start_extended(double t, const ExtendedState& q) override {
    if constexpr (requires { stepper_.start_extended(t, q); }) {
      stepper_.start_extended(t, q);
    } else {
      AnyStepper::start_extended(t, q);
    }
  }
  std::optional<ExtendedState> extended_state(Extended tau) const override {
    if constexpr (requires { stepper_.extended_state(tau); }) return stepper_.extended_state(tau);
    return std::nullopt;
  }
  std::vector<std::string> warnings() const override {
    if constexpr (requires { stepper_.warnings(); }) return stepper_.warnings();
    return {};
  }

 private:
  S stepper_;
};

}  // namespace trajet::detail
