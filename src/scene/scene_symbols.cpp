#include "scene_symbols.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <variant>

#include "trajet/law/program_builder.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

/// Evaluates each parameter after those it uses.
class ParameterEvaluation {
 public:
  ParameterEvaluation(const Scene& scene, Symbols& symbols) : symbols_(symbols) {
    for (const NamedExpression& parameter : scene.parameters) by_name_.emplace(parameter.name, &parameter);
  }

  void evaluate(const NamedExpression& parameter) {
    State& state = states_[&parameter];
    if (state == State::done) return;
    if (state == State::open)
      throw InputError(parameter.value.where(), "parameter '" + parameter.name + "' depends on itself");
    state = State::open;
    for (const std::string& name : parameter.value.names()) {
      const auto used = by_name_.find(name);
      if (used != by_name_.end()) evaluate(*used->second);
    }
    define(parameter);
    states_[&parameter] = State::done;
  }

 private:
  enum class State { untouched, open, done };

  void define(const NamedExpression& parameter) {
    const auto value = evaluate_constant(parameter.value, symbols_);
    const auto is_finite = [](const ExtendedConstant& number) { return std::isfinite(number.value); };
    const auto* vector = std::get_if<Symbols::ConstantVector>(&value);
    const bool finite =
        vector == nullptr ? is_finite(std::get<ExtendedConstant>(value)) : ranges::all_of(*vector, is_finite);
    if (!finite) throw InputError(parameter.value.where(), "parameter '" + parameter.name + "' is not a finite number");
    std::visit([&](const auto& number) { symbols_.set_constant(parameter.name, number); }, value);
  }

  Symbols& symbols_;
  std::map<std::string_view, const NamedExpression*> by_name_;
  std::map<const NamedExpression*, State> states_;
};

/// Names that change with time have no place in a constant; say so instead of "unknown".
void forbid_time_dependent_names(const Scene& scene, Symbols& symbols) {
  const std::string where = " changes with time: only laws, rates and events may use it";
  symbols.forbid("t", "t" + where);
  for (const BodyDefinition& body : scene.bodies) {
    const auto forbid = [&](const std::string& name) { symbols.forbid(name, name + where); };
    for (const BodyPart& part : kBodyParts) forbid(body.name + "." + part.name);
    for (const char* name : kRotationNames) forbid(body.name + "." + name);
  }
  for (const StateDefinition& state : scene.states) symbols.forbid(state.name, state.name + where);
}

}  // namespace

const BodyPart* find_body_part(std::string_view name) {
  for (const BodyPart& part : kBodyParts)
    if (name == part.name) return &part;
  return nullptr;
}

ParameterSet evaluate_parameters(const Scene& scene) {
  ParameterSet set;
  for (const auto& [name, table] : scene.tables) set.symbols.set_table(name, table);
  forbid_time_dependent_names(scene, set.symbols);
  ParameterEvaluation evaluation(scene, set.symbols);
  for (const NamedExpression& parameter : scene.parameters) evaluation.evaluate(parameter);
  for (const NamedExpression& parameter : scene.parameters) {
    const Symbols::Meaning& meaning = *set.symbols.find(parameter.name);
    if (const auto* number = std::get_if<ExtendedConstant>(&meaning)) {
      set.values.push_back({parameter.name, number->value});
    } else {
      const auto& vector = std::get<Symbols::ConstantVector>(meaning);
      for (std::size_t i = 0; i < 3; ++i) set.values.push_back({parameter.name + "." + "xyz"[i], vector[i].value});
    }
  }
  return set;
}

void add_body_symbols(Symbols& symbols, const std::string& prefix, int input) {
  for (const BodyPart& part : kBodyParts) {
    const int first = input + part.first;
    if (part.size == 3)
      symbols.set_inputs(prefix + part.name, {first, first + 1, first + 2});
    else
      symbols.set_input(prefix + part.name, first);
  }
}

}  // namespace trajet
