#include "trajet/io/report_json.hpp"

#include "json_text.hpp"
#include "trajet/io/names.hpp"
#include "trajet/version.hpp"

namespace trajet {

namespace {

using detail::Json;

Json array(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

Json array(const Matrix3& m) { return {array(Vector3(m.row(0))), array(Vector3(m.row(1))), array(Vector3(m.row(2)))}; }

Json array(const Quaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }

Json object(const std::vector<NamedValue>& values) {
  Json json = Json::object();
  for (const NamedValue& value : values) json[value.name] = value.value;
  return json;
}

Json object(const Impact& impact) {
  return {{"time", impact.time},
          {"body", impact.body},
          {"with", impact.with},
          {"kind", name(impact.kind)},
          {"point", array(impact.point)},
          {"normal", array(impact.normal)},
          {"position", array(impact.position)},
          {"velocity_before", array(impact.velocity_before)},
          {"velocity_after", array(impact.velocity_after)},
          {"angular_velocity_before", array(impact.angular_velocity_before)},
          {"angular_velocity_after", array(impact.angular_velocity_after)},
          {"impulse", array(impact.impulse)},
          {"time_error_bound", impact.time_error_bound}};
}

Json object(const EventRecord& event) {
  return {{"time", event.time}, {"event", event.event}, {"direction", event.direction < 0 ? "falling" : "rising"}};
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

template <class T>
Json array(const std::vector<T>& items) {
  Json json = Json::array();
  for (const T& item : items) json.push_back(object(item));
  return json;
}

}  // namespace

std::string report_json(const RunResult& result) {
  Json json = {{"trajet", kVersion},
               {"scene", result.scene},
               {"title", result.title},
               {"method", result.method},
               {"status", name(result.status)}};
  if (result.status == RunStatus::failed) json["failure"] = result.failure;
  json["start_time"] = result.start_time;
  json["end_time"] = result.end_time;
  json["parameters"] = object(result.parameters);
  json["impacts"] = array(result.impacts);
  json["events"] = array(result.events);
  json["final"] = array(result.final.bodies);
  json["states"] = object(result.final.states);
  json["warnings"] = result.warnings;
  json["statistics"] = {{"steps", result.statistics.steps},
                        {"rejected_steps", result.statistics.rejected_steps},
                        {"law_evaluations", result.statistics.law_evaluations},
                        {"wall_seconds", result.statistics.wall_seconds}};
  if (result.statistics.proposed_step > 0.0) json["statistics"]["proposed_step"] = result.statistics.proposed_step;
  return detail::json_text(json);
}

}  // namespace trajet
