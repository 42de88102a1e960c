#include "scene_names.hpp"

#include <algorithm>
#include <map>

#include "trajet/portable.hpp"
#include "trajet/text/did_you_mean.hpp"
#include "trajet/text/name.hpp"

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

/// NAME(-NAME)*, where what follows a dash may start with a digit.
bool is_name(std::string_view text) {
  std::size_t length = name_length(text);
  if (length == 0) return false;
  while (length < text.size()) {
    const std::size_t next = text[length] == '-' ? 1 : name_character_length(text.substr(length));
    if (next == 0) return false;
    length += next;
  }
  return true;
}

/// A title in one line: events are named in tables and lists only.
bool is_title(std::string_view text) {
  const bool is_bare = !text.empty() && text.front() != ' ' && text.back() != ' ';
  return is_bare && ranges::none_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
}

void add(Names& names, const std::string& name, std::string_view kind, const SourceLocation& where) {
  const auto [place, is_new] = names.try_emplace(name, NameUse{kind, where});
  if (is_new) return;
  const NameUse& first = place->second;
  const std::string line = first.where.line > 0 ? " in line " + std::to_string(first.where.line) : "";
  throw InputError(where, "the name '" + name + "' is already that of the " + std::string(first.kind) + line);
}

void add_name(Names& names, const std::string& name, std::string_view kind, const SourceLocation& where) {
  if (!is_name(name))
    throw InputError(
        where, "'" + name + "' is no name: letters, digits, '_' and '-' expected, not starting with a digit or '-'");
  add(names, name, kind, where);
}

void add_usable_in_laws(Names& names, const std::string& name, std::string_view kind, const SourceLocation& where,
                        bool has_bodies) {
  const bool is_own = has_bodies && ranges::find(kOwnNames, name) != std::end(kOwnNames);
  if (is_own || is_reserved_name(name))
    throw InputError(where, "the name '" + name + "' is reserved: it has a meaning in expressions" +
                                std::string(is_own ? " of bodies" : ""));
  add_name(names, name, kind, where);
}

/// Throws unless `name` is an extra state or BODY.PART.
void check_target(const Scene& scene, const std::string& target, const SourceLocation& where,
                  std::span<const std::string_view> parts) {
  std::vector<std::string> known;
  for (const StateDefinition& state : scene.states) known.push_back(state.name);
  for (const BodyDefinition& body : scene.bodies)
    for (const std::string_view part : parts) known.push_back(body.name + "." + std::string(part));
  if (ranges::find(known, target) != known.end()) return;
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
    add_name(solid_names, obstacle.name, "obstacle", obstacle.where);

  Names event_names;
  for (const EventDefinition& event : scene.events) {
    if (!is_title(event.name))
      throw InputError(event.where, "'" + event.name + "' is no name of an event: some text in one line expected");
    add(event_names, event.name, "event", event.where);
    for (const NamedExpression& target : event.set) check_target(scene, target.name, target.where, kSetParts);
  }

  for (const NamedExpression& closed_form : scene.exact)
    check_target(scene, closed_form.name, closed_form.where, kExactParts);
  for (const ExactOrientation& closed_form : scene.exact_orientations)
    check_target(scene, closed_form.name, closed_form.where, kExactParts);
  if (!has_bodies && scene.states.empty())
    throw InputError({scene.file, 1, 1}, "nothing moves in this scene: a [[body]] or a [[state]] expected");
}

}  // namespace trajet::detail
