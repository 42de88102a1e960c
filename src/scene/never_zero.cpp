#include "never_zero.hpp"

#include <algorithm>
#include <vector>

#include "trajet/law/evaluate.hpp"
#include "trajet/math/interval.hpp"
#include "trajet/portable.hpp"

namespace trajet {

bool never_crosses_zero(const Program& program) {
  // of a power by logarithms, the enclosure holds for positive bases only
  const auto is_power = [](const Instruction& each) {
    return each.opcode == Opcode::power || each.opcode == Opcode::power_constant;
  };
  if (ranges::any_of(program.instructions, is_power)) return false;
  const Interval anything = Interval::whole();
  const std::vector<Interval> state(static_cast<std::size_t>(program.input_count - 1), anything);
  Interval value;
  Evaluator<Interval> evaluate(program);
  evaluate(anything, state.data(), &value);
  const double least = value.lower(), most = value.upper();
  return least > 0.0 || most < 0.0 || (least == 0.0 && most == 0.0);
}

}  // namespace trajet
