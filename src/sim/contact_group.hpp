#pragma once

#include <vector>

#include "run_control.hpp"
#include "trajet/collide/detect/contact.hpp"

namespace trajet {

/// A contact of those that are resolved together.
struct GroupedContact {
  int first = 0;                  ///< body
  int second = -1;                ///< body; -1: it is an obstacle
  int obstacle = -1;              ///< obstacle; -1: it is a body
  ContactResult contact{};        ///< of the first with the other
  std::vector<Vector3> points{};  ///< of solids: where they touch, world
  Surface surface{};
  bool is_met = false;      ///< they meet now; else they touched already
  bool is_lasting = false;  ///< the body stays on the obstacle
};

/// What happens at one instant together with one contact: all that bounce and cannot be told from it in time, and those
/// at which bodies touch already, of all bodies that can be reached from one to the next.
///
/// Two contacts are at one instant if their times are closer than their bounds and the later one's gap is then less
/// than a billionth of the size of what meets. Points and balls are seen to touch by their distance; of other solids,
/// only what meets or stays on obstacles is known. Bodies that cannot answer to an impact are left out.
///
/// \param seed  with its bounds; it is the first of the result
std::vector<GroupedContact> contacts_at_once(const RunControl& run, const GroupedContact& seed);

}  // namespace trajet
