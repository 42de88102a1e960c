#include "trajet/io/scene_overrides.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "formula_text.hpp"
#include "scene_keys.hpp"
#include "trajet/law/program_builder.hpp"
#include "trajet/portable.hpp"
#include "trajet/rigid/orientation.hpp"
#include "trajet/scene/scene_units.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet {

namespace {

detail::FormulaReader formulas_of(const Scene& scene) {
  detail::FormulaReader formulas(scene.file, scene.tables);
  for (const NamedExpression& parameter : scene.parameters) formulas.add_name(parameter.name);
  return formulas;
}

/// A parameter keeps the dimension of its text. Throws InputError where the new value has another one, warns where it
/// has none.
void keep_dimension(const Measure& before, NamedExpression& parameter, Scene& scene) {
  if (before.kind != Measure::Kind::known || !before.is_written) return;
  const std::map<std::string, Measure, std::less<>> measures = parameter_measures(scene);
  const Measure& now = measures.find(parameter.name)->second;
  const std::string fault = dimension_fault(now, before.dimension);
  if (!fault.empty()) throw InputError(parameter.where, fault);
  if (now.kind == Measure::Kind::known) return;
  if (before.dimension != kDimensionless)
    scene.warnings.push_back(parameter.where.file.str() + "=" + parameter.value.text() +
                             " has no unit, where the scene has one: taken as " + describe(before.dimension));
  if (!parameter.value.names().empty()) return;
  const auto value = evaluate_constant(parameter.value, Symbols());
  if (const auto* number = std::get_if<ExtendedConstant>(&value))
    parameter.value = Expression::quantity(*number, before.dimension, parameter.where);
}

/// LOW:HIGH or LOW:HIGH:COUNT is what other commands take.
void refuse_range(const std::string& name, const std::string& value) {
  if (value.find(':') == std::string::npos) return;
  throw InputError({"--set " + name}, "one value expected, got the range '" + value +
                                          "': many motions are computed by 'trajet sweep --vary " + name +
                                          "=LOW:HIGH:COUNT', and 'trajet aim' finds the value that hits a target");
}

std::string without_blanks_around(std::string text) {
  text.erase(0, text.find_first_not_of(" \t"));
  text.erase(text.find_last_not_of(" \t") + 1);
  return text;
}

/// A table with one key, as scene files give it; a word needs no quotation marks.
void read_key(const detail::SceneKey& key, const std::string& name, const std::string& value, const TextName& file,
              detail::FormulaReader& formulas) {
  const std::string last = name.substr(name.rfind('.') + 1);
  const auto read = [&](const std::string& text) {
    constexpr int kNoLine = 0;
    const detail::TomlDocument document(text, file, kNoLine);
    key.read({document, document.root(), "--set", {file}, formulas});
  };
  const bool is_word = ranges::all_of(
      value, [](char c) { return c == '-' || c == '#' || std::isalnum(static_cast<unsigned char>(c)) != 0; });
  const bool is_number = !value.empty() && std::isdigit(static_cast<unsigned char>(value.front())) != 0;
  read(last + " = " + (is_word && !is_number && value != "true" && value != "false" ? '"' + value + '"' : value));
}

void set_parameter(const std::string& assignment, Scene& scene) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) throw InputError({"--set"}, "NAME=VALUE expected, got '" + assignment + "'");
  const std::string name = without_blanks_around(assignment.substr(0, equals));
  const std::string value = without_blanks_around(assignment.substr(equals + 1));
  if (name.find('.') != std::string::npos) {
    const SourceLocation where{"--set " + name};
    const detail::SceneKey key = detail::find_key(scene, name, where);
    detail::FormulaReader formulas = formulas_of(scene);
    if (key.read) {
      read_key(key, name, value, where.file, formulas);
      scene.tables = formulas.tables();
      return;
    }
    refuse_range(name, value);
    Expression formula = formulas.read(value, where, key.dimension);
    formulas.read_tables(formula);
    scene.tables = formulas.tables();
    key.set(std::move(formula));
    if (name == "method.step") scene.method.steps.clear();
    return;
  }
  const auto parameter = ranges::find(scene.parameters, name, &NamedExpression::name);
  if (parameter == scene.parameters.end()) {
    std::vector<std::string_view> known;
    for (const NamedExpression& candidate : scene.parameters) known.push_back(candidate.name);
    throw InputError({"--set " + name}, "the scene has no parameter '" + name + "'" + did_you_mean(name, known));
  }
  refuse_range(name, value);
  const Measure before = parameter_measures(scene).find(name)->second;
  detail::FormulaReader formulas = formulas_of(scene);
  parameter->where = {"--set " + name};
  parameter->value = formulas.read(value, parameter->where, std::nullopt);
  formulas.read_tables(parameter->value);
  scene.tables = formulas.tables();
  keep_dimension(before, *parameter, scene);
}

}  // namespace

OrientationWay orientation_way(const std::string& name, const SourceLocation& where) {
  if (const OrientationInfo* info = find_orientation_way(name)) return info->way;
  std::vector<std::string_view> known;
  for (const OrientationInfo& each : orientation_ways()) known.push_back(each.name);
  throw InputError(
      where, "unknown way of carrying orientations '" + name + "', see 'trajet methods'" + did_you_mean(name, known));
}

void apply(const SceneOverrides& overrides, Scene& scene) {
  for (const std::string& assignment : overrides.parameters) set_parameter(assignment, scene);
  const detail::FormulaReader formulas = formulas_of(scene);
  const auto replace = [&](std::optional<Expression>& target, const std::optional<std::string>& text,
                           const char* option, Dimension dimension) {
    if (text) target = formulas.read(*text, {option}, dimension);
  };
  replace(scene.time.end, overrides.end, "--end", kTime);
  replace(scene.method.step, overrides.step, "--step", kTime);
  replace(scene.method.rtol, overrides.rtol, "--rtol", kDimensionless);
  replace(scene.method.atol, overrides.atol, "--atol", kDimensionless);
  if (overrides.step) scene.method.steps.clear();
  if (overrides.orientation) {
    scene.method.orientation_where = {"--orientation"};
    scene.method.orientation = orientation_way(*overrides.orientation, scene.method.orientation_where);
  }
  if (overrides.order) {
    scene.method.order = *overrides.order;
    scene.method.order_where = {"--order"};
  }
  if (overrides.method) {
    scene.method.name = *overrides.method;
    scene.method.where = {"--method"};
  }
}

}  // namespace trajet
