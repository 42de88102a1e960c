#pragma once

#include <string>
#include <vector>

#include "trajet/law/symbols.hpp"
#include "trajet/scene/named_value.hpp"
#include "trajet/scene/scene.hpp"

namespace trajet {

/// The parts of a body's state by the names that laws call them, and where they stand behind the body's offset.
struct BodyPart {
  const char* name;
  int first;  ///< in the body's part of the state
  int size;   ///< 1 or 3
};
inline constexpr BodyPart kBodyParts[] = {{"r", 0, 3}, {"v", 3, 3},  {"x", 0, 1},  {"y", 1, 1},
                                          {"z", 2, 1}, {"vx", 3, 1}, {"vy", 4, 1}, {"vz", 5, 1}};

/// Names of what is computed from the rotational part: angular velocity in the world and in the body, R_WB, q_WB.
inline constexpr const char* kRotationNames[] = {"w",   "wx",  "wy",  "wz",  "w_body", "qw",  "qx",  "qy",  "qz",
                                                 "Rxx", "Rxy", "Rxz", "Ryx", "Ryy",    "Ryz", "Rzx", "Rzy", "Rzz"};

/// The body part of that name, or nullptr.
const BodyPart* find_body_part(std::string_view name);

/// The tables and the parameters of a scene, evaluated whatever the order in which they refer to each other, and the
/// names that they must not use. Throws InputError: a circle, an unknown name, a value that is not finite.
struct ParameterSet {
  Symbols symbols;
  std::vector<NamedValue> values;
};
ParameterSet evaluate_parameters(const Scene& scene);

/// Adds the meanings of the names of a body's position and velocity: `prefix` is "" for its own laws or "NAME." for
/// those of others. `input` is the index of its first component among the inputs of a program.
void add_body_symbols(Symbols& symbols, const std::string& prefix, int input);

}  // namespace trajet
