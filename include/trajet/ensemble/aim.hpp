#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "trajet/ensemble/varied_quantity.hpp"
#include "trajet/math/vector.hpp"
#include "trajet/scene/scene.hpp"

namespace trajet {

/// A quantity to be found, and where it is looked for: SI units, both ends included.
struct AimUnknown {
  VariedQuantity quantity{};
  double low = 0.0;
  double high = 0.0;
};

/// What the centre of a body shall hit: the centre of an obstacle of that name, which may move, or a point (m, world).
using AimTarget = std::variant<std::string, Vector3>;

/// A scene, what may be changed in it, and what shall come of it.
struct AimTask {
  Scene scene{};
  std::vector<AimUnknown> unknowns{};  ///< 1 to 4
  AimTarget target{};
  std::string body{};  ///< empty: the only one
  std::vector<std::string>
      conditions{};        ///< columns of a report (ReportColumns) at the time of the hit, none of them 0
  std::string minimise{};  ///< likewise; of all solutions only the one where it is least; empty: all
};

enum class AimStatus {
  found,
  unreachable,    ///< no motion in the ranges comes to the target, or none that fulfils the conditions
  not_converged,  ///< there may be solutions that the numbers have not brought out
};

/// Values of the unknowns with which the target is hit.
struct AimSolution {
  std::vector<double> parameters{};  ///< SI, in the order of the unknowns
  double time = 0.0;       ///< s, of the scene's clock: of the impact on an obstacle, at a point of the passage
  Vector3 point{0, 0, 0};  ///< of the impact, or where the body passes; m, world
  double miss = 0.0;       ///< m, from the centre of the body to the target, where it is nearest
  int bounces = 0;         ///< of the body, before the hit
};

/// The motion that comes nearest to the target.
struct ClosestApproach {
  std::vector<double> parameters{};
  double miss = 0.0;           ///< m
  double time = 0.0;           ///< s, of the scene's clock
  bool is_end = false;         ///< it still came nearer when the run was over
  bool ends_by_clock = false;  ///< over, because the scene's time was
};

struct AimResult {
  AimStatus status = AimStatus::unreachable;
  std::vector<AimSolution> solutions{};      ///< in the order of the first parameter, then the second
  std::optional<ClosestApproach> closest{};  ///< none where no motion could be computed
  bool is_family = false;                    ///< some solutions are single ones of a curve or a surface of them
  int refused = 0;                           ///< hits that do not fulfil the conditions
  long motions = 0;                          ///< computed
  bool is_interrupted = false;
  std::string failure{};  ///< of the first motion that failed, if one did
};

/// Finds all solutions in the ranges of the unknowns.
///
/// The target is passed through while aiming, so that a motion goes on behind it; all else happens as the scene says. A
/// *passage* is a time at which the body is nearest to the target, of one leg of its motion between impacts. Passages
/// of the same sequence of impacts depend smoothly on the unknowns, and so does the miss, the vector from the target to
/// the body there, at right angles to the motion. The ranges are cut into cells. A cell is dropped where a linear model
/// of the miss in it has no zero within twice the deviation from that model at its middle and its corners; it is halved
/// where there may be several; else Broyden's method finds the zero to the last digits. So all solutions are found that
/// the cells resolve: two that are nearer than 1e-6 of the ranges count as one, and a sequence of impacts that happens
/// between the nodes of the first cells only (64 for one unknown, 16 by 16 for two) is not seen.
///
/// `should_stop` is asked between steps; true ends the search with what has been found. Throws InputError where the
/// task is wrong.
AimResult aim(
    const AimTask& task, const std::function<bool()>& should_stop = [] { return false; });

}  // namespace trajet
