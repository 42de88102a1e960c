#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "trajet/ode/levelled_rate.hpp"
#include "trajet/ode/segment.hpp"
#include "trajet/ode/step_control.hpp"
#include "trajet/ode/stepper.hpp"

namespace trajet {
namespace detail {

/// The rule of Gauss and Kronrod with 15 nodes on [-1, 1], in it that of Gauss with 7, and what makes a polynomial of a
/// function's values at the nodes. The library stores nodes and weights from 0 on; every second one is Gauss's.
class KronrodRule {
 public:
  static constexpr int kNodes = 15;
  /// Of the polynomial. The rule is exact to degree 22, so that the products with Legendre polynomials that give the
  /// coefficients of a polynomial of this degree are too.
  static constexpr int kDegree = 11;

  using Values = std::array<double, kNodes>;

  static const KronrodRule& instance() {
    static const KronrodRule rule;
    return rule;
  }

  double node(int j) const { return nodes_[static_cast<std::size_t>(j)]; }

  /// Integral over [-1, 1] by the rule of Kronrod minus that by the rule of Gauss.
  double difference(const Values& values) const {
    double sum = 0.0;
    for (std::size_t j = 0; j < kNodes; ++j) sum += (weights_[j] - gauss_weights_[j]) * values[j];
    return sum;
  }

  /// The coefficients c_l of sum_l c_l P_l(x), the projection of the function on polynomials of degree kDegree:
  /// c_l = (2 l + 1)/2 * integral of f P_l.
  std::array<double, kDegree + 1> legendre_coefficients(const Values& values) const {
    std::array<double, kDegree + 1> c{};
    for (std::size_t l = 0; l <= kDegree; ++l)
      for (std::size_t j = 0; j < kNodes; ++j) c[l] += projection_[l][j] * values[j];
    return c;
  }

  /// The coefficient of s^k in P_l(2 s - 1).
  static double shifted_legendre(int l, int k) {
    return shifted_legendre_table()[static_cast<std::size_t>(l)][static_cast<std::size_t>(k)];
  }

 private:
  using Kronrod = boost::math::quadrature::gauss_kronrod<double, kNodes>;
  using Gauss = boost::math::quadrature::gauss<double, (kNodes - 1) / 2>;
  using Table = std::array<std::array<double, kDegree + 1>, kDegree + 1>;

  KronrodRule() {
    constexpr std::size_t kMiddle = kNodes / 2;
    for (std::size_t i = 0; i <= kMiddle; ++i) {
      for (const std::size_t j : {kMiddle - i, kMiddle + i}) {
        nodes_[j] = j < kMiddle ? -Kronrod::abscissa()[i] : Kronrod::abscissa()[i];
        weights_[j] = Kronrod::weights()[i];
        gauss_weights_[j] = i % 2 == 0 ? Gauss::weights()[i / 2] : 0.0;
      }
    }
    for (std::size_t j = 0; j < kNodes; ++j) {
      // (l + 1) P_{l+1} = (2 l + 1) x P_l - l P_{l-1}
      double before = 0.0, p = 1.0;
      for (std::size_t l = 0; l <= kDegree; ++l) {
        const auto n = static_cast<double>(l);
        projection_[l][j] = (n + 0.5) * weights_[j] * p;
        before = std::exchange(p, ((2.0 * n + 1.0) * nodes_[j] * p - n * before) / (n + 1.0));
      }
    }
  }

  static const Table& shifted_legendre_table() {
    static const Table table = [] {
      Table t{};
      // (-1)^(l+k) binomial(l, k) binomial(l+k, k), whole numbers below 2^53
      for (std::size_t l = 0; l <= kDegree; ++l) {
        double c = l % 2 == 0 ? 1.0 : -1.0;
        for (std::size_t k = 0; k <= l; ++k) {
          t[l][k] = c;
          c *= -static_cast<double>((l - k) * (l + k + 1));
          c /= static_cast<double>((k + 1) * (k + 1));
        }
      }
      return t;
    }();
    return table;
  }

  Values nodes_{}, weights_{}, gauss_weights_{};
  std::array<Values, kDegree + 1> projection_{};
};

}  // namespace detail

/// Direct integration of accelerations of time alone: v = v0 + int a dt, r = r0 + int v dt, by the
/// adaptive rule of Gauss and Kronrod with 7 and 15 nodes [PiessensEtAl1983], nodes and weights of Boost.Math.
///
/// Of the values at the nodes of a step, each rate becomes the polynomial of degree 11 that is its projection on
/// Legendre polynomials, and its integral, of degree 12, the Segment: at the end of the step it is Kronrod's rule
/// itself. A step is halved until, for every component, the last two terms of the rate's polynomial, integrated over
/// the step, and the difference of both rules are within atol + rtol |q|.
///
/// For any system whose rates are known beforehand level by level (see Levels). No step is longer than a sixteenth of
/// the way: a pulse shorter than a two-hundredth of it can still fall between the nodes; `StepOptions::step`, the
/// longest step then, helps. A Stepper.
template <class Rate, int Dim>
class QuadratureStepper {
 public:
  using State = Eigen::Matrix<double, Dim, 1>;
  static constexpr int kDimension = Dim;

  /// Throws std::invalid_argument for wrong tolerances, or for a law that depends on its own solution.
  QuadratureStepper(Rate rate, Structure structure, const StepOptions& options)
      : rate_(std::move(rate), std::move(structure)), options_(options) {
    check_step_control(options);
    const int n = rate_.dimension();
    segment_.resize(n, kDegree + 1);
    trial_.resize(n);
    node_state_.resize(n);
    node_rate_.resize(n);
    values_.resize(n, Rule::kNodes);
  }

  void start(double t, const State& q) {
    t_ = start_time_ = t;
    q_ = q;
    next_step_ = options_.step.value_or(std::numeric_limits<double>::infinity());
    controller_.reset();
  }

  StepStatus advance(double t_limit) {
    assert(t_limit != t_);
    const double direction = t_limit > t_ ? 1.0 : -1.0;
    const double longest = options_.step.value_or(kLongestStep * std::abs(t_limit - start_time_));
    t_limit = step_limit(t_, t_limit, options_.max_step);
    const double distance = std::abs(t_limit - t_);
    double h = std::min(next_step_, longest);
    while (true) {
      const bool lands = h * kLandingStretch >= distance;
      const double t1 = lands ? t_limit : t_ + direction * h;
      const double error = integrate_to(t1);
      if (lands) h = distance;
      if (error <= 1.0) {
        const double proposed = h * controller_.accepted(error);
        next_step_ = lands ? std::max(proposed, next_step_) : proposed;
        t_ = t1;
        q_ = trial_;
        ++statistics_.steps;
        return StepStatus::ok;
      }
      ++statistics_.rejected_steps;
      h *= controller_.rejected(error);
      if (!(h >= smallest_step(t_))) return std::isfinite(error) ? StepStatus::step_too_small : StepStatus::not_finite;
    }
  }

  /// Writes the last step.
  void fill_segment(Segment<Dim>& segment) { segment = segment_; }

  double time() const { return t_; }
  const State& state() const { return q_; }
  const StepStatistics& statistics() const { return statistics_; }

 private:
  using Rule = detail::KronrodRule;
  static constexpr int kDegree = Rule::kDegree;
  static constexpr double kLongestStep = 1.0 / 16.0;  // of the way

  /// Makes segment_ lead from (t_, q_) to t1 and trial_ its end; returns the largest error over its tolerance.
  double integrate_to(double t1) {
    segment_.set_interval(t_, t1);
    segment_.coefficients().setZero();
    segment_.coefficients().col(0) = q_;
    double largest = 0.0;
    for (const auto& level : rate_.levels()) {
      for (int j = 0; j < Rule::kNodes; ++j) {
        const double t = t_ + 0.5 * (1.0 + Rule::instance().node(j)) * (t1 - t_);
        segment_.evaluate(t, node_state_);
        statistics_.law_evaluations += rate_.evaluate(level, t, node_state_, node_rate_);
        for (const int i : level) values_(i, j) = node_rate_[i];
      }
      for (const int i : level) largest = std::max(largest, integrate_component(i));
    }
    return trial_.allFinite() ? largest : std::numeric_limits<double>::quiet_NaN();
  }

  /// The polynomial of component i from the values of its rate; returns its error over its tolerance.
  double integrate_component(int i) {
    const Rule& rule = Rule::instance();
    const double h = segment_.duration();
    Rule::Values values;
    double magnitude = 0.0;
    for (int j = 0; j < Rule::kNodes; ++j) {
      values[static_cast<std::size_t>(j)] = values_(i, j);
      magnitude = std::max(magnitude, std::abs(values_(i, j)));
    }
    auto c = rule.legendre_coefficients(values);
    for (std::size_t l = 0; l <= kDegree; ++l)
      if (std::abs(c[l]) < kNoise * static_cast<double>(2 * l + 1) * magnitude) c[l] = 0.0;
    // q(t0 + s h) = q0 + h int_0^s sum_l c_l P_l(2 s' - 1) ds'
    double power = 1.0;  // h^-k
    for (int k = 0; k <= kDegree; ++k) {
      double sum = 0.0;
      for (int l = k; l <= kDegree; ++l) sum += c[static_cast<std::size_t>(l)] * Rule::shifted_legendre(l, k);
      segment_.coefficients()(i, k + 1) = sum * power / (k + 1);
      power /= h;
    }
    // only the constant P_0 has an integral over the whole step
    trial_[i] = q_[i] + h * c[0];
    const double last_terms = std::abs(c[kDegree]) + std::abs(c[kDegree - 1]);
    const double error = std::abs(h) * std::max(last_terms, 0.5 * std::abs(rule.difference(values)));
    const double scale = std::max(std::abs(q_[i]), std::abs(trial_[i]));
    const double rounding = kSumRounding * (scale + std::abs(h) * magnitude);
    segment_.error_bound()[i] = error + rounding;
    return error / (absolute_tolerance(options_, i) + options_.rtol * scale + rounding);
  }

  // The values of the polynomials near the end of a step lose this much by the alternating sums of their coefficients.
  static constexpr double kSumRounding = 8.0 * std::numeric_limits<double>::epsilon();

  // A coefficient below this part of (2 l + 1) |rate| is what rounding leaves of zero: a polynomial's rate keeps its
  // degree.
  static constexpr double kNoise = std::numeric_limits<double>::epsilon();

  detail::LevelledRate<Rate, Dim> rate_;
  StepOptions options_;
  double t_ = 0.0;
  double start_time_ = 0.0;
  double next_step_ = 0.0;  // s
  State q_;
  StepController controller_{kDegree};
  Segment<Dim> segment_;
  State trial_, node_state_, node_rate_;
  Eigen::Matrix<double, Dim, Rule::kNodes> values_;  // rates at the nodes  // (dimension x kNodes)
  StepStatistics statistics_;
};

/// The method as a type, for solve<Quadrature>(law, …).
struct Quadrature {
  template <int Dim, class Law>
  static auto make_stepper(Law law, int dimension, const StepOptions& options) {
    Structure structure = structure_of(law, dimension);
    return QuadratureStepper<Law, Dim>(std::move(law), std::move(structure), options);
  }
};

}  // namespace trajet
