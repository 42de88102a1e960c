#pragma once

#include <optional>
#include <vector>

#include "trajet/law/evaluate.hpp"
#include "trajet/law/program.hpp"
#include "trajet/math/interval.hpp"

namespace trajet {

/// The times at which a law takes another branch whatever the state: where a comparison, abs, sign, min, max or floor
/// of functions of t alone switches, and where such a function comes to the next interval of a table.
class TimeSwitches {
 public:
  explicit TimeSwitches(const Program& law);

  bool empty() const { return functions_.empty(); }
  /// Whether the law may jump at a switch; else it has corners at most.
  bool may_jump() const { return may_jump_; }

  /// A stretch of time on which none of the branches changes, s.
  struct Piece {
    double first;    ///< the law's branches are those of the piece from here …
    double last;     ///< … to here; between this and `end` is the rounding of the switch
    double end;      ///< the next switch, or where the search ended
    bool is_switch;  ///< whether there is one at `end`
  };
  /// From time `from` on, at which a switch may be, towards `to`.
  Piece piece(double from, double to);

 private:
  struct Function {
    Program program;  // one output: what decides
    const LookupTable* table = nullptr;
    bool is_floor = false;
    std::vector<double> borders(double value) const;
  };

  void search(const Function& function, double border, double from, Piece& piece);

  std::vector<Function> functions_;
  bool may_jump_ = false;
  std::vector<double> no_state_;
  std::vector<IntervalJet> no_state_enclosed_;
};

}  // namespace trajet
