#pragma once

#include <cstddef>
#include <vector>

#include "trajet/law/evaluate.hpp"
#include "trajet/math/interval.hpp"

namespace trajet {

/// A program of t and the state, of one output, as a ComposedFunction takes it: on enclosures of the components that it
/// reads.
struct ProgramFunction {
  Evaluator<IntervalJet>* evaluator;
  const std::vector<int>* inputs;  ///< components of the state
  std::vector<IntervalJet>* state;

  template <class Components>
  IntervalJet operator()(const IntervalJet& t, const Components& x) const {
    for (std::size_t i = 0; i < inputs->size(); ++i)
      (*state)[static_cast<std::size_t>((*inputs)[i])] = x[static_cast<Eigen::Index>(i)];
    IntervalJet result;
    (*evaluator)(t, state->data(), &result);
    return result;
  }
};

}  // namespace trajet
