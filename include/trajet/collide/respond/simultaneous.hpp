#pragma once

namespace trajet {

/// What becomes of impacts at one instant.
enum class Simultaneous {
  reflections,  ///< reflected at all that approach together, until nothing does
  group,        ///< Moreau's law: the cone of velocities that the contacts let pass decides at once
};

}  // namespace trajet
