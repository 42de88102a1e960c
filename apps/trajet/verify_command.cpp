#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "commands.hpp"
#include "published_checks.hpp"
#include "terminal.hpp"
#include "text_table.hpp"
#include "trajet/io/output_file.hpp"
#include "trajet/io/scene_file.hpp"
#include "trajet/sim/run.hpp"
#include "trajet/study/compare.hpp"

namespace trajet {

namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// `ball.z`, `ball.vx` or an extra state at the end of a run.
double final_value(const RunResult& result, const std::string& name) {
  for (const NamedValue& state : result.final.states)
    if (state.name == name) return state.value;
  for (const BodyState& body : result.final.bodies)
    for (int i = 0; i < 3; ++i) {
      if (name == body.body + "." + "xyz"[i]) return body.position[i];
      if (name == body.body + ".v" + "xyz"[i]) return body.velocity[i];
    }
  return kNothing;
}

double rest_time(const RunResult& result) {
  for (const Impact& impact : result.impacts)
    if (impact.kind == ImpactKind::rest) return impact.time;
  return kNothing;
}

double error_at_nodes(const Scene& scene, const std::string& method, long steps) {
  ComparePlan plan;
  plan.methods = {method};
  plan.step_counts = {steps};
  const Comparison comparison = compare(scene, plan);
  return comparison.rows.at(0).at_nodes.state.value_or(kNothing);
}

/// What PublishedCheck::observe asks for.
double compute(const PublishedCheck& check) {
  const Scene scene = parse_scene(check.scene, std::string(check.source));
  std::istringstream words{std::string(check.observe)};
  std::string what, name;
  words >> what;
  if (what == "nodes") {
    long steps = 0;
    words >> name >> steps;
    return error_at_nodes(scene, name, steps);
  }
  const RunResult result = run(scene);
  if (what == "rest") return rest_time(result);
  if (what == "impact") {
    std::size_t count = 0;
    words >> count;
    return count <= result.impacts.size() ? result.impacts[count - 1].time : kNothing;
  }
  words >> name;
  return final_value(result, name);
}

}  // namespace

int verify_command() {
  const bool color = wants_color(stdout);
  const int width = text_width(stdout);
  TextTable table{{"problem", "quantity", "published", "ours", "difference", ""}};
  std::string text;
  std::string_view source;
  int wrong = 0;
  const auto print = [&] {
    if (table.size() > 1)
      text += styled(source, Style::bold, color) + "\n" +
              format_table(table, {.first_number = 2, .keys = 2, .width = width}) + "\n";
    table.resize(1);
  };
  for (const PublishedCheck& check : published_checks()) {
    if (check.source != source) print();
    source = check.source;
    const double ours = compute(check);
    const bool agrees = std::abs(ours - check.value) <= check.tolerance;
    wrong += agrees ? 0 : 1;
    table.push_back({std::string(check.problem), std::string(check.observe), fmt::format("{:.15g}", check.value),
                     fmt::format("{:.15g}", ours), fmt::format("{:.1e}", ours - check.value),
                     agrees ? "agrees" : "DIFFERS"});
  }
  print();
  text += fmt::format("{} of {} published values agree\n", published_checks().size() - static_cast<std::size_t>(wrong),
                      published_checks().size());
  OutputFile out("-");
  out.write(text);
  out.finish();
  return wrong == 0 ? kDone : kNumbersFailed;
}

}  // namespace trajet
