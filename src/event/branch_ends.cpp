#include <algorithm>
#include <cmath>

#include "trajet/event/composed_function.hpp"
#include "trajet/event/law_branches.hpp"
#include "trajet/event/path.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

/// Where one output of a program leaves the side of a border on which it begins, between the start of a Segment and
/// tau = `until`.
struct BorderCrossing {
  double tau = 0.0;
  bool is_known = false;
};

/// An output of a program along a Segment.
struct Watched {
  Evaluator<IntervalJet>& program;
  std::size_t output;
  const std::vector<int>& inputs;  // components of the state that it reads
  std::vector<IntervalJet>& state;
  std::vector<IntervalJet>& values;
};

std::optional<BorderCrossing> find_crossing(const Watched& watched, const Path<Eigen::Dynamic>& path, double until,
                                            double at, double side) {
  const auto distance = [&](const IntervalJet& t, const auto& x) {
    for (std::size_t k = 0; k < watched.inputs.size(); ++k)
      watched.state[static_cast<std::size_t>(watched.inputs[k])] = x[static_cast<Eigen::Index>(k)];
    watched.program(t, watched.state.data(), watched.values.data());
    return watched.values[watched.output] - IntervalJet(Interval(at));
  };
  std::optional<BorderCrossing> found;
  visit_roots(ComposedFunction(path, distance, 0.0, until, 0.0, true), [&](const Root& root) {
    if (root.kind == RootKind::unresolved) {
      found = BorderCrossing{root.time, false};
      return false;
    }
    const bool stays = root.kind == RootKind::touch && !root.at_begin;
    if (root.kind == RootKind::undefined || stays || root.sign_after == 0 || root.sign_after == side) return true;
    found = BorderCrossing{root.time, true};
    return false;
  });
  return found;
}

}  // namespace

std::optional<LawBranches::End> LawBranches::find_end(const Segment<>& segment) {
  std::optional<End> first;
  const double direction = segment.duration() < 0.0 ? -1.0 : 1.0;
  const auto take = [&](const std::optional<End>& end) {
    if (end && (!first || direction * (end->time - first->time) < 0.0)) first = end;
  };
  for (int i = 0; i < static_cast<int>(sides_.size()); ++i)
    if (ranges::find(sliding(), i, &SlidingBorder::border) == sliding().end()) take(find_border_end(segment, i));
  for (std::size_t k = 0; k < sliding().size(); ++k) take(find_slip(segment, k));
  return first;
}

std::optional<LawBranches::End> LawBranches::find_border_end(const Segment<>& segment, int index) {
  const BorderSide& side = sides_[static_cast<std::size_t>(index)];
  const Path<Eigen::Dynamic> path(segment, inputs_);
  const Watched function{functions_, function_of(index), inputs_, state_, values_};
  double until = segment.duration();
  std::optional<End> end;
  const auto search = [&](double at, double sign) {
    if (!std::isfinite(at)) return;
    const auto crossing = find_crossing(function, path, until, at, sign);
    if (!crossing) return;
    until = crossing->tau;
    end = End{segment.t0() + crossing->tau, index, at, -sign, false, crossing->is_known};
  };
  if (border(index).is_by_sign()) {
    search(0.0, side.sign);
  } else {
    search(side.lower, 1.0);
    search(side.upper, -1.0);
  }
  return end;
}

std::optional<LawBranches::End> LawBranches::find_slip(const Segment<>& segment, std::size_t which) {
  const Path<Eigen::Dynamic> path(segment, sliding_->inputs);
  const Watched share{sliding_->shares, which, sliding_->inputs, state_, sliding_->share_values};
  const SlidingBorder& border = sliding_->borders[which];
  double until = segment.duration();
  std::optional<End> end;
  for (const double side : {-1.0, 1.0}) {
    // the share of the upper side stays above 0 and below 1
    const auto crossing = find_crossing(share, path, until, side < 0.0 ? 0.0 : 1.0, -side);
    if (!crossing) continue;
    until = crossing->tau;
    end = End{segment.t0() + crossing->tau, border.border, border.at, side, true, crossing->is_known};
  }
  return end;
}

}  // namespace trajet
