#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "recurrence_step.hpp"
#include "trajet/law/program_expansion.hpp"

/// The part of ProgramExpansion that deals with branches: which one an instruction takes, and how long it holds.
namespace trajet {
namespace detail {

/// Two times are the same, relative to their size, where a step from one to the other is not worth making.
inline constexpr double kSameTime = 64.0 * std::numeric_limits<double>::epsilon();
/// Two states are the same, relative to the terms of their series, where only rounding lies between them: an event that
/// sets the state at the end of a step moves it further.
inline constexpr double kSameState = 1e-12;

}  // namespace detail

/// The sign that the branch's function has just behind the start, as far as its coefficients up to n tell: -1, 0, 1.
template <class T>
double ProgramExpansionT<T>::decide_sign(Branch& branch, int n) {
  if (n == 0) {
    const T value = row(branch.function)[0];
    branch.starts_at_zero = branch.forced_sign.has_value() || value == 0.0;
    branch.sign = branch.forced_sign.value_or(trajet::sign(value));
  } else if (branch.sign == 0.0) {
    branch.sign = trajet::sign(row(branch.function)[n]);
  }
  return branch.sign;
}

template <class T>
void ProgramExpansionT<T>::decide_interval(const Step& step, Branch& branch, T x) {
  const bool forced = branch.forced_sign.has_value();
  const double place = forced ? branch.forced_border : static_cast<double>(x);
  if (step.opcode == Opcode::tan) {
    // from pole to pole, at odd multiples of pi/2
    const double pole = place / std::numbers::pi - 0.5;
    branch.lower = forced ? std::nearbyint(pole) : std::floor(pole);
    if (forced && *branch.forced_sign < 0.0) branch.lower -= 1.0;
    branch.upper = (branch.lower + 1.5) * std::numbers::pi;
    branch.lower = (branch.lower + 0.5) * std::numbers::pi;
  } else if (step.opcode == Opcode::floor) {
    branch.lower = std::floor(place);
    if (forced && *branch.forced_sign < 0.0) branch.lower -= 1.0;
    branch.upper = branch.lower + 1.0;
  } else {
    const LookupTable& table = *step.table;
    int cell = table.find_cell(place);
    if (forced && *branch.forced_sign < 0.0 && place == table.cell(cell).begin) --cell;
    const bool inside =
        cell >= 0 && table.contains(place) && !(forced && *branch.forced_sign > 0.0 && place == table.last());
    branch.lower = inside ? table.cell(cell).begin : std::numeric_limits<double>::quiet_NaN();
    branch.upper = inside ? table.cell_end(cell) : std::numeric_limits<double>::quiet_NaN();
  }
  branch.sign = 1.0;
  branch.starts_at_zero = forced || x == branch.lower || x == branch.upper;
}

template <class T>
void ProgramExpansionT<T>::run_branch(const Step& step, Branch& branch, int n) {
  const T *a = step.a, *b = step.b, *c = step.c;
  T *r = step.result, *u = step.own[0];
  switch (step.opcode) {
    case Opcode::abs: {
      const double sign = decide_sign(branch, n);
      r[n] = n == 0 ? std::abs(a[0]) : sign < 0.0 ? -a[n] : a[n];
      break;
    }
    case Opcode::min:
    case Opcode::max: {
      u[n] = a[n] - b[n];
      const double sign = decide_sign(branch, n);
      const bool takes_b = step.opcode == Opcode::min ? sign > 0.0 : sign < 0.0;
      r[n] = takes_b ? b[n] : a[n];
      break;
    }
    case Opcode::sign:
      r[n] = n == 0 ? decide_sign(branch, 0) : 0.0;
      break;
    case Opcode::less:
    case Opcode::less_equal: {
      u[n] = a[n] - b[n];
      const double sign = n == 0 ? decide_sign(branch, 0) : branch.sign;
      const bool holds = sign < 0.0 || (sign == 0.0 && step.opcode == Opcode::less_equal);
      r[n] = n == 0 && holds ? 1.0 : 0.0;
      break;
    }
    case Opcode::equal:
      u[n] = a[n] - b[n];
      r[n] = n == 0 && decide_sign(branch, 0) == 0.0 ? 1.0 : 0.0;
      break;
    case Opcode::where:
      if (n == 0) decide_sign(branch, 0);
      r[n] = branch.sign != 0.0 ? b[n] : c[n];
      break;
    case Opcode::sqrt:
      branch.sign = 1.0;
      branch.starts_at_zero = a[0] == 0.0;
      r[n] = n > 0 && a[0] == 0.0 ? detail::power_of_zero(a, n) : recurrence::sqrt(a, r, u[0], n);
      break;
    case Opcode::norm:
      branch.sign = 1.0;
      if (n == 0) branch.starts_at_zero = branch.forced_sign.has_value() || norm3(a[0], b[0], c[0]) == 0.0;
      if (branch.starts_at_zero) {
        // |v| = s |v / s| for s >= 0; what v has left at the start is rounding
        r[n] = n == 0 ? 0.0 : recurrence::norm3(a + 1, b + 1, c + 1, r + 1, u[0], n - 1);
      } else {
        r[n] = recurrence::norm3(a, b, c, r, u[0], n);
      }
      break;
    case Opcode::asin:
    case Opcode::acos: {  // pi/2 - asin a: v = asin a; u = sqrt(1 - a^2)
      const bool is_cosine = step.opcode == Opcode::acos;
      T* angle = is_cosine ? step.own[1] : r;
      detail::asin_step(a, angle, u, n);
      if (is_cosine) r[n] = n == 0 ? std::acos(a[0]) : -angle[n];
      branch.sign = 1.0;
      branch.starts_at_zero = u[0] == 0.0;
      break;
    }
    case Opcode::atan2:  // the cut: y = 0, x < 0
      if (n > 0) {
        recurrence::atan2(a, b, r, u, n);
      } else {
        r[0] = angle_on_side(a[0], b[0], decide_sign(branch, 0));
        u[0] = a[0] * a[0] + b[0] * b[0];
      }
      break;
    case Opcode::tan:
      if (n > 0) return recurrence::tan(a, r, u, n);
      decide_interval(step, branch, a[0]);
      r[0] = branch.starts_at_zero ? std::numeric_limits<T>::quiet_NaN() : std::tan(a[0]);
      u[0] = 1.0 + r[0] * r[0];
      break;
    case Opcode::floor:
      if (n == 0) decide_interval(step, branch, a[0]);
      r[n] = n == 0 ? branch.lower : 0.0;
      break;
    case Opcode::table: {
      if (n == 0) decide_interval(step, branch, a[0]);
      // y = ((c3 s + c2) s + c1) s + c0 with s = x - begin: u = s, v = c3 s + c2, w = v s + c1
      const LookupTable& table = *step.table;
      const LookupTable::Cell& cell = table.cell(table.find_cell(branch.lower));
      T *v = step.own[1], *w = step.own[2];
      u[n] = n == 0 ? a[0] - branch.lower : a[n];
      v[n] = cell.c3 * u[n] + (n == 0 ? cell.c2 : 0.0);
      w[n] = recurrence::multiply(v, u, n) + (n == 0 ? cell.c1 : 0.0);
      r[n] = recurrence::multiply(w, u, n) + (n == 0 ? cell.c0 : 0.0);
      break;
    }
    default:
      break;
  }
}

template <class T>
BranchTime ProgramExpansionT<T>::end_of_branch(const Branch& branch, double duration, double& border) const {
  std::array<double, kMaxOrder> room;
  const T* function = rows_.data() + static_cast<std::ptrdiff_t>(branch.function) * stride_;
  const std::span<const double> series = detail::in_doubles(function, order_, room);
  const BranchTime none{duration, -1, 0.0};
  if (branch.kind == Branch::Kind::nonzero && branch.sign != 0.0) return none;  // zero for an instant decides nothing
  if (branch.kind != Branch::Kind::interval) {
    return first_sign_change(series, branch.sign, branch.starts_at_zero, duration);
  }
  if (!(branch.lower < branch.upper)) return none;  // outside a table
  // x - lower and upper - x both stay positive
  BranchTime first = none;
  for (const double end : {branch.lower, branch.upper}) {
    const double sign = end == branch.lower ? 1.0 : -1.0;
    std::array<double, kMaxOrder> distance;
    for (std::size_t k = 0; k < series.size(); ++k) distance[k] = sign * (k == 0 ? series[0] - end : series[k]);
    const bool starts_here = branch.starts_at_zero && std::abs(distance[0]) < 0.5 * (branch.upper - branch.lower);
    const BranchTime change =
        first_sign_change(std::span(distance).first(series.size()), 1.0, starts_here, first.duration);
    if (change.index < 0) {
      if (change.duration != first.duration) first = change;
      continue;
    }
    first = {change.duration, 0, sign * change.sign_after};
    border = end;
  }
  return first;
}

template <class T>
double ProgramExpansionT<T>::duration_until_branch(double duration) {
  const double search = duration * row_direction_;  // on the axis s of the rows
  direction_ = duration < 0.0 ? -1.0 : 1.0;
  has_end_ = false;
  BranchTime first{search, -1, 0.0};
  double first_border = 0.0;
  for (std::size_t i = 0; i < branches_.size(); ++i) {
    if (leaves_branches_by_time_ && branches_[i].is_by_time) continue;
    double border = 0.0;
    const BranchTime end = end_of_branch(branches_[i], first.duration, border);
    if (end.index < 0) {
      if (end.duration != first.duration) first = end;
      continue;
    }
    if (std::isnan(end.sign_after)) continue;  // the caller sees it in the coefficients
    first = {end.duration, static_cast<int>(i), end.sign_after};
    first_border = border;
  }
  if (first.index < 0) return first.duration * row_direction_;
  // What is known of the start stays known as long as the time does not move on: several branches may end together.
  if (std::abs(first.duration) > detail::kSameTime * std::abs(start_)) forget_forced_branches();
  force(branches_[static_cast<std::size_t>(first.index)], first.sign_after, first_border);
  remember_end(first.duration);
  return first.duration * row_direction_;
}

template <class T>
void ProgramExpansionT<T>::forget_forced_branches() {
  for (Branch& branch : branches_) {
    branch.forced_sign.reset();
    branch.refuted = {};
  }
}

template <class T>
void ProgramExpansionT<T>::force(Branch& branch, double sign, double border) {
  const auto refuted = [&](double s) -> bool& { return branch.refuted[static_cast<std::size_t>(s + 1.0)]; };
  if (branch.kind == Branch::Kind::sign) {
    refuted(branch.sign) = true;
    if (refuted(sign) && !refuted(0.0)) sign = 0.0;
  }
  branch.forced_sign = sign;
  branch.forced_border = border;
}

template <class T>
void ProgramExpansionT<T>::remember_end(double s) {
  if (is_in_blocks_) unpack_state();
  has_end_ = true;
  end_time_ = start_ + s * row_direction_;
  for (int i = 0; i < dimension(); ++i) {
    const T* q = rows_.data() + static_cast<std::ptrdiff_t>(1 + i) * stride_;
    T value = 0.0, magnitude = 0.0;
    for (int k = order_; k >= 0; --k) {
      value = value * s + q[k];
      magnitude = magnitude * std::abs(s) + std::abs(q[k]);
    }
    end_state_[static_cast<std::size_t>(i)] = static_cast<double>(value);
    end_tolerance_[static_cast<std::size_t>(i)] = detail::kSameState * static_cast<double>(magnitude);
  }
}

template <class T>
bool ProgramExpansionT<T>::continues_at(double t, const T* q) const {
  if (!has_end_ || std::abs(t - end_time_) > detail::kSameTime * std::abs(t)) return false;
  for (std::size_t i = 0; i < end_state_.size(); ++i) {
    if (std::abs(q[i] - end_state_[i]) > end_tolerance_[i]) return false;
  }
  return true;
}

}  // namespace trajet
