#include "report_text.hpp"

#include <array>
#include <optional>
#include <utility>

#include "trajet/ensemble/report_columns.hpp"
#include "trajet/portable.hpp"
#include "trajet/text/name.hpp"
#include "trajet/text/outer_parts.hpp"

namespace trajet {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// Reads a text from left to right.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  bool at_end() const { return at_ == text_.size(); }
  char peek() const { return at_end() ? '\0' : text_[at_]; }
  char next() { return text_[at_++]; }
  std::size_t place() const { return at_; }
  void go_back(std::size_t place) { at_ = place; }
  void skip_blanks() {
    while (is_blank(peek())) ++at_;
  }
  bool take(std::string_view symbol) {
    skip_blanks();
    if (!text_.substr(at_).starts_with(symbol)) return false;
    at_ += symbol.size();
    return true;
  }
  /// A name without dashes and dots, if one stands here.
  std::string_view name() {
    std::size_t length = name_length(text_.substr(at_));
    return std::exchange(at_, at_ + length), text_.substr(at_ - length, length);
  }
  std::optional<int> whole_number() {
    skip_blanks();
    std::size_t end = at_;
    while (end < text_.size() && text_[end] >= '0' && text_[end] <= '9' && end < at_ + 9) ++end;
    if (end == at_) return std::nullopt;
    int number = 0;
    for (; at_ < end; ++at_) number = 10 * number + (text_[at_] - '0');
    return number;
  }
  /// Behind an opening parenthesis: what stands before the one that closes it. Nothing where none does.
  std::optional<std::string_view> inside() {
    const std::size_t begin = at_;
    for (int depth = 1; at_ < text_.size(); ++at_) {
      if (text_[at_] == '(' || text_[at_] == '[') ++depth;
      if (text_[at_] == ')' || text_[at_] == ']') --depth;
      if (depth == 0) return text_.substr(begin, at_++ - begin);
    }
    return std::nullopt;
  }
  /// A text between quotes, if one stands here.
  std::optional<std::string> quoted() {
    const char quote = peek();
    if (quote != '\'' && quote != '"') return std::nullopt;
    const std::size_t end = text_.find(quote, at_ + 1);
    if (end == std::string_view::npos) return std::nullopt;
    std::string result(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return result;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

constexpr std::array<std::pair<std::string_view, WordSource::Kind>, 3> kImpactWords{
    {{"with", WordSource::Kind::impact_with},
     {"body", WordSource::Kind::impact_body},
     {"kind", WordSource::Kind::impact_kind}}};

/// `impact(N).FIELD` behind the name `impact`, or nothing.
std::optional<ImpactSource> impact_source(Scanner& scanner) {
  if (!scanner.take("(")) return std::nullopt;
  const std::optional<int> number = scanner.whole_number();
  if (!number || !scanner.take(")") || !scanner.take(".")) return std::nullopt;
  return ImpactSource{*number, std::string(scanner.name())};
}

/// The word that starts with that name, or nothing; the scanner is then anywhere.
std::optional<WordSource> word_source(std::string_view name, Scanner& scanner) {
  if (name == "hit") return WordSource{.kind = WordSource::Kind::hit};
  if (name == "status") return WordSource{.kind = WordSource::Kind::status};
  if (name != "impact") return std::nullopt;
  const std::optional<ImpactSource> source = impact_source(scanner);
  if (!source) return std::nullopt;
  for (const auto& [field, kind] : kImpactWords)
    if (source->field == field) return WordSource{kind, source->impact};
  return std::nullopt;
}

/// Names that mean something in a body's own laws, and `speed`.
constexpr std::string_view kOwnNames[] = {"r",  "v",  "w",  "x",  "y",      "z",  "vx", "vy", "vz",
                                          "wx", "wy", "wz", "qw", "w_body", "qx", "qy", "qz", "speed"};

}  // namespace

std::vector<std::string> split_columns(std::string_view list) { return outer_parts(list, ','); }

ReportReader::ReportReader(const Scene& scene, const SourceLocation& where) : where_(where) {
  const auto add = [this](const std::string& name) {
    names_.push_back(name);
    if (name.find('-') != std::string::npos) dashed_names_.push_back(name);
  };
  for (const NamedExpression& parameter : scene.parameters) add(parameter.name);
  for (const BodyDefinition& body : scene.bodies) add(body.name);
  for (const StateDefinition& state : scene.states) add(state.name);
  if (scene.bodies.size() == 1) only_body_ = scene.bodies.front().name;
}

std::optional<WordSource> ReportReader::word(std::string_view text) {
  Scanner scanner(trimmed(text));
  const std::optional<WordSource> result = word_source(scanner.name(), scanner);
  return scanner.at_end() ? result : std::nullopt;
}

bool ReportReader::is_taken(const std::string& name) const { return ranges::find(names_, name) != names_.end(); }

std::string ReportReader::owner_at_end(std::string_view text) const {
  std::string longest;
  for (const std::string& name : names_)
    if (text.ends_with(name + ".") && name.size() > longest.size()) longest = name;
  return longest;
}

std::string ReportReader::new_name() {
  std::string name;
  do name = "_" + std::to_string(++last_name_);
  while (is_taken(name));
  return name;
}

ReportText ReportReader::read(std::string_view text, ExtremeList& extremes) {
  ReportText result;
  Scanner scanner(text);
  const auto stand_for = [&](auto source) {
    result.inputs.push_back({new_name(), std::move(source)});
    result.text += result.inputs.back().name;
  };
  bool is_part = false;  // behind a dot
  while (!scanner.at_end()) {
    const std::size_t begin = scanner.place();
    const std::string name(scanner.name());
    if (name.empty()) {
      if (const std::optional<std::string> quoted = scanner.quoted()) {  // the name of a table
        result.text += text.substr(begin, scanner.place() - begin);
        continue;
      }
      const char c = scanner.next();
      is_part = c == '.';
      result.text += c;
      continue;
    }
    const std::size_t end = scanner.place();
    const auto keep = [&] {
      scanner.go_back(end);
      result.text += name;
    };
    if (std::exchange(is_part, false)) {
      if (name == "speed" && !owner_at_end(result.text).empty()) {
        // stands for a formula of NAME.v
        const std::string owner = owner_at_end(result.text);
        result.text.resize(result.text.size() - owner.size() - 1);
        result.text += "norm(" + owner + ".v)";
      } else {
        keep();
      }
      continue;
    }
    if (const std::optional<WordSource> word = word_source(name, scanner); word && !is_taken(name)) {
      const bool is_equal = scanner.take("=="), is_unequal = !is_equal && scanner.take("!=");
      scanner.skip_blanks();
      const std::optional<std::string> other = is_equal || is_unequal ? scanner.quoted() : std::nullopt;
      if (!other)
        throw InputError(where_, "'" + std::string(text) + "': " + name +
                                     " is a word: a column of its own, or compared as in " + name + " == 'target'");
      stand_for(WordComparison{*word, *other, is_unequal});
      continue;
    }
    scanner.go_back(end);
    if (name == "impact" && !is_taken(name)) {
      const std::optional<ImpactSource> source = impact_source(scanner);
      if (!source) throw InputError(where_, "'" + std::string(text) + "': impact(N).t expected, N from 1");
      stand_for(*source);
      continue;
    }
    if ((name == "max" || name == "min") && scanner.take("(")) {
      const std::optional<std::string_view> inside = scanner.inside();
      if (inside && split_columns(*inside).size() == 1) {
        ReportText formula = read(*inside, extremes);
        if (!formula.inputs.empty())
          throw InputError(where_,
                           "'" + std::string(text) + "': " + name + "(…) over the flight is of what changes then");
        extremes.push_back({Expression::parse(formula.text, where_, dashed_names_), name == "max"});
        stand_for(ReportInput::ExtremeSource{static_cast<int>(extremes.size()) - 1});
        continue;
      }
    }
    const bool is_own = !only_body_.empty() && !is_taken(name) && ranges::find(kOwnNames, name) != std::end(kOwnNames);
    scanner.go_back(end);
    if (!is_own) {
      keep();
    } else if (name == "speed") {
      result.text += "norm(" + only_body_ + ".v)";
    } else {
      result.text += only_body_ + "." + name;
    }
  }
  return result;
}

}  // namespace trajet
