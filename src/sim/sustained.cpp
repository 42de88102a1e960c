#include "sustained.hpp"

#include "trajet/collide/sustain/stuck_law.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

std::vector<SustainedContact> sustained(const World& world, const std::vector<RestingContact>& contacts, int body) {
  std::vector<SustainedContact> result;
  for (const RestingContact& contact : contacts)
    if (contact.body == body) result.push_back(sustained_contact(world, contact));
  return result;
}

/// A pointer to what outlives it.
std::shared_ptr<const Program> borrowed(const Program& program) { return {std::shared_ptr<const Program>(), &program}; }

}  // namespace

SustainedBody sustained_body(const World& world, int index) {
  const World::Body& body = world.bodies[static_cast<std::size_t>(index)];
  SustainedBody result{.offset = body.offset, .inertia = body.inertia, .R_WB = rotation_matrix(body.q_WB)};
  if (body.mass) result.mass = borrowed(*body.mass);
  if (body.rotation) {
    result.layout = body.rotation->layout;
    result.rotation_offset = body.rotation->offset;
  }
  return result;
}

SupportCorner support_corner(const ConvexCore& core, int vertex) {
  const auto place = static_cast<std::size_t>(vertex);
  return {core.vertices[place], core.is_spread() ? core.spreads[place] : Matrix3(Matrix3::Zero()), core.rounding};
}

SustainedContact sustained_contact(const World& world, const RestingContact& contact) {
  const World::Obstacle& obstacle = world.obstacles[static_cast<std::size_t>(contact.obstacle)];
  const Surface& surface = world.surface(contact.body, contact.obstacle);
  SustainedContact result{.patch = contact.patch,
                          .friction = {surface.friction, surface.rolling_friction, surface.spinning_friction},
                          .mode = contact.mode};
  result.is_on_rim = contact.is_on_rim;
  if (contact.core) {
    for (int i = 0; i < static_cast<int>(contact.core->vertices.size()); ++i)
      (ranges::find(contact.corners, i) != contact.corners.end() ? result.corners : result.others)
          .push_back(support_corner(*contact.core, i));
    // what lies flat on a round face has its other corners above it, and they stay there
    if (contact.is_on_rim) result.others.clear();
  } else {
    result.corners = {{.rounding = bounding_radius(world.bodies[static_cast<std::size_t>(contact.body)].solid)}};
  }
  if (obstacle.drive) {
    result.pose = borrowed(obstacle.drive->pose);
    result.pivot = obstacle.drive->pivot;
    result.turns = obstacle.drive->turns;
  }
  return result;
}

std::vector<RestingContact> contacts_of(const std::vector<RestingContact>& contacts, int body) {
  std::vector<RestingContact> result;
  for (const RestingContact& contact : contacts)
    if (contact.body == body) result.push_back(contact);
  return result;
}

bool are_plain(const std::vector<RestingContact>& contacts, int body) {
  return ranges::all_of(contacts, [body](const RestingContact& each) { return each.body != body || each.is_plain; });
}

bool is_plain_contact(const World& world, int body, int obstacle, const SurfacePatch& patch) {
  const Surface& surface = world.surface(body, obstacle);
  return patch.is_flat() && !world.obstacles[static_cast<std::size_t>(obstacle)].drive && surface.friction == 0.0 &&
         surface.rolling_friction == 0.0 && surface.spinning_friction == 0.0;
}

std::optional<BodyTerms<double>> contact_terms(const World& world, const Program& law,
                                               const std::vector<RestingContact>& contacts, int body, double t,
                                               const Eigen::VectorXd& q) {
  auto motion = ContactMotion::make(law, sustained_body(world, body), sustained(world, contacts, body));
  if (!motion) return std::nullopt;
  return motion->at(t, q.data());
}

std::optional<ContactLaw> law_with_contacts(const World& world, const Program& law,
                                            const std::vector<RestingContact>& contacts, int body) {
  std::vector<ContactUnknown> unknowns;
  for (const RestingContact& contact : contacts)
    if (contact.body == body) unknowns.insert(unknowns.end(), contact.unknowns.begin(), contact.unknowns.end());
  ranges::sort(unknowns, {}, &ContactUnknown::order);
  return make_contact_law(law, sustained_body(world, body), sustained(world, contacts, body), unknowns);
}

std::optional<Program> stuck_law(const World& world, const Program& law, const RestingContact& contact) {
  return make_stuck_law(law, sustained_body(world, contact.body), sustained_contact(world, contact), *contact.stuck_at);
}

}  // namespace trajet
