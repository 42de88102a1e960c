#include "gltf_keys.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "trajet/error.hpp"
#include "trajet/io/gltf.hpp"
#include "trajet/portable.hpp"
#include "trajet/scene/driven_frame.hpp"
#include "trajet/sim/state_at.hpp"

namespace trajet::detail {

namespace {

/// From one key to the next a body turns by no more than this, rad: somewhat less than a quarter of a turn, so that
/// what its angular velocity does between the points where it is looked at does not matter.
constexpr double kMostTurn = 0.45 * std::numbers::pi;

/// A time that wants a key.
struct Moment {
  double t;        // s since the start
  float time;      // s, forward
  bool is_before;  // a jump at t: the pose before it
};

/// The motion of one body, read once from its begin to its end.
class BodyMotion {
 public:
  BodyMotion(const RecordedMotion& motion, const World::Body& body, double direction)
      : world_(motion.world()), reader_(motion.read(body.group)), body_(body), direction_(direction) {
    read_on();
  }

  bool is_empty() const { return pieces_.empty(); }

  /// Nothing before that time will be asked any more.
  void forget_before(double t) {
    while (pieces_.size() > 1 && direction_ * (pieces_.front().to - t) < 0.0) pieces_.pop_front();
  }

  // before a jump at t the piece that ends there counts, behind it the one that begins there
  Pose before(double t) { return pose(piece_before(t)->segment, t); }
  Pose behind(double t) { return pose(piece_behind(t)->segment, t); }

  /// The largest angular velocity between two times, rad/s.
  double largest_spin(double from, double to) {
    if (!body_.rotation) return 0.0;
    const int w = body_.slice().angular_velocity_index();
    double largest = 0.0;
    const auto last = piece_before(to);
    for (auto piece = piece_behind(from); piece <= last; ++piece) {
      const double first = later(piece->from, from), end = earlier(piece->to, to);
      constexpr int kParts = 8;
      for (int i = 0; i <= kParts; ++i) {
        const double t = first + (end - first) * i / kParts;
        const auto at = [&](int axis) { return piece->segment.value(w + axis, t); };
        largest = std::max(largest, Vector3(at(0), at(1), at(2)).norm());
      }
    }
    return largest;
  }

 private:
  using Iterator = std::deque<RecordedPiece>::const_iterator;

  double later(double a, double b) const { return direction_ * (a - b) > 0.0 ? a : b; }
  double earlier(double a, double b) const { return direction_ * (a - b) < 0.0 ? a : b; }

  bool read_on() {
    const RecordedPiece* const piece = reader_->next();
    if (piece != nullptr) pieces_.push_back(*piece);
    return piece != nullptr;
  }
  /// Until a piece begins behind t.
  void read_beyond(double t) {
    while (direction_ * (pieces_.back().from - t) <= 0.0 && read_on()) {
    }
  }

  Iterator piece_before(double t) {
    read_beyond(t);
    const auto piece =
        ranges::partition_point(pieces_, [&](const auto& each) { return direction_ * (each.to - t) < 0.0; });
    return piece == pieces_.end() ? std::prev(piece) : piece;
  }
  Iterator piece_behind(double t) {
    read_beyond(t);
    const auto next =
        ranges::partition_point(pieces_, [&](const auto& each) { return direction_ * (each.from - t) <= 0.0; });
    return next == pieces_.begin() ? next : std::prev(next);
  }

  Pose pose(const Segment<>& segment, double t) const {
    const Eigen::VectorXd q = state_at(world_, body_.group, segment, t);
    const BodySlice slice = body_.slice();
    if (!body_.rotation) return {slice.position(q), body_.q_WB};
    // glTF knows rotations only: what stretches is left out
    return {slice.position(q), Quaternion(nearest_rotation(body_.rotation->layout.rotation(slice.orientation(q))))};
  }

  const World& world_;
  std::unique_ptr<RecordedMotion::Reader> reader_;
  std::deque<RecordedPiece> pieces_;  // those that are read and not forgotten
  const World::Body& body_;
  double direction_;
};

/// The moments of a run of which nothing is known but its jumps: strictly increasing in single precision.
std::vector<Moment> moments(const RunResult& result, std::span<const double> jumps, double fps) {
  const double direction = result.elapsed < 0.0 ? -1.0 : 1.0;
  const double duration = std::abs(result.elapsed);
  if (duration * fps > kMostAnimationKeys) throw std::length_error("too many keys for an animation");
  std::vector<Moment> all;  // of one time the last one counts
  const auto frame_count = static_cast<long>(std::floor(duration * fps));
  all.reserve(static_cast<std::size_t>(frame_count) + 2 + 2 * jumps.size());
  for (long i = 0; i <= frame_count; ++i) {
    const double time = static_cast<double>(i) / fps;
    all.push_back({direction * time, static_cast<float>(time), false});
  }
  all.push_back({result.elapsed, static_cast<float>(duration), true});
  for (const double t : jumps) {
    const auto time = static_cast<float>(direction * t);
    all.push_back({t, time, true});
    if (t != result.elapsed) all.push_back({t, std::nextafter(time, std::numeric_limits<float>::infinity()), false});
  }
  ranges::stable_sort(all, {}, &Moment::time);
  std::vector<Moment> kept;
  kept.reserve(all.size());
  for (const Moment& moment : all) {
    if (!kept.empty() && kept.back().time == moment.time) kept.pop_back();
    kept.push_back(moment);
  }
  return kept;
}

/// The motion of a driven obstacle that stands so at the start.
class ObstacleMotion {
 public:
  ObstacleMotion(const World::Drive& drive, const Pose& start) : frame_(drive), start_(start) {}

  void forget_before(double) {}
  Pose before(double t) { return behind(t); }
  Pose behind(double t) {
    const FrameMotion frame = frame_.at(t);
    return {frame.from_start(start_.position), Quaternion(frame.R) * start_.q_WB};
  }
  double largest_spin(double from, double to) {
    double largest = 0.0;
    constexpr int kParts = 8;
    for (int i = 0; i <= kParts; ++i) largest = std::max(largest, frame_.at(from + (to - from) * i / kParts).w.norm());
    return largest;
  }

 private:
  DrivenFrame frame_;
  Pose start_;
};

/// `Motion`: that of a body or an obstacle.
template <class Motion>
class KeyMaker {
 public:
  /// `name`: whose keys they are, in messages.
  KeyMaker(Motion& motion, std::string name, bool turns) : motion_(motion), name_(std::move(name)), turns_(turns) {}

  AnimationKeys make(const std::vector<Moment>& moments) {
    keys_.times.reserve(moments.size());
    keys_.positions.reserve(moments.size());
    if (turns_) keys_.rotations.reserve(moments.size());
    for (const Moment& moment : moments) add(moment);
    return std::move(keys_);
  }

 private:
  /// Adds the key of a moment, and what the way from the last one to it needs.
  void add(const Moment& moment) {
    if (last_) {
      motion_.forget_before(last_->t);
      fill(*last_, moment);
    }
    add_key(moment);
    last_ = moment;
  }

  /// The keys between two moments.
  void fill(const Moment& from, const Moment& to) {
    if (motion_.largest_spin(from.t, to.t) * std::abs(to.t - from.t) <= kMostTurn) return;
    const double t = from.t + 0.5 * (to.t - from.t);
    const Moment middle{t, static_cast<float>(std::abs(t)), false};
    if (static_cast<double>(keys_.times.size()) >= kMostAnimationKeys) fail("would be more than a million");
    if (!(from.time < middle.time && middle.time < to.time)) fail("would be closer than single precision can tell");
    fill(from, middle);
    add_key(middle);
    fill(middle, to);
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw FileError(name_ + " turns too fast for an animation: its keys, a quarter of a turn apart, " + what);
  }

  void add_key(const Moment& moment) {
    const Pose pose = moment.is_before ? motion_.before(moment.t) : motion_.behind(moment.t);
    keys_.times.emplace_back(moment.time);
    keys_.positions.push_back(pose.position.cast<float>());
    if (!turns_) {
      if (keys_.rotations.empty()) keys_.rotations.push_back(pose.q_WB.coeffs().cast<float>());
      return;
    }
    Eigen::Vector4f rotation = pose.q_WB.coeffs().cast<float>();
    if (!keys_.rotations.empty() && keys_.rotations.back().dot(rotation) < 0.0f) rotation = -rotation;
    keys_.rotations.push_back(rotation);
  }

  Motion& motion_;
  std::string name_;
  bool turns_;
  std::optional<Moment> last_;
  AnimationKeys keys_;
};

}  // namespace

AnimationKeys animation_keys(const RecordedMotion& motion, const RunResult& result, const World::Body& body,
                             std::span<const double> jumps, double fps) {
  BodyMotion body_motion(motion, body, result.elapsed < 0.0 ? -1.0 : 1.0);
  if (body_motion.is_empty()) return {};
  return KeyMaker(body_motion, "body '" + body.name + "'", body.rotation.has_value()).make(moments(result, jumps, fps));
}

AnimationKeys animation_keys(const RunResult& result, const World::Obstacle& obstacle, const Pose& start, double fps) {
  ObstacleMotion motion(*obstacle.drive, start);
  return KeyMaker(motion, "obstacle '" + obstacle.name + "'", obstacle.drive->turns).make(moments(result, {}, fps));
}

}  // namespace trajet::detail
