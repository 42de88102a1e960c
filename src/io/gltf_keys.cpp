#include "gltf_keys.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "trajet/io/gltf.hpp"

namespace trajet::detail {

namespace {

Pose pose(const World::Body& body, const Segment<>& segment, double t) {
  const auto at = [&](int component) { return segment.value(component, t); };
  const Vector3 position(at(body.offset), at(body.offset + 1), at(body.offset + 2));
  if (!body.rotation) return {position, body.q_WB};
  const OrientationLayout& layout = body.rotation->layout;
  constexpr int kMostNumbers = 9;  // a matrix
  double orientation[kMostNumbers] = {};
  for (int i = 0; i < layout.size(); ++i) orientation[i] = at(body.rotation->offset + i);
  // glTF knows rotations only: what stretches is left out
  const Matrix3 R_WB = layout.rotation(orientation);
  return {position, Quaternion(nearest_rotation(R_WB))};
}

}  // namespace

std::map<float, Pose> animation_keys(const MotionRecord& motion, const RunResult& result, const World::Body& body,
                                     double fps) {
  const auto& pieces = motion.pieces(body.group);
  std::map<float, Pose> keys;
  if (pieces.empty()) return keys;
  const double start = result.start_time;
  const double direction = result.end_time < start ? -1.0 : 1.0;
  const double duration = std::abs(result.end_time - start);
  // before a jump at t the piece that ends there counts, behind it the one that begins there
  const auto pose_before = [&](double t) {
    const auto piece =
        std::ranges::partition_point(pieces, [&](const auto& each) { return direction * (each.to - t) < 0.0; });
    return pose(body, piece == pieces.end() ? pieces.back().segment : piece->segment, t);
  };
  const auto pose_behind = [&](double t) {
    const auto next =
        std::ranges::partition_point(pieces, [&](const auto& each) { return direction * (each.from - t) <= 0.0; });
    return pose(body, (next == pieces.begin() ? next : std::prev(next))->segment, t);
  };

  const auto add_jump = [&](double t) {
    const auto time = static_cast<float>(direction * (t - start));
    keys.insert_or_assign(time, pose_before(t));
    if (t != result.end_time)
      keys.insert_or_assign(std::nextafter(time, std::numeric_limits<float>::infinity()), pose_behind(t));
  };
  for (const Impact& impact : result.impacts)
    if (impact.body == body.name) add_jump(impact.time);
  for (const EventRecord& event : result.events) add_jump(event.time);

  if (duration * fps > kMostAnimationKeys) throw std::length_error("too many keys for an animation");
  const auto frame_count = static_cast<long>(std::floor(duration * fps));
  for (long i = 0; i <= frame_count; ++i) {
    const double time = static_cast<double>(i) / fps;
    keys.try_emplace(static_cast<float>(time), pose_behind(start + direction * time));
  }
  keys.try_emplace(static_cast<float>(duration), pose_before(result.end_time));

  const Pose* last = nullptr;
  for (auto& [time, key] : keys) {
    if (last != nullptr && last->q_WB.dot(key.q_WB) < 0.0) key.q_WB.coeffs() *= -1.0;
    last = &key;
  }
  return keys;
}

}  // namespace trajet::detail
