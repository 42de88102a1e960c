#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "trajet/ode/segment.hpp"
#include "trajet/ode/step_grid.hpp"
#include "trajet/ode/stepper.hpp"

namespace trajet {

/// Gauss collocation with three stages, order 6, with steps that the user gives. A Stepper.
///
///     k_i = g(t0 + c_i h, q0 + h sum_j a_ij k_j),   q1 = q0 + h sum_i b_i k_i
///
/// [HairerLubichWanner2006] II.1.3: symplectic and symmetric, so that energy does not drift however long a run; it
/// keeps every quadratic invariant. A-stable. The stages are solved by a simplified Newton iteration until rounding
/// stops it, and the sums of the steps are compensated: what is left of drift is the rounding of the rates,
/// [HairerLubichWanner2006] VIII.5. Segments are the collocation polynomial u, u'(t0 + c_i h) = k_i: of order 3 within
/// the step.
///
/// `Rate` is a rate with a Jacobian: DifferentiableLaw or SystemRate.
template <class Rate, int Dim>
class GaussStepper {
 public:
  using State = Eigen::Matrix<double, Dim, 1>;
  static constexpr int kDimension = Dim;

  /// Reads `step` or `nodes`. Throws std::invalid_argument if both are missing or wrong.
  GaussStepper(Rate rate, const StepOptions& options) : rate_(std::move(rate)), grid_(options) {}

  void start(double t, const State& q) {
    t0_ = t1_ = t;
    q0_ = q1_ = q;
    const Eigen::Index n = q.size();
    lost_.setZero(n);
    lost_before_.setZero(n);
    time_rate_.setZero(n);
    jacobian_.setZero(n, n);
    k_.setZero(n, kStages);
    stage_rate_.setZero(n);
    factored_step_ = 0.0;
    has_polynomial_ = false;
    grid_.start(t);
  }

  /// Replaces the state. The sums of the components that stay are compensated further.
  void amend(const State& q) {
    for (Eigen::Index i = 0; i < q.size(); ++i)
      if (q[i] != q1_[i]) lost_[i] = 0.0;
    q1_ = q;
  }

  StepStatus advance(double t_limit) {
    assert(t_limit != t1_);
    const double previous_step = t1_ - t0_;
    t0_ = t1_;
    q0_ = q1_;
    lost_before_ = lost_;
    t1_ = grid_.next(t0_, t_limit);
    const double h = t1_ - t0_;
    if (!guess(previous_step, h) || !solve(h)) {
      t1_ = t0_;
      has_polynomial_ = false;
      return met_not_finite_ ? StepStatus::not_finite : StepStatus::step_too_small;
    }
    // q1 = q0 + h sum_i b_i k_i, with what rounding took from the sum before
    const State increment = h * (k_ * weights()) + lost_before_;
    q1_ = q0_ + increment;
    lost_ = increment - (q1_ - q0_);
    has_polynomial_ = true;
    ++statistics_.steps;
    return StepStatus::ok;
  }

  /// The last step. `error_bound` is the largest distance of the collocation polynomial from the solution within the
  /// step, h^4 q''''/1920, by its defect at the start; at the end the error is of order h^7.
  void fill_segment(Segment<Dim>& segment) {
    const double h = t1_ - t0_;
    segment.resize(static_cast<int>(q1_.size()), kStages);
    segment.set_interval(t0_, t1_);
    // u' through the k_i at c_i, by divided differences: u'(t0 + s h) = k_1 + (s - c_1) (d_12 + (s - c_2) d_123)
    const State d12 = (k_.col(1) - k_.col(0)) / (kC[1] - kC[0]);
    const State d23 = (k_.col(2) - k_.col(1)) / (kC[2] - kC[1]);
    const State d123 = (d23 - d12) / (kC[2] - kC[0]);
    const State slope = d12 - (kC[0] + kC[1]) * d123;
    segment.coefficients().col(0) = q0_;
    segment.coefficients().col(2) = slope / (2.0 * h);
    segment.coefficients().col(3) = d123 / (3.0 * h * h);
    const State start_rate = k_.col(0) - kC[0] * (d12 - kC[1] * d123);
    // the first coefficient from the end, which the polynomial then meets to the last digit
    segment.coefficients().col(1) = (q1_ - q0_) / h - (slope / 2.0 + d123 / 3.0);
    // defect at the start: u'(t0) - g = h^3 q''''/6 c_1 c_2 c_3, and c_1 c_2 c_3 = 1/20;
    // error at the middle of the step, the largest: h^4 q''''/6 (integral of (s - c_1)(s - c_2)(s - c_3) from 0 to 1/2)
    // = h^4 q''''/6 / 320
    rate_(t0_, q0_, stage_rate_);
    ++statistics_.law_evaluations;
    segment.error_bound() = (std::abs(h) / 16.0) * (start_rate - stage_rate_).cwiseAbs() +
                            std::numeric_limits<double>::epsilon() * (q0_.cwiseAbs() + q1_.cwiseAbs());
  }

  double time() const { return t1_; }
  const State& state() const { return q1_; }
  const StepStatistics& statistics() const { return statistics_; }

  static constexpr int kStages = 3;
  static constexpr double kSqrt15 = 3.872983346207417;
  static constexpr std::array<double, kStages> kC = {0.5 - kSqrt15 / 10.0, 0.5, 0.5 + kSqrt15 / 10.0};
  static constexpr std::array<double, kStages> kB = {5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0};
  static constexpr std::array<std::array<double, kStages>, kStages> kA = {
      {{5.0 / 36.0, 2.0 / 9.0 - kSqrt15 / 15.0, 5.0 / 36.0 - kSqrt15 / 30.0},
       {5.0 / 36.0 + kSqrt15 / 24.0, 2.0 / 9.0, 5.0 / 36.0 - kSqrt15 / 24.0},
       {5.0 / 36.0 + kSqrt15 / 30.0, 2.0 / 9.0 + kSqrt15 / 15.0, 5.0 / 36.0}}};

 private:
  static constexpr int kStageDim = Dim == Eigen::Dynamic ? Eigen::Dynamic : kStages * Dim;
  using Stages = Eigen::Matrix<double, Dim, kStages>;
  using StageMatrix = Eigen::Matrix<double, kStageDim, kStageDim>;

  static Eigen::Vector3d weights() { return Eigen::Map<const Eigen::Vector3d>(kB.data()); }

  /// The k_i to start from: the last step's polynomial goes on, or the rate at the start. False if that is not finite.
  bool guess(double previous_step, double h) {
    met_not_finite_ = false;
    if (!has_polynomial_) {
      evaluate(t0_, q0_);
      k_.colwise() = stage_rate_;
      return !met_not_finite_;
    }
    Eigen::Matrix3d extrapolation;
    for (int i = 0; i < kStages; ++i) {
      const double s = 1.0 + kC[static_cast<std::size_t>(i)] * h / previous_step;
      for (int j = 0; j < kStages; ++j) {
        double basis = 1.0;  // Lagrange's
        for (int m = 0; m < kStages; ++m) {
          const double cm = kC[static_cast<std::size_t>(m)];
          if (m != j) basis *= (s - cm) / (kC[static_cast<std::size_t>(j)] - cm);
        }
        extrapolation(j, i) = basis;
      }
    }
    k_ = (k_ * extrapolation).eval();
    return true;
  }

  /// Newton's iteration for the k_i with the Jacobian of some step before, renewed where it converges badly; until the
  /// corrections are rounding: no longer than a few ulps of the state, or no shorter than the last one.
  bool solve(double h) {
    if (h != factored_step_) factor(h);
    double previous = std::numeric_limits<double>::infinity();
    bool renewed = false;
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
      const double size = correct(h);
      if (met_not_finite_) return false;
      if (size <= kStillCorrection) return true;
      const bool is_slow = size > kSlow * previous;
      if (is_slow && previous <= kNearRounding) return true;
      if (is_slow && !renewed) {
        factor(h);
        if (met_not_finite_) return false;
        renewed = true;
      } else if (!(size < 2.0 * previous)) {
        return false;
      }
      previous = size;
    }
    return false;
  }

  /// One correction of all k_i; its size, h dk over the state.
  double correct(double h) {
    for (int i = 0; i < kStages; ++i) {
      const Eigen::Vector3d a = Eigen::Map<const Eigen::Vector3d>(kA[static_cast<std::size_t>(i)].data());
      evaluate(t0_ + kC[static_cast<std::size_t>(i)] * h, q0_ + (h * (k_ * a) + lost_before_));
      residual_.template segment<Dim>(i * q0_.size(), q0_.size()) = stage_rate_ - k_.col(i);
    }
    correction_ = lu_.solve(residual_);
    if (!correction_.allFinite()) met_not_finite_ = true;
    double size = 0.0;
    for (int i = 0; i < kStages; ++i) {
      const State change = correction_.template segment<Dim>(i * q0_.size(), q0_.size());
      k_.col(i) += change;
      size = std::max(size, std::abs(h) * change.template lpNorm<Eigen::Infinity>());
    }
    if (size == 0.0) return 0.0;  // of a state at rest in zero too
    return size / std::max(q0_.template lpNorm<Eigen::Infinity>(), std::abs(h) * k_.template lpNorm<Eigen::Infinity>());
  }

  /// Factors 1 - h A x J with the Jacobian at the start of the step.
  void factor(double h) {
    const Eigen::Index n = q0_.size();
    rate_.jacobian(t0_, q0_, jacobian_, time_rate_);
    ++statistics_.law_evaluations;
    if (!jacobian_.allFinite()) met_not_finite_ = true;
    matrix_.setIdentity(kStages * n, kStages * n);
    for (int i = 0; i < kStages; ++i)
      for (int j = 0; j < kStages; ++j)
        matrix_.template block<Dim, Dim>(i * n, j * n, n, n) -=
            h * kA[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] * jacobian_;
    lu_.compute(matrix_);
    factored_step_ = h;
    residual_.resize(kStages * n);
  }

  void evaluate(double t, const State& q) {
    rate_(t, q, stage_rate_);
    ++statistics_.law_evaluations;
    if (!stage_rate_.allFinite()) met_not_finite_ = true;
  }

  static constexpr int kMaxIterations = 50;
  static constexpr double kSlow = 0.1;  // corrections that shrink less deserve a new Jacobian
  static constexpr double kStillCorrection = std::numeric_limits<double>::epsilon() / 4.0;
  // Corrections below this that stop shrinking are rounding of the rates, which the Newton matrix cannot remove.
  static constexpr double kNearRounding = 1e4 * std::numeric_limits<double>::epsilon();

  Rate rate_;
  StepGrid grid_;
  double t0_ = 0.0;
  double t1_ = 0.0;
  State q0_, q1_;
  State lost_, lost_before_;  // what the sum of the steps still owes to q1 and q0
  Stages k_;
  bool has_polynomial_ = false;  // k_ is of the step that ended at t1
  bool met_not_finite_ = false;
  double factored_step_ = 0.0;
  State stage_rate_, time_rate_;
  Eigen::Matrix<double, Dim, Dim> jacobian_;
  StageMatrix matrix_;
  Eigen::PartialPivLU<StageMatrix> lu_;
  Eigen::Matrix<double, kStageDim, 1> residual_, correction_;
  StepStatistics statistics_;
};

}  // namespace trajet
