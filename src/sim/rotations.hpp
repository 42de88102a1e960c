#pragma once

#include <optional>
#include <vector>

#include "trajet/rigid/free_invariants.hpp"
#include "trajet/rigid/free_rotation.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// The orientations within the state of a group, kept as their ways of carrying them want.
class Rotations {
 public:
  Rotations(const World& world, int group);

  bool empty() const { return turning_.empty(); }
  /// By how much the tolerance of a step is less than that which is asked for.
  double tolerance_factor() const;
  /// A motion starts here, or goes on from a state that was changed: closed forms start anew.
  void begin(double t, const Eigen::VectorXd& q);
  /// What becomes of the numbers of each orientation at the end of a step, or wherever the state is read: unit
  /// quaternions, rotation vectors that start at 0, the energy and momentum of free tops, the values of closed forms.
  void settle(double t, Eigen::VectorXd& q) const;
  /// How far the state is from a settled one; 0.5 is as far as it should get.
  double unsettled(const Eigen::VectorXd& q) const;

 private:
  struct Turning {
    const World::Rotation* rotation;
    double start = 0.0;                          // s, of the closed form
    std::optional<FreeRotation> closed_form{};   // of `exact`
    std::optional<FreeInvariants> invariants{};  // of a free top whose way keeps them
  };
  std::vector<Turning> turning_;
};

}  // namespace trajet
