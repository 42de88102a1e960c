#include "trajet/viz/pose.hpp"

#include <algorithm>
#include <cmath>

#include "trajet/sim/state_at.hpp"

namespace trajet {

Pose pose(const World::Body& body, double time, const Eigen::VectorXd& state) {
  Pose result{time, body.slice().position(state), Matrix3::Identity()};
  result.R_WB =
      body.rotation ? body.rotation->layout.matrix(body.slice().orientation(state)) : rotation_matrix(body.q_WB);
  return result;
}

std::vector<double> pose_times(double start, double end) {
  constexpr double kMostSteps = 12.0;
  const double duration = end - start;
  if (duration == 0.0) return {start};
  const double rough = std::abs(duration) / kMostSteps * (1.0 - 1e-9);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = power * (rough <= power ? 1.0 : rough <= 2.0 * power ? 2.0 : rough <= 5.0 * power ? 5.0 : 10.0);
  std::vector<double> times;
  // an end that comes soon after a round step takes its place
  constexpr double kSoon = 0.3;
  for (int k = 0; k * step < std::abs(duration) - kSoon * step; ++k)
    times.push_back(start + std::copysign(k * step, duration));
  times.push_back(end);
  return times;
}

std::vector<Pose> poses_at(const MotionRecord& record, const World::Body& body, const std::vector<double>& times) {
  const auto& pieces = record.pieces(body.group);
  std::vector<Pose> poses;
  if (pieces.empty()) {
    const Eigen::VectorXd& start = record.world().groups[static_cast<std::size_t>(body.group)].start;
    for (const double t : times) poses.push_back(pose(body, t, start));
    return poses;
  }
  const double direction = pieces.back().to < pieces.front().from ? -1.0 : 1.0;
  auto piece = pieces.begin();
  for (const double t : times) {
    piece = std::find_if(piece, pieces.end() - 1,
                         [&](const MotionRecord::Piece& each) { return direction * (each.to - t) >= 0.0; });
    poses.push_back(pose(body, t, state_at(record.world(), body.group, piece->segment, t)));
  }
  return poses;
}

std::vector<Pose> make_poses(const MotionRecord& record, const World::Body& body) {
  const auto& pieces = record.pieces(body.group);
  if (pieces.empty()) return poses_at(record, body, {0.0});
  return poses_at(record, body, pose_times(pieces.front().from, pieces.back().to));
}

}  // namespace trajet
