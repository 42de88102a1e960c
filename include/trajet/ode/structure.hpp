#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trajet/math/dependence.hpp"

namespace trajet {

/// Which components of the state the rate of each component depends on, whatever the state: read off the law, not off
/// numbers. Time is no component; every rate may depend on it.
struct Structure {
  struct Rate {
    std::vector<int> uses;       ///< components, in increasing order
    std::optional<int> copy_of;  ///< dq_i/dt = q_j and nothing else: j
  };
  std::vector<Rate> rates;  ///< one a component

  int dimension() const { return static_cast<int>(rates.size()); }
  const Rate& operator[](int component) const { return rates[static_cast<std::size_t>(component)]; }
};

/// The structure of a law that is callable as law(t, q, dq) on Eigen vectors of Dependence. A law that decides by `if`
/// does not show it: each of its rates then counts as using every component.
template <class Law>
Structure structure_of(const Law& law, int dimension) {
  using State = Eigen::Matrix<Dependence, Eigen::Dynamic, 1>;
  State q(dimension), dq(dimension);
  for (int i = 0; i < dimension; ++i) q[i] = Dependence::on(i);
  DependenceComparison::met = false;
  law(Dependence(), q, dq);
  Structure structure;
  for (const Dependence& rate : dq) structure.rates.push_back({rate.inputs(), rate.input()});
  if (DependenceComparison::met) {
    std::vector<int> all(static_cast<std::size_t>(dimension));
    std::iota(all.begin(), all.end(), 0);
    for (Structure::Rate& rate : structure.rates) rate = {all, std::nullopt};
  }
  return structure;
}

/// Why a method cannot solve problems of a structure, and the component whose rate is the reason.
struct Unsuitable {
  int component;
  std::string reason;  ///< about that rate: "depends on …"
};

/// The components by levels: the rates of level 0 depend on time alone, those of each further level on levels below.
/// So all of them are integrals of functions that are known beforehand: a(t) first, then v(t).
using Levels = std::vector<std::vector<int>>;

/// The levels of a structure, or, where a component depends on itself in a circle, why there are none.
struct LevelsResult {
  Levels levels;
  std::optional<Unsuitable> unsuitable;
};
LevelsResult find_levels(const Structure& structure);

/// The two parts of a system of the form dr/dt = f(v, t), dv/dt = a(r, t): `is_position[i]` says which part component i
/// is of.
struct PartsResult {
  std::vector<bool> is_position;
  std::optional<Unsuitable> unsuitable;
};
PartsResult find_parts(const Structure& structure);

}  // namespace trajet
