#pragma once

#include <string>

namespace trajet {

/// A parameter or an extra state with its number, SI.
struct NamedValue {
  std::string name;
  double value = 0.0;
};

}  // namespace trajet
