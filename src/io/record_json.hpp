#pragma once

#include "json_text.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet::detail {

Json array(const Vector3& v);

/// An impact: when and where what met what, and how fast before and after.
Json impact_json(const Impact& impact);
Json event_json(const EventRecord& event);

}  // namespace trajet::detail
