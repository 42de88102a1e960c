#pragma once

#include <deque>
#include <vector>

#include "trajet/rigid/free_rotation.hpp"
#include "trajet/scene/program_system.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// The rotations of a group whose orientations are carried in closed form (`orientation = "exact"`).
///
/// Where a method has made a step, they write their part of its Segment: the closed form's Taylor polynomial, as many
/// pieces one after the other as it needs to be exact to rounding.
class ClosedRotations {
 public:
  ClosedRotations(const World& world, int group);

  bool empty() const { return rotations_.empty(); }
  /// The motion starts at time t in state q, or goes on there from state `before`. What goes on as it came keeps its
  /// closed form. `pushed`: the rotations that contacts change, which have none.
  void begin(double t, const Eigen::VectorXd& q, const Eigen::VectorXd* before,
             const std::vector<const World::Rotation*>& pushed);
  /// Puts the closed forms' values at time t into a state.
  void write(double t, Eigen::VectorXd& q) const;
  /// The step with the closed forms in it, in pieces.
  std::deque<Segment<>> pieces(const Segment<>& step);

 private:
  struct Rotation {
    const World::Rotation* place;
    double start;  // s, of the closed form
    FreeRotation closed_form;
  };

  std::vector<const World::Rotation*> places_;
  std::vector<Rotation> rotations_;
  ProgramSystem system_;
};

}  // namespace trajet
