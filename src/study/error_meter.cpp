#include "error_meter.hpp"

#include <algorithm>
#include <cmath>

#include "carried_orientations.hpp"
#include "trajet/sim/state_at.hpp"

namespace trajet {
namespace {

void raise(std::optional<double>& maximum, const std::optional<double>& value) {
  if (value && !(maximum && *maximum >= *value)) maximum = value;
}

void raise(Deviation& maximum, const Deviation& value) {
  raise(maximum.state, value.state);
  raise(maximum.position, value.position);
}

}  // namespace

void ErrorMeter::begin(const World& world) {
  world_ = &world;
  sample_ = world.direction() * world.sample;
  rotation_ = RotationMeter(world);
  constexpr double kLongestHistory = 500.0;
  history_stride_ = std::max(1L, std::lround(std::abs(world.duration) / world.sample / kLongestHistory));
  groups_.resize(world.groups.size());
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    Group& group = groups_[g];
    group.until = 0.0;
    group.is_position.resize(static_cast<std::size_t>(world.groups[g].start.size()));
    for (const int b : world.groups[g].bodies) {
      const int position = world.bodies[static_cast<std::size_t>(b)].slice().position_index();
      std::fill_n(group.is_position.begin() + position, 3, true);
    }
    state_ = world.groups[g].start;
    read_reference(static_cast<int>(g), 0.0);
    group.at_end = deviation(group);
    raise(at_samples_, group.at_end);
    raise(at_nodes_, group.at_end);
    note_rotation(static_cast<int>(g), 0, 0.0);
    group.rotation_at_end = rotation_.measure(static_cast<int>(g), state_, reference_state_);
  }
}

void ErrorMeter::motion(const MotionPiece& piece) {
  Group& group = groups_[static_cast<std::size_t>(piece.group)];
  if (piece.begins_anew && reference_.ends_at_jumps() && piece.from != 0.0) group.open = false;
  if (!group.open) return;

  const double forward = sample_ < 0.0 ? -1.0 : 1.0;
  double to = piece.to;
  if (const auto end = reference_.end_time(); end && forward * (to - *end) >= 0.0) {
    to = *end;
    group.open = false;
    if (forward * (to - piece.from) < 0.0) return;
  }
  // Samples on (from, to]; one that misses the end by rounding is the end.
  constexpr double kRounding = 1e-9;
  while (true) {
    const double t = static_cast<double>(group.next_sample) * sample_;
    const double beyond = forward * (t - to);
    if (beyond > kRounding * std::abs(sample_)) break;
    raise(at_samples_, deviation(piece, beyond > 0.0 ? to : t));
    note_rotation(piece.group, group.next_sample, t);
    ++group.next_sample;
  }
  group.until = to;
  group.at_end = deviation(piece, to);
  if (!rotation_.empty()) group.rotation_at_end = rotation_.measure(piece.group, state_, reference_state_);
  if (piece.ends_step && to == piece.to) raise(at_nodes_, group.at_end);
}

void ErrorMeter::note_rotation(int group, long sample, double t) {
  if (rotation_.empty()) return;
  const RotationDeviation deviation = rotation_.measure(group, state_, reference_state_);
  raise(rotation_at_samples_, deviation);
  if (sample % history_stride_ != 0) return;
  const auto index = static_cast<std::size_t>(sample / history_stride_);
  if (rotation_history_.size() <= index) rotation_history_.resize(index + 1);
  rotation_history_[index].time = t;
  raise(rotation_history_[index].deviation, deviation);
}

Deviation ErrorMeter::deviation(const MotionPiece& piece, double t) {
  state_ = state_at(*world_, piece.group, piece.segment, t);
  read_reference(piece.group, t);
  return deviation(groups_[static_cast<std::size_t>(piece.group)]);
}

void ErrorMeter::read_reference(int group, double t) {
  Eigen::VectorXd carried;
  reference_.state(group, t, carried);
  read_orientations(reference_world_, group, carried);
  reference_state_ = carried_as_in(*world_, reference_world_, group, carried);
  align_orientations(*world_, group, reference_state_, state_);
}

Deviation ErrorMeter::deviation(const Group& group) const {
  Deviation result;
  for (Eigen::Index i = 0; i < state_.size(); ++i) {
    const double error = std::abs(state_[i] - reference_state_[i]);
    if (std::isnan(reference_state_[i])) continue;
    raise(result.state, error);
    if (group.is_position[static_cast<std::size_t>(i)]) raise(result.position, error);
  }
  return result;
}

Deviation ErrorMeter::at_end() const {
  Deviation result;
  for (const Group& group : groups_) raise(result, group.at_end);
  return result;
}

RotationDeviation ErrorMeter::rotation_at_end() const {
  RotationDeviation worst;
  for (const Group& group : groups_) raise(worst, group.rotation_at_end);
  return worst;
}

double ErrorMeter::compared_until() const {
  const double forward = sample_ < 0.0 ? -1.0 : 1.0;
  double until = groups_.front().until;
  for (const Group& group : groups_)
    if (forward * (until - group.until) > 0.0) until = group.until;
  return until;
}

}  // namespace trajet
