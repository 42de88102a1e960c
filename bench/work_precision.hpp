#pragma once

#include <benchmark/benchmark.h>

#include <string>

namespace trajet::bench {

/// Who did the work of a case. The table sets the best of each beside the others.
enum class Contender { law, scene, odeint };

/// One run of a problem: what the table needs to know of it.
struct Case {
  std::string problem;
  Contender contender;
  std::string method;  ///< with its tolerance or step
};

/// Registers `solve`, which solves the problem once and returns the error at its end. The error is printed with the
/// time.
template <class Solve>
void add_case(const Case& properties, Solve solve);

/// Encodes a case in a benchmark's name, and reads it back from there.
std::string name_of(const Case& properties);
Case case_of(const std::string& name);

template <class Solve>
void add_case(const Case& properties, Solve solve) {
  benchmark::RegisterBenchmark(name_of(properties).c_str(), [solve](benchmark::State& state) {
    double error = 0.0;
    for (auto _ : state) {
      error = solve();
      benchmark::DoNotOptimize(error);
    }
    state.counters["error"] = error;
  })->Unit(benchmark::kMicrosecond);
}

/// The cases of each file.
void add_smooth_problems();
void add_rifle_shot();

}  // namespace trajet::bench
