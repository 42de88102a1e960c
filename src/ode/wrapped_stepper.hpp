#pragma once

#include <concepts>
#include <string>
#include <utility>
#include <vector>

#include "trajet/ode/stepper.hpp"

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
  std::vector<std::string> warnings() const override {
    if constexpr (requires { stepper_.warnings(); }) return stepper_.warnings();
    return {};
  }

 private:
  S stepper_;
};

}  // namespace trajet::detail
