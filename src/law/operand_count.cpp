#include "graph.hpp"

namespace trajet::detail {

int operand_count(Opcode opcode) {
  switch (opcode) {
    case Opcode::where:
    case Opcode::norm:
      return 3;
    case Opcode::add:
    case Opcode::subtract:
    case Opcode::multiply:
    case Opcode::divide:
    case Opcode::power:
    case Opcode::atan2:
    case Opcode::min:
    case Opcode::max:
    case Opcode::less:
    case Opcode::less_equal:
    case Opcode::equal:
      return 2;
    default:
      return 1;
  }
}

}  // namespace trajet::detail
