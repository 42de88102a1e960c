#pragma once

#include <array>
#include <optional>
#include <vector>

#include "block_program.hpp"
#include "trajet/law/program.hpp"

namespace trajet::detail {

/// Slots of a Program that are to lie beside each other, one a lane; -1: a spare lane. Beside the Program's own slots
/// there are constants that it has in none, and negatives: -x of a slot x, which its signs make cheap.
using Lanes = std::array<int, 4>;

/// Reads a Program lane by lane: whether one operation on blocks computes four slots, and of what.
class LaneReader {
 public:
  /// Keeps a reference to the program.
  explicit LaneReader(const Program& program);

  /// An operation and the lanes that it needs; `b` where it has two operands.
  struct Operation {
    BlockInstruction::Kind kind = BlockInstruction::Kind::add;
    Lanes a{-1, -1, -1, -1};
    Lanes b{-1, -1, -1, -1};
    Block4 constant{1.0};
    int replaced = 0;  ///< the instructions of the Program that it does the work of
  };
  /// What computes these lanes. Lanes whose instructions differ meet where a constant makes them alike, to the last
  /// bit: x is 1 x and x + -0, -x is -0 - x.
  std::optional<Operation> operation(const Lanes& lanes);

  /// The length of a vector, or the product of two: what a slot has of three lanes. The same as its instructions.
  std::optional<Operation> reduction(int slot);

  /// Components of the state, and their rates.
  Lanes inputs(int first, int count) const;
  Lanes outputs(int first, int count) const;
  /// The same slot in all lanes if it is the only one.
  static Lanes spread(Lanes lanes);
  static int count_distinct(const Lanes& lanes);

  /// A negative has no instruction and no place of its own.
  static bool is_negative(int slot) { return slot >= kNegative; }
  static bool has_negative(const Lanes& lanes);
  bool is_constant(int slot) const;
  bool are_constant(const Lanes& lanes) const;
  /// The values of constants, 0 in spare lanes.
  std::array<double, 4> values(const Lanes& lanes) const;
  /// The slots that the Program has for constants, else -1.
  std::array<int, 4> constant_slots(const Lanes& lanes) const;
  /// Whether they are inputs in their order.
  bool are_neighbouring_inputs(const Lanes& lanes) const;
  /// The instruction that computes the slot; -1: none.
  int producer(int slot) const { return producer_[static_cast<std::size_t>(slot)]; }

 private:
  static constexpr int kNegative = 1 << 28;  // added to the slot
  static int negative_of(int slot) { return slot + kNegative; }

  /// A way to have a number as a sum: a + sign b.
  struct Sum {
    int a = -1;
    int b = -1;
    double sign = 1.0;
  };

  const Instruction* instruction(int slot) const;
  /// A constant that the Program has in no slot.
  int literal(double value);
  /// What may stand in the lanes of one block: the same number for kinds of computations that can be made alike.
  int kind_of(int slot) const;
  double likeness(int a, int b) const;
  /// How like a negative is to what may be anything.
  double likeness_of_negative(int slot, int other) const;
  std::vector<Sum> ways_to_sum(int slot);

  std::optional<Operation> product(const Lanes& lanes);
  std::optional<Operation> quotient(const Lanes& lanes);
  std::optional<Operation> sum(const Lanes& lanes);
  std::optional<Operation> multiple(const Lanes& lanes);
  /// Appends the terms of a sum of three products, those of a sum within it first; false if it is anything else.
  bool collect_terms(int slot, std::vector<int>& terms) const;
  /// Swaps operands that may be swapped so that each is like that of a lane in which they may not, or of the first.
  void align(Operation& operation, const Lanes& swappable) const;

  const Program& program_;
  std::vector<int> producer_;
  std::vector<bool> is_constant_;
  std::vector<double> values_;  // of constants, those of the program and then the literals
};

}  // namespace trajet::detail
