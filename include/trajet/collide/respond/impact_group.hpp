#pragma once

#include <optional>
#include <vector>

#include "trajet/collide/respond/restitution_law.hpp"
#include "trajet/collide/respond/simultaneous.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// A rigid body, point or solid, as the impacts of a group see it. World frame, SI units.
struct GroupBody {
  Vector3 velocity = Vector3::Zero();  ///< of the centre of mass
  Vector3 angular_velocity = Vector3::Zero();
  double inverse_mass = 0.0;                  ///< 1/kg; 0: nothing moves it, though it may move
  Matrix3 inverse_inertia = Matrix3::Zero();  ///< 1/(kg m^2), about the centre of mass; 0: nothing turns it
};

/// A contact of two of them.
struct GroupContact {
  int first = 0;                        ///< index of the body towards which the normal points
  int second = 0;                       ///< index of the other
  Vector3 normal;                       ///< unit
  Vector3 arm_first = Vector3::Zero();  ///< from the centre of mass to the point of contact, m
  Vector3 arm_second = Vector3::Zero();
  RestitutionLaw restitution{};
  double friction = 0.0;  ///< Coulomb's coefficient
};

/// One round of those that a group may take.
struct GroupRound {
  std::vector<int> pushing{};  ///< the contacts that pushed at once, their indices in order
  bool is_projection = false;  ///< whatever their restitutions, they keep no speed
  bool rubs = true;            ///< what has friction rubs
};

/// What a group of impacts comes to.
struct GroupResponse {
  enum class Status {
    resolved,
    jammed,      ///< driven bodies close in on a body from all sides: there is no velocity that they let pass
    impossible,  ///< a restitution is not within 0 and 1: that of `contact` at its speed of approach
  };
  Status status = Status::resolved;
  int contact = -1;    ///< of an impossible restitution
  double speed = 0.0;  ///< m/s, of approach at it
  std::vector<GroupBody> after{};
  std::vector<double> impulses{};    ///< N s, of each contact along its normal on its first body, all rounds together
  std::vector<Vector3> frictions{};  ///< N s, likewise, along the surfaces
  std::vector<double> approaches{};  ///< m/s, > 0: at which each contact was approached when it pushed first; else 0
  std::vector<GroupRound> rounds{};
};

/// The impacts of rigid bodies at several contacts at one instant.
///
/// Of contacts K the law of a round is Newton's at all of them together: impulses lambda_i >= 0 with
/// u+_i + e_i u-_i >= 0 and lambda_i (u+_i + e_i u-_i) = 0, u the speeds along the normals. `reflections`: K are those
/// that approach, u-_i < 0, round after round until none does [SmithEtAl2012]; with e = 1 a round reflects the velocity
/// about the cone that K lets pass, with e < 1 that is blended with the projection on it. `group`: K are those that do
/// not depart, u-_i <= 0, which with one e for all is Moreau's v+ = (1 + e) P(v-) - e v- [Moreau1988], and again where
/// others are approached then. Where all e are 0 the one round holds all contacts, and is the projection.
///
/// Friction: the impulses along the surfaces within Coulomb's limit, mu lambda_i, that leave the least kinetic energy.
/// They are those that oppose slip, or end it, and that is what the law of one contact says of points and balls. Where
/// they make contacts approach, these are of the next round.
///
/// The energy does not grow (less the work of driven bodies): in each round the gain is
/// sum lambda_i (u+_i + u-_i) / 2 = sum lambda_i (1 - e_i) u-_i / 2 <= 0, and by the projection -|v- - v+|^2 / 2;
/// friction leaves no more than none would. Impulses act on both bodies of a contact at one point, so momentum and
/// angular momentum stay. The velocities behind are unique, whatever the order of bodies and contacts; impulses are
/// unless some contacts could do without others. Where restitutions below 1, or friction, would take rounds without
/// end, the projection ends them, which is their limit.
GroupResponse resolve_group(const std::vector<GroupBody>& bodies, const std::vector<GroupContact>& contacts,
                            Simultaneous rule);

/// The velocities behind those rounds, of bodies and contacts near those by which they came about: the same contacts
/// push in each. Nothing where they cannot.
std::optional<std::vector<GroupBody>> repeat_rounds(const std::vector<GroupBody>& bodies,
                                                    const std::vector<GroupContact>& contacts,
                                                    const std::vector<GroupRound>& rounds);

/// Kinetic energy of a body, J; 0 of one that nothing moves.
double kinetic_energy(const GroupBody& body);

}  // namespace trajet
