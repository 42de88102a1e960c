#pragma once

#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "trajet/io/scene_file.hpp"
#include "trajet/math/vector.hpp"
#include "trajet/sim/run.hpp"

namespace trajet::test {

/// Runs a scene that is written out in a test.
inline RunResult run_text(const std::string& text, RunObserver* observer = nullptr) {
  return run(parse_scene(text, "test.toml"), observer);
}

/// A way to run a scene: a method with its tolerance and step, as the lines of [method].
struct Way {
  std::string name;
  std::string lines;
};

inline std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  const std::string written = text;
  return written.find_first_of(".en") == std::string::npos ? written + ".0" : written;
}

inline std::string vector(const Vector3& v) {
  return "[" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + "]";
}

inline Way fixed(const std::string& name, double step) {
  return {name + " " + number(step), "name = \"" + name + "\"\nstep = " + number(step) + "\n"};
}

inline Way controlled(const std::string& name, double tolerance) {
  const std::string value = number(tolerance);
  return {name + " " + value, "name = \"" + name + "\"\nrtol = " + value + "\natol = " + value + "\n"};
}

inline std::vector<const Impact*> impacts_of(const RunResult& result, ImpactKind kind) {
  std::vector<const Impact*> found;
  for (const Impact& impact : result.impacts)
    if (impact.kind == kind) found.push_back(&impact);
  return found;
}

inline const BodyState& final_of(const RunResult& result, const std::string& body) {
  for (const BodyState& state : result.final.bodies)
    if (state.body == body) return state;
  throw std::out_of_range("no body '" + body + "'");
}

inline double state_of(const RunResult& result, const std::string& name) {
  for (const NamedValue& state : result.final.states)
    if (state.name == name) return state.value;
  throw std::out_of_range("no state '" + name + "'");
}

inline std::vector<EventRecord> events_named(const RunResult& result, const std::string& name) {
  std::vector<EventRecord> found;
  for (const EventRecord& event : result.events)
    if (event.event == name) found.push_back(event);
  return found;
}

/// What is said of a wrong scene, whose file is called "s".
inline std::string error_of(const std::string& text) {
  try {
    check(parse_scene(text, "s"));
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace trajet::test
