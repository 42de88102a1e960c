#pragma once

#include <optional>
#include <vector>

#include "trajet/rigid/free_invariants.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// The orientations within the state of a group, put right where a step ends: unit quaternions, rotation vectors that
/// start at 0, the energy and momentum of free tops.
///
/// The Segment is bent so that it ends where the next one begins: what is reported of a motion is read from its
/// Segments and nowhere else.
class OrientationUpkeep {
 public:
  OrientationUpkeep(const World& world, int group);

  bool empty() const { return turning_.empty(); }
  /// By how much the tolerance of a step is less than that which is asked for.
  double tolerance_factor() const;
  /// A motion starts in state q, or goes on there from state `before`; orientations are put right. What a free top
  /// keeps, it keeps where it goes on as it came. `pushed`: the rotations that contacts change, which are not free.
  void begin(Eigen::VectorXd& q, const Eigen::VectorXd* before, const std::vector<const World::Rotation*>& pushed);
  /// A step has ended in the stepper's state `end`, which becomes right; `segment`, which is the step, is bent.
  void end_step(Segment<>& segment, Eigen::VectorXd& end);
  /// The stepper goes on from the state as it was put right. Where it does not, the next step is bent at its start too.
  void was_taken();
  /// How far the state is from a right one; 0.5 is as far as it should get.
  double drift(const Eigen::VectorXd& q) const;

 private:
  struct Turning {
    const World::Rotation* rotation;
    bool is_pushed = false;
    std::optional<FreeInvariants> invariants{};  // of a free top whose way keeps them
    Eigen::VectorXd correction{};                // of its numbers where the current step began, and then where it ended

    int offset() const { return rotation->offset; }
    int size() const { return rotation->layout.size() + 3; }
  };
  /// The numbers of a turning body that mean what `numbers` should: written about the same quaternion where a rotation
  /// vector is carried.
  static Eigen::VectorXd right_numbers(const Turning& turning, const Eigen::VectorXd& numbers);

  std::vector<Turning> turning_;
};

}  // namespace trajet
