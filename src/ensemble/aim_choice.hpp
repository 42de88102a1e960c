#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "aim_search.hpp"
#include "trajet/ensemble/report_columns.hpp"

namespace trajet {

/// Which of the places that hit are solutions: those that hit as the scene has it, with the target as it is, that
/// fulfil the conditions, or the one of these where something is least.
class AimChoice {
 public:
  /// Throws InputError where a condition or what is to be least is wrong.
  explicit AimChoice(AimFlights& flights);

  /// Fills the solutions of the result and what goes with them.
  void choose(std::vector<AimRoot> roots, const std::function<bool()>& should_stop, AimResult& result);

 private:
  /// A hit, with what is to be least of it.
  struct Hit {
    AimSolution solution{};
    double cost = 0.0;  ///< infinite where it has none
    bool fulfils_conditions = true;
  };

  /// None where the motion is over, or has hit elsewhere, before it comes there.
  std::optional<Hit> hit_of(const AimRoot& root);
  void judge(const AimRoot& root, std::optional<double> contact, Hit& hit);
  /// Moves along a family while that makes the cost less.
  void descend(AimRoot root, Hit hit, const std::function<bool()>& should_stop, Hit& best);

  AimFlights& flights_;
  VariedScene varied_;
  std::optional<ReportColumns> columns_;
  std::unique_ptr<ReportColumns::Reader> reader_;
};

}  // namespace trajet
