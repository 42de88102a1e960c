#pragma once

#include <string>
#include <vector>

#include "contact_group.hpp"
#include "run_control.hpp"

namespace trajet {

class ContactHandler;
class GroupBounce;

/// What becomes of a run where several contacts happen at one instant.
class GroupHandler {
 public:
  /// Both outlive the object.
  GroupHandler(const RunControl& run, ContactHandler& contacts) : run_(run), contacts_(contacts) {}

  /// Resolves an impact of a body with an obstacle, or of two bodies, together with what happens at the same instant,
  /// and lets all go on. False, and nothing has changed, where it is resolved by itself: where nothing else pushes, or
  /// where it has to be, one after the other. `course`: of a body of it.
  bool handle(int course, const Pair& met);
  bool handle(int course, const Meeting& met);

 private:
  bool handle(int course, const GroupedContact& seed);
  /// Whether contacts push of which only the law of one contact is known: of solids with friction, and of what grips
  /// with a tangential restitution. They are resolved one by one; by none of these laws energy grows.
  bool is_known_alone(const std::vector<GroupedContact>& contacts, const GroupBounce& bounce) const;
  /// Why the group cannot be resolved, if it cannot.
  std::string describe_failure(const std::vector<GroupedContact>& contacts, const GroupBounce& bounce) const;
  /// Of the contacts that push, their impacts.
  std::vector<Impact> impacts(const std::vector<GroupedContact>& contacts, const GroupBounce& bounce,
                              const std::map<int, Instant>& instants) const;
  /// Begins the rests of bodies that do not fly any more. False if the run has ended.
  bool settle(const std::vector<GroupedContact>& contacts, const std::vector<Impact>& impacts,
              const GroupBounce& bounce, std::map<int, Instant>& instants);
  std::string names(const GroupedContact& contact) const;

  const World::Body& body(int index) const { return run_.world().bodies[static_cast<std::size_t>(index)]; }

  const RunControl& run_;
  ContactHandler& contacts_;
};

}  // namespace trajet
