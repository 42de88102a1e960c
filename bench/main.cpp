#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "work_precision.hpp"

/// Runs all benchmarks, then prints for each problem and accuracy the fastest run of each contender that reached it.
namespace trajet::bench {
namespace {

struct Measurement {
  Case properties;
  double microseconds;  ///< median of the repetitions
  double error;
};

/// Collects the median of each case's repetitions.
class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override {
    PrintBasicContext(&GetErrorStream(), context);
    return true;
  }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Aggregate || run.aggregate_name != "median") continue;
      const auto error = run.counters.find("error");
      all_.push_back({case_of(run.run_name.function_name), run.GetAdjustedCPUTime(),
                      error == run.counters.end() ? 0.0 : error->second.value});
    }
  }

  /// By problem, contender and method.
  std::vector<Measurement> measurements() const {
    std::vector<Measurement> sorted = all_;
    std::sort(sorted.begin(), sorted.end(),
              [](const Measurement& a, const Measurement& b) { return name_of(a.properties) < name_of(b.properties); });
    return sorted;
  }

 private:
  std::vector<Measurement> all_;
};

const Measurement* fastest(const std::vector<Measurement>& all, const std::string& problem, Contender contender,
                           double error) {
  const Measurement* best = nullptr;
  for (const Measurement& m : all)
    if (m.properties.problem == problem && m.properties.contender == contender && m.error <= error &&
        (best == nullptr || m.microseconds < best->microseconds))
      best = &m;
  return best;
}

void print_entry(const Measurement* m) {
  if (m == nullptr)
    std::printf(" | %-34s", "-");
  else
    std::printf(" | %8.3f us  %-13s %.0e", m->microseconds, m->properties.method.c_str(), m->error);
}

void print_ratio(const Measurement* ours, const Measurement* peer) {
  if (ours == nullptr || peer == nullptr)
    std::printf(" |     -");
  else
    std::printf(" | %5.2f", ours->microseconds / peer->microseconds);
}

void print_tables(const std::vector<Measurement>& all) {
  std::vector<std::string> problems;
  for (const Measurement& m : all)
    if (std::find(problems.begin(), problems.end(), m.properties.problem) == problems.end())
      problems.push_back(m.properties.problem);
  std::printf("%-44s %12s %12s\n", "case", "time [us]", "error");
  for (const Measurement& m : all)
    std::printf("%-44s %12.3f %12.2e\n", name_of(m.properties).c_str(), m.microseconds, m.error);
  for (const std::string& problem : problems) {
    std::printf("\n%s: the fastest run whose error at the end is within the accuracy (its own error behind it)\n",
                problem.c_str());
    std::printf("%-8s | %-34s | %-34s | %-34s | law/  | scene/\n", "accuracy", "trajet, C++ law", "trajet, scene",
                "Boost.odeint");
    std::printf("%-8s | %-34s | %-34s | %-34s | odeint| odeint\n", "", "", "", "");
    for (int digits = 4; digits <= 14; digits += 2) {
      const double accuracy = std::pow(10.0, -digits);
      const Measurement* law = fastest(all, problem, Contender::law, accuracy);
      const Measurement* scene = fastest(all, problem, Contender::scene, accuracy);
      const Measurement* odeint = fastest(all, problem, Contender::odeint, accuracy);
      std::printf("%-8.0e", accuracy);
      for (const Measurement* m : {law, scene, odeint}) print_entry(m);
      print_ratio(law, odeint);
      print_ratio(scene, odeint);
      std::printf("\n");
    }
  }
}

}  // namespace

std::string name_of(const Case& properties) {
  static constexpr const char* kContenders[] = {"law", "scene", "odeint"};
  return properties.problem + "/" + kContenders[static_cast<int>(properties.contender)] + "/" + properties.method;
}

Case case_of(const std::string& name) {
  const std::size_t first = name.find('/'), second = name.find('/', first + 1);
  const std::string contender = name.substr(first + 1, second - first - 1);
  return {name.substr(0, first),
          contender == "law"     ? Contender::law
          : contender == "scene" ? Contender::scene
                                 : Contender::odeint,
          name.substr(second + 1)};
}

}  // namespace trajet::bench

int main(int argc, char** argv) {
  // Short repetitions, taken in turn over all cases: a machine whose speed drifts then slows all contenders alike.
  std::vector<std::string> defaults = {argv[0], "--benchmark_min_time=0.02", "--benchmark_repetitions=5",
                                       "--benchmark_enable_random_interleaving=true",
                                       "--benchmark_report_aggregates_only=true"};
  defaults.insert(defaults.end(), argv + 1, argv + argc);
  std::vector<char*> arguments;
  for (std::string& argument : defaults) arguments.push_back(argument.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  trajet::bench::add_smooth_problems();
  trajet::bench::add_rifle_shot();
  trajet::bench::Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  trajet::bench::print_tables(collector.measurements());
}
