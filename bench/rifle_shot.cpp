#include <Eigen/Core>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <memory>
#include <numbers>

#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/ode/solve.hpp"
#include "work_precision.hpp"

/// The rifle shot's impact: on the target (0.05 degrees) and on the ground (-0.5 degrees). The error is that of its
/// time, in s.
namespace trajet::bench {
namespace {

namespace odeint = boost::numeric::odeint;

constexpr double kSpeed = 500.0, kGravity = 9.8, kHeight = 1.5;                      // m/s, m/s^2, m
constexpr double kTargetDistance = 180.0, kTargetHeight = 1.0, kTargetRadius = 0.2;  // m

struct Shot {
  const char* problem;
  double angle_rad;
  bool hits_target;

  /// The closed form of the course.
  double exact_time() const {
    const double up = kSpeed * std::sin(angle_rad);
    if (hits_target) return kTargetDistance / (kSpeed * std::cos(angle_rad));
    return (up + std::sqrt(up * up + 2.0 * kHeight * kGravity)) / kGravity;
  }
};

/// State: (r, v).
struct Ballistic {
  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    for (int i = 0; i < 3; ++i) dq[i] = q[3 + i];
    dq[3] = 0.0;
    dq[4] = 0.0;
    dq[5] = -kGravity;
  }
};

using State = Eigen::Matrix<double, 6, 1>;

State start(const Shot& shot) {
  return (State() << 0, 0, kHeight, kSpeed * std::cos(shot.angle_rad), 0, kSpeed * std::sin(shot.angle_rad)).finished();
}

template <class Method>
void add_trajet(const Shot& shot, const char* method, const StepOptions& options) {
  using Stepper = decltype(Method::template make_stepper<6>(Ballistic{}, 6, options));
  auto stepper = std::make_shared<Stepper>(Method::template make_stepper<6>(Ballistic{}, 6, options));
  const Disk target = make_disk({kTargetDistance, 0, kTargetHeight}, {-1, 0, 0}, kTargetRadius);
  const Plane ground = make_plane({0, 0, 0}, {0, 0, 1});
  add_case({shot.problem, Contender::law, method}, [=] {
    Segment<6> segment;
    ContactMemory target_memory, ground_memory;
    double impact = HUGE_VAL;
    stepper->start(0.0, start(shot));
    while (impact == HUGE_VAL && stepper->advance(5.0) == StepStatus::ok) {
      stepper->fill_segment(segment);
      const PointPath path(segment, 0);
      const MovingBall ball{path, 0.0, segment.t0(), segment.t1()};
      const ContactResult on_target = first_contact_with(target, ball, target_memory);
      const ContactResult on_ground = first_contact_with(ground, ball, ground_memory);
      if (on_target.status == ContactStatus::hit) impact = on_target.time;
      if (on_ground.status == ContactStatus::hit) impact = std::min(impact, on_ground.time);
      target_memory = on_target.memory;
      ground_memory = on_ground.memory;
    }
    return std::abs(impact - shot.exact_time());
  });
}

/// What a user of odeint writes: its dense output, a look at the signs after each step, and bisection.
void add_odeint_search(const Shot& shot) {
  using OdeintState = std::array<double, 6>;
  add_case({shot.problem, Contender::odeint, "dopri5+signs"}, [shot] {
    const auto law = [](const OdeintState& q, OdeintState& dq, double t) { Ballistic{}(t, q, dq); };
    auto stepper = odeint::make_dense_output(1e-10, 1e-10, odeint::runge_kutta_dopri5<OdeintState>());
    OdeintState q;
    Eigen::Map<State>(q.data()) = start(shot);
    stepper.initialize(q, 0.0, 0.01);
    const auto first_root = [&](double a, double b, auto&& gap) {
      OdeintState at;
      while (true) {
        const double middle = 0.5 * (a + b);
        if (middle <= a || middle >= b) return b;
        stepper.calc_state(middle, at);
        (gap(at) > 0.0 ? a : b) = middle;
      }
    };
    const auto to_target = [](const OdeintState& x) { return kTargetDistance - x[0]; };
    const auto to_ground = [](const OdeintState& x) { return x[2]; };
    while (stepper.current_time() < 5.0) {
      const auto [from, to] = stepper.do_step(law);
      const OdeintState& end = stepper.current_state();
      double impact = HUGE_VAL;
      if (to_ground(end) <= 0.0) impact = first_root(from, to, to_ground);
      if (to_target(stepper.previous_state()) > 0.0 && to_target(end) <= 0.0) {
        const double crossing = first_root(from, to, to_target);
        OdeintState at;
        stepper.calc_state(crossing, at);
        if (std::hypot(at[1], at[2] - kTargetHeight) <= kTargetRadius) impact = std::min(impact, crossing);
      }
      if (impact != HUGE_VAL) return std::abs(impact - shot.exact_time());
    }
    return kFailed;
  });
}

}  // namespace

void add_rifle_shot() {
  constexpr double kDegree = std::numbers::pi / 180.0;
  for (const Shot& shot :
       {Shot{"rifle shot on target", 0.05 * kDegree, true}, Shot{"rifle shot on ground", -0.5 * kDegree, false}}) {
    add_trajet<Taylor>(shot, "taylor", {});
    add_trajet<Dopri5>(shot, "dopri5", {.rtol = 1e-10, .atol = 1e-10});
    add_trajet<Rk4>(shot, "rk4", {.step = 0.3});
    add_odeint_search(shot);
  }
}

}  // namespace trajet::bench
