#include "trajet/io/scene_schema.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "json_text.hpp"
#include "scene_tables.hpp"

namespace trajet {

namespace {

using detail::Json;
using detail::Key;
using detail::Keys;
using detail::Names;
using detail::ShapeKind;
using Form = detail::ValueForm;

Json reference(const char* name) { return {{"$ref", std::string("#/definitions/") + name}}; }

Json array_of(const Json& items, int count) {
  Json schema{{"type", "array"}, {"items", items}, {"minItems", count > 0 ? count : 1}};
  if (count > 0) schema["maxItems"] = count;
  return schema;
}

Json table_of(const Json& values) { return {{"type", "object"}, {"additionalProperties", values}}; }

Json form_schema(Form form, const Key& key) {
  switch (form) {
    case Form::text:
      return {{"type", "string"}};
    case Form::flag:
      return {{"type", "boolean"}};
    case Form::whole_number:
      return {{"type", "integer"}, {"minimum", 1}};
    case Form::word:
      return {{"enum", key.words}};
    case Form::names: {
      Json schema = array_of({{"type", "string"}}, key.count);
      if (key.count == 0) schema.erase("minItems");
      return schema;
    }
    case Form::scalar:
      return reference("scalar");
    case Form::vector:
      return reference("vector");
    case Form::formula:
      return reference("formula");
    case Form::scalars:
      return array_of(reference("scalar"), key.count);
    case Form::vectors:
      return array_of(reference("vector"), key.count);
    case Form::orientation:
      return reference("orientation");
    case Form::formulas:
      return reference("formulas");
    case Form::setting:
      return {{"type", "object"},
              {"properties", {{"set", reference("formulas")}}},
              {"required", Json::array({"set"})},
              {"additionalProperties", false}};
    case Form::named_points:
      return table_of(reference("vector"));
    case Form::parts:
      return {{"type", "array"}, {"items", reference("part")}, {"minItems", 1}};
    case Form::closed_forms:
      return reference("exact");
    case Form::table:
      return reference(std::string(key.name).c_str());
    case Form::tables:
      return {{"type", "array"}, {"items", reference(std::string(key.name).c_str())}};
  }
  return Json::object();
}

Json key_schema(const Key& key) {
  Json schema = form_schema(key.form, key);
  if (key.other_form) schema = {{"anyOf", {schema, form_schema(*key.other_form, key)}}};
  std::string description(key.meaning);
  if (key.dimension && *key.dimension != kDimensionless) description += "; " + describe(*key.dimension);
  // draft 4 ignores what stands beside a reference
  if (schema.contains("$ref")) schema = {{"allOf", Json::array({schema})}};
  schema["description"] = description;
  return schema;
}

/// A table with these keys and no others.
Json object_schema(const std::vector<Keys>& tables) {
  Json properties = Json::object(), required = Json::array();
  for (const Keys keys : tables)
    for (const Key& key : keys) {
      properties[std::string(key.name)] = key_schema(key);
      if (key.is_required) required.push_back(key.name);
    }
  Json schema{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

bool has(const Names& keys, std::string_view name) { return std::find(keys.begin(), keys.end(), name) != keys.end(); }

Json is_shape(const std::vector<std::string_view>& names) {
  return {{"properties", {{"shape", {{"enum", names}}}}}, {"required", Json::array({"shape"})}};
}

/// Adds the shapes: their keys, which of them each needs, and which shapes each key is of. Without a `shape` it is a
/// `default_shape`, or it must be said.
void add_shapes(Json& schema, const std::vector<ShapeKind>& shapes, std::string_view default_shape) {
  Names all;
  for (const ShapeKind& shape : shapes) all.push_back(shape.name);
  schema["properties"]["shape"] = {{"enum", all}, {"description", "its keys follow from it"}};
  if (default_shape.empty()) schema["required"].push_back("shape");
  Json rules = Json::array();
  for (const Key& key : detail::shape_keys()) {
    Names owners;
    for (const ShapeKind& shape : shapes)
      if (has(shape.keys, key.name)) owners.push_back(shape.name);
    if (owners.empty()) continue;
    const std::string name(key.name);
    Json& property = schema["properties"][name];
    // a key that means something else where the shape does not have it
    const bool is_of_all = !property.is_null() || owners.size() == shapes.size();
    property = property.is_null() ? key_schema(key) : Json{{"anyOf", {property, key_schema(key)}}};
    if (!is_of_all)
      rules.push_back({{"anyOf", {{{"not", {{"required", Json::array({name})}}}}, is_shape(owners)}},
                       {"description", "'" + name + "' is a key of some shapes only"}});
  }
  for (const ShapeKind& shape : shapes)
    if (!shape.required.empty())
      rules.push_back({{"anyOf", {{{"not", is_shape({shape.name})}}, {{"required", shape.required}}}},
                       {"description", "what the shape " + std::string(shape.name) + " needs"}});
  schema["allOf"] = rules;
}

Json definitions() {
  const Json scalar{{"anyOf", {{{"type", "number"}}, {{"type", "string"}}}},
                    {"description", "a number (SI), a quantity such as \"5 m/s\", or a formula"}};
  const Json vector{{"anyOf", {array_of(reference("scalar"), 3), {{"type", "string"}}}},
                    {"description", "three numbers, quantities or formulas, or one formula of a vector"}};
  Json all{{"scalar", scalar},
           {"vector", vector},
           {"formula", {{"anyOf", {reference("scalar"), reference("vector")}}}},
           // `ball.v = …` is a table in a table
           {"formulas", table_of({{"anyOf", {reference("formula"), table_of(reference("formula"))}}})},
           {"orientation", object_schema({detail::orientation_keys()})}};
  const Json closed_form{{"anyOf", {reference("formula"), reference("orientation")}}};
  all["exact"] = table_of({{"anyOf", {closed_form, table_of(closed_form)}}});
  all["time"] = object_schema({detail::time_keys()});
  all["method"] = object_schema({detail::method_keys()});
  all["state"] = object_schema({detail::state_keys()});
  all["event"] = object_schema({detail::event_keys()});
  all["pair"] = object_schema({detail::pair_keys(), detail::friction_keys()});
  all["body"] = object_schema({detail::body_keys(), detail::friction_keys()});
  add_shapes(all["body"], detail::body_shapes(), "point");
  all["obstacle"] = object_schema({detail::obstacle_keys(), detail::friction_keys()});
  add_shapes(all["obstacle"], detail::obstacle_shapes(), "");
  all["part"] = object_schema({detail::part_keys()});
  add_shapes(all["part"], detail::part_shapes(), "");
  return all;
}

}  // namespace

std::string scene_schema_json() {
  Json schema{{"$schema", "http://json-schema.org/draft-04/schema#"},
              {"title", "a scene of trajet"},
              {"description", "docs/formats/scene.md"}};
  schema.update(object_schema({detail::scene_keys()}));
  schema["definitions"] = definitions();
  return detail::json_text(schema);
}

}  // namespace trajet
