#pragma once

#include <string>

namespace trajet {

/// The JSON Schema (draft 4) of scene files, made from the tables by which they are read: for editors, which complete
/// keys and words and mark what is wrong while it is written. What formulas mean only `check` knows.
std::string scene_schema_json();

}  // namespace trajet
