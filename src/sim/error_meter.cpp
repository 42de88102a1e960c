#include "error_meter.hpp"

#include <algorithm>
#include <cmath>

#include "rotations.hpp"

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
  if (onlooker_ != nullptr) onlooker_->begin(world);
  world_ = &world;
  start_ = world.start;
  sample_ = world.end < world.start ? -world.sample : world.sample;
  groups_.resize(world.groups.size());
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    Group& group = groups_[g];
    group.until = start_;
    group.is_position.resize(static_cast<std::size_t>(world.groups[g].start.size()));
    for (const int b : world.groups[g].bodies) {
      const int offset = world.bodies[static_cast<std::size_t>(b)].offset;
      std::fill_n(group.is_position.begin() + offset, 3, true);
    }
    state_ = world.groups[g].start;
    read_reference(static_cast<int>(g), start_);
    group.at_end = deviation(group);
    raise(at_samples_, group.at_end);
    raise(at_nodes_, group.at_end);
  }
}

void ErrorMeter::motion(const MotionPiece& piece) {
  if (onlooker_ != nullptr) onlooker_->motion(piece);
  Group& group = groups_[static_cast<std::size_t>(piece.group)];
  if (piece.begins_anew && reference_.ends_at_jumps() && piece.from != start_) group.open = false;
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
    const double t = start_ + static_cast<double>(group.next_sample) * sample_;
    const double beyond = forward * (t - to);
    if (beyond > kRounding * std::abs(sample_)) break;
    raise(at_samples_, deviation(piece, beyond > 0.0 ? to : t));
    ++group.next_sample;
  }
  group.until = to;
  group.at_end = deviation(piece, to);
  if (piece.ends_step && to == piece.to) raise(at_nodes_, group.at_end);
}

Deviation ErrorMeter::deviation(const MotionPiece& piece, double t) {
  state_ = piece.state(t);
  read_reference(piece.group, t);
  return deviation(groups_[static_cast<std::size_t>(piece.group)]);
}

void ErrorMeter::read_reference(int group, double t) {
  reference_.state(group, t, reference_state_);
  settle_orientations(*world_, group, reference_state_);
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

double ErrorMeter::compared_until() const {
  const double forward = sample_ < 0.0 ? -1.0 : 1.0;
  double until = groups_.front().until;
  for (const Group& group : groups_)
    if (forward * (until - group.until) > 0.0) until = group.until;
  return until;
}

}  // namespace trajet
