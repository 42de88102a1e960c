#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <string>
#include <vector>

#include "work_precision.hpp"

/// Runs all benchmarks, then prints for each problem and accuracy the fastest run of each contender that reached it.
namespace trajet::bench {
namespace {

/// Of the contenders, in their order.
constexpr const char* kNames[] = {"law", "solve", "scene", "odeint", "gsl", "sundials", "bullet", "ode"};
static_assert(std::size(kNames) == std::size(kContenders));

/// The tables begin at an accuracy of 1e-2, which the engines reach.
constexpr int kLoosestDigits = 2;

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
      if (run.error_occurred || run.run_type != Run::RT_Aggregate || run.aggregate_name != "median") continue;
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

std::string entry(const Measurement* m) {
  if (m == nullptr) return "-";
  char text[64];
  std::snprintf(text, sizeof text, "%9.3f %-15s %.0e", m->microseconds, m->properties.method.c_str(), m->error);
  return text;
}

/// One time over another, or a dash.
std::string ratio(const Measurement* a, const Measurement* b) {
  if (a == nullptr || b == nullptr) return "-";
  char text[16];
  std::snprintf(text, sizeof text, "%.2f", a->microseconds / b->microseconds);
  return text;
}

/// The fastest run of each contender at each accuracy; ours over the best of all peers, and over the law's stepper.
void print_table(const std::vector<Measurement>& all, const std::string& problem) {
  std::vector<Contender> present;
  for (const Contender contender : kContenders)
    if (fastest(all, problem, contender, kFailed) != nullptr) present.push_back(contender);
  std::printf("\n%s: the fastest run whose error at the end is within the accuracy: time [us], method, its own error\n",
              problem.c_str());
  std::printf("%-8s", "accuracy");
  for (const Contender contender : present) std::printf(" | %-31s", kNames[static_cast<int>(contender)]);
  std::printf(" | law/  | scene/ | solve/ | scene/\n%-8s", "");
  for (std::size_t i = 0; i < present.size(); ++i) std::printf(" | %-31s", "");
  std::printf(" | peers | peers  | law    | law\n");
  for (int digits = kLoosestDigits; digits <= 14; digits += 2) {
    const double accuracy = std::pow(10.0, -digits);
    const Measurement *law = nullptr, *solve = nullptr, *scene = nullptr, *best_peer = nullptr;
    std::printf("%-8.0e", accuracy);
    for (const Contender contender : present) {
      const Measurement* best = fastest(all, problem, contender, accuracy);
      std::printf(" | %-31s", entry(best).c_str());
      if (contender == Contender::law)
        law = best;
      else if (contender == Contender::solve)
        solve = best;
      else if (contender == Contender::scene)
        scene = best;
      else if (best != nullptr && (best_peer == nullptr || best->microseconds < best_peer->microseconds))
        best_peer = best;
    }
    std::printf(" | %5s | %6s | %6s | %6s\n", ratio(law, best_peer).c_str(), ratio(scene, best_peer).c_str(),
                ratio(solve, law).c_str(), ratio(scene, law).c_str());
  }
}

void print_tables(const std::vector<Measurement>& all) {
  std::vector<std::string> problems;
  for (const Measurement& m : all)
    if (std::find(problems.begin(), problems.end(), m.properties.problem) == problems.end())
      problems.push_back(m.properties.problem);
  std::printf("%-44s %12s %12s\n", "case", "time [us]", "error");
  for (const Measurement& m : all)
    std::printf("%-44s %12.3f %12.2e\n", name_of(m.properties).c_str(), m.microseconds, m.error);
  for (const std::string& problem : problems) print_table(all, problem);
}

}  // namespace

std::string name_of(const Case& properties) {
  return properties.problem + "/" + kNames[static_cast<int>(properties.contender)] + "/" + properties.method;
}

Case case_of(const std::string& name) {
  const std::size_t first = name.find('/'), second = name.find('/', first + 1);
  const std::string contender = name.substr(first + 1, second - first - 1);
  const auto found = std::find(std::begin(kNames), std::end(kNames), contender);
  return {name.substr(0, first), kContenders[found - std::begin(kNames)], name.substr(second + 1)};
}

std::string labelled(const char* method, double tolerance) {
  char text[64];
  std::snprintf(text, sizeof text, "%s:%.0e", method, tolerance);
  return text;
}

std::string labelled(const char* method, int steps) { return method + std::string(":") + std::to_string(steps); }

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
  trajet::bench::add_laws();
  trajet::bench::add_scenes();
  trajet::bench::add_odeint();
  trajet::bench::add_gsl();
  trajet::bench::add_sundials();
  trajet::bench::add_rifle_shot();
  trajet::bench::add_boxes();
  trajet::bench::add_turning_contacts();
  trajet::bench::add_motions();
  trajet::bench::add_bullet();
  trajet::bench::add_ode();
  trajet::bench::Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  trajet::bench::print_tables(collector.measurements());
}
