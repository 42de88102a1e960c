#pragma once

#include <vector>

#include "trajet/collide/respond/restitution_law.hpp"
#include "trajet/scene/scene.hpp"

namespace trajet {

/// What becomes of what comes to a surface.
struct Surface {
  OnHit on_hit = OnHit::stop;
  RestitutionLaw restitution{};
  SourceLocation restitution_where{};
};

/// Which others a body meets, for its part.
struct Company {
  bool has_all_bodies = true;
  bool has_all_obstacles = true;
  std::vector<int> bodies{};     ///< else these, in order
  std::vector<int> obstacles{};  ///< likewise
};

}  // namespace trajet
