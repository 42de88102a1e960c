#include "state_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unsupported/Eigen/MatrixFunctions>

#include "trajet/portable.hpp"

namespace trajet {
namespace {

/// So many steps are kept before they are worked off.
constexpr std::size_t kMostOpenSteps = 64;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Eigen::MatrixXd jacobian(System& law, double t, const Eigen::VectorXd& q) {
  Eigen::MatrixXd dg_dq(q.size(), q.size());
  Eigen::VectorXd dg_dt(q.size());
  law.jacobian(t, q.data(), dg_dq.data(), dg_dt.data());
  return dg_dq;
}

/// exp(a), where the units of the components may be far apart: powers of two make rows and columns alike in size first
/// [ParlettReinsch1969].
Eigen::MatrixXd exponential(Eigen::MatrixXd a) {
  constexpr int kMostRounds = 20;
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(a.rows());
  bool has_changed = true;
  for (int round = 0; has_changed && round < kMostRounds; ++round) {
    has_changed = false;
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      const double own = std::abs(a(i, i));
      const double row = a.row(i).cwiseAbs().sum() - own, column = a.col(i).cwiseAbs().sum() - own;
      if (!(row > 0.0 && column > 0.0)) continue;
      const int power = std::ilogb(row / column) / 2;
      if (power == 0) continue;
      has_changed = true;
      const double factor = std::ldexp(1.0, power);
      scale[i] *= factor;
      a.row(i) /= factor;
      a.col(i) *= factor;
    }
  }
  const Eigen::MatrixXd balanced = a.exp();
  return scale.asDiagonal() * balanced * scale.cwiseInverse().asDiagonal();
}

}  // namespace

StateError::StateError(int dimension, double roundoff) : roundoff_(roundoff), generators_(dimension, 0) {}

StateError::Step StateError::step_until(System& law, const Segment<>& segment, double t) const {
  Step step{&law, segment.t0(), t - segment.t0(), segment.coefficients().col(0), {}, {}, segment.error_bound()};
  step.in_middle = segment.state(segment.t0() + 0.5 * step.duration);
  step.at_end = segment.state(t);
  step.error += roundoff_ * step.at_end.cwiseAbs();
  return step;
}

Eigen::MatrixXd StateError::transition(const Step& step) {
  const double h = step.duration;
  const Eigen::Index n = step.at_start.size();
  // where solutions are parabolas, the law's powers end with its square
  if (const int degree = step.law->polynomial_degree(); degree >= 0 && degree <= 2) {
    const Eigen::MatrixXd a = jacobian(*step.law, step.start + 0.5 * h, step.in_middle);
    return Eigen::MatrixXd::Identity(n, n) + h * a + (0.5 * h * h) * (a * a);
  }
  // exp(integral of A), the integral by Simpson's rule: the first term of Magnus' series
  const Eigen::MatrixXd mean = (jacobian(*step.law, step.start, step.at_start) +
                                4.0 * jacobian(*step.law, step.start + 0.5 * h, step.in_middle) +
                                jacobian(*step.law, step.start + h, step.at_end)) /
                               6.0;
  if (!mean.allFinite()) return Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd result = exponential(h * mean);
  return result.allFinite() ? result : Eigen::MatrixXd::Identity(n, n);
}

void StateError::pass(System& law, const Segment<>& segment, double t) {
  open_.push_back(step_until(law, segment, t));
  if (open_.size() >= kMostOpenSteps) settle();
}

void StateError::settle() {
  for (const Step& step : open_) {
    if (generators_.cols() > 0 && step.duration != 0.0) generators_ = transition(step) * generators_;
    add(step.error);
  }
  open_.clear();
  check();
}

void StateError::check() {
  if (is_infinite_ || generators_.allFinite()) return;
  is_infinite_ = true;
  generators_.resize(generators_.rows(), 0);
}

void StateError::jump(const Eigen::MatrixXd& derivative, const Eigen::MatrixXd& further) {
  settle();
  generators_ = derivative * generators_;
  if (further.cols() == 0) return check();
  const Eigen::Index before = generators_.cols();
  generators_.conservativeResize(Eigen::NoChange, before + further.cols());
  generators_.rightCols(further.cols()) = further;
  if (generators_.cols() > 4 * generators_.rows()) reduce();
  check();
}

Eigen::MatrixXd StateError::columns(System& law, const Segment<>& segment, double t) {
  settle();
  const Step part = step_until(law, segment, t);
  const Eigen::Index n = generators_.rows(), before = generators_.cols();
  Eigen::MatrixXd all(n, before + n);
  all.leftCols(before) = generators_;
  if (before > 0 && part.duration != 0.0) all.leftCols(before) = transition(part) * generators_;
  all.rightCols(n) = part.error.asDiagonal();
  if (is_infinite_) all.setConstant(kInfinity);
  return all;
}

void StateError::add(const Eigen::VectorXd& error) {
  const Eigen::Index before = generators_.cols();
  const Eigen::Index count = (error.array() > 0.0).count();
  generators_.conservativeResize(Eigen::NoChange, before + count);
  Eigen::Index column = before;
  for (Eigen::Index i = 0; i < error.size(); ++i)
    if (error[i] > 0.0) generators_.col(column++) = error[i] * Eigen::VectorXd::Unit(error.size(), i);
  if (generators_.cols() > 4 * error.size()) reduce();
}

void StateError::reduce() {
  const Eigen::Index n = generators_.rows(), count = generators_.cols();
  // what a column adds to the box around it, which it is replaced by
  const Eigen::VectorXd excess = generators_.cwiseAbs().colwise().sum() - generators_.cwiseAbs().colwise().maxCoeff();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  ranges::stable_sort(order, {}, [&](Eigen::Index column) { return excess[column]; });
  const Eigen::Index kept = n;
  Eigen::MatrixXd reduced(n, kept + n);
  Eigen::VectorXd box = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < count - kept; ++i) box += generators_.col(order[static_cast<std::size_t>(i)]).cwiseAbs();
  for (Eigen::Index i = 0; i < kept; ++i)
    reduced.col(i) = generators_.col(order[static_cast<std::size_t>(count - kept + i)]);
  reduced.rightCols(n) = box.asDiagonal();
  generators_ = std::move(reduced);
}

Eigen::VectorXd StateError::bound(System& law, const Segment<>& segment, double t) {
  settle();
  if (is_infinite_) return Eigen::VectorXd::Constant(generators_.rows(), kInfinity);
  const Step part = step_until(law, segment, t);
  if (generators_.cols() == 0) return part.error;
  const Eigen::MatrixXd moved = part.duration != 0.0 ? Eigen::MatrixXd(transition(part) * generators_) : generators_;
  return part.error + moved.cwiseAbs().rowwise().sum();
}

double StateError::bound_along(const Eigen::VectorXd& direction, System& law, const Segment<>& segment, double t) {
  settle();
  if (is_infinite_) return kInfinity;
  const Step part = step_until(law, segment, t);
  const double own = direction.cwiseAbs().dot(part.error);
  if (generators_.cols() == 0) return own;
  const Eigen::RowVectorXd row =
      part.duration != 0.0 ? Eigen::RowVectorXd(direction.transpose() * transition(part)) : direction.transpose();
  return own + (row * generators_).cwiseAbs().sum();
}

}  // namespace trajet
