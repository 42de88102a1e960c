#pragma once

#include <functional>
#include <string>
#include <vector>

#include "instant.hpp"
#include "trajet/collide/sustain/contact_decision.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

/// What has ended at one of an instant's contacts.
struct EndedMode {
  PairId id;
  ContactEnd end;
};

/// How a body's lasting contacts go on that are not all plain: decides their modes, and takes out of the body's
/// velocity what they do not let pass.
class ContactSettling {
 public:
  /// Called with a contact that would have to pull, before it is looked at what the others do: takes it out of the
  /// instant.
  using Release = std::function<void(int contact)>;

  /// All outlive the object.
  ContactSettling(const World& world, Instant& instant, int body) : world_(world), instant_(instant), body_(body) {}

  /// Why it cannot be decided; empty if it is.
  std::string settle(const std::vector<EndedMode>& ended, const Release& release);

  /// How the body moves at its contacts in the instant's state; their normals are those now.
  std::optional<BodyTerms<double>> look();

  /// What reports call the ways in which the contacts last that were settled.
  struct Kind {
    PairId id;
    ImpactKind kind;
  };
  const std::vector<Kind>& kinds() const { return kinds_; }

 private:
  /// Of the contacts of the instant, those of the body.
  std::vector<int> own() const;
  std::vector<ContactQuestion> questions(const BodyTerms<double>& terms, const std::vector<EndedMode>& ended) const;
  /// Stops what its contacts hold.
  void stop_held(const BodyTerms<double>& terms, const std::vector<ContactQuestion>& questions,
                 const std::vector<ContactMode>& modes);
  /// What rounding has left of the velocity of a body that stands still.
  void stand_still();
  double speed_scale(const ContactTerms<double>& at) const;
  ImpactKind kind_of(const RestingContact& contact, const ContactTerms<double>& at, const ContactRates& by_forces,
                     double force) const;
  const World::Body& body() const { return world_.bodies[static_cast<std::size_t>(body_)]; }

  const World& world_;
  Instant& instant_;
  int body_;
  std::vector<Kind> kinds_;
};

}  // namespace trajet
