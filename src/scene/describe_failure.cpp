#include "trajet/scene/describe_failure.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "law_symbols.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/portable.hpp"
#include "trajet/scene/law_name.hpp"
#include "trajet/text/shortest_text.hpp"

namespace trajet {
namespace {

using Formula = World::LawFormula;

bool is_finite(const std::vector<double>& values) {
  return ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

std::string text_of(double value) { return std::isnan(value) ? "not-a-number" : shortest_text(value); }

std::string text_of(const std::vector<double>& values) {
  if (values.size() == 1) return text_of(values[0]);
  return "[" + text_of(values[0]) + ", " + text_of(values[1]) + ", " + text_of(values[2]) + "]";
}

/// The parameters and tables of a World as names of formulas.
Symbols constants_of(const World& world) {
  Symbols constants;
  for (const auto& [name, table] : world.tables) constants.set_table(name, table);
  for (std::size_t i = 0; i < world.parameters.size(); ++i) {
    const std::string& name = world.parameters[i].name;
    if (!name.ends_with(".x")) {
      constants.set_constant(name, world.parameters[i].value);
      continue;
    }
    const auto part = [&](std::size_t k) { return world.parameters[i + k].value; };
    constants.set_constant(name.substr(0, name.size() - 2), Vector3(part(0), part(1), part(2)));
    i += 2;
  }
  return constants;
}

/// The law of a group, formula by formula.
class LawReading {
 public:
  LawReading(const World& world, int group)
      : world_(world), group_(world.groups[static_cast<std::size_t>(group)]), index_(group) {}

  const World::Group& group() const { return group_; }

  std::vector<double> rate(double t, const Eigen::VectorXd& q) const {
    std::vector<double> rate(group_.law.outputs.size());
    Evaluator<double> evaluate(group_.law);
    evaluate(t, q.data(), rate.data());
    return rate;
  }

  /// The value of a formula in which the names of a law of the group mean what they do in `of`.
  std::vector<double> value(const Expression& formula, const Formula& of, double t, const Eigen::VectorXd& q) const {
    ProgramBuilder builder(group_.law.input_count);
    const Symbols constants = constants_of(world_);
    const Symbols scope = group_symbols(world_, index_, constants, builder);
    const Symbols own = of.body < 0 ? Symbols(&scope) : own_symbols(body(of), scope, builder);
    builder.add_output(builder.compile(formula, own));
    const Program program = builder.build();
    std::vector<double> values(program.outputs.size());
    Evaluator<double> evaluate(program);
    evaluate(t, q.data(), values.data());
    return values;
  }

  /// The first formula that is not finite and makes the rate so; nullptr if there is none.
  const Formula* find_not_finite(double t, const Eigen::VectorXd& q) const {
    const std::vector<double> rate = this->rate(t, q);
    const auto fails = [&](const Formula& each) {
      const auto first = rate.begin() + each.first;
      return !is_finite({first, first + each.size}) && !is_finite(value(each.text, each, t, q));
    };
    const auto found = ranges::find_if(group_.formulas, fails);
    return found == group_.formulas.end() ? nullptr : &*found;
  }

  /// "acceleration of body 'ball' (scene.toml:8:17: -g/x) is [0, 0, not-a-number] at t = 1 s, where x = 0"
  std::string describe(const Formula& formula, double t, const Eigen::VectorXd& q) const {
    constexpr std::size_t kMostValues = 8;
    std::string result = name_with_place(world_, index_, formula) + " is " +
                         text_of(value(formula.text, formula, t, q)) + " at t = " + clock_text(t) + " s";
    std::size_t count = 0;
    for (const std::string& name : formula.text.names()) {
      if (name == "t" || count == kMostValues) continue;
      const std::vector<std::string> dashed{name};
      result += (count++ == 0 ? ", where " : ", ") + name + " = " +
                text_of(value(Expression::parse(name, {}, dashed), formula, t, q));
    }
    return result;
  }

  /// All formulas behind a component of the rate, after a colon; where it has none of its own, as that of a position,
  /// those of its body.
  std::string describe_all(int component, double t, const Eigen::VectorXd& q) const {
    const auto describe_where = [&](const auto& suits) {
      std::string text;
      for (const Formula& formula : group_.formulas)
        if (suits(formula)) text += (text.empty() ? ": " : "; ") + describe(formula, t, q);
      return text;
    };
    const std::string own = describe_where(
        [&](const Formula& formula) { return component >= formula.first && component < formula.first + formula.size; });
    if (!own.empty() || is_of_state(component)) return own;
    return describe_where([owner = body_of(component)](const Formula& formula) { return formula.body == owner; });
  }

  /// What the scene's clock shows at time t.
  std::string clock_text(double t) const { return shortest_text(world_.epoch + t); }

  /// Of a component of the state.
  std::string name_of(int component) const {
    for (const World::ExtraState& each : world_.states)
      if (is_at(each, component)) return "state '" + each.name + "'";
    const World::Body& body = world_.bodies[static_cast<std::size_t>(body_of(component))];
    const int part = component - body.offset;
    return std::string(part < 3   ? "the position"
                       : part < 6 ? "the velocity"
                                  : "the rotation") +
           " of body '" + body.name + "'";
  }

 private:
  bool is_at(const World::ExtraState& state, int component) const {
    return state.group == index_ && state.offset == component;
  }
  bool is_of_state(int component) const {
    return ranges::any_of(world_.states, [&](const World::ExtraState& each) { return is_at(each, component); });
  }
  /// The body, in World::bodies, to whose state a component belongs.
  int body_of(int component) const {
    return *ranges::find_if(group_.bodies.rbegin(), group_.bodies.rend(),
                            [&](int b) { return world_.bodies[static_cast<std::size_t>(b)].offset <= component; });
  }
  const World::Body& body(const Formula& formula) const {
    return world_.bodies[static_cast<std::size_t>(formula.body)];
  }
  const World& world_;
  const World::Group& group_;
  int index_;
};

/// A component of the state that would grow by its own size, or beyond the size of its motion so far, in no time.
struct Growth {
  int component;
  double remaining;   ///< s, at the present rate
  bool of_the_state;  ///< else of its rate alone
};

std::optional<Growth> find_growth(const LawReading& law, double t, const Eigen::VectorXd& q) {
  constexpr double kNoTime = 1e-6;  // of the run so far
  constexpr double kLarge = 1e3;    // beside all that the state has been
  const double elapsed = std::abs(t);
  const std::vector<double> rate = law.rate(t, q);
  std::vector<double> first_rate;  // where it is needed
  std::optional<Growth> fastest;
  for (std::size_t i = 0; i < rate.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (!(std::abs(q[k]) < kNoTime * elapsed * std::abs(rate[i]))) continue;
    if (first_rate.empty()) first_rate = law.rate(0.0, law.group().start);
    const double usual = std::abs(law.group().start[k]) + std::abs(first_rate[i]) * elapsed;
    const double remaining = std::max(std::abs(q[k]), usual) / std::abs(rate[i]);
    if (!(remaining < kNoTime * elapsed) || (fastest && fastest->remaining <= remaining)) continue;
    fastest = {static_cast<int>(i), remaining, usual > 0.0 && std::abs(q[k]) > kLarge * usual};
  }
  return fastest;
}

std::string blow_up_text(const LawReading& law, const Growth& growth, double t, const Eigen::VectorXd& q) {
  return law.name_of(growth.component) + " runs to infinity in finite time, near t = " + law.clock_text(t) + " s" +
         law.describe_all(growth.component, t, q);
}

/// The first time a little ahead, on a straight line, at which a formula is not finite.
std::optional<std::string> find_hole_ahead(const LawReading& law, const World& world, double t,
                                           const Eigen::VectorXd& q) {
  const std::vector<double> rate = law.rate(t, q);
  const Eigen::VectorXd direction = Eigen::Map<const Eigen::VectorXd>(rate.data(), q.size());
  const double sign = world.direction();
  const double furthest = world.step_options.step.value_or(1e-6 * std::abs(world.duration));
  constexpr double kFiner = 10.0;
  for (double ahead = 1e-16 * (1.0 + std::abs(t)); ahead <= kFiner * furthest; ahead *= kFiner) {
    const double h = sign * std::min(ahead, furthest);
    const Eigen::VectorXd there = q + h * direction;
    if (const Formula* formula = law.find_not_finite(t + h, there)) return law.describe(*formula, t + h, there);
  }
  return std::nullopt;
}

/// The component of the state whose rate changes most, beside its size, over a time next to nothing.
struct Restless {
  int component = 0;
  double change = -1.0;  ///< of the rate; 2 where it turns round
  bool jumps = false;    ///< the change is no smaller in a tenth of the time
};

Restless find_restless(const LawReading& law, double t, const Eigen::VectorXd& q) {
  const std::vector<double> rate = law.rate(t, q);
  const auto size = static_cast<Eigen::Index>(rate.size());
  const Eigen::VectorXd direction = Eigen::Map<const Eigen::VectorXd>(rate.data(), size);
  constexpr double kShortest = 1e-15, kLongest = 1e-9, kLonger = 10.0;  // of the time so far
  constexpr double kJump = 0.01;
  Restless most;
  Eigen::ArrayXd last = Eigen::ArrayXd::Zero(size);  // change over the time before
  for (double part = kShortest; part <= kLongest; part *= kLonger) {
    const double h = part * (1.0 + std::abs(t));
    const std::vector<double> behind = law.rate(t - h, q - h * direction), ahead = law.rate(t + h, q + h * direction);
    for (Eigen::Index i = 0; i < size; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double mean = 0.5 * (std::abs(behind[k]) + std::abs(ahead[k]));
      const double change = std::abs(ahead[k] - behind[k]);
      const bool jumps = last[i] >= 0.5 * change && last[i] > kJump * mean;
      const double relative = mean > 0.0 ? change / mean : 0.0;
      if (jumps > most.jumps || (jumps == most.jumps && relative > most.change))
        most = {static_cast<int>(i), relative, jumps};
      last[i] = change;
    }
  }
  return most;
}

std::string jump_text(const LawReading& law, const Restless& restless, double t, const Eigen::VectorXd& q) {
  if (!restless.jumps) return {};
  return "the rate of " + law.name_of(restless.component) + " jumps near t = " + law.clock_text(t) + " s" +
         law.describe_all(restless.component, t, q);
}

}  // namespace

std::string describe_failure(const World& world, int group, double t, const Eigen::VectorXd& q) {
  const LawReading law(world, group);
  if (const Formula* formula = law.find_not_finite(t, q)) return law.describe(*formula, t, q);
  const std::vector<double> rate = law.rate(t, q);
  const auto broken = ranges::find_if(rate, [](double value) { return !std::isfinite(value); });
  if (broken != rate.end()) {  // a quotient of finite formulas: a force and a mass
    const int component = static_cast<int>(broken - rate.begin());
    return "the rate of " + law.name_of(component) + " is " + text_of(*broken) + law.describe_all(component, t, q);
  }
  const std::optional<Growth> growth = find_growth(law, t, q);
  if (growth && growth->of_the_state) return blow_up_text(law, *growth, t, q);
  if (const auto hole = find_hole_ahead(law, world, t, q)) return *hole;
  if (growth)
    return "the rate of " + law.name_of(growth->component) + " runs to infinity near t = " + law.clock_text(t) +
           " s, where the law has a pole" + law.describe_all(growth->component, t, q);
  const Restless restless = find_restless(law, t, q);
  const std::string jump = jump_text(law, restless, t, q);
  if (!jump.empty()) return jump;
  return "the rate of " + law.name_of(restless.component) + " changes most" +
         law.describe_all(restless.component, t, q);
}

std::string describe_jump(const World& world, int group, double t, const Eigen::VectorXd& q) {
  const LawReading law(world, group);
  return jump_text(law, find_restless(law, t, q), t, q);
}

std::string describe_blow_up(const World& world, int group, double t, const Eigen::VectorXd& q) {
  const LawReading law(world, group);
  const std::optional<Growth> growth = find_growth(law, t, q);
  return growth && growth->of_the_state ? blow_up_text(law, *growth, t, q) : "";
}

}  // namespace trajet
