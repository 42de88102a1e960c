#pragma once

#include <cstdint>
#include <vector>

#include "trajet/law/program.hpp"

namespace trajet::detail {

/// A vector x(t, q) of whose direction x / |x| a law makes its rates, among them those of x itself: dry friction
/// `-mu*g*unit(v)`. Where x vanishes the direction may be any within the unit ball.
struct LawDirection {
  std::vector<std::int32_t> components;  ///< slots of x; what is the constant 0 is left out
  std::int32_t hold = 0;                 ///< slot of a constant: not 0, and the law reads `unit` in place of x / |x|
  std::vector<std::int32_t> unit;        ///< slots of constants, one for each component
};

/// A law whose directions can be said from outside.
struct DirectedLaw {
  Program law;  ///< as the law it was made of, while every `hold` is 0
  std::vector<LawDirection> directions;
};

/// Finds x_i / |x| and multiples of it, as (k x_i) / |x| and (k / |x|) x_i.
DirectedLaw open_directions(const Program& law);

}  // namespace trajet::detail
