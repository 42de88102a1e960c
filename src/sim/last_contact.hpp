#pragma once

#include <optional>

#include "trajet/collide/detect/contact.hpp"

namespace trajet {

/// So many impacts of one body at one instant are a body that cannot get away, not a motion.
inline constexpr int kMaxImpactsAtOnce = 1000;

/// What is known behind a contact that is the last one still, from which the two part: gaps up to a small part of
/// `height` (m) are of it. `known`: before that contact; where that was found at the same time already, the part is
/// larger. Nothing where it would be too large to be told from a flight.
std::optional<ContactMemory> memory_of_last_contact(const ContactResult& contact, const ContactMemory& known,
                                                    double height);

}  // namespace trajet
