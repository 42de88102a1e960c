#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "trajet/ensemble/distribution.hpp"
#include "trajet/ensemble/varied_quantity.hpp"

namespace trajet {

/// How the numbers between 0 and 1 that samples are made of fill the unit cube.
enum class SampleDesign {
  random,           ///< independent
  latin_hypercube,  ///< each of `count` equal parts of each quantity once, in random orders (McKay 1979)
  sobol,            ///< Sobol's sequence, shifted by random bits: even in all quantities together (Owen 1995)
};

/// A quantity that takes the values low, …, high in `count` equal steps.
struct GridAxis {
  VariedQuantity quantity;
  double low = 0.0;
  double high = 0.0;
  std::uint64_t count = 1;

  double value(std::uint64_t i) const;
};

struct SampledQuantity {
  VariedQuantity quantity;
  Distribution distribution;
};

/// A linear dependence of two sampled quantities: the correlation of the normal scores of their shares. Of normal ones
/// it is their own.
struct Correlation {
  std::size_t first = 0, second = 0;  ///< in SweepPlan::samples
  double coefficient = 0.0;           ///< -1 … 1
};

/// The motions of a sweep: each node of the grid, with `samples_per_node` draws of the sampled quantities at each.
///
/// Motion number `index` has the same values wherever and in whatever order motions are computed. The last axis of the
/// grid changes first, the draws of a node before all axes.
struct SweepPlan {
  std::vector<GridAxis> axes{};
  std::vector<SampledQuantity> samples{};
  std::vector<Correlation> correlations{};
  std::uint64_t samples_per_node = 1;
  std::uint64_t seed = 0;
  SampleDesign design = SampleDesign::random;

  std::size_t quantity_count() const { return axes.size() + samples.size(); }
  /// Of the axes, then of the samples.
  const VariedQuantity& quantity(std::size_t i) const;
  /// Number of motions; saturates.
  std::uint64_t count() const;
};

/// Computes the values of a plan's motions, which outlives it.
class PlanValues {
 public:
  /// Throws std::invalid_argument where no distribution has the correlations.
  explicit PlanValues(const SweepPlan& plan);
  ~PlanValues();

  /// The values of all quantities in motion `index`, in their order.  // values: (quantity_count)
  void operator()(std::uint64_t index, std::span<double> values);

 private:
  class Sobol;
  void fill_shares(std::uint64_t index, std::vector<double>& shares);

  const SweepPlan& plan_;
  std::vector<double> cholesky_;  // of the correlations, row by row; empty if there are none
  std::vector<double> shares_, scores_;
  std::unique_ptr<Sobol> sobol_;
};

}  // namespace trajet
