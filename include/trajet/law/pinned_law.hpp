#pragma once

#include <memory>
#include <vector>

#include "trajet/law/lookup_table.hpp"
#include "trajet/law/program.hpp"

namespace trajet {

/// A law whose choices by the state are made from outside: each comparison, abs, sign, min, max, floor and table that
/// functions of the state decide reads a constant, its pin, that says how it comes out. So the law is smooth across the
/// borders at which it changes, and a step that passes one can be told where.
///
/// What functions of t alone decide chooses as before, and so does what is decided by other choices.
///
/// The direction x / |x| of a vector that the state makes, as of a velocity in dry friction, is a choice too where x
/// vanishes: there it may be said from outside.
struct PinnedLaw {
  /// What one choice reads in place of what decides it.
  struct Pin {
    Opcode opcode = Opcode::sign;
    double orientation = 1.0;         ///< its own function is this times the border's
    std::vector<std::int32_t> slots;  ///< of the constants, in both programs; of a table: begin, c0, c1, c2, c3
  };
  /// A function of time and state at whose borders choices change, and the choices.
  struct Border {
    int function = 0;  ///< output of `functions`
    std::shared_ptr<const LookupTable> table{};
    bool is_floor = false;
    std::vector<Pin> pins;

    /// Whether the sign of the function decides; else the interval it lies in.
    bool is_by_sign() const { return table == nullptr && !is_floor; }
  };

  /// A vector whose direction the law reads. Its rate changes with that.
  struct Direction {
    std::vector<int> functions;      ///< outputs of `functions`: its components
    std::int32_t hold = 0;           ///< slot of a constant, in both programs: not 0, and the law reads `unit` instead
    std::vector<std::int32_t> unit;  ///< slots of constants, one for each component
  };

  Program law;        ///< inputs and outputs as those of the law
  Program functions;  ///< what decides, as the pinned law has it
  std::vector<Border> borders;
  std::vector<Direction> directions;

  /// Directions are numbered behind the borders where both are meant.
  bool is_direction(int index) const { return index >= static_cast<int>(borders.size()); }
  const Direction& direction(int index) const { return directions[static_cast<std::size_t>(index) - borders.size()]; }
};

/// Whether a choice of the law depends on the state.
bool chooses_by_state(const Program& law);

/// Without borders and directions where none does.
PinnedLaw pin_choices(const Program& law);

/// The first output of the law that the choices of a border, or a direction, change directly, or -1.
int first_output_of(const PinnedLaw& law, int border);

/// Where the function of a border lies: on a side of zero, or in an interval that it is to leave.
struct BorderSide {
  double sign = 0.0;                ///< of a border by sign: -1 or 1
  double lower = 0.0, upper = 0.0;  ///< else the interval, infinite outside of a table
  bool operator==(const BorderSide&) const = default;
};

/// The side on which the function has a value that is no border itself, or at a border the one that lies in
/// `direction`, -1 or 1.
BorderSide side_of(const PinnedLaw::Border& border, double value, double direction);

/// The constants of a pin on a side, in the order of its slots.
std::vector<double> pinned_values(const PinnedLaw::Border& border, const PinnedLaw::Pin& pin, const BorderSide& side);

}  // namespace trajet
