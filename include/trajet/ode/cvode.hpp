#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <utility>

#include "trajet/ode/segment.hpp"
#include "trajet/ode/stepper.hpp"

namespace trajet {

/// The multistep methods of SUNDIALS CVODE, of variable order and step [HindmarshEtAl2005].
enum class MultistepFormula {
  adams,  ///< Adams-Moulton, orders 1 to 12, by functional iteration
  bdf,    ///< backward differentiation, orders 1 to 5, by Newton's iteration with the exact Jacobian
};

namespace detail {

/// What CVODE integrates.
class CvodeProblem {
 public:
  virtual ~CvodeProblem() = default;
  virtual void rate(double t, const double* q, double* dq) = 0;
  /// dg_dq(i, j) = d g_i / d q_j  // (dimension x dimension), column-major
  virtual void jacobian(double t, const double* q, double* dg_dq) = 0;
};

/// A CVODE solver at work. Defined where SUNDIALS is known.
class Cvode {
 public:
  /// Throws std::invalid_argument if the tolerances are negative or both zero.
  Cvode(MultistepFormula formula, int dimension, std::unique_ptr<CvodeProblem> problem, const StepOptions& options);
  Cvode(Cvode&&) noexcept;
  Cvode& operator=(Cvode&&) noexcept;
  ~Cvode();

  void start(double t, const double* q);
  StepStatus advance(double t_limit);

  double time() const;
  const double* state() const;  ///< (dimension)
  const StepStatistics& statistics() const;

  double step_start() const;
  const double* start_state() const;  ///< at the start of the last step  // (dimension)
  /// The degree of the last step's polynomial.
  int order() const;
  /// The polynomial's k-th derivative at the start of the last step, 1 <= k <= order.  // (dimension)
  void derivative(int k, double* values) const;
  /// The error of the last step as estimated.  // (dimension)
  void error_estimate(double* values) const;

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

/// The problem that a rate with a Jacobian poses: DifferentiableLaw or SystemRate.
template <class Rate, int Dim>
class RateProblem final : public CvodeProblem {
 public:
  RateProblem(Rate rate, int dimension)
      : rate_(std::move(rate)), q_(dimension), g_(dimension), jacobian_(dimension, dimension) {}

  void rate(double t, const double* q, double* dq) override {
    q_ = Eigen::Map<const State>(q, q_.size());
    rate_(t, q_, g_);
    Eigen::Map<State>(dq, g_.size()) = g_;
  }
  void jacobian(double t, const double* q, double* dg_dq) override {
    q_ = Eigen::Map<const State>(q, q_.size());
    rate_.jacobian(t, q_, jacobian_, g_);
    Eigen::Map<Jacobian>(dg_dq, jacobian_.rows(), jacobian_.cols()) = jacobian_;
  }

 private:
  using State = Eigen::Matrix<double, Dim, 1>;
  using Jacobian = Eigen::Matrix<double, Dim, Dim>;

  Rate rate_;
  State q_, g_;
  Jacobian jacobian_;
};

}  // namespace detail

/// One of CVODE's methods as a Stepper. Its Segments are CVODE's own interpolation polynomials, of the order of the
/// step.
///
/// CVODE bounds the root mean square of the components' errors over their tolerances; it is given tolerances smaller by
/// the root of the dimension, so that every component's error per step stays within atol + rtol |q_i|.
template <class Rate, int Dim>
class CvodeStepper {
 public:
  using State = Eigen::Matrix<double, Dim, 1>;
  static constexpr int kDimension = Dim;

  CvodeStepper(MultistepFormula formula, Rate rate, int dimension, const StepOptions& options)
      : cvode_(formula, dimension, std::make_unique<detail::RateProblem<Rate, Dim>>(std::move(rate), dimension),
               options),
        state_(dimension) {}

  void start(double t, const State& q) {
    cvode_.start(t, q.data());
    state_ = q;
  }

  StepStatus advance(double t_limit) {
    const StepStatus status = cvode_.advance(t_limit);
    state_ = Eigen::Map<const State>(cvode_.state(), state_.size());
    return status;
  }

  void fill_segment(Segment<Dim>& segment) {
    const int order = cvode_.order();
    segment.resize(static_cast<int>(state_.size()), order);
    segment.set_interval(cvode_.step_start(), cvode_.time());
    const Eigen::Map<const State> start(cvode_.start_state(), state_.size());
    segment.coefficients().col(0) = start;
    double factorial = 1.0;
    State derivative(state_.size());
    for (int k = 1; k <= order; ++k) {
      factorial *= k;
      cvode_.derivative(k, derivative.data());
      segment.coefficients().col(k) = derivative / factorial;
    }
    cvode_.error_estimate(derivative.data());
    // the state and the polynomial's value near it are rounded twice each
    segment.error_bound() =
        derivative.cwiseAbs() + std::numeric_limits<double>::epsilon() * (start.cwiseAbs() + state_.cwiseAbs());
  }

  double time() const { return cvode_.time(); }
  const State& state() const { return state_; }
  const StepStatistics& statistics() const { return cvode_.statistics(); }

 private:
  detail::Cvode cvode_;
  State state_;
};

}  // namespace trajet
