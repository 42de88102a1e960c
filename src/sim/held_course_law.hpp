#pragma once

#include <memory>
#include <vector>

#include "event_hold.hpp"
#include "sustained.hpp"
#include "trajet/collide/sustain/resting_contact.hpp"
#include "trajet/scene/program_system.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// The contacts among several that are of the body at `offset` of a group's state, together.
Support support_of(const std::vector<RestingContact>& contacts, int offset);

/// The law of a group with what holds its motion: lasting contacts with obstacles, and events at which it stays.
class HeldCourseLaw {
 public:
  HeldCourseLaw(const World& world, int group);

  const std::vector<RestingContact>& contacts() const { return contacts_; }
  const std::vector<EventHold>& holds() const { return holds_; }
  /// From now on it is these that hold. Whether they are others than before.
  bool take(const std::vector<RestingContact>& contacts, std::vector<EventHold> holds);
  bool is_held(int event) const;
  /// The rotations of solids that stay on corners.
  std::vector<const World::Rotation*> turning_corners() const;
  /// Those that the forces of contacts change.
  std::vector<const World::Rotation*> pushed_rotations() const;
  /// What ends the contacts that are not plain: their `contact` counts `contacts`.
  const std::vector<ContactEndCondition>& ends() const { return ends_; }
  /// Over how short a time no slip that friction follows changes by more than half of itself, s.
  double time_of_slips(double t, const Eigen::VectorXd& q) const;
  /// The group's law with contacts and holds.
  Program with(const std::vector<RestingContact>& contacts, const std::vector<EventHold>& holds) const {
    return with(contacts, holds, nullptr, nullptr);
  }
  /// The law stays on the branches that are true between two times, s.
  void keep_within(double first, double last);

  /// The law without what holds, and with it.
  ProgramSystem& free() const { return *free_; }
  ProgramSystem& system() const { return held_ ? *held_ : *free_; }

 private:
  /// `ends`, `slips`: if not null, get what ends the contacts that are not plain, and what slips there.
  Program with(const std::vector<RestingContact>& contacts, const std::vector<EventHold>& holds,
               std::vector<ContactEndCondition>* ends, std::vector<Program>* slips) const;
  const World::Group& group() const { return world_.groups[static_cast<std::size_t>(group_)]; }

  const World& world_;
  int group_;
  std::unique_ptr<ProgramSystem> free_;
  std::unique_ptr<ProgramSystem> held_;  // with contacts or holds only
  std::vector<RestingContact> contacts_;
  std::vector<EventHold> holds_;
  std::vector<ContactEndCondition> ends_;
  std::vector<Program> slips_;  // as ContactLaw has them
};

}  // namespace trajet
