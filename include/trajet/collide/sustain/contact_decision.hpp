#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "trajet/collide/sustain/contact_forces.hpp"

namespace trajet {

/// What is known of a contact whose mode is to be decided.
struct ContactQuestion {
  FrictionCoefficients friction{};
  bool turns = false;               ///< contacts can make the body turn
  bool may_go_straight = false;     ///< what slides here may do so in a constant direction
  bool is_of_corners = false;       ///< of a solid that turns: what presses it on may make it slide
  ContactMode before{};             ///< how it lasted so far
  std::vector<ContactEnd> ended{};  ///< of that, just now: whatever rounding leaves of it
  double speed = 0.0;               ///< m/s: the scale of the speeds at the contact
  double radius = 0.0;              ///< m, of the body
  double time_scale = 0.0;          ///< s, of the run

  bool has_ended(ContactEnd end) const { return std::find(ended.begin(), ended.end(), end) != ended.end(); }
};

/// The modes by the velocities alone: what does not move is held.
std::vector<ContactMode> modes_by_velocity(const BodyTerms<double>& terms,
                                           const std::vector<ContactQuestion>& questions);

/// How contacts go on.
struct ContactDecision {
  std::vector<ContactMode> modes{};
  std::vector<ContactUnknown> unknowns{};
  std::vector<ContactForce<double>> forces{};
  int pulling = -1;       ///< of the contacts that would have to pull at a side, the one that pulls most; else -1
  int pulled_side = 0;    ///< of it; of a rim 0 as a whole, 1 beyond one side
  std::string failure{};  ///< why no mode fits
};

/// Decides which resistances hold: all that do not move, but for those whose limit the forces pass; these begin to move
/// in the direction in which the motion then accelerates.
/// `impulses`: decides the impulses that stop the motions instead, N s.
ContactDecision decide_contacts(const BodyTerms<double>& terms, const std::vector<ContactQuestion>& questions,
                                std::vector<ContactMode> modes, bool impulses = false);

}  // namespace trajet
