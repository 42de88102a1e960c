#include "scene_names.hpp"

#include <algorithm>
#include <map>

#include "trajet/text/did_you_mean.hpp"

namespace trajet::detail {

namespace {

/// What a name stands for, and where it was given.
struct NameUse {
  std::string_view kind;
  SourceLocation where;
};
using Names = std::map<std::string, NameUse, std::less<>>;

/// Names that mean something in a body's own laws.
constexpr std::string_view kOwnNames[] = {"r",   "v",   "w",   "x",      "y",   "z",   "vx",  "vy", "vz",
                                          "wx",  "wy",  "wz",  "w_body", "qw",  "qx",  "qy",  "qz", "Rxx",
                                          "Rxy", "Rxz", "Ryx", "Ryy",    "Ryz", "Rzx", "Rzy", "Rzz"};
/// Parts of a body that `set` may change, and those that `exact` gives.
constexpr std::string_view kSetParts[] = {"r", "v", "x", "y", "z", "vx", "vy", "vz", "w"};
constexpr std::string_view kExactParts[] = {"r", "v", "w", "w_body", "orientation"};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_name_character(char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '-'; }

void add(Names& names, const std::string& name, std::string_view kind, const SourceLocation& where) {
  if (name.empty() || !is_letter(name.front()) || !std::ranges::all_of(name, is_name_character))
    throw InputError(
        where, "'" + name + "' is no name: letters, digits, '_' and '-' expected, not starting with a digit or '-'");
  const auto [place, is_new] = names.try_emplace(name, NameUse{kind, where});
  if (is_new) return;
  const NameUse& first = place->second;
  throw InputError(where, "the name '" + name + "' is already that of the " + std::string(first.kind) + " in line " +
                              std::to_string(first.where.line));
}

void add_usable_in_laws(Names& names, const std::string& name, std::string_view kind, const SourceLocation& where,
                        bool has_bodies) {
  const bool is_own = has_bodies && std::ranges::find(kOwnNames, name) != std::end(kOwnNames);
  if (is_own || is_reserved_name(name))
    throw InputError(where, "the name '" + name + "' is reserved: it has a meaning in expressions" +
                                std::string(is_own ? " of bodies" : ""));
  add(names, name, kind, where);
}

/// Throws unless `name` is an extra state or BODY.PART.
void check_target(const Scene& scene, const std::string& target, const SourceLocation& where,
                  std::span<const std::string_view> parts) {
  std::vector<std::string> known;
  for (const StateDefinition& state : scene.states) known.push_back(state.name);
  for (const BodyDefinition& body : scene.bodies)
    for (const std::string_view part : parts) known.push_back(body.name + "." + std::string(part));
  if (std::ranges::find(known, target) != known.end()) return;
  const std::vector<std::string_view> views(known.begin(), known.end());
  throw InputError(where,
                   "'" + target + "' is neither an extra state nor a part of a body" + did_you_mean(target, views));
}

}  // namespace

void check_names(const Scene& scene) {
  const bool has_bodies = !scene.bodies.empty();
  Names law_names;
  for (const NamedExpression& parameter : scene.parameters)
    add_usable_in_laws(law_names, parameter.name, "parameter", parameter.where, has_bodies);
  for (const StateDefinition& state : scene.states)
    add_usable_in_laws(law_names, state.name, "state", state.where, has_bodies);
  for (const BodyDefinition& body : scene.bodies)
    add_usable_in_laws(law_names, body.name, "body", body.where, has_bodies);

  Names solid_names;
  for (const BodyDefinition& body : scene.bodies) add(solid_names, body.name, "body", body.where);
  for (const ObstacleDefinition& obstacle : scene.obstacles)
    add(solid_names, obstacle.name, "obstacle", obstacle.where);

  Names event_names;
  for (const EventDefinition& event : scene.events) {
    add(event_names, event.name, "event", event.where);
    for (const NamedExpression& target : event.set) check_target(scene, target.name, target.where, kSetParts);
  }

  for (const NamedExpression& closed_form : scene.exact)
    check_target(scene, closed_form.name, closed_form.where, kExactParts);
  for (const ExactOrientation& closed_form : scene.exact_orientations)
    check_target(scene, closed_form.name, closed_form.where, kExactParts);
}

}  // namespace trajet::detail
