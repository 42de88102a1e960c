#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "trajet/ensemble/flight_extremes.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

/// What a column has in a row: nothing, where the motion has none (an impact that did not happen); a number, SI; or a
/// word, such as the name of what was hit.
using Cell = std::variant<std::monostate, double, std::string>;

/// The parts of a list between its outermost commas, without blanks around them.
std::vector<std::string> split_columns(std::string_view list);

/// What is reported of each motion of a sweep: expressions over its end, its impacts and its extremes.
///
/// As in the scene's laws: the parameters, `t`, extra states, `ball.x`, `norm(ball.v)`; `ball.speed`; of a scene with
/// one body also `x`, `speed`. They are those at the end of the motion. Further:
/// - `impact(2).t`: of the second impact (hits and grazes, from 1) `t`, `x y z` and `r` of the point of contact, `vx vy
///   vz`, `v` and `speed` of the body before it, and by their names in reports `point`, `normal`, `position`,
///   `velocity_before`, `velocity_after`, `angular_velocity_before`, `angular_velocity_after`, `impulse`;
/// - `max(EXPR)`, `min(EXPR)`: the largest and the smallest value over the whole motion;
/// - words: `hit`, the name of what was hit first; `status`; `impact(2).with`, `.body`, `.kind`. Alone they are columns
/// of
///   words; compared with a text, as in `hit == 'target'`, they are conditions, 1 or 0.
class ReportColumns {
 public:
  /// `scene` is that of any of the motions: it gives the names. Throws InputError at `where`.
  ReportColumns(std::vector<std::string> texts, const Scene& scene, const SourceLocation& where);
  ~ReportColumns();
  ReportColumns(ReportColumns&&) noexcept;

  /// As they were written.
  const std::vector<std::string>& texts() const { return texts_; }
  bool is_word(std::size_t column) const;
  /// Whether the column is 1 or 0.
  bool is_condition(std::size_t column) const;

  /// The extremes that columns need, which an observer of each run must follow.
  const ExtremeList& extremes() const;

  /// Computes the cells of motions one after the other; each thread has one of its own. The columns outlive it.
  class Reader {
   public:
    explicit Reader(const ReportColumns& columns);
    ~Reader();
    /// Of a motion that failed: no cells but its status.  // extremes: those of the flight
    std::vector<Cell> operator()(const RunResult& result, std::span<const double> extremes);

   private:
    class State;
    std::unique_ptr<State> state_;
  };

 private:
  class Compiled;
  std::vector<std::string> texts_;
  std::unique_ptr<const Compiled> compiled_;
};

/// What was hit first; null if nothing was.
const Impact* first_hit(const RunResult& result);

/// The columns of a sweep that asks for none: the end time, the final state, the first impact where there can be one.
std::vector<std::string> default_columns(const Scene& scene);

}  // namespace trajet
