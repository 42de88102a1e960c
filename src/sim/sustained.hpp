#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "trajet/collide/sustain/contact_decision.hpp"
#include "trajet/collide/sustain/contact_law.hpp"
#include "trajet/collide/sustain/resting_contact.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// A body as its lasting contacts see it.
SustainedBody sustained_body(const World& world, int body);
/// A vertex of a core, as one of the body that touches.
SupportCorner support_corner(const ConvexCore& core, int vertex);
/// A lasting contact as its law sees it. Corners are in the order of the core's vertices.
SustainedContact sustained_contact(const World& world, const RestingContact& contact);

/// Those of several contacts that are of one body.
std::vector<RestingContact> contacts_of(const std::vector<RestingContact>& contacts, int body);
/// Whether all of a body's contacts only hold it back along constant normals.
bool are_plain(const std::vector<RestingContact>& contacts, int body);
/// Whether a contact on that patch of an obstacle would.
bool is_plain_contact(const World& world, int body, int obstacle, const SurfacePatch& patch);

/// How a body moves at its contacts in a state, without their forces; none where that cannot be computed.
std::optional<BodyTerms<double>> contact_terms(const World& world, const Program& law,
                                               const std::vector<RestingContact>& contacts, int body, double t,
                                               const Eigen::VectorXd& q);

/// The law of a group with the forces of the body's contacts, and what ends them: their `contact` counts the body's.
std::optional<ContactLaw> law_with_contacts(const World& world, const Program& law,
                                            const std::vector<RestingContact>& contacts, int body);

/// The law of a group in which a body sticks to an obstacle; none where the obstacle moves by what has no derivative.
std::optional<Program> stuck_law(const World& world, const Program& law, const RestingContact& contact);

}  // namespace trajet
