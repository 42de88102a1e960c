#include "trajet/io/report_json.hpp"

#include "record_json.hpp"
#include "trajet/sim/names.hpp"
#include "trajet/version.hpp"

namespace trajet {

namespace {

using detail::array;
using detail::Json;

Json array(const Matrix3& m) { return {array(Vector3(m.row(0))), array(Vector3(m.row(1))), array(Vector3(m.row(2)))}; }

Json array(const Quaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }

Json object(const std::vector<NamedValue>& values) {
  Json json = Json::object();
  for (const NamedValue& value : values) json[value.name] = value.value;
  return json;
}

Json object(const Impact& impact) {
  Json json = detail::impact_json(impact);
  json["angular_velocity_before"] = array(impact.angular_velocity_before);
  json["angular_velocity_after"] = array(impact.angular_velocity_after);
  json["impulse"] = array(impact.impulse);
  json["time_error_bound"] = impact.time_error_bound;
  if (impact.partner) {
    json["with_velocity_before"] = array(impact.partner->velocity_before);
    json["with_velocity_after"] = array(impact.partner->velocity_after);
    json["with_angular_velocity_before"] = array(impact.partner->angular_velocity_before);
    json["with_angular_velocity_after"] = array(impact.partner->angular_velocity_after);
  }
  if (impact.group) json["group"] = *impact.group;
  if (!impact.touched) return json;
  json["features"] = {name(impact.touched->of_body), name(impact.touched->of_obstacle)};
  for (const Vector3& point : impact.touched->points) json["points"].push_back(array(point));
  return json;
}

Json object(const UnresolvedContact& contact) {
  return {{"time", contact.time}, {"body", contact.body}, {"with", contact.with}, {"why", contact.why}};
}

Json object(const BodyState& state) {
  Json points = Json::object();
  for (const PointState& point : state.points)
    points[point.point] = {{"position", array(point.position)},
                           {"velocity", array(point.velocity)},
                           {"acceleration", array(point.acceleration)}};
  const Matrix3& R = state.rotation_matrix;
  Json json = {{"body", state.body},
               {"position", array(state.position)},
               {"velocity", array(state.velocity)},
               {"acceleration", array(state.acceleration)},
               {"orientation", array(state.orientation)},
               {"rotation_matrix", array(R)},
               {"angular_velocity", array(state.angular_velocity)},
               {"points", points}};
  if (state.position_error_bound) json["position_error_bound"] = *state.position_error_bound;
  if (state.velocity_error_bound) json["velocity_error_bound"] = *state.velocity_error_bound;
  if (state.turns) {
    json["determinant"] = R.determinant();
    json["orthogonality_error"] = (R.transpose() * R - Matrix3::Identity()).cwiseAbs().maxCoeff();
  }
  return json;
}

Json object(const ContactSpan& contact) {
  return {{"from", contact.from},
          {"to", contact.to ? Json(*contact.to) : Json()},
          {"body", contact.body},
          {"with", contact.with},
          {"mode", name(contact.mode)}};
}

}  // namespace

void write_report_json(const RunResult& result, const std::function<void(std::string_view)>& write) {
  write_report_json(result, ResultRecords(result), write);
}

void write_report_json(const RunResult& result, const RunRecords& records,
                       const std::function<void(std::string_view)>& write) {
  detail::JsonObjectWriter writer(write);
  writer.member("trajet", kVersion);
  writer.member("scene", result.scene);
  writer.member("title", result.title);
  writer.member("method", result.method);
  writer.member("status", name(result.status));
  if (result.status == RunStatus::failed) writer.member("failure", result.failure);
  writer.member("start_time", result.start_time);
  writer.member("end_time", result.end_time);
  writer.member("parameters", object(result.parameters));
  writer.array("impacts",
               [&](const auto& add) { records.each_impact([&](const Impact& impact) { add(object(impact)); }); });
  writer.array("events", [&](const auto& add) {
    records.each_event([&](const EventRecord& event) { add(detail::event_json(event)); });
  });
  writer.array("contacts", [&](const auto& add) {
    for (const ContactSpan& contact : result.contacts) add(object(contact));
  });
  writer.member("verdict", result.unresolved.empty() ? "complete" : "unresolved");
  if (!result.unresolved.empty())
    writer.array("unresolved", [&](const auto& add) {
      for (const UnresolvedContact& contact : result.unresolved) add(object(contact));
    });
  writer.array("final", [&](const auto& add) {
    for (const BodyState& state : result.final.bodies) add(object(state));
  });
  writer.member("states", object(result.final.states));
  writer.member("warnings", result.warnings);
  Json statistics = {{"steps", result.statistics.steps},
                     {"rejected_steps", result.statistics.rejected_steps},
                     {"law_evaluations", result.statistics.law_evaluations},
                     {"contact_searches", result.statistics.contact_searches},
                     {"wall_seconds", result.statistics.wall_seconds}};
  if (result.statistics.proposed_step > 0.0) statistics["proposed_step"] = result.statistics.proposed_step;
  writer.member("statistics", statistics);
  writer.finish();
}

std::string report_json(const RunResult& result) {
  std::string text;
  write_report_json(result, [&](std::string_view part) { text += part; });
  return text;
}

}  // namespace trajet
