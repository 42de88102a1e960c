#include "trajet/ensemble/report_columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "report_text.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/law/program_builder.hpp"
#include "trajet/portable.hpp"
#include "trajet/sim/names.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet {
namespace {

bool is_hit(const Impact& impact) { return impact.kind == ImpactKind::hit || impact.kind == ImpactKind::stick; }

bool is_met(const Impact& impact) { return is_hit(impact) || impact.kind == ImpactKind::graze; }

const Impact* nth_impact(const RunResult& result, int n) {
  for (const Impact& impact : result.impacts)
    if (is_met(impact) && --n == 0) return &impact;
  return nullptr;
}

std::string word_of(const WordSource& source, const RunResult& result) {
  const auto name_of = [&](const auto& part) {
    const Impact* impact = nth_impact(result, source.impact);
    return impact == nullptr ? std::string() : std::string(part(*impact));
  };
  switch (source.kind) {
    case WordSource::Kind::hit: {
      const Impact* hit = first_hit(result);
      return hit == nullptr ? std::string() : hit->with;
    }
    case WordSource::Kind::status:
      return std::string(name(result.status));
    case WordSource::Kind::impact_with:
      return name_of([](const Impact& impact) { return impact.with; });
    case WordSource::Kind::impact_body:
      return name_of([](const Impact& impact) { return impact.body; });
    case WordSource::Kind::impact_kind:
      return name_of([](const Impact& impact) { return name(impact.kind); });
  }
  return {};
}

/// A vector of an impact under its names, and the letter of its components: `vx` is a component of `v`.
struct ImpactVector {
  std::string_view name;
  std::string_view short_name;
  const Vector3& (*value)(const Impact&);
};
constexpr ImpactVector kImpactVectors[] = {
    {"point", "r", [](const Impact& i) -> const Vector3& { return i.point; }},
    {"velocity_before", "v", [](const Impact& i) -> const Vector3& { return i.velocity_before; }},
    {"angular_velocity_before", "w", [](const Impact& i) -> const Vector3& { return i.angular_velocity_before; }},
    {"normal", "", [](const Impact& i) -> const Vector3& { return i.normal; }},
    {"position", "", [](const Impact& i) -> const Vector3& { return i.position; }},
    {"velocity_after", "", [](const Impact& i) -> const Vector3& { return i.velocity_after; }},
    {"angular_velocity_after", "", [](const Impact& i) -> const Vector3& { return i.angular_velocity_after; }},
    {"impulse", "", [](const Impact& i) -> const Vector3& { return i.impulse; }},
};

/// What a field of an impact is: its time, its speed, a vector, or a component of one.
struct ImpactField {
  enum class Kind { time, speed, vector, component };
  Kind kind = Kind::time;
  const ImpactVector* vector = nullptr;
  int component = 0;
};

std::optional<ImpactField> impact_field(std::string_view field) {
  if (field == "t") return ImpactField{};
  if (field == "speed") return ImpactField{ImpactField::Kind::speed};
  for (const ImpactVector& vector : kImpactVectors)
    if (field == vector.name || (!vector.short_name.empty() && field == vector.short_name))
      return ImpactField{ImpactField::Kind::vector, &vector};
  const std::size_t axis = std::string_view("xyz").find(field.empty() ? '\0' : field.back());
  if (axis == std::string_view::npos) return std::nullopt;
  const std::string_view owner = field.size() == 1 ? "r" : field.substr(0, field.size() - 1);
  for (const ImpactVector& vector : kImpactVectors)
    if (owner == vector.short_name && (field.size() == 1 || owner != "r"))
      return ImpactField{ImpactField::Kind::component, &vector, static_cast<int>(axis)};
  return std::nullopt;
}

}  // namespace

/// The columns as programs over what is known at the end of a motion: t, the bodies, the extra states, the parameters,
/// and what columns have beside these.
class ReportColumns::Compiled {
 public:
  Compiled(const std::vector<std::string>& texts, const Scene& scene, const SourceLocation& where) {
    ReportReader reader(scene, where);
    struct Pending {
      std::size_t column;
      Expression formula;
    };
    std::vector<Pending> formulas;
    std::vector<ReportInput> inputs;
    for (const std::string& text : texts) {
      Column column;
      column.word = ReportReader::word(text);
      if (!column.word) {
        if (text.empty()) throw InputError(where, "an expression is missing in the list");
        ReportText read = reader.read(text, extremes_);
        Expression formula = Expression::parse(read.text, where, reader.dashed_names());
        column.is_condition = formula.is_condition() || is_comparison_alone(read);
        formulas.push_back({columns_.size(), std::move(formula)});
        inputs.insert(inputs.end(), read.inputs.begin(), read.inputs.end());
      }
      columns_.push_back(column);
    }
    // the World of the scene as it stands gives names their meaning, and finds what is wrong in extremes
    world_ = make_observed_world(scene, extremes_).world;
    Symbols symbols = scene_symbols(scene);
    for (const World::Body& body : world_.bodies) add_body(body, symbols);
    for (const World::ExtraState& state : world_.states) symbols.set_input(state.name, take(1));
    for (const NamedValue& parameter : world_.parameters) add_parameter(parameter, symbols);
    for (ReportInput& input : inputs) add_input(std::move(input), symbols, where);
    ProgramBuilder builder(input_count_);
    for (const Pending& each : formulas) {
      columns_[each.column].output = output_count_++;
      builder.add_output(builder.compile_scalar(each.formula, symbols));
    }
    program_ = builder.build();
  }

  struct Column {
    std::optional<WordSource> word{};
    bool is_condition = false;
    int output = 0;  // of the program
  };
  const std::vector<Column>& columns() const { return columns_; }
  const ExtremeList& extremes() const { return extremes_; }
  const Program& program() const { return program_; }
  int output_count() const { return output_count_; }

  /// Fills the inputs behind t.  // numbers: (inputs - 1)
  void fill(const RunResult& result, std::span<const double> extremes, std::vector<double>& numbers) const {
    numbers.clear();
    const auto append = [&](const auto& vector) {
      for (const double value : vector) numbers.push_back(value);
    };
    for (const BodyState& body : result.final.bodies) {
      append(body.position);
      append(body.velocity);
      const Quaternion& q = body.orientation;
      append(std::array{q.w(), q.x(), q.y(), q.z()});
      append(body.angular_velocity);
      append(Vector3(body.rotation_matrix.transpose() * body.angular_velocity));
      for (int i = 0; i < 3; ++i) append(Vector3(body.rotation_matrix.row(i).transpose()));
    }
    for (const NamedValue& state : result.final.states) numbers.push_back(state.value);
    for (const NamedValue& parameter : result.parameters) numbers.push_back(parameter.value);
    for (const auto& [source, field] : inputs_) append_input(source, field, result, extremes, numbers);
  }

 private:
  static bool is_comparison_alone(const ReportText& text) {
    return text.inputs.size() == 1 && text.text == text.inputs.front().name &&
           std::holds_alternative<WordComparison>(text.inputs.front().source);
  }

  int take(int size) { return std::exchange(input_count_, input_count_ + size); }

  static Symbols scene_symbols(const Scene& scene) {
    Symbols symbols;
    symbols.set_input("t", 0);
    for (const auto& [name, table] : scene.tables) symbols.set_table(name, table);
    return symbols;
  }

  void add_vector(Symbols& symbols, const std::string& name, const std::array<std::string, 3>& components) {
    const int first = take(3);
    if (!name.empty()) symbols.set_inputs(name, {first, first + 1, first + 2});
    for (int i = 0; i < 3; ++i)
      if (const std::string& component = components[static_cast<std::size_t>(i)]; !component.empty())
        symbols.set_input(component, first + i);
  }

  void add_body(const World::Body& body, Symbols& symbols) {
    const std::string prefix = body.name + ".";
    add_vector(symbols, prefix + "r", {prefix + "x", prefix + "y", prefix + "z"});
    add_vector(symbols, prefix + "v", {prefix + "vx", prefix + "vy", prefix + "vz"});
    for (const char* part : {"qw", "qx", "qy", "qz"}) symbols.set_input(prefix + part, take(1));
    add_vector(symbols, prefix + "w", {prefix + "wx", prefix + "wy", prefix + "wz"});
    add_vector(symbols, prefix + "w_body", {});
    for (const char* row : {"Rx", "Ry", "Rz"})
      add_vector(symbols, {}, {prefix + row + "x", prefix + row + "y", prefix + row + "z"});
  }

  /// A vector's components come one after the other, under names of their own.
  void add_parameter(const NamedValue& parameter, Symbols& symbols) {
    const int input = take(1);
    symbols.set_input(parameter.name, input);
    if (parameter.name.ends_with(".z"))
      symbols.set_inputs(parameter.name.substr(0, parameter.name.size() - 2), {input - 2, input - 1, input});
  }

  void add_input(ReportInput input, Symbols& symbols, const SourceLocation& where) {
    ImpactField field;
    if (const auto* impact = std::get_if<ImpactSource>(&input.source)) {
      const std::optional<ImpactField> found = impact_field(impact->field);
      if (!found || impact->impact < 1) throw_no_field(*impact, where);
      field = *found;
    }
    if (field.kind == ImpactField::Kind::vector)
      add_vector(symbols, input.name, {});
    else
      symbols.set_input(input.name, take(1));
    inputs_.emplace_back(std::move(input), field);
  }

  [[noreturn]] static void throw_no_field(const ImpactSource& source, const SourceLocation& where) {
    if (source.impact < 1) throw InputError(where, "impacts are counted from 1: impact(1)." + source.field);
    std::vector<std::string_view> known{"t",  "speed", "x",  "y",  "z",    "vx",   "vy",
                                        "vz", "wx",    "wy", "wz", "with", "body", "kind"};
    for (const ImpactVector& vector : kImpactVectors) {
      known.push_back(vector.name);
      if (!vector.short_name.empty()) known.push_back(vector.short_name);
    }
    throw InputError(where, "an impact has no '" + source.field + "'" + did_you_mean(source.field, known));
  }

  static void append_input(const ReportInput& input, const ImpactField& field, const RunResult& result,
                           std::span<const double> extremes, std::vector<double>& numbers) {
    if (const auto* comparison = std::get_if<WordComparison>(&input.source)) {
      const bool is_same = word_of(comparison->word, result) == comparison->text;
      numbers.push_back(is_same != comparison->is_negated ? 1.0 : 0.0);
    } else if (const auto* extreme = std::get_if<ReportInput::ExtremeSource>(&input.source)) {
      numbers.push_back(extremes[static_cast<std::size_t>(extreme->index)]);
    } else {
      const Impact* impact = nth_impact(result, std::get<ImpactSource>(input.source).impact);
      if (impact == nullptr) {
        numbers.insert(numbers.end(), field.kind == ImpactField::Kind::vector ? 3 : 1, std::nan(""));
        return;
      }
      switch (field.kind) {
        case ImpactField::Kind::time:
          numbers.push_back(impact->time);
          break;
        case ImpactField::Kind::speed:
          numbers.push_back(impact->velocity_before.norm());
          break;
        case ImpactField::Kind::vector:
          for (const double value : field.vector->value(*impact)) numbers.push_back(value);
          break;
        case ImpactField::Kind::component:
          numbers.push_back(field.vector->value(*impact)[field.component]);
          break;
      }
    }
  }

  World world_;
  std::vector<Column> columns_;
  ExtremeList extremes_;
  std::vector<std::pair<ReportInput, ImpactField>> inputs_;
  Program program_;
  int input_count_ = 1;
  int output_count_ = 0;
};

ReportColumns::ReportColumns(std::vector<std::string> texts, const Scene& scene, const SourceLocation& where)
    : texts_(std::move(texts)), compiled_(std::make_unique<const Compiled>(texts_, scene, where)) {}

ReportColumns::~ReportColumns() = default;
ReportColumns::ReportColumns(ReportColumns&&) noexcept = default;

bool ReportColumns::is_word(std::size_t column) const { return compiled_->columns()[column].word.has_value(); }

bool ReportColumns::is_condition(std::size_t column) const { return compiled_->columns()[column].is_condition; }

const ExtremeList& ReportColumns::extremes() const { return compiled_->extremes(); }

class ReportColumns::Reader::State {
 public:
  explicit State(const Compiled& compiled)
      : compiled_(compiled),
        evaluator_(compiled.program()),
        outputs_(static_cast<std::size_t>(compiled.output_count())) {}

  std::vector<Cell> read(const RunResult& result, std::span<const double> extremes) {
    const bool has_failed = result.status == RunStatus::failed;
    if (!has_failed && !outputs_.empty()) {
      compiled_.fill(result, extremes, inputs_);
      evaluator_(result.end_time, inputs_.data(), outputs_.data());
    }
    std::vector<Cell> cells;
    for (const Compiled::Column& column : compiled_.columns()) {
      if (column.word) {
        const bool is_known = !has_failed || column.word->kind == WordSource::Kind::status;
        std::string word = is_known ? word_of(*column.word, result) : std::string();
        cells.push_back(word.empty() ? Cell() : Cell(std::move(word)));
      } else {
        const double value = has_failed ? std::nan("") : outputs_[static_cast<std::size_t>(column.output)];
        cells.push_back(std::isnan(value) ? Cell() : Cell(value));
      }
    }
    return cells;
  }

 private:
  const Compiled& compiled_;
  Evaluator<double> evaluator_;
  std::vector<double> inputs_, outputs_;
};

ReportColumns::Reader::Reader(const ReportColumns& columns) : state_(std::make_unique<State>(*columns.compiled_)) {}
ReportColumns::Reader::~Reader() = default;

std::vector<Cell> ReportColumns::Reader::operator()(const RunResult& result, std::span<const double> extremes) {
  return state_->read(result, extremes);
}

const Impact* first_hit(const RunResult& result) {
  const auto hit = ranges::find_if(result.impacts, is_hit);
  return hit == result.impacts.end() ? nullptr : &*hit;
}

std::vector<std::string> default_columns(const Scene& scene) {
  std::vector<std::string> columns{"t"};
  for (const BodyDefinition& body : scene.bodies)
    for (const char* part : {"x", "y", "z", "vx", "vy", "vz"}) columns.push_back(body.name + "." + part);
  for (const StateDefinition& state : scene.states) columns.push_back(state.name);
  if (!scene.obstacles.empty() || scene.bodies.size() > 1)
    for (const char* part : {"hit", "impact(1).t", "impact(1).x", "impact(1).y", "impact(1).z"})
      columns.emplace_back(part);
  return columns;
}

}  // namespace trajet
