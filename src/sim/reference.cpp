#include "trajet/sim/reference.hpp"

#include <algorithm>
#include <limits>

namespace trajet {

ClosedFormReference::ClosedFormReference(const World& world) : closed_forms_(world.exact) {
  for (const World::Group& group : world.groups) sizes_.push_back(group.start.size());
  for (const World::ClosedForm& closed_form : closed_forms_) evaluators_.emplace_back(closed_form.value);
}

void ClosedFormReference::state(int group, double t, Eigen::VectorXd& q) const {
  q.setConstant(sizes_[static_cast<std::size_t>(group)], std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < closed_forms_.size(); ++i) {
    const World::ClosedForm& closed_form = closed_forms_[i];
    if (closed_form.group != group) continue;
    const auto size = static_cast<Eigen::Index>(closed_form.value.outputs.size());
    evaluators_[i](t, nullptr, q.data() + closed_form.offset);
    if (!q.segment(closed_form.offset, size).allFinite())
      throw ReferenceError(closed_form.where, "the closed form of '" + closed_form.name +
                                                  "' is not finite at t = " + std::to_string(t) + " s");
  }
}

void RecordedReference::begin(const World& world) {
  direction_ = world.end < world.start ? -1.0 : 1.0;
  end_ = world.start;
  starts_.clear();
  for (const World::Group& group : world.groups) starts_.push_back(group.start);
  pieces_.assign(world.groups.size(), {});
}

void RecordedReference::motion(const MotionPiece& piece) {
  pieces_[static_cast<std::size_t>(piece.group)].push_back({piece.to, piece.segment});
  if (piece.group == 0) end_ = piece.to;
}

void RecordedReference::state(int group, double t, Eigen::VectorXd& q) const {
  const std::vector<Piece>& pieces = pieces_[static_cast<std::size_t>(group)];
  if (pieces.empty()) {
    q = starts_[static_cast<std::size_t>(group)];
    return;
  }
  const auto ends_by = [this](double time, const Piece& piece) { return direction_ * (piece.to - time) > 0.0; };
  auto found = std::upper_bound(pieces.begin(), pieces.end(), t, ends_by);
  if (found == pieces.end()) --found;
  found->segment.evaluate(t, q);
}

}  // namespace trajet
