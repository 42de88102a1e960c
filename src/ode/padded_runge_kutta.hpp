#pragma once

#include <Eigen/Core>
#include <array>
#include <cstring>
#include <numeric>
#include <utility>
#include <vector>

#include "trajet/ode/runge_kutta.hpp"
#include "trajet/ode/system.hpp"

namespace trajet::detail {

/// The rate of a System for a state of `Dim` lanes, in which its components are where its BlockBorder has them, or side
/// by side. Lanes of no component are zero.
template <int Dim>
class PaddedRate {
  using Lanes = typename PackedState<Dim>::Block;
  using Bits = typename LanesOf<Dim>::Bits;

 public:
  explicit PaddedRate(System& system) : system_(&system), border_(system.block_border()) {
    if (border_.lanes.empty()) {
      lanes_.resize(static_cast<std::size_t>(system.dimension()));
      std::iota(lanes_.begin(), lanes_.end(), 0);
    } else {
      lanes_ = border_.lanes;
    }
    components_.fill(-1);
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
      const auto lane = static_cast<std::size_t>(lanes_[i]);
      components_[lane] = static_cast<int>(i);
      is_component_[lanes_[i]] = -1;
    }
  }

  int dimension() const { return static_cast<int>(lanes_.size()); }
  /// The lane of a component, and the component of a lane, -1 where there is none.
  int lane(int component) const { return lanes_[static_cast<std::size_t>(component)]; }
  int component(Eigen::Index lane) const { return components_[static_cast<std::size_t>(lane)]; }

  TRAJET_INLINE void block(double t, const Lanes& q, Lanes& dq) const {
    if (border_.state == nullptr) return by_components(t, q, dq);
    std::memcpy(static_cast<void*>(border_.state), &q, sizeof(Lanes));
    system_->evaluate_blocks(t);
    Lanes rate;
    join<Dim>(border_.rate, rate);
    dq = reinterpret_cast<Lanes>(reinterpret_cast<Bits>(rate) & is_component_);
  }

 private:
  void by_components(double t, const Lanes& q, Lanes& dq) const {
    Eigen::Matrix<double, Dim, 1> state, rate = Eigen::Matrix<double, Dim, 1>::Zero();
    PackedState<Dim>::write(q, state.data(), 0);
    system_->rate(t, state.data(), rate.data());
    PackedState<Dim> packed;
    packed.assign(rate);
    dq = packed[0];
  }

  /// Blocks beside each other as one: each by a load of its own, since a load that spans two stores waits for both.
  template <int Width>
  TRAJET_INLINE static void join(const Block4* blocks, typename LanesOf<Width>::Type& lanes) {
    if constexpr (Width == Block4::kLanes) {
      lanes = blocks->lanes;
    } else {
      typename LanesOf<Width / 2>::Type low, high;
      join<Width / 2>(blocks, low);
      join<Width / 2>(blocks + Width / 2 / Block4::kLanes, high);
      [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
        lanes = __builtin_shufflevector(low, high, I...);
      }
      (std::make_integer_sequence<int, Width>());
    }
  }

  System* system_;
  BlockBorder border_;
  std::vector<int> lanes_;
  std::array<int, static_cast<std::size_t>(Dim)> components_{};
  Bits is_component_{};  // all bits of the lanes of components
};

/// A Runge-Kutta method on a System whose components fit into `Dim` lanes, as a Stepper of run-time dimension. Inside,
/// the state has the fixed dimension `Dim` and stays in vector registers.
template <class Method, int Dim>
class PaddedRungeKutta {
 public:
  using State = Eigen::VectorXd;
  static constexpr int kDimension = Eigen::Dynamic;

  PaddedRungeKutta(System& system, const StepOptions& options)
      : layout_(system), stepper_(layout_, options), state_(layout_.dimension()) {}

  void start(double t, const State& q) { stepper_.start(t, padded(q)); }
  void amend(const State& q) { stepper_.amend(padded(q)); }
  StepStatus advance(double t_limit) {
    const StepStatus status = stepper_.advance(t_limit);
    for (int i = 0; i < layout_.dimension(); ++i) state_[i] = stepper_.state()[layout_.lane(i)];
    return status;
  }
  void fill_segment(Segment<>& segment) {
    stepper_.fill_segment(segment_);
    segment.resize(layout_.dimension(), segment_.degree());
    segment.set_interval(segment_.t0(), segment_.t1());
    for (int i = 0; i < layout_.dimension(); ++i) {
      segment.coefficients().row(i) = segment_.coefficients().row(layout_.lane(i));
      segment.error_bound()[i] = segment_.error_bound()[layout_.lane(i)];
    }
  }

  double time() const { return stepper_.time(); }
  const State& state() const { return state_; }
  const StepStatistics& statistics() const { return stepper_.statistics(); }

 private:
  using Padded = Eigen::Matrix<double, Dim, 1>;

  Padded padded(const State& q) {
    state_ = q;
    Padded result = Padded::Zero();
    for (int i = 0; i < layout_.dimension(); ++i) result[layout_.lane(i)] = q[i];
    return result;
  }

  PaddedRate<Dim> layout_;
  RungeKutta<Method, PaddedRate<Dim>, Dim> stepper_;
  State state_;
  Segment<Dim> segment_;
};

}  // namespace trajet::detail
