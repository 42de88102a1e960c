#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "trajet/collide/sustain/contact_forces.hpp"
#include "trajet/collide/sustain/contact_mode.hpp"
#include "trajet/geom/surface_patch.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/law/program.hpp"
#include "trajet/rigid/orientation.hpp"

namespace trajet {

/// A part of a body's surface that touches: a corner, which may be spread to an ellipsoid and grown by a radius, in the
/// body's frame. A ball is its centre, grown; the rim of a disk its centre, spread.
struct SupportCorner {
  Vector3 p_B = Vector3::Zero();     ///< m
  Matrix3 spread = Matrix3::Zero();  ///< E of the ellipsoid {E y : |y| <= 1} around it, m
  double rounding = 0.0;             ///< m

  bool is_spread() const { return !spread.isZero(0.0); }
  bool is_ball() const { return p_B.isZero(0.0) && !is_spread(); }
};

/// A body in contact, and where its numbers lie in the state of its group.
struct SustainedBody {
  int offset = 0;                             ///< of position and velocity
  int rotation_offset = 0;                    ///< of orientation and angular velocity, if it turns
  std::optional<OrientationLayout> layout{};  ///< none: it does not turn
  std::shared_ptr<const Program> mass{};      ///< kg; none: forces are per mass
  std::optional<Matrix3> inertia{};           ///< kg m^2, body's frame; none: contacts do not turn it
  Matrix3 R_WB = Matrix3::Identity();         ///< of one that does not turn
};

/// A contact of it that lasts.
struct SustainedContact {
  SurfacePatch patch{};  ///< where the obstacle stands at the start
  /// Of an obstacle that is driven: of t, the place of its pivot and its unit quaternion since the start.
  std::shared_ptr<const Program> pose{};
  Vector3 pivot = Vector3::Zero();       ///< at the start, m
  bool turns = false;                    ///< the obstacle
  std::vector<SupportCorner> corners{};  ///< of the body that touch; several lie on a flat patch
  std::vector<SupportCorner> others{};   ///< that may come to touch, on a flat patch
  bool is_on_rim = false;                ///< the corners are points of the rim of a round face that lies flat
  FrictionCoefficients friction{};
  ContactMode mode{};
};

/// A program of t and the group's state that becomes positive when that happens.
struct ContactEndCondition {
  int contact = 0;
  ContactEnd end = ContactEnd::pull;
  Program program{};
  int detail = 0;  ///< of `tips`: the side of the contact's points; of `touches`: the corner among the others
};

/// The points of a body's contacts, one behind the other.
std::vector<ContactPoints> contact_points(const std::vector<SustainedContact>& contacts);

/// How a body moves at its contacts, as its group's law has it without their forces: a program, evaluated at states.
class ContactMotion {
 public:
  /// None where a function on the way has no derivative among our operations (a table in a `position_rate`).
  static std::optional<ContactMotion> make(const Program& law, const SustainedBody& body,
                                           const std::vector<SustainedContact>& contacts);
  BodyTerms<double> at(double t, const double* q);

 private:
  ContactMotion(Program program, std::vector<ContactPoints> contacts)
      : program_(std::make_shared<const Program>(std::move(program))),
        evaluate_(*program_),
        contacts_(std::move(contacts)) {}

  std::shared_ptr<const Program> program_;  // the evaluator keeps pointers to it
  Evaluator<double> evaluate_;
  std::vector<ContactPoints> contacts_;
};

/// The law of a group with the forces of a body's contacts, and what ends them.
struct ContactLaw {
  Program law;
  std::vector<ContactEndCondition> ends;
  /// Of each point whose friction follows its slip, the squares of its speed and acceleration along the surface. None:
  /// an empty program.
  Program slips{};
};
/// \param unknowns  as `independent_unknowns` gives them for the modes of the contacts
std::optional<ContactLaw> make_contact_law(const Program& law, const SustainedBody& body,
                                           const std::vector<SustainedContact>& contacts,
                                           const std::vector<ContactUnknown>& unknowns);

/// What forces of contacts at a body change: its rates of velocity and angular velocity in the rate of the group's
/// state; impulses the same in the state itself.
void add_forces(const SustainedBody& body, const BodyTerms<double>& terms,
                const std::vector<ContactForce<double>>& forces, const double* q, double* changed);

}  // namespace trajet
