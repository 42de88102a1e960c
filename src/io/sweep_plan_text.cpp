#include "trajet/io/sweep_plan_text.hpp"

#include <stdexcept>
#include <string_view>
#include <utility>

#include "trajet/error.hpp"
#include "trajet/io/variation_text.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet {
namespace {

constexpr std::uint64_t kDefaultCount = 1000;
constexpr std::uint64_t kMostMotions = 1'000'000'000'000'000;

SampleDesign design_of(const std::string& name) {
  constexpr std::pair<std::string_view, SampleDesign> kDesigns[] = {
      {"random", SampleDesign::random}, {"lhs", SampleDesign::latin_hypercube}, {"sobol", SampleDesign::sobol}};
  for (const auto& [known, design] : kDesigns)
    if (name == known) return design;
  constexpr std::string_view kNames[] = {"random", "lhs", "sobol"};
  throw InputError({"--design"}, "random, lhs or sobol expected, got '" + name + "'" + did_you_mean(name, kNames));
}

}  // namespace

SweepPlan read_sweep_plan(const SweepPlanTexts& texts, Scene& scene) {
  SweepPlan plan{.seed = texts.seed, .design = design_of(texts.design)};
  for (const std::string& text : texts.vary) {
    GridAxis axis = read_range(text, "--vary", scene);
    if (axis.count == 0)
      throw InputError({"--vary " + axis.quantity.name},
                       "a number of values is missing: LOW:HIGH:COUNT, got '" + text + "'");
    plan.axes.push_back(std::move(axis));
  }
  for (const std::string& text : texts.sample) plan.samples.push_back(read_sample(text, "--sample", scene));
  if (plan.quantity_count() == 0)
    throw InputError({"--vary"},
                     "nothing varies: --vary NAME=LOW:HIGH:COUNT or --sample NAME=normal(MEAN,SD) expected");
  for (std::size_t i = 0; i < plan.quantity_count(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (plan.quantity(i).name == plan.quantity(j).name)
        throw InputError({i < plan.axes.size() ? "--vary" : "--sample"},
                         "'" + plan.quantity(i).name + "' varies twice");
  for (const std::string& text : texts.correlate)
    plan.correlations.push_back(read_correlation(text, "--correlate", plan.samples));
  if (texts.count && plan.samples.empty())
    throw InputError({"--count"}, "the number of motions is that of the grid: --count goes with --sample");
  if (texts.count == 0U) throw InputError({"--count"}, "a positive number expected");
  plan.samples_per_node = texts.count.value_or(plan.samples.empty() ? 1 : kDefaultCount);
  if (plan.count() > kMostMotions)
    throw InputError({texts.vary.empty() ? "--count" : "--vary"}, "more than 1e15 motions");
  try {
    const PlanValues are_possible(plan);
  } catch (const std::invalid_argument& error) {
    throw InputError({"--correlate"}, error.what());
  }
  return plan;
}

}  // namespace trajet
