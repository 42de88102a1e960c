#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "trajet/math/force_inline.hpp"
#include "trajet/ode/segment.hpp"
#include "trajet/ode/step_control.hpp"
#include "trajet/ode/step_state.hpp"
#include "trajet/ode/tableau.hpp"
#include "trajet/portable.hpp"

namespace trajet::detail {

/// One step of the explicit Runge-Kutta method `Method` (a tableau such as Rk4Tableau): all of its arithmetic, no
/// decision.
///
/// The law is inlined into every stage; loops over stages are unrolled; zero coefficients leave no trace. A packed
/// state goes through the stages in registers: component by component to a law that is written so, as one block to a
/// rate that has `block(t, q, dq)`.
template <class Method, int Dim>
class RungeKuttaStep {
  static constexpr auto& kTableau = Method::kTableau;
  static constexpr std::size_t kStages = kTableau.kStages;
  static constexpr std::size_t kLast = kStages - 1;
  static constexpr std::size_t kAllStages = kStages + kTableau.kDenseStages;
  static_assert(std::equal(kTableau.b.begin(), kTableau.b.end(), kTableau.a[kLast].begin()) &&
                    kTableau.c[kLast].value() == 1.0,
                "the last stage is the end rate");

 public:
  using Vector = StepState<Dim>;
  using State = Eigen::Matrix<double, Dim, 1>;
  /// Evaluations of the law by compute(), without the rate at the end.
  static constexpr long kInnerEvaluations = static_cast<long>(kStages) - 2;

  double t0() const { return t0_; }
  double t1() const { return t1_; }
  /// The state at t1.
  const State& end() const { return end_; }

  /// A step of no length at (t, q).
  void start(double t, const State& q) {
    t0_ = t1_ = t;
    end_ = q;
    q1_.assign(q);
    if constexpr (!kIsPacked<Dim>) {  // the only allocations, the first time
      q_stage_ = q;
      q0_.assign(q);
      for (Vector& k : k_) k.assign(q);
    }
  }

  /// The last stage: the rate at the end.
  template <class Rate>
  TRAJET_INLINE void evaluate_end(Rate& rate) {
    evaluate(rate, t1_, end_, k_[kLast]);
  }

  /// Begins the next step where this one ended.
  TRAJET_INLINE void begin_next() {
    t0_ = t1_;
    q0_ = q1_;
    k_[0] = k_[kLast];
  }

  /// Back to the state and the rate at t0.
  void undo() {
    t1_ = t0_;
    q1_ = q0_;
    k_[kLast] = k_[0];
    for_each_block([&](Eigen::Index b) { Vector::write(q1_[b], end_.data(), b); });
  }

  /// From the state at t0: the stages and the state at `t1`. The rates at the start and at the end are the ones there
  /// are, or, `WithStartRate` and `WithEndRate`, evaluated.
  template <bool WithStartRate, bool WithEndRate, class Rate>
  TRAJET_INLINE void compute(double t1, Rate& rate) {
    t1_ = t1;
    if constexpr (kTakesBlocks<Rate>) {
      compute_block_stages<WithStartRate, WithEndRate>(rate);
    } else if constexpr (kIsPacked<Dim>) {
      State q, newest;  // not members: nothing need be stored
      compute_stages<WithStartRate, WithEndRate>(rate, q, newest);
    } else {
      compute_stages<WithStartRate, WithEndRate>(rate, q_stage_, q_stage_);
    }
  }

  TRAJET_INLINE bool end_is_finite() const {
    return std::isfinite(
        largest_component([&](Eigen::Index b, Block & x) __attribute__((always_inline)) { x = q1_[b]; }));
  }

  /// log2 of the largest component of the error estimate over its tolerance atol + rtol |q|, |q| the larger one of both
  /// ends, within 0.003; above 1000 if it is not finite. Each `atol` > 0.
  ///
  /// The step's successor waits for this number: as a logarithm it needs neither square root nor division.
  TRAJET_INLINE double log2_error_norm(const Vector& atol, double rtol) const {
    const double first = difference_norm<ErrorWeights>(atol, rtol);
    if constexpr (kHasSecondCompanion<Method>) {
      const double second = difference_norm<SecondErrorWeights>(atol, rtol);
      const double sum = first * first + 0.01 * (second * second);
      if (!(sum <= std::numeric_limits<double>::max())) return kLog2NotFinite;
      return 2.0 * rough_log2(first) - 0.5 * rough_log2(sum);
    } else {
      return rough_log2(first);
    }
  }
  /// What rough_log2 makes of infinity, and more of what is not a number.
  static constexpr double kLog2NotFinite = 1024.0;

  /// The largest component at the end over the tolerance there: of the state, of the rate after evaluate_end(), and of
  /// the change of the rate in a step `h` of Euler's method, which spoils the first stage. Each `atol` > 0.
  double state_norm(const Vector& atol, double rtol) const {
    return end_norm(atol, rtol, [&](Eigen::Index b, Block& x) { x = q1_[b]; });
  }
  double rate_norm(const Vector& atol, double rtol) const {
    return end_norm(atol, rtol, [&](Eigen::Index b, Block& x) { x = k_[kLast][b]; });
  }
  template <class Rate>
  double rate_change_norm(double h, Rate& rate, const Vector& atol, double rtol) {
    for_each_block([&](Eigen::Index b) {
      const Block q = q1_[b] + h * k_[kLast][b];
      Vector::write(q, q_stage_.data(), b);
    });
    evaluate(rate, t1_ + h, q_stage_, k_[0]);
    return end_norm(atol, rtol, [&](Eigen::Index b, Block& x) { x = k_[0][b] - k_[kLast][b]; });
  }

  /// The step as polynomials, with the error estimate and rounding as bound, after evaluate_end(). Evaluates the law
  /// for the stages that only the dense output needs.
  template <class Rate>
  TRAJET_INLINE void fill(Segment<Dim>& segment, Rate& rate) {
    constexpr int kDegree = kTableau.kDenseDegree;
    [&]<std::size_t... S>(std::index_sequence<S...>) __attribute__((always_inline)) {
      (compute_dense_stage<kStages + S>(rate), ...);
    }
    (std::make_index_sequence<kTableau.kDenseStages>());
    segment.resize(static_cast<int>(end_.size()), kDegree);
    segment.set_interval(t0_, t1_);
    const double h = t1_ - t0_;
    const double per_h = 1.0 / h;
    for_each_block([&](Eigen::Index b) __attribute__((always_inline)) {
      double* coefficients = segment.coefficients().data();
      Vector::write(q0_[b], coefficients, b);
      std::array<Block, kDegree> dense{};
      double scale = 1.0;  // h^(1 - power)
      [&]<int... P>(std::integer_sequence<int, P...>) __attribute__((always_inline)) {
        (add_weighted<DenseWeights<P>, kAllStages>(1.0, b, dense[P]), ...);
        ((write_power<P>(dense, scale, b, coefficients += end_.size()), scale *= per_h), ...);
      }
      (std::make_integer_sequence<int, kDegree>());
    });
    fill_error_bound(segment);
  }

 private:
  using Block = typename Vector::Block;

  // The state is rounded twice in a step, and so are the values of the polynomials near it.
  static constexpr double kStateRounding = std::numeric_limits<double>::epsilon();

  template <std::size_t Stage>
  struct StageWeights {
    static constexpr double value(std::size_t j) { return kTableau.a[Stage][j].value(); }
  };
  struct ErrorWeights {
    static constexpr double value(std::size_t j) { return kTableau.b[j].value() - kTableau.companion[j].value(); }
  };
  struct SecondErrorWeights {
    static constexpr double value(std::size_t j) { return kTableau.b[j].value() - Method::kSecondCompanion[j].value(); }
  };
  template <std::size_t Column>
  struct DenseWeights {
    static constexpr double value(std::size_t j) { return kTableau.dense[j][Column].value(); }
  };

  template <class F>
  TRAJET_INLINE void for_each_block(F&& f) const {
    for (Eigen::Index b = 0; b < q0_.blocks(); ++b) f(b);
  }

  // Blocks go by reference: how one is passed by value depends on the instruction set.

  /// The largest magnitude of all components of x, where f(b, x) sets a block of it.
  template <class F>
  TRAJET_INLINE double largest_component(F&& f) const {
    std::int64_t largest = 0;
    for_each_block([&](Eigen::Index b) __attribute__((always_inline)) {
      Block x;
      f(b, x);
      largest = std::max(largest, Vector::largest_magnitude_bits(x));
    });
    return bit_cast<double>(largest);
  }

  template <class F>
  double end_norm(const Vector& atol, double rtol, F&& f) const {
    return largest_component([&](Eigen::Index b, Block& x) {
      Block end = q1_[b];
      Vector::take_magnitude(end);
      f(b, x);
      x /= atol[b] + rtol * end;
    });
  }

  /// Writes the coefficient of (t - t0)^(P + 1), where `dense` are the coefficients of the basis.
  template <int P, std::size_t Degree>
  TRAJET_INLINE static void write_power(const std::array<Block, Degree>& dense, double scale, Eigen::Index b,
                                        double* coefficients) {
    Block sum{};
    if constexpr (requires { Method::kDenseBasis; }) {
      [&]<std::size_t... F>(std::index_sequence<F...>) __attribute__((always_inline)) {
        (add<Method::kDenseBasis[F][P] != 0>(Method::kDenseBasis[F][P], dense[F], sum), ...);
      }
      (std::make_index_sequence<Degree>());
    } else {
      sum = dense[P];
    }
    sum *= scale;
    Vector::write(sum, coefficients, b);
  }

  /// The difference to the companion, or both companions, plus rounding.
  TRAJET_INLINE void fill_error_bound(Segment<Dim>& segment) {
    const double h = t1_ - t0_;
    double* const bound = segment.error_bound().data();
    write_difference<ErrorWeights>(h, bound);
    if constexpr (kHasSecondCompanion<Method>) {
      write_difference<SecondErrorWeights>(h, q_stage_.data());
      for (Eigen::Index i = 0; i < end_.size(); ++i) bound[i] = of_both_companions(bound[i], q_stage_[i]);
    }
    for (Eigen::Index i = 0; i < end_.size(); ++i)
      bound[i] += kStateRounding * (std::abs(segment.coefficients()(i, 0)) + std::abs(end_[i]));
  }
  template <class Weights>
  TRAJET_INLINE void write_difference(double h, double* components) const {
    for_each_block([&](Eigen::Index b) __attribute__((always_inline)) {
      Block difference{};
      add_weighted<Weights, kStages>(h, b, difference);
      Vector::take_magnitude(difference);
      Vector::write(difference, components, b);
    });
  }

  /// The norm of the difference to a companion over the tolerance.
  template <class Weights>
  TRAJET_INLINE double difference_norm(const Vector& atol, double rtol) const {
    return largest_component([&](Eigen::Index b, Block & x) __attribute__((always_inline)) {
      Block start = q0_[b], end = q1_[b], error{};
      Vector::take_magnitude(start);
      Vector::take_magnitude(end);
      add_weighted<Weights, kStages>(t1_ - t0_, b, error);
      x = error / (atol[b] + rtol * (start > end ? start : end));
    });
  }

  /// e1^2 / sqrt(e1^2 + (e2 / 10)^2) of magnitudes: at most e1.
  TRAJET_INLINE static double of_both_companions(double first, double second) {
    const double sum = first * first + 0.01 * (second * second);
    if (!(sum > 0.0 && sum <= std::numeric_limits<double>::max())) return first;
    return first * first / std::sqrt(sum);
  }

  template <class Rate>
  static constexpr bool kTakesBlocks = requires(Rate& rate, const Block& q, Block& k) {
    rate.block(0.0, q, k);
  };

  template <class Rate>
  TRAJET_INLINE static void evaluate(Rate& rate, double t, const State& q, Vector& k) {
    if constexpr (kTakesBlocks<Rate>) {
      Vector packed;
      packed.assign(q);
      rate.block(t, packed[0], k[0]);
    } else {
      State newest;
      evaluate(rate, t, q, k, newest);
    }
  }

  /// The same, which leaves a packed rate also in `newest`, component by component.
  template <class Rate>
  TRAJET_INLINE static void evaluate(Rate& rate, double t, const State& q, Vector& k, State& newest) {
    if constexpr (kIsPacked<Dim>) {
      rate(t, q, newest);
      k.assign(newest);
    } else {
      rate(t, q, k.components());
    }
  }

  template <bool WithStartRate, bool WithEndRate, class Rate>
  TRAJET_INLINE void compute_stages(Rate& rate, State& q, State& newest) {
    if constexpr (WithStartRate) {
      evaluate(rate, t0_, end_, k_[0], newest);
    } else if constexpr (kIsPacked<Dim>) {
      unrolled<Dim>([&](Eigen::Index i) __attribute__((always_inline)) { newest[i] = k_[0][0][i]; });
    }
    [&]<std::size_t... S>(std::index_sequence<S...>) __attribute__((always_inline)) {
      (compute_stage<S + 1>(rate, q, newest), ...);
    }
    (std::make_index_sequence<kStages - 2>());
    combine<kLast>(q, newest);
    q1_.assign(q);
    for_each_block([&](Eigen::Index b) __attribute__((always_inline)) { Vector::write(q1_[b], end_.data(), b); });
    if constexpr (WithEndRate) evaluate(rate, t1_, q, k_[kLast], newest);
  }

  /// The same where the rate takes blocks.
  template <bool WithStartRate, bool WithEndRate, class Rate>
  TRAJET_INLINE void compute_block_stages(Rate& rate) {
    if constexpr (WithStartRate) rate.block(t0_, q0_[0], k_[0][0]);
    [&]<std::size_t... S>(std::index_sequence<S...>) __attribute__((always_inline)) {
      (compute_block_stage<S + 1, true>(rate), ...);
    }
    (std::make_index_sequence<kStages - 2>());
    compute_block_stage<kLast, WithEndRate>(rate);
    Vector::write(q1_[0], end_.data(), 0);
  }
  template <std::size_t S, bool WithRate, class Rate>
  TRAJET_INLINE void compute_block_stage(Rate& rate) {
    const double h = t1_ - t0_;
    Block sum{};
    add_weighted<StageWeights<S>, S - 1>(h, 0, sum);
    const Block q = (q0_[0] + sum) + (h * kTableau.a[S][S - 1].value()) * k_[S - 1][0];
    if constexpr (S == kLast) q1_[0] = q;
    if constexpr (WithRate) rate.block(S == kLast ? t1_ : t0_ + kTableau.c[S].value() * h, q, k_[S][0]);
  }

  template <std::size_t S, class Rate>
  TRAJET_INLINE void compute_dense_stage(Rate& rate) {
    for_each_block([&](Eigen::Index b) __attribute__((always_inline)) {
      Block q = q0_[b], sum{};
      add_weighted<StageWeights<S>, S>(t1_ - t0_, b, sum);
      q += sum;
      Vector::write(q, q_stage_.data(), b);
    });
    evaluate(rate, t0_ + kTableau.c[S].value() * (t1_ - t0_), q_stage_, k_[S]);
  }

  template <std::size_t S, class Rate>
  TRAJET_INLINE void compute_stage(Rate& rate, State& q, State& newest) {
    combine<S>(q, newest);
    constexpr double c = kTableau.c[S].value();
    evaluate(rate, t0_ + c * (t1_ - t0_), q, k_[S], newest);
  }

  /// q = q0 + h sum_{j<S} a_Sj k_j. The newest stage comes last and alone: all the rest is summed while it is computed.
  template <std::size_t S>
  TRAJET_INLINE void combine(State& q, const State& newest) const {
    const double h = t1_ - t0_;
    const double weight = h * kTableau.a[S][S - 1].value();
    for_each_block([&](Eigen::Index b) __attribute__((always_inline)) {
      Block rest = q0_[b];
      if constexpr (S > 1) {
        Block sum{};
        add_weighted<StageWeights<S>, S - 1>(h, b, sum);
        rest += sum;
      }
      if constexpr (kIsPacked<Dim>) {
        unrolled<Dim>([&](Eigen::Index i) __attribute__((always_inline)) { q[i] = rest[i] + weight * newest[i]; });
      } else {
        q[b] = rest + weight * k_[S - 1][b];
      }
    });
  }

  /// sum += scale * sum_{j<Count} weight_j k_j
  template <class Weights, std::size_t Count>
  TRAJET_INLINE void add_weighted(double scale, Eigen::Index b, Block& sum) const {
    [&]<std::size_t... J>(std::index_sequence<J...>) __attribute__((always_inline)) {
      (add<Weights::value(J) != 0.0>(scale * Weights::value(J), k_[J][b], sum), ...);
    }
    (std::make_index_sequence<Count>());
  }
  template <bool kNonZero>
  TRAJET_INLINE static void add(double weight, const Block& stage, Block& sum) {
    if constexpr (kNonZero) sum += weight * stage;
  }

  double t0_ = 0.0;
  double t1_ = 0.0;
  Vector q0_;
  Vector q1_;
  std::array<Vector, kAllStages> k_;
  State end_;
  State q_stage_;  // where a stage is evaluated
};

}  // namespace trajet::detail
