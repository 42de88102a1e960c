#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <utility>
#include <vector>

#include "block_program.hpp"
#include "block_steps.hpp"
#include "trajet/math/block4.hpp"
#include "trajet/math/force_inline.hpp"

namespace trajet::detail {

/// A BlockProgram with the rows of coefficients of its blocks, ready to run.
class BlockRows {
 public:
  /// Points to the coefficients of a slot of the Program.
  using SlotRow = std::function<double*(int slot)>;

  explicit BlockRows(BlockProgram program) : program_(std::move(program)) {}

  /// For power series: rows of `stride` coefficients; the state is integrated.
  void place_series(int stride, const SlotRow& slot_row);
  /// For rates, the coefficients of order 0: the blocks of the groups' states are read at `state`, those of their rates
  /// written at `rate`.  // (groups) each
  void place_rates(Block4* state, Block4* rate, const SlotRow& slot_row);
  /// From now on the constant in a slot of the Program is this one.
  void set_constant(int slot, double value);

  const BlockProgram& program() const { return program_; }

  /// See run_block_steps.
  template <class Order, class Scalar>
  TRAJET_INLINE bool run(Order n, double factor, Scalar&& scalar) {
    return run_block_steps(steps_, sources_, row(first_), n, factor, std::forward<Scalar>(scalar));
  }

  /// The components that have blocks, between a state and blocks beside each other, one a group.
  void pack(const double* q, Block4* blocks) const;
  void unpack(const Block4* blocks, double* q) const;

  void set_state(const double* q);
  /// The series of the state, in s = direction (time - start), as those in the time: column-major, and as rows in s.
  void write_state(int order, int dimension, double direction, double* coefficients) const;
  void unpack_state(int order, const SlotRow& component_row) const;

 private:
  Block4* row(int block) { return rows_[static_cast<std::size_t>(block)]; }
  const Block4* row(int block) const { return rows_[static_cast<std::size_t>(block)]; }

  void allocate(int stride);
  void add_step(const BlockInstruction& i, const SlotRow& slot_row);
  void add_sources(const BlockInstruction& i, const SlotRow& slot_row);
  /// Whether an instruction makes the block.
  bool is_made(int block) const { return is_made_[static_cast<std::size_t>(block)]; }
  bool is_state(int block) const;

  BlockProgram program_;
  std::vector<Block4> storage_;
  std::vector<Block4*> rows_;  // of each block
  std::vector<bool> is_made_;
  int first_ = 0;   // the block that is the newest before the first step
  int newest_ = 0;  // … and after the last one so far
  std::vector<BlockStep> steps_;
  std::vector<Sources> sources_;
};

}  // namespace trajet::detail
