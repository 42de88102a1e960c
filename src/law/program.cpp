#include "trajet/law/program.hpp"

#include <algorithm>

#include "trajet/law/evaluate.hpp"
#include "trajet/math/polynomial_degree.hpp"

namespace trajet {

int polynomial_degree(const Program& program) {
  // Solutions of a higher degree exist, but no Segment holds them.
  constexpr int kHighest = 64;
  const auto dimension = program.outputs.size();
  std::vector<PolynomialDegree> q(dimension), rate(dimension);
  Evaluator<PolynomialDegree> evaluate(program);
  // Degrees only grow from pass to pass, so that a circle of dependences climbs until it is given up.
  for (bool changed = true; changed;) {
    changed = false;
    evaluate(PolynomialDegree::of(1), q.data(), rate.data());
    for (std::size_t i = 0; i < dimension; ++i) {
      if (rate[i].degree() >= kHighest) return -1;
      // deg q_i = deg(dq_i/dt) + 1
      if (rate[i].degree() + 1 <= q[i].degree()) continue;
      q[i] = PolynomialDegree::of(rate[i].degree() + 1);
      changed = true;
    }
  }
  int highest = 0;
  for (const PolynomialDegree& component : q) highest = std::max(highest, component.degree());
  return highest;
}

std::vector<int> read_components(const Program& program) {
  std::vector<bool> is_read(static_cast<std::size_t>(program.slot_count), false);
  for (const Instruction& instruction : program.instructions)
    for (const int slot : {instruction.a, instruction.b, instruction.c}) is_read[static_cast<std::size_t>(slot)] = true;
  for (const int slot : program.outputs) is_read[static_cast<std::size_t>(slot)] = true;
  std::vector<int> components;
  for (int slot = 1; slot < program.input_count; ++slot)
    if (is_read[static_cast<std::size_t>(slot)]) components.push_back(slot - 1);
  return components;
}

}  // namespace trajet
