#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trajet/scene/scene.hpp"
#include "trajet/sim/run_observer.hpp"
#include "trajet/study/reference.hpp"

namespace trajet {

/// Which methods to run on a scene, with what steps and tolerances, and against what.
struct ComparePlan {
  /// Names or aliases; empty: all of the registry.
  std::vector<std::string> methods;
  /// For methods of given step: into how many equal steps to divide the run. Empty: the scene's step, or 10, 40, 160.
  std::vector<long> step_counts;
  /// For error-controlled methods. Empty: the scene's rtol, or 1e-3, 1e-6, 1e-9.
  std::vector<Expression> rtols;
  /// Ways of carrying orientations, each with every method; empty: the scene's.
  std::vector<OrientationWay> orientations;
  /// `exact` for the scene's closed forms, or a method; empty: the closed forms if there are any, else the
  /// error-controlled method of the highest order that is not itself compared, with tight tolerances.
  std::string reference;
  SourceLocation methods_where{};  ///< where errors about `methods` point to
  SourceLocation orientations_where{};
  SourceLocation reference_where{};  ///< likewise `reference`
};

/// How far a motion is from its reference: the largest absolute value over all components, m and m/s alike.
struct Deviation {
  std::optional<double> state;     ///< over all components that the reference knows
  std::optional<double> position;  ///< over those of positions, m
};

/// What has become of the bodies that turn: of each quantity the value of the body that fares worst, none where no body
/// has it.
struct RotationDeviation {
  std::optional<double> determinant;  ///< of the matrix R as carried; 1 for a rotation
  std::optional<double> norm;         ///< |q| as carried, where a quaternion is
  std::optional<double> angle_rad;    ///< between the orientation and that of the reference, 0 … pi
  std::optional<double> energy;       ///< |T - T_0| / T_0 of a free body with an inertia, T its energy of rotation
  std::optional<double> momentum;     ///< |L - L_0| / |L_0|, L its angular momentum in the world's frame
};

/// The same at a time.
struct RotationSample {
  double time = 0.0;  ///< s since the start
  RotationDeviation deviation;
};

/// One method with one step or tolerance.
struct ComparisonRow {
  std::string method;          ///< canonical name
  std::string orientation;     ///< name of the way of carrying it; empty where no body turns
  std::optional<double> step;  ///< s, as given to the method
  std::optional<double> rtol;  ///< error-controlled methods
  std::optional<double> atol;
  RunStatus status = RunStatus::failed;
  std::string failure;   ///< why there is no result: the method does not suit the law, or the numbers failed
  double elapsed = 0.0;  ///< s since the start; where the run ended
  double compared_until =
      0.0;               ///< s since the start; where the comparison ended: there, or where the reference ends to hold
  Deviation at_end;      ///< at `compared_until`
  Deviation at_samples;  ///< maximum over the scene's samples
  Deviation at_nodes;    ///< maximum over the ends of the method's own steps
  RotationDeviation rotation_at_end;
  RotationDeviation rotation_at_samples;           ///< the worst over the scene's samples
  std::vector<RotationSample> rotation_history{};  ///< at samples, at most some 500 of them
  std::size_t impacts = 0;
  RunStatistics statistics;  ///< the time is the shortest of a few runs where these are short

  bool succeeded() const { return status == RunStatus::finished || status == RunStatus::stopped; }
};

struct Comparison {
  std::string scene;  ///< file name
  std::string title;
  std::string reference_name;  ///< `exact` or the method's
  std::optional<double> reference_rtol;
  std::optional<double> reference_atol;
  std::optional<double> reference_step;  ///< s
  std::vector<std::string> components;   ///< what is compared: `ball.r`, `ball.v`, an extra state
  bool turns = false;                    ///< some body of the scene does: rows tell its RotationDeviation
  std::shared_ptr<Reference> reference;
  double epoch = 0.0;     ///< the time at the start, s: all others count from there
  double duration = 0.0;  ///< s, asked for; negative backward in time
  std::vector<NamedValue> parameters;
  std::vector<ComparisonRow> rows;
  std::vector<std::string> warnings;
  bool interrupted = false;
};

/// Receives a comparison while it goes on.
class CompareObserver {
 public:
  virtual ~CompareObserver() = default;
  /// A run begins: that of the reference, or of row `row` of `count`. What is returned, if anything, receives this run;
  /// if it interrupts it, the comparison ends there.
  virtual RunObserver* begin_reference(const std::string& /*method*/) { return nullptr; }
  virtual RunObserver* begin_row(const ComparisonRow& /*row*/, std::size_t /*index*/, std::size_t /*count*/) {
    return nullptr;
  }
};

/// Checks a scene and a plan without running anything, and returns what is going to move. Throws InputError that points
/// at what is wrong.
World check(const Scene& scene, const ComparePlan& plan);

/// Runs a scene by several methods and measures each against a reference.
///
/// What fails for one method alone, because it does not suit the law or because the numbers fail, is told in its row;
/// the others go on. Throws InputError where the scene or the plan is wrong, or where the reference cannot be computed.
///
/// Closed forms know nothing of impacts: against them a motion is compared up to its first bounce or rest, or the first
/// event that sets a state. Against a method, it is compared up to the earlier of the two ends, bounces and all.
Comparison compare(const Scene& scene, const ComparePlan& plan, CompareObserver* observer = nullptr);

}  // namespace trajet
