#pragma once

#include "trajet/collide/sustain/contact_law.hpp"

namespace trajet {

/// Something that happens to a course on its current Segment by its own motion.
struct Crossing {
  enum class Kind { segment_end, event, pull, past_edge, mode, let_go };
  double time = 0.0;
  Kind kind = Kind::segment_end;
  int index = 0;  ///< of the event in World::events; of the lasting contact that would pull, has come to its edge or
                  ///< changes its mode, or of the hold that lets go
  double error_bound = 0.0;           ///< s
  ContactEnd end = ContactEnd::pull;  ///< of a lasting contact
  int detail = 0;                     ///< as in ContactEndCondition
};

}  // namespace trajet
