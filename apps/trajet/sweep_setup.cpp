#include "sweep_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <utility>

#include "scene_source.hpp"
#include "trajet/io/sweep_plan_text.hpp"
#include "trajet/text/decimal_number.hpp"
#include "trajet/version.hpp"

namespace trajet {
namespace {

/// Motions of a sweep that ends by `--until`, if nothing else is said: more than anybody computes.
constexpr std::uint64_t kUntilItIsKnown = 1'000'000'000'000;

/// "ci(hit == 'target') < 0.1%".
UntilCondition until_of(const std::string& text) {
  const auto fault = [&] {
    return InputError({"--until"},
                      "ci(CONDITION) < SHARE expected, as in \"ci(hit == 'target') < 0.1%\", got '" + text + "'");
  };
  const std::size_t begin = text.find_first_not_of(' '), close = text.rfind(')');
  const std::size_t less = close == std::string::npos ? close : text.find('<', close);
  if (begin == std::string::npos || less == std::string::npos || text.compare(begin, 3, "ci(") != 0) throw fault();
  std::string number = text.substr(less + 1);
  std::erase(number, ' ');
  const bool is_percent = number.ends_with('%');
  if (is_percent) number.pop_back();
  const std::optional<double> value = finite_number(number);
  if (!value || *value <= 0.0) throw fault();
  return {text.substr(begin + 3, close - begin - 3), is_percent ? *value / 100.0 : *value};
}

/// The motions of shard I of N, from 1.
std::pair<std::uint64_t, std::uint64_t> shard_of(const std::string& text, std::uint64_t count) {
  if (text.empty()) return {0, count};
  const std::size_t slash = text.find('/');
  const std::optional<double> i = finite_number(text.substr(0, slash));
  const std::optional<double> n = slash == std::string::npos ? std::nullopt : finite_number(text.substr(slash + 1));
  const auto is_whole = [](const std::optional<double>& x) {
    return x && *x >= 1.0 && *x <= 1e6 && *x == static_cast<double>(static_cast<long>(*x));
  };
  if (!is_whole(i) || !is_whole(n) || *i > *n)
    throw InputError({"--shard"}, "I/N with I from 1 to N expected, got '" + text + "'");
  const auto shard = static_cast<std::uint64_t>(*i), shards = static_cast<std::uint64_t>(*n);
  const std::uint64_t size = count / shards, rest = count % shards;
  const auto begin = [&](std::uint64_t k) { return k * size + std::min(k, rest); };
  return {begin(shard - 1), begin(shard)};
}

std::string fingerprint_of(const SweepArguments& arguments, const std::string& scene_text) {
  boost::crc_optimal<64, 0x42F0E1EBA9EA3693> crc;  // ECMA-182
  const auto add = [&](const std::string& text) { crc.process_bytes(text.c_str(), text.size() + 1); };
  const SceneOverrides& o = arguments.overrides;
  add(scene_text);
  for (const auto* list : {&o.parameters, &arguments.vary, &arguments.sample, &arguments.correlate}) {
    for (const std::string& text : *list) add(text);
    add("");
  }
  for (const auto& text : {o.method, o.step, o.rtol, o.atol, o.end, o.orientation}) add(text.value_or(""));
  for (const std::string& text : {arguments.design, arguments.report, arguments.until, arguments.shard}) add(text);
  add(fmt::format("{} {} {}", o.order.value_or(0), arguments.count.value_or(0), arguments.seed));
  return fmt::format("trajet {} sweep {:016x}", kVersion, crc.checksum());
}

}  // namespace

SweepSetup make_sweep(const SweepArguments& arguments) {
  Scene scene = read_named_scene(arguments.scene);
  apply(arguments.overrides, scene);
  SweepPlanTexts texts = arguments;
  if (!arguments.until.empty() && !texts.count) texts.count = kUntilItIsKnown;
  SweepPlan plan = read_sweep_plan(texts, scene);
  std::vector<std::string> columns =
      arguments.report.empty() ? default_columns(scene) : split_columns(arguments.report);
  const std::size_t column_count = columns.size();
  std::optional<UntilCondition> until;
  std::size_t until_column = 0;
  if (!arguments.until.empty()) {
    if (plan.samples.empty() || plan.design != SampleDesign::random || !plan.axes.empty())
      throw InputError({"--until"}, "goes with independent samples: --sample, no --vary, --design random");
    until = until_of(arguments.until);
    until_column = columns.size();
    columns.push_back(until->condition);
  }
  const std::uint64_t count = plan.count();
  Sweep sweep(std::move(scene), std::move(plan), std::move(columns), {"--report"});
  if (until && !sweep.columns().is_condition(until_column))
    throw InputError({"--until"},
                     "'" + until->condition + "' is no condition, as hit == 'target' or impact(1).speed > 20 are");
  SweepSetup setup{
      .sweep = std::move(sweep), .column_count = column_count, .until = std::move(until), .until_column = until_column};
  std::tie(setup.first, setup.last) = shard_of(arguments.shard, count);
  setup.fingerprint = fingerprint_of(arguments, text_of(arguments.scene));
  return setup;
}

}  // namespace trajet
