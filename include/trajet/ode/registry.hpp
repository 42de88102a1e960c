#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trajet/ode/stepper.hpp"
#include "trajet/ode/system.hpp"

namespace trajet {

enum class StepControl {
  fixed,       ///< the user gives the step
  adaptive,    ///< the method chooses steps that meet rtol and atol
  subdivided,  ///< the user gives the step, and the method divides it until rtol is met
};

/// One integration method as users see it. A line of the table in src/ode/registry.cpp adds one.
struct MethodInfo {
  std::string_view name;
  std::vector<std::string_view> aliases;
  int order;        ///< of the global error; 0: chosen from the tolerance
  int dense_order;  ///< p: the error within a Segment is O(h^(p+1)); 0: chosen from the tolerance
  StepControl control;
  std::string_view known_as;  ///< what the notes (docs/notes/) or MATLAB call it
  std::string_view summary;   ///< one line
  std::unique_ptr<AnyStepper> (*make)(System& system, const StepOptions& options);
  int max_order = 0;  ///< what StepOptions::order may be at most; 0: the method's order cannot be chosen
  /// Why the method cannot solve systems of that structure; nullptr: it can solve all.
  std::optional<Unsuitable> (*find_unsuitable)(const Structure& structure) = nullptr;

  bool carries_extended = false;  ///< its state is in extended precision from step to step

  bool needs_step() const { return control != StepControl::adaptive; }
};

/// All methods, in the order in which `trajet methods` prints them.
std::span<const MethodInfo> methods();

/// The method of that name or alias, or nullptr. Capital letters make no difference.
const MethodInfo* find_method(std::string_view name);

/// Of a method that other programs have and trajet has not (SciPy's Radau and LSODA, MATLAB's ode78 and ode89), the
/// nearest one, or nullptr.
const MethodInfo* find_nearest_method(std::string_view foreign_name);

}  // namespace trajet
