#pragma once

#include <Eigen/Core>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trajet/ode/segment.hpp"
#include "trajet/ode/step_grid.hpp"
#include "trajet/ode/stepper.hpp"
#include "trajet/text/shortest_text.hpp"

namespace trajet {

/// Runge-Kutta 4 with step doubling and Richardson extrapolation as the notes have it (`SEDRK4c`), with their
/// errata put right.
///
/// The user gives output intervals and a relative accuracy eps = rtol. Over an interval the method marches with 1, 2,
/// 4, … steps of rk4 until two marches, q_a with steps h and q_b with steps h/2, agree at its end, the whole state in
/// one norm:
///
///     |q_b - q_a| <= eps |q_b + q_a| / 2
///
/// A state at rest meets that at once. The march of kMaxSubsteps steps is the last one; if it does not agree either,
/// the run goes on and a warning says so. In any case the next interval starts from Richardson's extrapolation
///
///     q_c = q_b + (q_b - q_a)/15
///
/// Every step of every march costs four evaluations of the law; marches share none. The Segments, one for each step h
/// of q_a, lead through the extrapolated states. A Stepper.
template <class Rate, int Dim>
class Rk4DoublingStepper {
 public:
  using State = Eigen::Matrix<double, Dim, 1>;
  static constexpr int kDimension = Dim;
  static constexpr int kMaxSubsteps = 128;  // the notes' routine stops at the first power of 2 above 100

  /// Reads `rtol` and `step` or `nodes`. Throws std::invalid_argument if the intervals are missing or wrong, or for a
  /// negative `rtol`.
  Rk4DoublingStepper(Rate rate, const StepOptions& options)
      : rate_(std::move(rate)), accuracy_(options.rtol), grid_(options) {
    if (!(options.rtol >= 0.0)) throw std::invalid_argument("`rtol` must not be negative");
  }

  void start(double t, const State& q) {
    t_ = t;
    q_ = q;
    piece_ = piece_count_ = 0;
    for (State* state : {&k2_, &k3_, &k4_, &stage_}) *state = q;  // the only allocations, the first time
    for (March* march : {&coarse_, &fine_}) {
      march->states.resize(kMaxSubsteps + 1, q);
      march->rates.resize(kMaxSubsteps + 1, q);
    }
    grid_.start(t);
  }

  /// Replaces the state at the end of an interval, from which the next one starts. False within one.
  bool amend(const State& q) {
    if (piece_ != piece_count_) return false;
    q_ = q;
    return true;
  }

  /// Hands out the next piece of the interval, a step h of q_a; behind the last one, computes the next interval.
  StepStatus advance(double t_limit) {
    assert(t_limit != t_);
    const bool limit_is_nearer = std::abs(t_limit - t_) < std::abs(interval_end_ - t_);
    if (piece_ == piece_count_ || limit_is_nearer) {
      interval_start_ = t_;
      interval_end_ = grid_.next(t_, t_limit);
      if (!compute_interval()) return StepStatus::not_finite;
    }
    ++piece_;
    t_ = time_of(piece_);
    q_ = extrapolated(piece_);
    ++statistics_.steps;
    return StepStatus::ok;
  }

  /// Writes the last piece: the quartic through the extrapolated states at its ends and in its middle with the rates at
  /// its start and in its middle. `error_bound` is a multiple of what the extrapolation has changed over the piece, and
  /// rounding: above the error at its end, of the size of that between its ends.
  void fill_segment(Segment<Dim>& segment) const {
    const auto last = static_cast<std::size_t>(piece_ - 1);
    segment.resize(static_cast<int>(q_.size()), 4);
    segment.set_interval(time_of(piece_ - 1), t_);
    const double h = segment.duration();
    const State start = extrapolated(piece_ - 1);
    const State rate = fine_.rates[2 * last];
    const State correction = this->correction(piece_) - this->correction(piece_ - 1);
    const State middle = fine_.states[2 * last + 1] + this->correction(piece_ - 1) + 0.5 * correction;
    // q = start + rate h s + c2 s^2 + c3 s^3 + c4 s^4, 0 <= s <= 1, with
    // A = q(1) - start - rate h,  B = q(1/2) - start - rate h/2,  C = (q'(1/2) - q'(0)) h
    const State a = q_ - start - h * rate;
    const State b = middle - start - 0.5 * h * rate;
    const State c = h * (fine_.rates[2 * last + 1] - rate);
    auto& coefficients = segment.coefficients();
    coefficients.col(0) = start;
    coefficients.col(1) = rate;
    coefficients.col(2) = (a - 4.0 * c + 16.0 * b) / (h * h);
    coefficients.col(3) = (12.0 * c - 4.0 * a - 32.0 * b) / (h * h * h);
    coefficients.col(4) = (4.0 * a - 8.0 * c + 16.0 * b) / (h * h * h * h);
    segment.error_bound() = kQuarticError * correction.cwiseAbs() + kStateRounding * (start.cwiseAbs() + q_.cwiseAbs());
  }

  double time() const { return t_; }
  const State& state() const { return q_; }
  const StepStatistics& statistics() const { return statistics_; }

  std::vector<std::string> warnings() const {
    if (unconverged_ == 0) return {};
    return {"rk4-doubling: " + std::to_string(unconverged_) + (unconverged_ == 1 ? " interval" : " intervals") +
            ", the first from t = " + shortest_text(first_unconverged_) + " s, did not reach the relative accuracy " +
            shortest_text(accuracy_) + " with " + std::to_string(kMaxSubsteps) + " sub-steps; sub-steps of " +
            shortest_text(needed_step_) + " s would"};
  }

 private:
  static constexpr double kStateRounding = std::numeric_limits<double>::epsilon();

  /// The largest error of the quartic, q^(5) h^5 max(s^2 (s - 1/2)^2 (1 - s))/5! = 1.12e-4 q^(5) h^5, over the
  /// extrapolation's change, a sixteenth of the error of a step of Simpson's rule, q^(5) h^5/2880: 5.2 where the law
  /// depends on t alone.
  static constexpr double kQuarticError = 6.0;

  /// The states at the nodes of an interval and the rates at all of them but the last.
  struct March {
    std::vector<State> states;
    std::vector<State> rates;
  };

  /// `steps` steps of rk4 over the interval.
  void march(int steps, March& way) {
    const double h = (interval_end_ - interval_start_) / steps;
    way.states[0] = q_;
    for (int k = 0; k < steps; ++k) {
      const double t = interval_start_ + k * h;
      const State& q = way.states[static_cast<std::size_t>(k)];
      State& k1 = way.rates[static_cast<std::size_t>(k)];
      rate_(t, q, k1);
      stage_ = q + 0.5 * h * k1;
      rate_(t + 0.5 * h, stage_, k2_);
      stage_ = q + 0.5 * h * k2_;
      rate_(t + 0.5 * h, stage_, k3_);
      stage_ = q + h * k3_;
      rate_(t + h, stage_, k4_);
      way.states[static_cast<std::size_t>(k) + 1] = q + h / 6.0 * (k1 + 2.0 * k2_ + 2.0 * k3_ + k4_);
    }
    statistics_.law_evaluations += 4 * steps;
  }

  /// Marches until two agree or the cap is reached. Returns false where the result is not finite.
  bool compute_interval() {
    march(1, fine_);
    for (int steps = 2; steps <= kMaxSubsteps; steps *= 2) {
      std::swap(coarse_, fine_);
      march(steps, fine_);
      const State& q_a = coarse_.states[static_cast<std::size_t>(steps / 2)];
      const State& q_b = fine_.states[static_cast<std::size_t>(steps)];
      const double difference = (q_b - q_a).norm();
      const double size = 0.5 * (q_b + q_a).norm();
      const bool agree = difference <= accuracy_ * size;
      if (!agree && steps < kMaxSubsteps) {
        ++statistics_.rejected_steps;
        continue;
      }
      piece_ = 0;
      piece_count_ = steps / 2;
      if (!extrapolated(piece_count_).allFinite()) break;
      propose_step(difference, size);
      if (!agree) remember_unconverged();
      return true;
    }
    piece_ = piece_count_ = 0;
    return false;
  }

  /// The error of steps h is c h^4 with c = 16 (q_b - q_a) / (15 h^4); it is eps |q| for h = (eps |q| / |c|)^(1/4).
  void propose_step(double difference, double size) {
    const double h = std::abs(interval_end_ - interval_start_) / piece_count_;
    const double c = 16.0 / 15.0 * difference / (h * h * h * h);
    statistics_.proposed_step = c > 0.0 ? std::sqrt(std::sqrt(accuracy_ * size / c)) : 0.0;
  }

  void remember_unconverged() {
    if (unconverged_ == 0) {
      first_unconverged_ = interval_start_;
      needed_step_ = statistics_.proposed_step;
    }
    needed_step_ = std::min(needed_step_, statistics_.proposed_step);
    ++unconverged_;
  }

  double time_of(int piece) const {
    if (piece == piece_count_) return interval_end_;
    return interval_start_ + piece * ((interval_end_ - interval_start_) / piece_count_);
  }
  /// What Richardson's extrapolation adds to the finer march at the end of a piece.
  State correction(int piece) const {
    const auto i = static_cast<std::size_t>(piece);
    return (fine_.states[2 * i] - coarse_.states[i]) / 15.0;
  }
  State extrapolated(int piece) const { return fine_.states[2 * static_cast<std::size_t>(piece)] + correction(piece); }

  Rate rate_;
  double accuracy_;
  StepGrid grid_;
  double t_ = 0.0;
  State q_;
  double interval_start_ = 0.0, interval_end_ = 0.0;
  int piece_ = 0, piece_count_ = 0;  // of the interval: handed out, and in all
  March coarse_, fine_;              // q_a and q_b
  State k2_, k3_, k4_, stage_;
  long unconverged_ = 0;
  double first_unconverged_ = 0.0;  // s
  double needed_step_ = 0.0;        // s, the smallest that was proposed
  StepStatistics statistics_;
};

/// The method as a type, for solve<Rk4Doubling>(law, …).
struct Rk4Doubling {
  template <int Dim, class Law>
  static auto make_stepper(Law law, int, const StepOptions& options) {
    return Rk4DoublingStepper<Law, Dim>(std::move(law), options);
  }
};

}  // namespace trajet
