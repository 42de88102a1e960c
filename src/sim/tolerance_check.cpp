#include "tolerance_check.hpp"

#include <algorithm>
#include <cmath>

#include "trajet/math/polynomial.hpp"
#include "trajet/portable.hpp"
#include "trajet/text/shortest_text.hpp"

namespace trajet {

ToleranceCheck::ToleranceCheck(const World& world, int group)
    : atol_(world.step_options.atol), start_(world.groups[static_cast<std::size_t>(group)].start) {
  for (const int b : world.groups[static_cast<std::size_t>(group)].bodies) {
    const World::Body& body = world.bodies[static_cast<std::size_t>(b)];
    parts_.push_back({"body '" + body.name + "'", " m", body.slice().position_index(), 3});
  }
  for (const World::ExtraState& state : world.states)
    if (state.group == group) parts_.push_back({"state '" + state.name + "'", "", state.offset, 1});
  take(start_);
}

void ToleranceCheck::take(const Eigen::VectorXd& q) {
  for (Part& part : parts_) {
    part.reach = std::max(part.reach, (q - start_).segment(part.first, part.size).norm());
    part.largest = std::max(part.largest, q.segment(part.first, part.size).norm());
  }
}

std::string ToleranceCheck::warning() const {
  constexpr double kPart = 0.01;      // of the way that a step may be off by
  constexpr double kRoundings = 1e3;  // what comes no farther stands still
  const auto is_too_fine = [&](const Part& part) {
    return part.reach > kRoundings * kUnitRoundoff * part.largest && atol_ > kPart * part.reach;
  };
  const auto found = ranges::find_if(parts_, is_too_fine);
  if (found == parts_.end()) return {};
  return "atol = " + shortest_text(atol_) + " is coarser than the motion of " + found->name +
         ", which comes no farther than " + shortest_text(found->reach) + found->unit +
         ": without atol the tolerance follows the scale of the motion";
}

}  // namespace trajet
