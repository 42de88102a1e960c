#pragma once

#include "encounters.hpp"
#include "instant.hpp"
#include "recorder.hpp"

namespace trajet {

/// What reaches an obstacle's surface from outside, and does not merely touch it.
inline bool is_hit(const ContactResult& contact) {
  return contact.status == ContactStatus::hit && contact.direction != ContactDirection::leaving;
}

/// Of a pair's contact and those at the same instant the one to handle first: one at which the body sticks; else a
/// bounce, so that what else was touched counts once, on whichever side of it the body is then.
PairId first_to_handle(const World& world, const Encounters& encounters, const Pair& contact);

/// Says that impacts of other pairs, which will not be handled, or handled otherwise, because `impact` of `handled`
/// was, may have been first as well.
void warn_of_hidden_ties(const World& world, const Encounters& encounters, const Pair& handled, const Impact& impact,
                         const Course& course, Recorder& recorder);

/// Of the contacts at the instant of a bounce those from which the body moves away already: it was there, and does not
/// bounce again. Adds what is known of their pairs; returns whether one of them stops the run.
bool settle_other_contacts(const World& world, Encounters& encounters, const Pair& handled, const Impact& impact,
                           Instant& instant, Recorder& recorder);

}  // namespace trajet
