#pragma once

#include <Eigen/Core>

#include "trajet/scene/world.hpp"

namespace trajet {

/// How far the state of a group may be off: the estimated errors of all steps so far, added up.
class StateError {
 public:
  StateError(const World& world, int group);

  /// Where the current Segment begins, in each component's unit.
  const Eigen::VectorXd& bound() const { return bound_; }
  /// The motion goes on behind time t on the Segment, on which it came to the state `end`.
  void pass(const Segment<>& segment, double t, const Eigen::VectorXd& end);

 private:
  std::vector<int> offsets_;  // of the bodies
  Eigen::VectorXd bound_;
};

}  // namespace trajet
