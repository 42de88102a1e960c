#pragma once

#include <functional>
#include <string>
#include <vector>

#include "encounters.hpp"
#include "instant.hpp"
#include "trajet/collide/sustain/contact_decision.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

/// Why a body cannot be followed that lay flat on a round face and does so no more.
inline constexpr const char* kTipsOverRim =
    "it tips over the rim of the round face on which it lay flat, and how it goes on from there is not computed yet";

/// What has ended at one of an instant's contacts.
struct EndedMode {
  PairId id;
  ContactEnd end;
};

/// The contact goes on on some of its corners, counted as in `contact_points`.
void narrow(RestingContact& contact, const std::vector<int>& remaining);

/// How a body's lasting contacts go on that are not all plain: decides their modes, and takes out of the body's
/// velocity what they do not let pass.
class ContactSettling {
 public:
  /// Called with a contact that would have to pull, before it is looked at what the others do: takes it out of the
  /// instant.
  using Release = std::function<void(int contact)>;

  /// All outlive the object.
  /// `restitution`: of the speed at which corners come to a surface.
  ContactSettling(const World& world, Encounters& encounters, Instant& instant, int body, double restitution = 0.0)
      : world_(world), encounters_(encounters), instant_(instant), body_(body), restitution_(restitution) {}

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
  /// Stops what its contacts hold: of several corners, only where they push. False if they are fewer now.
  bool stop(const BodyTerms<double>& terms, const std::vector<ContactQuestion>& questions,
            const std::vector<ContactMode>& modes, std::string& failure);
  /// Impulses that are linear in the velocities, with what becomes of their errors.
  void apply(const BodyTerms<double>& terms, const std::vector<ContactQuestion>& questions,
             const std::vector<ContactMode>& modes, const std::vector<ContactUnknown>& unknowns);
  /// Leaves out the corners that depart; false if none is left of a contact, whose number is `gone`.
  bool keep_touching(const BodyTerms<double>& terms, int& gone);
  /// Whether what moves along the normal there is too slow for a flight that can be told from contact.
  bool is_slow(const ContactTerms<double>& at, double height) const;
  /// Whether a corner is far below its surface.
  bool has_sunk();
  /// Of the corners of a contact above the surface, m.
  std::vector<double> heights_of(int contact);
  /// Whether corners come to their surface still.
  bool are_closing(const BodyTerms<double>& terms);
  /// Of the corners that touch, those that forces and velocities let sink are taken on; whether there were any.
  bool take_sinking(const BodyTerms<double>& terms, const std::vector<ContactForce<double>>& forces);
  /// A contact goes on on some of its corners; of a round rim that is not known how.
  void leave_out(RestingContact& contact, const std::vector<int>& remaining);
  RestingContact& contact(int index) { return instant_.contacts[static_cast<std::size_t>(index)]; }
  /// What rounding has left of the velocity of a body that stands still.
  void stand_still();
  double speed_scale(const ContactTerms<double>& at) const;
  ImpactKind kind_of(const RestingContact& contact, const ContactTerms<double>& at, const ContactRates& by_forces,
                     double force) const;
  const World::Body& body() const { return world_.bodies[static_cast<std::size_t>(body_)]; }

  const World& world_;
  Encounters& encounters_;
  Instant& instant_;
  int body_;
  double restitution_;
  bool has_tipped_ = false;  // of corners that touched some would have to pull
  bool tips_over_rim_ = false;
  std::vector<Kind> kinds_;
};

}  // namespace trajet
