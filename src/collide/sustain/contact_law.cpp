#include "trajet/collide/sustain/contact_law.hpp"

#include <utility>

#include "contact_builder.hpp"
#include "contact_ways.hpp"
#include "trajet/collide/sustain/resting_contact.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

using detail::along_surface;
using detail::ContactBuilder;
using NumberVector = Vector3T<ProgramNumber>;

/// A speed so small of those at a contact is a motion to the side by rounding.
constexpr double kStraight = 1e-13;

/// A corner that is so much deeper than the surface, of its distance from the centre of mass, has come to it unseen.
constexpr double kDeep = 1e-8;

void push(const NumberVector& v, ProgramBuilder& builder, std::vector<int>& nodes) {
  for (int i = 0; i < 3; ++i) nodes.push_back(v[i].node(builder));
}

ProgramNumber square(const ProgramNumber& x) { return x * x; }

/// The conditions that end what a resistance does: of motions at the points of a contact.
class ResistanceEnds {
 public:
  ResistanceEnds(const Resistance& resistance, std::vector<NumberVector> motions, const NumberVector& normal)
      : resistance_(resistance), motions_(std::move(motions)), normal_(normal) {}

  /// The motion along its direction turns round.
  ProgramNumber turns_round() const { return -resistance_.direction.cast<ProgramNumber>().dot(motions_.front()); }
  /// The motion has died.
  ProgramNumber dies() const { return below(kHasDied) - squares(); }
  /// One of the motions is so small a part of all, or has died.
  ProgramNumber is_below(const NumberVector& motion, double part) const {
    return ProgramNumber(part * part) * squares() + below(kHasDied) - motion.dot(motion);
  }
  /// The motion is fast enough for a direction of its own.
  ProgramNumber has_begun() const { return squares() - below(kBegun); }
  /// The motion is not along its direction any more.
  ProgramNumber bends() const {
    const NumberVector across = normal_.cross(resistance_.direction.cast<ProgramNumber>());
    ProgramNumber sum(0.0);
    for (const NumberVector& motion : motions_) sum += square(across.dot(motion));
    return sum - ProgramNumber(kStraight * kStraight) * squares() - below(kStraight);
  }

 private:
  ProgramNumber squares() const {
    ProgramNumber sum(0.0);
    for (const NumberVector& motion : motions_) sum += motion.dot(motion);
    return sum;
  }
  ProgramNumber below(double part) const { return square(ProgramNumber(part * resistance_.scale)); }

  const Resistance& resistance_;
  std::vector<NumberVector> motions_;
  NumberVector normal_;
};

/// Of each point whose friction follows its slip, the squares of its speed and acceleration along the surface.
Program slips_that_bend(ProgramBuilder& builder, const BodyTerms<ProgramNumber>& terms,
                        const std::vector<ContactMode>& modes, const std::vector<ContactForce<ProgramNumber>>& forces) {
  NumberVector force, moment;
  force.setConstant(ProgramNumber(0.0));
  moment.setConstant(ProgramNumber(0.0));
  for (const ContactForce<ProgramNumber>& each : forces) {
    force += each.force;
    moment += each.moment;
  }
  const NumberVector acceleration = force * terms.inverse_mass, turning = terms.inverse_inertia * moment;
  std::vector<int> nodes;
  for (std::size_t c = 0; c < modes.size(); ++c) {
    const ContactPoints& contact = terms.contacts[c];
    // places on a rim are nodes of an integral: one that hardly moves is none that stops
    if (!modes[c].slip.is_moving() || !modes[c].slip.follows || contact.is_rim) continue;
    for (std::size_t i = 0; i < contact.points.size(); ++i) {
      if (!contact.is_one() && modes[c].points[i].state != PointSlip::State::follows) continue;
      if (modes[c].slip.begins) continue;
      const ContactTerms<ProgramNumber>& at = terms.points[static_cast<std::size_t>(contact.points[i])];
      const NumberVector slip = along_surface(at.slip, at.normal);
      const NumberVector rate =
          along_surface(at.slip_rate + acceleration + NumberVector(turning.cross(at.arm)), at.normal);
      nodes.push_back(slip.dot(slip).node(builder));
      nodes.push_back(rate.dot(rate).node(builder));
    }
  }
  return nodes.empty() ? Program{} : builder.build(nodes);
}

/// Whether position changes as the velocity says.
bool has_no_drift(const Program& law, int offset) {
  for (int i = 0; i < 3; ++i)
    if (law.outputs[static_cast<std::size_t>(offset + i)] != 1 + offset + 3 + i) return false;
  return true;
}

/// The directions of the world in which a point's or a ball's centre stays where it is.
std::vector<Vector3> still_directions(const std::vector<SustainedContact>& contacts) {
  std::vector<Vector3> normals;
  for (const SustainedContact& contact : contacts) {
    if (contact.pose || !contact.patch.is_flat() || !contact.corners.front().is_ball()) continue;
    normals.push_back(contact.patch.axis);
    const bool is_still =
        contact.mode.slip.is_held() && (contact.corners.front().rounding == 0.0 || contact.mode.roll.is_held());
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
  for (const ContactTerms<ProgramNumber>& at : terms.points)
    for (const NumberVector* each :
         {&at.normal, &at.normal_rate, &at.tangents[0], &at.tangents[1], &at.tangent_rates[0], &at.tangent_rates[1],
          &at.arm, &at.slip, &at.slip_rate, &at.turning, &at.turning_rate})
      push(*each, builder, nodes);
  return ContactMotion(builder.build(nodes), terms.contacts);
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
  terms.contacts = contacts_;
  while (next != values.data() + values.size()) {
    ContactTerms<double>& at = terms.points.emplace_back();
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
    for (const Vector3& direction : still_directions(contacts)) result.law = hold(result.law, body.offset, direction);

  const auto end = [&](std::size_t contact, ContactEnd kind, const ProgramNumber& value, int detail = 0) {
    const int node = value.node(builder);
    result.ends.push_back({static_cast<int>(contact), kind, builder.build(std::span(&node, 1)), detail});
  };
  result.slips = slips_that_bend(builder, terms, modes, forces);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const ContactPoints& points = terms.contacts[c];
    const auto point = [&](int i) -> const ContactTerms<ProgramNumber>& {
      return terms.points[static_cast<std::size_t>(points.points[static_cast<std::size_t>(i)])];
    };
    const ContactTerms<ProgramNumber>& at = point(0);
    const ContactMode& mode = modes[c];
    const ContactForce<ProgramNumber>& force = forces[c];
    const auto watch = [&](const Resistance& resistance, const std::vector<NumberVector>& motions, ContactEnd stops,
                           ContactEnd bends) {
      const ResistanceEnds ends(resistance, motions, at.normal);
      if (resistance.begins) return end(c, bends, ends.has_begun());
      // a motion whose direction follows it may turn round without a stop
      if (!resistance.follows || points.is_one()) end(c, resistance.follows ? bends : stops, ends.turns_round());
      if (resistance.follows) end(c, stops, ends.dies());
      // where one of several points stops, its direction is lost
      const bool has_corners = resistance.follows && motions.size() > 1 && !points.is_rim;
      for (std::size_t i = 0; has_corners && i < motions.size(); ++i) {
        if (mode.points[i].state == PointSlip::State::begins)
          end(c, bends, -ends.is_below(motions[i], kOneBegun));
        else
          end(c, ContactEnd::one_stops, ends.is_below(motions[i], kOneStops));
      }
      if (!resistance.follows) end(c, bends, ends.bends());
    };
    const auto limit = [&](ContactEnd starts, const ProgramNumber& squared, double coefficient) {
      end(c, starts, squared - square(ProgramNumber(coefficient) * force.normal));
    };
    const auto squared = [](const NumberVector& v) { return v.dot(v); };
    if (points.is_rim) {
      end(c, ContactEnd::pull, -force.normal);
      end(c, ContactEnd::tips, -load_within_rim(points, force.shares));
    } else {
      const std::vector<ProgramNumber> loads = loads_of_sides(points, force.shares);
      for (std::size_t side = 0; side < loads.size(); ++side)
        end(c, points.is_one() ? ContactEnd::pull : ContactEnd::tips, -loads[side], static_cast<int>(side));
    }
    const int sticking = mode.sticking_point();
    if (sticking >= 0) {
      end(c, ContactEnd::slip_stops, ProgramNumber(-mode.slip.sign) * at.normal.dot(at.turning));
      end(c, ContactEnd::slip_starts,
          squared(force.sticking) -
              square(ProgramNumber(friction[c].slip) * force.shares[static_cast<std::size_t>(sticking)]));
    } else if (mode.slip.is_moving()) {
      std::vector<NumberVector> slips;
      for (std::size_t i = 0; i < points.points.size(); ++i)
        slips.push_back(along_surface(point(static_cast<int>(i)).slip, at.normal));
      watch(mode.slip, slips, ContactEnd::slip_stops, ContactEnd::slip_bends);
    }
    if (mode.slip.is_held() && points.is_one())
      limit(ContactEnd::slip_starts, squared(along_surface(force.force, at.normal)), friction[c].slip);
    if (mode.slip.is_held() && !points.is_one())
      for (const NumberVector& each : held_friction(terms, points, mode, force))
        end(c, ContactEnd::slip_starts, squared(each) - square(ProgramNumber(friction[c].slip)));
    if (mode.roll.is_moving())
      watch(mode.roll, {along_surface(at.turning, at.normal)}, ContactEnd::roll_stops, ContactEnd::roll_bends);
    if (mode.roll.is_held())
      limit(ContactEnd::roll_starts, squared(along_surface(force.torque, at.normal)), friction[c].roll);
    if (mode.spin.is_moving())
      end(c, ContactEnd::spin_stops, ProgramNumber(-mode.spin.sign) * at.normal.dot(at.turning));
    if (mode.spin.is_held()) limit(ContactEnd::spin_starts, square(at.normal.dot(force.torque)), friction[c].spin);
    for (const ProgramNumber& past : parts.past_edges(c)) end(c, ContactEnd::past_edge, past);
    for (std::size_t i = 0; i < contacts[c].others.size(); ++i) {
      const SupportCorner& corner = contacts[c].others[i];
      const ProgramNumber height = parts.height(c, corner);
      end(c, ContactEnd::touches, -height, static_cast<int>(i));
      // what hops so low that its flight is lost in the rounding of time does not sink deeper
      end(c, ContactEnd::touches, -height - ProgramNumber(kDeep * corner.p_B.norm()), static_cast<int>(i));
    }
  }
  return result;
}

void add_forces(const SustainedBody& body, const BodyTerms<double>& terms,
                const std::vector<ContactForce<double>>& forces, const double* q, double* changed) {
  Vector3 acceleration = Vector3::Zero(), moment = Vector3::Zero();
  for (const ContactForce<double>& each : forces) {
    acceleration += terms.inverse_mass * each.force;
    moment += each.moment;
  }
  Eigen::Map<Vector3>(changed + body.offset + 3) += acceleration;
  if (!body.layout || !body.inertia) return;
  Vector3 turning = terms.inverse_inertia * moment;
  if (body.layout->frame == Frame::body)
    turning = body.layout->rotation(q + body.rotation_offset).transpose() * turning;
  Eigen::Map<Vector3>(changed + body.rotation_offset + body.layout->size()) += turning;
}

}  // namespace trajet
