#include "trajet/ensemble/sweep_plan.hpp"

#include <Eigen/Cholesky>
#include <boost/random/sobol.hpp>
#include <limits>
#include <stdexcept>

#include "trajet/ensemble/random_stream.hpp"

namespace trajet {

double GridAxis::value(std::uint64_t i) const {
  if (i == 0) return low;
  if (i + 1 == count) return high;
  const double step = static_cast<double>(i) / static_cast<double>(count - 1);
  return low + (high - low) * step;
}

const VariedQuantity& SweepPlan::quantity(std::size_t i) const {
  return i < axes.size() ? axes[i].quantity : samples[i - axes.size()].quantity;
}

std::uint64_t SweepPlan::count() const {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t product = samples.empty() ? 1 : samples_per_node;
  for (const GridAxis& axis : axes)
    product = axis.count != 0 && product > kMost / axis.count ? kMost : product * axis.count;
  return product;
}

/// The sequence from any place on; going forward costs least.
class PlanValues::Sobol {
 public:
  explicit Sobol(std::size_t dimension) : engine_(dimension), dimension_(dimension) {}

  /// 64 bits of each coordinate of point `index`. The first is the origin, which Boost's sequence leaves out; without
  /// it the points are not even (Owen 2020).
  void point(std::uint64_t index, std::vector<std::uint64_t>& bits) {
    bits.assign(dimension_, 0);
    if (index == 0) return;
    if (index != next_) {
      engine_.seed(index - 1);
      next_ = index;
    }
    for (std::uint64_t& each : bits) each = engine_();
    ++next_;
  }

 private:
  boost::random::sobol engine_;
  std::size_t dimension_;
  std::uint64_t next_ = 1;
};

PlanValues::PlanValues(const SweepPlan& plan) : plan_(plan), shares_(plan.samples.size()) {
  const auto n = static_cast<Eigen::Index>(plan.samples.size());
  if (plan.design == SampleDesign::sobol && n > 0) sobol_ = std::make_unique<Sobol>(plan.samples.size());
  if (plan.correlations.empty()) return;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n);
  for (const Correlation& each : plan.correlations) {
    const auto i = static_cast<Eigen::Index>(each.first), j = static_cast<Eigen::Index>(each.second);
    matrix(i, j) = matrix(j, i) = each.coefficient;
  }
  const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix);
  if (cholesky.info() != Eigen::Success)
    throw std::invalid_argument("no quantities are correlated so: the matrix of correlations is not positive definite");
  const Eigen::MatrixXd lower = cholesky.matrixL();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) cholesky_.push_back(lower(i, j));
}

PlanValues::~PlanValues() = default;

void PlanValues::fill_shares(std::uint64_t index, std::vector<double>& shares) {
  const auto stream = [](std::size_t i) { return static_cast<std::uint32_t>(i); };
  switch (plan_.design) {
    case SampleDesign::random:
      for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = uniform_number(plan_.seed, index, stream(i));
      return;
    case SampleDesign::latin_hypercube: {
      // each node of the grid has a hypercube of its own
      const std::uint64_t n = plan_.samples_per_node, node = index / n;
      for (std::size_t i = 0; i < shares.size(); ++i) {
        const std::uint64_t key = random_bits(plan_.seed, node, stream(i), RandomPurpose::scramble);
        const std::uint64_t part = permuted_index(index % n, n, key, stream(i));
        shares[i] = (static_cast<double>(part) + uniform_number(plan_.seed, index, stream(i))) / static_cast<double>(n);
      }
      return;
    }
    case SampleDesign::sobol: {
      std::vector<std::uint64_t> bits;
      sobol_->point(index % plan_.samples_per_node, bits);
      for (std::size_t i = 0; i < shares.size(); ++i) {
        const std::uint64_t shift = random_bits(plan_.seed, 0, stream(i), RandomPurpose::scramble);
        shares[i] = (static_cast<double>((bits[i] ^ shift) >> 12U) + 0.5) * 0x1p-52;
      }
      return;
    }
  }
}

void PlanValues::operator()(std::uint64_t index, std::span<double> values) {
  std::uint64_t node = plan_.samples.empty() ? index : index / plan_.samples_per_node;
  for (std::size_t i = plan_.axes.size(); i-- > 0;) {
    const GridAxis& axis = plan_.axes[i];
    values[i] = axis.value(node % axis.count);
    node /= axis.count;
  }
  if (plan_.samples.empty()) return;
  fill_shares(index, shares_);
  if (!cholesky_.empty()) {
    const std::size_t n = shares_.size();
    scores_.resize(n);
    for (std::size_t i = 0; i < n; ++i) scores_[i] = normal_quantile(shares_[i]);
    for (std::size_t i = 0; i < n; ++i) {
      double score = 0.0;
      for (std::size_t j = 0; j <= i; ++j) score += cholesky_[i * n + j] * scores_[j];
      shares_[i] = normal_share(score);
    }
  }
  for (std::size_t i = 0; i < shares_.size(); ++i)
    values[plan_.axes.size() + i] = plan_.samples[i].distribution.quantile(shares_[i]);
}

}  // namespace trajet
