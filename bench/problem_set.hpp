#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "problems/drag.hpp"
#include "problems/free_kick.hpp"
#include "problems/free_top.hpp"
#include "problems/kepler.hpp"
#include "trajet/scene/scene.hpp"

/// The smooth problems of the benchmark: for each its name in the tables, its true end, and the same as a scene.
namespace trajet::bench {

template <class Problem>
struct Benchmark;

/// A scene of one body with a mass point's law, and its start.
inline Scene body_scene(const Vector3& position, const Vector3& velocity, const char* acceleration, double end_time) {
  Scene scene;
  BodyDefinition body;
  body.name = "particle";
  body.position = position;
  body.velocity = velocity;
  body.acceleration = Expression(acceleration);
  scene.bodies = {body};
  scene.time.end = Expression(end_time);
  return scene;
}

/// Problems whose state is (v, r); a body's is (r, v).
template <class Problem>
struct BodyBenchmark {
  using State = typename Problem::State;
  static State from_scene(const Eigen::VectorXd& q) {
    constexpr int kHalf = Problem::kDimension / 2;
    return (State() << q.segment<kHalf>(3), q.head<kHalf>()).finished();
  }
};

template <>
struct Benchmark<problems::Drag> : BodyBenchmark<problems::Drag> {
  static constexpr const char* kName = "P1 drag";
  static State reference_end() { return problems::Drag::exact(problems::Drag::end_time()); }
  static Scene scene() {
    const State start = problems::Drag::start();
    return body_scene(start.tail<3>(), start.head<3>(), "[-vx*vx/2, -vy*vy, -vz*vz/3]", problems::Drag::end_time());
  }
};

template <>
struct Benchmark<problems::FreeKick> : BodyBenchmark<problems::FreeKick> {
  static constexpr const char* kName = "P2 free kick";
  static State reference_end() { return problems::FreeKick::reference_end(); }
  static Scene scene() {
    const State start = problems::FreeKick::start();
    return body_scene(start.tail<3>(), start.head<3>(), "[0, 0, -9.81] - 0.0126*norm(v)*v + cross([0, 0, 0.3], v)",
                      problems::FreeKick::end_time());
  }
};

template <>
struct Benchmark<problems::Kepler> : BodyBenchmark<problems::Kepler> {
  static constexpr const char* kName = "P4 Kepler";
  static State reference_end() { return problems::Kepler::reference_end(); }
  static Scene scene() {
    const State start = problems::Kepler::start();
    return body_scene({start[2], start[3], 0.0}, {start[0], start[1], 0.0}, "-r/norm(r)^3",
                      problems::Kepler::end_time());
  }
};

template <>
struct Benchmark<problems::FreeTop> {
  using State = problems::FreeTop::State;
  static constexpr const char* kName = "P3 free top";
  static State reference_end() { return problems::FreeTop::reference_end(); }
  static Scene scene() {
    static constexpr const char* kNames[] = {"q0", "q1", "q2", "q3", "w1", "w2", "w3"};
    static constexpr const char* kRates[] = {"-(q1*w1 + q2*w2 + q3*w3)/2",
                                             "(q0*w1 + q2*w3 - q3*w2)/2",
                                             "(q0*w2 + q3*w1 - q1*w3)/2",
                                             "(q0*w3 + q1*w2 - q2*w1)/2",
                                             "-w2*w3",
                                             "w3*w1",
                                             "-w1*w2/3"};
    const State start = problems::FreeTop::start();
    Scene scene;
    for (int i = 0; i < problems::FreeTop::kDimension; ++i)
      scene.states.push_back({.name = kNames[i], .value = start[i], .rate = Expression(kRates[i])});
    scene.time.end = Expression(problems::FreeTop::end_time());
    return scene;
  }
  static State from_scene(const Eigen::VectorXd& q) { return q; }
};

/// Calls f.operator()<Problem>() for each of them.
template <class F>
void for_each_problem(F&& f) {
  f.template operator()<problems::Drag>();
  f.template operator()<problems::FreeKick>();
  f.template operator()<problems::FreeTop>();
  f.template operator()<problems::Kepler>();
}

/// The largest error of a component at the end, not a number if any is not. `state` is anything with an index.
template <class Problem, class State>
double error_at_end(const State& state) {
  static const typename Problem::State reference = Benchmark<Problem>::reference_end();
  double error = 0.0;
  for (int i = 0; i < Problem::kDimension; ++i) {
    const double of_component = std::abs(state[static_cast<unsigned>(i)] - reference[i]);
    if (!(of_component <= error)) error = of_component;
  }
  return error;
}

inline constexpr double kTolerances[] = {1e0,  1e-1,  1e-2,  1e-3,  1e-4,  1e-5,  1e-6,  1e-7, 1e-8,
                                         1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15, 1e-16};

/// Those of extended precision.
inline constexpr double kExtendedTolerances[] = {1e-14, 1e-15, 1e-16, 1e-17};

/// The first step (s) of every embedded pair: the peers must be told one, so ours are told the same.
inline constexpr double kFirstStep = 0.1;

/// Numbers of steps of the methods with fixed steps.
template <class Problem>
std::vector<int> fixed_steps() {
  const double duration = Problem::end_time() - Problem::start_time();
  std::vector<int> steps;
  for (const double per_second : {0.5, 1.0, 2.0, 4.0, 5.0, 8.0, 16.0, 32.0, 64.0, 128.0})
    steps.push_back(std::max(1, static_cast<int>(std::lround(per_second * duration))));
  return steps;
}

}  // namespace trajet::bench
