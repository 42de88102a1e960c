// Any text as a formula: it compiles, evaluates and expands, or is refused with an InputError that points into it.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trajet/law/evaluate.hpp"
#include "trajet/law/program_builder.hpp"
#include "trajet/law/program_expansion.hpp"

using trajet::Expression;
using trajet::ProgramBuilder;

namespace {

constexpr int kDimension = 6;

trajet::Symbols make_symbols() {
  trajet::Symbols symbols;
  symbols.set_input("t", 0);
  symbols.set_inputs("v", {1, 2, 3});
  symbols.set_inputs("r", {4, 5, 6});
  symbols.set_input("x", 4);
  symbols.set_input("y", 5);
  symbols.set_constant("k", 0.5);
  symbols.set_constant("ball-1.r", trajet::Vector3(1.0, 2.0, 3.0));
  symbols.forbid("w", "w is not allowed here");
  return symbols;
}

/// Evaluates the formula as the rate of every state, and expands the motion.
void run(ProgramBuilder builder, const ProgramBuilder::Value& value) {
  for (int i = 0; i < kDimension; i += value.is_vector ? 3 : 1) builder.add_output(value);
  const trajet::Program program = builder.build();
  const std::vector<double> state{1.0, -2.0, 0.5, 0.0, 3.0, 1e3};
  std::vector<double> rates(kDimension);
  trajet::Evaluator<double> evaluate(program);
  evaluate(0.25, state.data(), rates.data());
  constexpr int kOrder = 5;
  std::vector<double> coefficients(kDimension * (kOrder + 1));
  trajet::ProgramExpansion expansion(program);
  for (const double duration : {0.5, -0.5, 0.5}) {
    expansion.expand(0.25, state.data(), kOrder, coefficients.data());
    const double until = expansion.duration_until_branch(duration);
    if (until * duration < 0.0 || std::abs(until) > std::abs(duration)) std::abort();
  }
  trajet::polynomial_degree(program);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const trajet::Symbols symbols = make_symbols();
  static const std::vector<std::string> dashed{"ball-1"};
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const Expression formula = Expression::parse(text, {"fuzz", 1, 1}, dashed);
    ProgramBuilder builder(kDimension + 1);
    const ProgramBuilder::Value value = builder.compile(formula, symbols);
    run(std::move(builder), value);
  } catch (const trajet::InputError& error) {
    // at most one place behind the last character of an existing line
    const long lines = 1 + std::count(text.begin(), text.end(), '\n');
    if (error.where().line < 1 || error.where().line > lines) std::abort();
    if (error.where().column < 1 || error.where().column > static_cast<int>(size) + 1) std::abort();
  } catch (const trajet::FileError&) {  // a table that does not exist
  }
  return 0;
}
