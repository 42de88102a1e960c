#include "trajet/event/law_branches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "trajet/law/program_jacobian.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

/// The branches may change this often at one instant before they count as undecided there.
constexpr int kMostChanges = 8;

/// The sign of all of the numbers; 0 where they have several or are not known.
double definite_sign(const Interval& values) { return values.lower() > 0.0 ? 1.0 : values.upper() < 0.0 ? -1.0 : 0.0; }

/// The value of a border that may be among the function's values, if there is one.
std::optional<double> border_within(const PinnedLaw::Border& border, const Interval& values) {
  if (border.is_by_sign()) return zero_in(values) ? std::optional(0.0) : std::nullopt;
  if (border.is_floor) {
    const double whole = std::floor(values.upper());
    return whole >= values.lower() ? std::optional(whole) : std::nullopt;
  }
  const LookupTable& table = *border.table;
  for (const double end : {table.last(), table.cell(table.find_cell(values.upper())).begin})
    if (in(end, values)) return end;
  return std::nullopt;
}

}  // namespace

LawBranches::Sliding::Sliding(std::vector<SlidingBorder> along, SlidingLaw their_law)
    : borders(std::move(along)),
      law(std::move(their_law)),
      inputs(read_components(law.shares)),
      rate(law.law),
      residuals(law.residuals),
      holds(law.holds),
      rate_jets(law.law),
      shares(law.shares),
      share_values(borders.size()) {}

LawBranches::LawBranches(const Program& law)
    : pinned_(pin_choices(law)),
      inputs_(read_components(pinned_.functions)),
      sides_(pinned_.borders.size()),
      law_(pinned_.law),
      law_jets_(pinned_.law),
      functions_(pinned_.functions),
      rate_(pinned_.law.outputs.size()),
      state_(static_cast<std::size_t>(law.input_count - 1)),
      rate_jets_(rate_.size()),
      values_(pinned_.functions.outputs.size()),
      displacement_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(state_.size()))),
      repels_(pinned_.directions.size(), false) {
  for (const PinnedLaw::Border& each : pinned_.borders) {
    first_pin_.push_back(pins_.size());
    for (const PinnedLaw::Pin& pin : each.pins)
      for (const std::int32_t slot : pin.slots) pins_.push_back({slot, 0.0});
  }
}

std::span<const SlidingBorder> LawBranches::sliding() const {
  return sliding_ ? std::span<const SlidingBorder>(sliding_->borders) : std::span<const SlidingBorder>();
}

void LawBranches::set_side(int index, const BorderSide& side) {
  const auto place = static_cast<std::size_t>(index);
  sides_[place] = side;
  std::size_t k = first_pin_[place];
  for (const PinnedLaw::Pin& pin : border(index).pins)
    for (const double value : pinned_values(border(index), pin, side)) {
      PinValue& pin_value = pins_[k++];
      pin_value.value = value;
      law_.set_constant(pin_value.slot, value);
      law_jets_.set_constant(pin_value.slot, value);
      functions_.set_constant(pin_value.slot, value);
    }
}

Eigen::RowVectorXd LawBranches::gradient(int border, double t, const double* q) {
  if (pinned_.is_direction(border))  // of its length
    return vector_of(border, t, q).normalized().transpose() * derivative_of(border, t, q);
  return function_derivatives(t, q).row(static_cast<Eigen::Index>(function_of(border)));
}

Eigen::MatrixXd LawBranches::function_derivatives(double t, const double* q) const {
  const auto rows = static_cast<Eigen::Index>(pinned_.functions.outputs.size());
  const auto size = static_cast<Eigen::Index>(state_.size());
  Eigen::MatrixXd derivatives(rows, size + 1);
  Program functions = pinned_.functions;
  for (Program::Constant& constant : functions.constants)
    for (const PinValue& pin : pins_)
      if (constant.slot == pin.slot) constant.value = pin.value;
  ProgramJacobian jacobian(functions);
  jacobian(t, q, derivatives.data(), derivatives.col(size).data());
  return derivatives;
}

void LawBranches::evaluate_values(double t, const double* q) {
  constexpr double kRoundings = 8.0;
  law_(t, q, rate_.data());
  for (std::size_t i = 0; i < state_.size(); ++i) {
    const double change = std::isfinite(rate_[i]) ? std::abs(t * rate_[i]) : 0.0;
    const double rounding = kRoundings * kUnitRoundoff * (std::abs(q[i]) + change);
    state_[i] = IntervalJet(Interval(q[i] - rounding, q[i] + rounding));
  }
  const double rounding = kRoundings * kUnitRoundoff * std::abs(t);
  functions_(IntervalJet(Interval(t - rounding, t + rounding)), state_.data(), values_.data());
}

void LawBranches::evaluate_jets(double t, const double* q) {
  const IntervalJet time = IntervalJet::variable(Interval(t));
  Evaluator<double>& rate = sliding_ ? sliding_->rate : law_;
  Evaluator<IntervalJet>& jets = sliding_ ? sliding_->rate_jets : law_jets_;
  rate(t, q, rate_.data());
  for (std::size_t i = 0; i < state_.size(); ++i) {
    state_[i] = IntervalJet(Interval(q[i]));
    state_[i][1] = Interval(rate_[i]);
  }
  jets(time, state_.data(), rate_jets_.data());
  for (std::size_t i = 0; i < state_.size(); ++i) state_[i][2] = 0.5 * rate_jets_[i][1];
  functions_(time, state_.data(), values_.data());
}

LawBranches::Finding LawBranches::begin(double t, const double* q, double direction) {
  return find_sides(t, q, direction, nullptr);
}

LawBranches::Finding LawBranches::pass(const End& end, double t, const double* q, double direction) {
  return find_sides(t, q, direction, &end);
}

LawBranches::Finding LawBranches::find_sides(double t, const double* q, double direction, const End* passed) {
  // what it slid along it has not left, however far it has drifted off
  std::vector<SlidingBorder> slid;
  if (passed != nullptr && sliding_) slid = sliding_->borders;
  sliding_.reset();
  undecided_.clear();
  displacement_.setZero();
  std::vector<Near> near;
  for (int i = 0; i < static_cast<int>(sides_.size()); ++i) {
    evaluate_values(t, q);  // which may be made of the choices before
    const Interval values = value(i);
    if (boost::numeric::empty(values) || std::isnan(values.lower()) || std::isnan(values.upper()))
      return Finding::undefined;
    const bool is_passed = passed != nullptr && passed->border == i;
    const auto was_slid = ranges::find(slid, i, &SlidingBorder::border);
    const std::optional<double> at = is_passed                ? std::optional(passed->at)
                                     : was_slid != slid.end() ? std::optional(was_slid->at)
                                                              : border_within(border(i), values);
    if (!at) {
      set_side(i, side_of(border(i), median(values), 1.0));
      continue;
    }
    const double onward = is_passed ? passed->onward : median(values) < *at ? -1.0 : 1.0;
    // what lets go of the motion has only just ceased to hold it
    if (!(is_passed && passed->is_slip)) near.push_back({i, *at, onward});
    set_side(i, side_of(border(i), *at, onward));
  }
  if (!pinned_.directions.empty()) {
    const Finding held = hold_directions(near, t, q, direction, passed, slid);
    if (held == Finding::moved || sliding_) return held;
  }
  for (int rounds = 0; rounds < kMostChanges; ++rounds) {
    if (const Finding finding = settle(near, t, q, direction); finding != Finding::decided)
      return finding == Finding::undecided ? slide(near, t, q, direction) : finding;
    if (passed != nullptr && passed->is_slip) return Finding::decided;
    if (!update_far_sides(near, t, q)) return Finding::decided;
  }
  return Finding::undecided;
}

bool LawBranches::update_far_sides(const std::vector<Near>& near, double t, const double* q) {
  evaluate_values(t, q);
  bool has_changed = false;
  for (int i = 0; i < static_cast<int>(sides_.size()); ++i) {
    if (ranges::any_of(near, [i](const Near& each) { return each.border == i; })) continue;
    const BorderSide side = side_of(border(i), median(value(i)), 1.0);
    if (side == sides_[static_cast<std::size_t>(i)]) continue;
    set_side(i, side);
    evaluate_values(t, q);
    has_changed = true;
  }
  return has_changed;
}

LawBranches::Finding LawBranches::settle(std::vector<Near>& near, double t, const double* q, double direction) {
  const int most_changes = kMostChanges * static_cast<int>(near.size());
  for (int changes = 0; changes <= most_changes; ++changes) {
    if (near.empty()) return Finding::decided;
    evaluate_jets(t, q);
    const auto leads_back = [&](const Near& each) {
      const IntervalJet& function = values_[function_of(each.border)];
      double goes = direction * definite_sign(function[1]);
      if (goes == 0.0) goes = definite_sign(function[2]);
      return goes * each.onward < 0.0;
    };
    // in turn, so that none waits for another that goes to and fro
    const auto wrong = ranges::max_element(
        near, {}, [&](const Near& each) { return leads_back(each) ? -each.changes : std::numeric_limits<int>::min(); });
    if (!leads_back(*wrong)) return Finding::decided;
    wrong->onward = -wrong->onward;
    ++wrong->changes;
    set_side(wrong->border, side_of(border(wrong->border), wrong->at, wrong->onward));
  }
  return Finding::undecided;
}

LawBranches::Finding LawBranches::slide(std::vector<Near>& near, double t, const double* q, double direction) {
  std::vector<SlidingBorder> along;
  for (const Near& each : near)
    if (each.changes > 1) along.push_back({each.border, each.at});
  std::erase_if(near, [](const Near& each) { return each.changes > 1; });
  return slide_along(std::move(along), near, t, q, direction);
}

LawBranches::Finding LawBranches::slide_along(std::vector<SlidingBorder> along, std::vector<Near>& near, double t,
                                              const double* q, double direction) {
  for (const SlidingBorder& each : along) undecided_.push_back(each.border);
  for (int rounds = 0; rounds < kMostChanges && !along.empty(); ++rounds) {
    auto law = make_sliding_law(pinned_, sides_, along);
    if (!law) break;
    sliding_ = std::make_unique<Sliding>(along, std::move(*law));
    if (leave_border(along, t, q)) continue;
    if (!shares_tell_all(t, q)) break;
    for (Near& each : near) each.changes = 0;
    if (settle(near, t, q, direction) != Finding::decided) break;
    if (ranges::any_of(near, [](const Near& each) { return each.changes > 0; })) continue;
    undecided_.clear();
    return Finding::decided;
  }
  sliding_.reset();
  return Finding::undecided;
}

bool LawBranches::leave_border(std::vector<SlidingBorder>& along, double t, const double* q) {
  for (std::size_t i = 0; i < state_.size(); ++i) state_[i] = IntervalJet(Interval(q[i]));
  sliding_->shares(IntervalJet(Interval(t)), state_.data(), sliding_->share_values.data());
  for (std::size_t k = 0; k < along.size(); ++k) {
    const double share = median(sliding_->share_values[k][0]);
    if (share >= 0.0 && share <= 1.0) continue;
    if (pinned_.is_direction(along[k].border)) return false;  // asked for before
    set_side(along[k].border, side_of(border(along[k].border), along[k].at, share > 1.0 ? 1.0 : -1.0));
    along.erase(along.begin() + static_cast<std::ptrdiff_t>(k));
    return true;
  }
  return false;
}

bool LawBranches::shares_tell_all(double t, const double* q) {
  constexpr double kRounding = 1e-9;  // of the rates, and far above what they round to
  std::vector<double> rests(sliding_->law.residuals.outputs.size());
  if (rests.empty()) return true;
  sliding_->residuals(t, q, rests.data());
  sliding_->rate(t, q, rate_.data());
  double largest = 0.0;
  for (const double rate : rate_) largest = std::max(largest, std::abs(rate));
  law_(t, q, rate_.data());
  for (const double rate : rate_) largest = std::max(largest, std::abs(rate));
  return ranges::all_of(rests, [&](double rest) { return std::abs(rest) <= kRounding * largest; });
}

}  // namespace trajet
