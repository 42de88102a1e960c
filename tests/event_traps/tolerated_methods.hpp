#pragma once

#include <string>
#include <vector>

#include "scene_run.hpp"

namespace trajet::test {

/// A way to run a scene, and what of its whole motion it may be off by.
struct ToleratedWay {
  Way way;
  double tolerance;
  bool is_coarse = false;  // of the first order
};

/// All methods of controlled error, with tolerances for motions of a few steps between switches.
inline std::vector<ToleratedWay> controlled_ways() {
  const auto way = [](const std::string& name, double rtol, double tolerance) {
    return ToleratedWay{controlled(name, rtol), tolerance};
  };
  return {way("taylor", 1e-12, 1e-9),      way("taylor-extended", 1e-12, 1e-9),
          way("dopri5", 1e-10, 1e-7),      way("dop853", 1e-11, 1e-7),
          way("rodas5p", 1e-9, 1e-6),      way("adams", 1e-10, 1e-5),
          way("bdf", 1e-9, 1e-4),          way("bs32", 1e-8, 1e-4),
          way("rosenbrock23", 1e-7, 1e-3), way("trapezoid", 1e-7, 1e-3),
          way("tr-bdf2", 1e-7, 1e-3)};
}

}  // namespace trajet::test
