#pragma once

#include <benchmark/benchmark.h>

#include <string>
#include <utility>

namespace trajet::bench {

/// Who did the work of a case. The tables set the best of each beside the others.
enum class Contender { law, solve, scene, odeint, gsl, sundials, bullet, ode };
inline constexpr Contender kContenders[] = {Contender::law, Contender::solve,    Contender::scene,  Contender::odeint,
                                            Contender::gsl, Contender::sundials, Contender::bullet, Contender::ode};

/// An error that no run which came to its end has.
inline constexpr double kFailed = 1e100;

/// One run of a problem: what the table needs to know of it.
struct Case {
  std::string problem;
  Contender contender;
  std::string method;  ///< with its tolerance or step
};

/// Registers `solve`, which solves the problem once and returns the error at its end, or `kFailed`, or not a number.
/// The error is printed with the time.
template <class Solve>
void add_case(const Case& properties, Solve solve);

/// Encodes a case in a benchmark's name, and reads it back from there.
std::string name_of(const Case& properties);
Case case_of(const std::string& name);

/// A method with its tolerance, or its number of steps.
std::string labelled(const char* method, double tolerance);
std::string labelled(const char* method, int steps);

template <class Solve>
void add_case(const Case& properties, Solve solve) {
  benchmark::RegisterBenchmark(name_of(properties).c_str(), [solve](benchmark::State& state) {
    double error = 0.0;
    for (auto _ : state) {
      error = solve();
      benchmark::DoNotOptimize(std::as_const(error));
    }
    state.counters["error"] = error < kFailed ? error : kFailed;  // also where it is not a number
  })->Unit(benchmark::kMicrosecond);
}

/// The cases of each file.
void add_laws();
void add_scenes();
void add_rifle_shot();
void add_boxes();
void add_turning_contacts();
void add_motions();
void add_odeint();
void add_gsl();
void add_sundials();
void add_bullet();
void add_ode();

}  // namespace trajet::bench
