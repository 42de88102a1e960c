#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "trajet/law/program.hpp"
#include "trajet/math/block4.hpp"

namespace trajet {

namespace detail {
class BlockRows;
}

/// Evaluates dq/dt = program(t, q), whose outputs are dq/dt of its inputs behind t, on plain numbers: what is alike in
/// neighbouring components together, in the lanes of blocks (src/law/block_program.hpp). The results are those of
/// `Evaluator<double>`, to the last bit where the compiler rounds both alike. One evaluator serves one thread at a
/// time.
class RateEvaluator {
 public:
  /// Keeps a pointer to the program.
  explicit RateEvaluator(const Program& program);
  ~RateEvaluator();

  /// q and dq do not overlap.  // (outputs of the program) each
  void operator()(double t, const double* q, double* dq);
  /// From now on the constant in a slot is another one than the program's.
  void set_constant(std::int32_t slot, double value);

  /// For each component the lane in which it lies in `state` and `rate`; empty where the law has no blocks, or numbers
  /// that are in none.
  const std::vector<int>& lanes() const { return lanes_; }
  /// For a multiple of four blocks, 64 bytes aligned.
  Block4* state() { return state_.data()->data(); }
  const Block4* rate() const { return rate_.data()->data(); }
  /// Computes `rate` at (t, `state`).
  void evaluate_blocks(double t);

 private:
  struct alignas(64) FourBlocks : std::array<Block4, 4> {};

  void run_blocks();

  const Program* program_;
  std::vector<double> slots_;
  std::unique_ptr<detail::BlockRows> blocks_;  // none: on the slots alone
  std::vector<FourBlocks> state_, rate_;
  std::vector<int> lanes_;
};

}  // namespace trajet
