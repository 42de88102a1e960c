#include "record_json.hpp"

#include "trajet/sim/names.hpp"

namespace trajet::detail {

Json array(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

Json impact_json(const Impact& impact) {
  return {{"time", impact.time},
          {"body", impact.body},
          {"with", impact.with},
          {"kind", name(impact.kind)},
          {"point", array(impact.point)},
          {"normal", array(impact.normal)},
          {"position", array(impact.position)},
          {"velocity_before", array(impact.velocity_before)},
          {"velocity_after", array(impact.velocity_after)}};
}

Json event_json(const EventRecord& event) {
  Json json = {{"time", event.time}, {"event", event.event}, {"direction", event.direction < 0 ? "falling" : "rising"}};
  if (!event.law.empty()) json["law"] = event.law;
  return json;
}

}  // namespace trajet::detail
