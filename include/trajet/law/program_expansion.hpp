#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "trajet/law/program.hpp"
#include "trajet/math/branch.hpp"
#include "trajet/math/polynomial.hpp"
#include "trajet/portable.hpp"

namespace trajet {

namespace detail {
class BlockRows;
}

/// Taylor expansion of the solutions of dq/dt = program(t, q), whose outputs are dq/dt of its inputs behind t.
///
/// All instructions compute their n-th coefficient from those below, then the state its (n+1)-th, for n = 0, 1, …: an
/// expansion of order N costs O(N^2) per instruction. In double precision, what is alike in neighbouring components is
/// expanded together, in the lanes of blocks (src/law/block_program.hpp).
///
/// A comparison, abs, min, max, sign, floor, a table, and a length that reaches zero have a series only as long as they
/// stay on the branch taken at the start. An expansion therefore holds only up to `duration_until_branch`. Where the
/// function that decides is zero at the start, the branch is the one behind the start in the direction of the search
/// before.
///
/// `T`, double or Extended, is the type of the coefficients.
template <class T>
class ProgramExpansionT {
 public:
  static constexpr int kMaxOrder = kMaxPolynomialDegree;

  explicit ProgramExpansionT(Program program);
  ~ProgramExpansionT();
  ProgramExpansionT(const ProgramExpansionT&) = delete;  // its steps point to its rows
  ProgramExpansionT& operator=(const ProgramExpansionT&) = delete;

  int dimension() const { return static_cast<int>(program_.outputs.size()); }
  const Program& program() const { return program_; }

  /// The Taylor coefficients of the solution through (t, q) up to (time - t)^order, order 1 … kMaxOrder.
  /// Coefficients that do not exist (the root of something that vanishes) are infinite or not-a-number.
  /// `coefficients` is (dimension x order+1), column-major; column 0 becomes q.
  void expand(double t, const T* q, int order, T* coefficients);

  /// How long, up to `duration` (s, either sign), the branches of the last expansion hold. The next expansion, if it
  /// starts there from the state reached, takes those behind. 0: they do not hold at all; expand again from the same
  /// state.
  double duration_until_branch(double duration);
  /// From now on the constant in a slot is this one.
  void set_constant(std::int32_t slot, double value);
  /// Branches that t alone decides hold until the caller, who knows when they change, expands behind that time.
  void leave_branches_by_time() { leaves_branches_by_time_ = true; }

 private:
  /// Where an instruction may take another branch.
  struct Branch {
    enum class Kind {
      sign,      ///< decided by the sign of the function
      nonzero,   ///< decided by whether the function vanishes
      positive,  ///< the function is a length or a root: what continues it below zero is no longer it
      interval,  ///< decided by the interval from `lower` to `upper` that the function lies in
    };
    Kind kind = Kind::sign;
    bool is_by_time = false;  ///< t alone decides
    int function = 0;         ///< row of the function that decides
    double sign = 0.0;        ///< the sign taken by the last expansion; of an interval always 1
    double lower = 0.0, upper = 0.0;
    bool starts_at_zero = false;        ///< the last expansion started where the function is zero but for rounding
    std::optional<double> forced_sign;  ///< the next expansion starts at a zero of the function and takes this sign
    double forced_border = 0.0;         ///< of an interval: the border that is crossed
    std::array<bool, 3> refuted{};      ///< the signs -1, 0, 1 that have been tried at that zero in vain
  };

  /// An instruction with the rows of coefficients that it reads and writes.
  struct Step {
    Opcode opcode;
    T constant;
    T *a, *b, *c, *result;
    std::array<T*, 3> own;  ///< what it keeps for itself
    const LookupTable* table;
    int branch;  ///< index of its Branch, or -1
  };

  /// Where an instruction branches, if it does; its first own row is `own`. `hides_pole`: see find_hidden_poles.
  static std::optional<Branch> find_branch(const Instruction& instruction, int own, bool hides_pole);
  T* row(int index) { return rows_.data() + static_cast<std::ptrdiff_t>(index) * stride_; }
  void reserve(int order);
  /// Where the rows of each instruction are, after they have moved.
  void place_rows();
  /// Calls run(n) for n = 0 … order - 1, an int or a constant, as long as it returns true.
  template <class Run>
  static bool for_each_order(int order, Run&& run);
  /// The n-th coefficient of every instruction and the next one of the state.
  template <class Order>
  void run(Order n);
  template <class Order>
  void run_step(const Step& step, Order n);
  /// The same in blocks. At order 0, false where a length vanishes, whose series is the instructions' business.
  template <class Order>
  bool run_blocks(Order n);
  bool expand_in_blocks(const T* q, int order, T* coefficients);
  /// The coefficients of the state as the last expansion left them in blocks, in its rows.
  void unpack_state();
  void run_branch(const Step& step, Branch& branch, int n);
  double decide_sign(Branch& branch, int n);
  void decide_interval(const Step& step, Branch& branch, T x);
  /// When the branch ends, from 0 to `duration` on the axis of the rows; of an interval, at which border.
  BranchTime end_of_branch(const Branch& branch, double duration, double& border) const;
  void forget_forced_branches();
  /// Makes the next expansion start at a zero of the branch's function and take the sign behind it.
  static void force(Branch& branch, double sign, double border);
  void remember_end(double s);
  /// Whether (t, q) is where the last search for the end of a branch ended.
  bool continues_at(double t, const T* q) const;

  Program program_;
  std::vector<Step> steps_;  // one for each instruction
  std::vector<Branch> branches_;
  std::vector<int> branch_of_;                 // for each instruction: an index of branches_, or -1
  std::unique_ptr<detail::BlockRows> blocks_;  // none where they do not pay, or for Extended
  bool is_in_blocks_ = false;                  // the last expansion
  int row_count_ = 0;
  int stride_ = 0;
  /// Taylor coefficients in s = row_direction (time - start): slots of the program, then scratch; (row_count x stride)
  std::vector<T> rows_;
  double row_direction_ = 1.0;
  double direction_ = 1.0;  ///< of the next expansion: that of the last search
  int order_ = 0;
  double start_ = 0.0;
  bool leaves_branches_by_time_ = false;
  bool has_end_ = false;  ///< the last search found the end of a branch, here:
  double end_time_ = 0.0;
  std::vector<double> end_state_;      // (dimension)
  std::vector<double> end_tolerance_;  // (dimension)
};

extern template class ProgramExpansionT<double>;
extern template class ProgramExpansionT<Extended>;
using ProgramExpansion = ProgramExpansionT<double>;

}  // namespace trajet
