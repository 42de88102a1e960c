// What of lasting contacts is lying flat on a round face.

#include "body_state.hpp"
#include "lasting_contacts.hpp"
#include "solid_bounce.hpp"
#include "trajet/collide/sustain/rest.hpp"

namespace trajet {

double LastingContacts::lay_flat(Instant& instant, const RestingContact& contact, const Pair& pair) const {
  if (!contact.is_on_rim) return 0.0;
  const std::optional<FrameMotion> surface = encounters_.frame(contact.obstacle, instant.time());
  const NormalMotion motion = normal_motion(world_, pair, surface, instant.q, instant.rate());
  const World::Body& moved = body(contact.body);
  Vector3 turning = angular_velocity(moved, instant.q) - (surface ? surface->w : Vector3(0, 0, 0));
  turning -= turning.dot(contact.normal) * contact.normal;
  // what tilts does not depart as a whole
  constexpr double kNoTilting = 1e-9;
  if (!(motion.speed > 0.0) || turning.norm() * bounding_radius(moved.solid) > kNoTilting * motion.speed) return 0.0;
  const double restitution = world_.surface(contact.body, contact.obstacle).restitution.at(motion.speed);
  instant.q.segment<3>(contact.offset + 3) -= motion.speed * contact.normal;
  auto rows = instant.derivative.middleRows<3>(contact.offset + 3);
  rows -= contact.normal * (contact.normal.transpose() * rows).eval();
  return motion.acceleration < 0.0 ? bouncing_time(motion.speed, -motion.acceleration, restitution) : 0.0;
}

}  // namespace trajet
