#pragma once

#include <Eigen/Core>
#include <vector>

#include "trajet/ode/segment.hpp"
#include "trajet/ode/system.hpp"

namespace trajet {

/// How far the state of a group may be off: the estimated errors of all steps so far, carried on by the derivatives of
/// the flights and of what happened in between.
///
/// The error is G r with |r_j| <= 1: each column of G is what one error of one step has become. A step multiplies G by
/// the derivative of its end by its start, exp(integral of the law's Jacobian), and adds columns of its own; an impact
/// multiplies it by the derivative of the state behind it by the state before it, of which the impact's time is part.
/// Where the columns become many, the shortest are replaced by the box around them [Girard2005]. Where errors have
/// grown beyond all numbers, as they do in chaos, the bound is infinite from then on.
///
/// Steps are kept and worked off where somebody asks.
class StateError {
 public:
  /// `roundoff`: of the precision in which the state is carried.
  StateError(int dimension, double roundoff);

  /// The motion under the law goes on behind time t on the Segment.
  void pass(System& law, const Segment<>& segment, double t);
  /// The state has changed; `derivative`: of the state behind by the state before. `further`: errors that others have
  /// brought, each a column.
  void jump(const Eigen::MatrixXd& derivative, const Eigen::MatrixXd& further = {});
  /// All steps are worked off: their laws may go.
  void settle();

  /// G at time t on the Segment, behind what was passed, in each component's unit.  // (dimension x any number)
  Eigen::MatrixXd columns(System& law, const Segment<>& segment, double t);
  /// What each component may be off by then.
  Eigen::VectorXd bound(System& law, const Segment<>& segment, double t);
  /// The same along one direction of the state.
  double bound_along(const Eigen::VectorXd& direction, System& law, const Segment<>& segment, double t);

 private:
  struct Step {
    System* law;
    double start;     // s
    double duration;  // s
    Eigen::VectorXd at_start, in_middle, at_end;
    Eigen::VectorXd error;  // that it adds
  };

  Step step_until(System& law, const Segment<>& segment, double t) const;
  static Eigen::MatrixXd transition(const Step& step);
  void add(const Eigen::VectorXd& error);
  void reduce();
  /// Whether the generators have become none.
  void check();

  double roundoff_;
  bool is_infinite_ = false;
  Eigen::MatrixXd generators_;  // (dimension x any number)
  std::vector<Step> open_;      // that are yet to be worked off
};

}  // namespace trajet
