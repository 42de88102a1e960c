#include "trajet/collide/sustain/contact_law.hpp"

#include <utility>

#include "contact_builder.hpp"
#include "trajet/collide/sustain/resting_contact.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

using detail::ContactBuilder;
using NumberVector = Vector3T<ProgramNumber>;

/// A speed so small of those at a contact is a motion to the side by rounding.
constexpr double kStraight = 1e-13;
/// And so small a one has stopped, where its direction follows it.
constexpr double kStopped = 1e-11;

void push(const NumberVector& v, ProgramBuilder& builder, std::vector<int>& nodes) {
  for (int i = 0; i < 3; ++i) nodes.push_back(v[i].node(builder));
}

ProgramNumber square(const ProgramNumber& x) { return x * x; }

/// The conditions that end what a resistance does.
class ResistanceEnds {
 public:
  ResistanceEnds(const Resistance& resistance, const NumberVector& motion, const NumberVector& normal)
      : resistance_(resistance), motion_(motion), normal_(normal) {}

  /// The motion along its direction turns round.
  ProgramNumber turns_round() const { return -resistance_.direction.cast<ProgramNumber>().dot(motion_); }
  /// The motion has died.
  ProgramNumber dies() const {
    return ProgramNumber(kStopped * kStopped * resistance_.scale * resistance_.scale) - motion_.dot(motion_);
  }
  /// The motion is fast enough for a direction of its own.
  ProgramNumber has_begun() const {
    return motion_.dot(motion_) - ProgramNumber(kBegun * kBegun * resistance_.scale * resistance_.scale);
  }
  /// The motion is not along its direction any more.
  ProgramNumber bends() const {
    const NumberVector across = normal_.cross(resistance_.direction.cast<ProgramNumber>());
    return square(across.dot(motion_)) -
           ProgramNumber(kStraight * kStraight) *
               (motion_.dot(motion_) + ProgramNumber(resistance_.scale * resistance_.scale));
  }

 private:
  const Resistance& resistance_;
  NumberVector motion_, normal_;
};

/// What a force or torque of the surface has without its part along the normal.
NumberVector along_surface(const NumberVector& v, const NumberVector& normal) { return v - normal * normal.dot(v); }

/// Whether position changes as the velocity says.
bool has_no_drift(const Program& law, int offset) {
  for (int i = 0; i < 3; ++i)
    if (law.outputs[static_cast<std::size_t>(offset + i)] != 1 + offset + 3 + i) return false;
  return true;
}

/// The directions of the world in which the body's centre stays where it is.
std::vector<Vector3> still_directions(const std::vector<SustainedContact>& contacts, const SustainedBody& body) {
  std::vector<Vector3> normals;
  for (const SustainedContact& contact : contacts) {
    if (contact.pose || !contact.patch.is_flat()) continue;
    normals.push_back(contact.patch.axis);
    const bool is_still = contact.mode.slip.is_held() && (body.radius == 0.0 || contact.mode.roll.is_held());
    if (is_still)
      for (int i = 0; i < 3; ++i) normals.push_back(Vector3::Unit(i));
  }
  return support(normals).blocked;
}

}  // namespace

std::optional<ContactMotion> ContactMotion::make(const Program& law, const SustainedBody& body,
                                                 const std::vector<SustainedContact>& contacts) {
  ProgramBuilder builder(law);
  ContactBuilder parts(builder, law, body, contacts);
  if (!parts.has_derivatives()) return std::nullopt;
  const BodyTerms<ProgramNumber>& terms = parts.terms();
  std::vector<int> nodes{terms.inverse_mass.node(builder)};
  for (int i = 0; i < 9; ++i) nodes.push_back(terms.inverse_inertia(i / 3, i % 3).node(builder));
  for (const ContactTerms<ProgramNumber>& at : terms.contacts)
    for (const NumberVector* each :
         {&at.normal, &at.normal_rate, &at.tangents[0], &at.tangents[1], &at.tangent_rates[0], &at.tangent_rates[1],
          &at.arm, &at.slip, &at.slip_rate, &at.turning, &at.turning_rate})
      push(*each, builder, nodes);
  return ContactMotion(builder.build(nodes), contacts.size());
}

BodyTerms<double> ContactMotion::at(double t, const double* q) {
  std::vector<double> values(program_->outputs.size());
  evaluate_(t, q, values.data());
  BodyTerms<double> terms;
  const double* next = values.data();
  terms.inverse_mass = *next++;
  for (int i = 0; i < 9; ++i) terms.inverse_inertia(i / 3, i % 3) = *next++;
  const auto take = [&](Vector3& v) {
    v = Eigen::Map<const Vector3>(next);
    next += 3;
  };
  for (std::size_t c = 0; c < contacts_; ++c) {
    ContactTerms<double>& at = terms.contacts.emplace_back();
    for (Vector3* each : {&at.normal, &at.normal_rate, &at.tangents[0], &at.tangents[1], &at.tangent_rates[0],
                          &at.tangent_rates[1], &at.arm, &at.slip, &at.slip_rate, &at.turning, &at.turning_rate})
      take(*each);
  }
  return terms;
}

std::optional<ContactLaw> make_contact_law(const Program& law, const SustainedBody& body,
                                           const std::vector<SustainedContact>& contacts,
                                           const std::vector<ContactUnknown>& unknowns) {
  ProgramBuilder builder(law);
  ContactBuilder parts(builder, law, body, contacts);
  if (!parts.has_derivatives()) return std::nullopt;
  const BodyTerms<ProgramNumber>& terms = parts.terms();
  std::vector<ContactMode> modes;
  std::vector<FrictionCoefficients> friction;
  for (const SustainedContact& contact : contacts) {
    modes.push_back(contact.mode);
    friction.push_back(contact.friction);
  }
  const auto forces = contact_forces<ProgramNumber>(terms, modes, friction, unknowns);
  ContactLaw result{builder.build(parts.rates_with(forces)), {}};
  if (has_no_drift(law, body.offset))
    for (const Vector3& direction : still_directions(contacts, body))
      result.law = hold(result.law, body.offset, direction);

  const auto end = [&](std::size_t contact, ContactEnd kind, const ProgramNumber& value) {
    const int node = value.node(builder);
    result.ends.push_back({static_cast<int>(contact), kind, builder.build(std::span(&node, 1))});
  };
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const ContactTerms<ProgramNumber>& at = terms.contacts[c];
    const ContactMode& mode = modes[c];
    const ProgramNumber& normal_force = forces[c].normal;
    end(c, ContactEnd::pull, -normal_force);
    const auto watch = [&](const Resistance& resistance, const NumberVector& motion, ContactEnd stops,
                           ContactEnd bends) {
      const ResistanceEnds ends(resistance, motion, at.normal);
      if (resistance.begins) return end(c, bends, ends.has_begun());
      // a motion whose direction follows it may turn round without a stop
      end(c, resistance.follows ? bends : stops, ends.turns_round());
      if (resistance.follows) end(c, stops, ends.dies());
      if (!resistance.follows) end(c, bends, ends.bends());
    };
    const auto limit = [&](ContactEnd starts, const NumberVector& resisting, double coefficient) {
      end(c, starts, resisting.dot(resisting) - square(ProgramNumber(coefficient) * normal_force));
    };
    if (mode.slip.is_moving()) watch(mode.slip, at.slip, ContactEnd::slip_stops, ContactEnd::slip_bends);
    if (mode.slip.is_held())
      limit(ContactEnd::slip_starts, along_surface(forces[c].force, at.normal), friction[c].slip);
    if (mode.roll.is_moving())
      watch(mode.roll, along_surface(at.turning, at.normal), ContactEnd::roll_stops, ContactEnd::roll_bends);
    if (mode.roll.is_held())
      limit(ContactEnd::roll_starts, along_surface(forces[c].torque, at.normal), friction[c].roll);
    if (mode.spin.is_moving())
      end(c, ContactEnd::spin_stops, ProgramNumber(-mode.spin.sign) * at.normal.dot(at.turning));
    if (mode.spin.is_held())
      end(c, ContactEnd::spin_starts,
          square(at.normal.dot(forces[c].torque)) - square(ProgramNumber(friction[c].spin) * normal_force));
    for (const ProgramNumber& past : parts.past_edges(c)) end(c, ContactEnd::past_edge, past);
  }
  return result;
}

void add_forces(const SustainedBody& body, const BodyTerms<double>& terms,
                const std::vector<ContactForce<double>>& forces, const double* q, double* changed) {
  Vector3 acceleration = Vector3::Zero(), torque = Vector3::Zero();
  for (std::size_t c = 0; c < forces.size(); ++c) {
    acceleration += terms.inverse_mass * forces[c].force;
    torque += terms.contacts[c].arm.cross(forces[c].force) + forces[c].torque;
  }
  Eigen::Map<Vector3>(changed + body.offset + 3) += acceleration;
  if (!body.layout || !body.inertia) return;
  Vector3 turning = terms.inverse_inertia * torque;
  if (body.layout->frame == Frame::body)
    turning = body.layout->rotation(q + body.rotation_offset).transpose() * turning;
  Eigen::Map<Vector3>(changed + body.rotation_offset + body.layout->size()) += turning;
}

}  // namespace trajet
