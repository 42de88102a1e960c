#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "trajet/law/program.hpp"
#include "trajet/math/block4.hpp"

namespace trajet::detail {

/// Where a number lies: a lane of a block, or a slot of the Program.
struct Place {
  int block = -1;  ///< -1: a slot
  int index = 0;   ///< the lane, or the slot
};

/// One operation of a BlockProgram. a, b and result are blocks; k is `constant`.
struct BlockInstruction {
  enum class Kind : std::uint8_t {
    scalar,             ///< instruction `result` of the Program, on slots
    unpack,             ///< slot `result` = lane `b` of block a
    collect,            ///< the lanes are the numbers at `places`
    permute,            ///< the lanes of a, in the order of `places`
    add,                ///< a + k b, k of 1 and -1
    multiply,           ///< a b
    multiply_constant,  ///< k a
    square,             ///< a^2
    divide,             ///< a / b
    divide_constant,    ///< a / k
    norm,               ///< in all lanes, and in `slot`, the length of the first three lanes of a
    dot,                ///< likewise the sum of the first three of a b
  };
  Kind kind = Kind::scalar;
  int result = 0;
  int a = 0;
  int b = 0;
  int slot = 0;
  Block4 constant{0.0};
  std::array<Place, 4> places{};
};

/// A law, compiled to a Program, of which what is alike in three or four neighbouring components is computed in the
/// lanes of one block: vectors as they were written, quaternions, and what several numbers have in common by chance.
///
/// It is read off the Program (`bundle`), which stays the one place in which laws are compiled; so laws that are held
/// by contacts, pinned, or written as ProgramNumbers have their vectors too. Its operations round as those of the
/// Program do. What is no sum, product, quotient or length remains an instruction of the Program, on the slots of the
/// Program; numbers are carried over where both meet.
struct BlockProgram {
  /// A block of constants, which remembers where the Program has them: another value there is another one here.
  struct Constant {
    int block;
    std::array<double, 4> lanes;
    std::array<int, 4> slots;  ///< -1: none
  };
  /// Neighbouring components of the state and their rates, as blocks; spare lanes are not defined.
  struct Group {
    int first;  ///< component
    int count;  ///< 2 … 4
    int state;  ///< block
    int rate;   ///< block
  };

  int block_count = 0;
  std::vector<Constant> constants;
  std::vector<BlockInstruction> instructions;
  std::vector<Group> groups;
  std::vector<int> single;  ///< the components in no group: in the slots of the Program
};

/// None where blocks would not pay.
std::optional<BlockProgram> bundle(const Program& program);

}  // namespace trajet::detail
