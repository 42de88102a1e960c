#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "trajet/ensemble/flight_extremes.hpp"
#include "trajet/error.hpp"
#include "trajet/scene/scene.hpp"

namespace trajet {

/// A word of a motion.
struct WordSource {
  enum class Kind { hit, status, impact_with, impact_body, impact_kind };
  Kind kind = Kind::hit;
  int impact = 0;  ///< from 1; of the last three
};

/// A number or a vector of an impact, by its name in reports or in laws.
struct ImpactSource {
  int impact = 0;  ///< from 1
  std::string field{};
};

/// 1 or 0: whether a word is a text.
struct WordComparison {
  WordSource word{};
  std::string text{};
  bool is_negated = false;
};

/// What the text of a column has beside what formulas of a scene have, with the name that stands for it there.
struct ReportInput {
  struct ExtremeSource {
    int index = 0;  ///< in the list of extremes
  };
  std::string name{};
  std::variant<ImpactSource, WordComparison, ExtremeSource> source{};
};

/// The text of a column in the words of the scene's formulas.
struct ReportText {
  std::string text{};
  std::vector<ReportInput> inputs{};
};

/// Translates columns of one scene.
class ReportReader {
 public:
  ReportReader(const Scene& scene, const SourceLocation& where);

  /// The word that the whole text is, or nothing.
  static std::optional<WordSource> word(std::string_view text);
  /// Throws InputError. What extremes it needs is added to `extremes`.
  ReportText read(std::string_view text, ExtremeList& extremes);

  /// Names that hold a `-`.
  const std::vector<std::string>& dashed_names() const { return dashed_names_; }

 private:
  bool is_taken(const std::string& name) const;
  /// The known name before the dot with which a text ends, or nothing.
  std::string owner_at_end(std::string_view text) const;
  std::string new_name();

  SourceLocation where_;
  std::vector<std::string> names_;
  std::vector<std::string> dashed_names_;
  std::string only_body_;  // empty where there are none or several
  int last_name_ = 0;
};

}  // namespace trajet
