#pragma once

#include <optional>
#include <vector>

#include "trajet/collide/respond/restitution_law.hpp"
#include "trajet/scene/scene.hpp"

namespace trajet {

/// What becomes of what comes to a surface.
struct Surface {
  OnHit on_hit = OnHit::stop;
  RestitutionLaw restitution{};
  SourceLocation restitution_where{};
  double friction = 0.0;  ///< Coulomb's coefficient
  /// How much of the slip of the point of contact an impact that grips turns round; none: friction alone decides.
  std::optional<double> tangential_restitution{};
  double rolling_friction = 0.0;   ///< m: torque against the turning along the surface over the normal force
  double spinning_friction = 0.0;  ///< m: the same about the normal
  ImpactLaw impact = ImpactLaw::stronge;
};

/// Which others a body meets, for its part.
struct Company {
  bool has_all_bodies = true;
  bool has_all_obstacles = true;
  std::vector<int> bodies{};     ///< else these, in order
  std::vector<int> obstacles{};  ///< likewise
};

}  // namespace trajet
