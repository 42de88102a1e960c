#include "trajet/sim/motion.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <unordered_map>

#include "body_state.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/sim/names.hpp"
#include "trajet/sim/observer_list.hpp"
#include "trajet/sim/piece_index.hpp"
#include "trajet/sim/run.hpp"
#include "trajet/sim/state_at.hpp"
#include "trajet/text/did_you_mean.hpp"
#include "trajet/text/shortest_text.hpp"

namespace trajet {
namespace {

/// `Count` components of a Segment from `first` on. The sums of even and odd powers do not wait for each other.
template <int Count>
Eigen::Matrix<double, Count, 1> components(const Segment<>& segment, int first, double t) {
  using Components = Eigen::Matrix<double, Count, 1>;
  const double tau = t - segment.t0();
  const auto rows = segment.coefficients().middleRows<Count>(first);
  const int degree = segment.degree();
  if (degree == 0) return rows.col(0);
  const double square = tau * tau;
  Components upper = rows.col(degree), lower = rows.col(degree - 1);
  for (int k = degree - 2; k >= 1; k -= 2) {
    upper = upper * square + rows.col(k);
    lower = lower * square + rows.col(k - 1);
  }
  // of an even degree the upper sum has the even powers, and the last of them is still to come
  if (degree % 2 == 0) return lower * tau + Components(upper * square + rows.col(0));
  return upper * tau + lower;
}

/// The index of a name; throws std::invalid_argument.
using Places = std::unordered_map<std::string_view, int>;
int place(const Places& places, std::string_view name, const char* what) {
  const auto found = places.find(name);
  if (found != places.end()) return found->second;
  std::vector<std::string_view> known;
  for (const auto& [each, index] : places) known.push_back(each);
  throw std::invalid_argument("the motion has no " + std::string(what) + " '" + std::string(name) + "'" +
                              did_you_mean(name, known));
}

template <class Things>
Places places_of(const Things& things) {
  Places places;
  for (std::size_t i = 0; i < things.size(); ++i) places.emplace(things[i].name, static_cast<int>(i));
  return places;
}

std::string counted(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

/// What the copies of a motion share.
struct Motion::Data {
  Data(MotionRecord given_record, RunResult given_result)
      : record(std::move(given_record)),
        result(std::move(given_result)),
        direction(record.world().direction()),
        known_until(result.elapsed),
        bodies(places_of(record.world().bodies)),
        states(places_of(record.world().states)) {
    for (std::size_t group = 0; group < record.world().groups.size(); ++group) {
      const auto& pieces = record.pieces(static_cast<int>(group));
      indices.emplace_back(pieces, direction);
      // where memory has run out, pieces are missing at the end
      if (!pieces.empty() && direction * (pieces.back().to - known_until) < 0.0) known_until = pieces.back().to;
    }
    for (const World::Body& each : record.world().bodies)
      tracks.push_back(
          {&record.pieces(each.group), &indices[static_cast<std::size_t>(each.group)], each.slice().position_index()});
  }

  /// The way of one body, where questions find it fast.
  struct Track {
    const std::vector<RecordedPiece>* pieces;
    const PieceIndex* index;
    int first;  // of the body's components

    const Segment<>& segment(double since) const { return (*pieces)[index->find(since)].segment; }
  };

  const Track& track(int i) const { return tracks[static_cast<std::size_t>(i)]; }
  const World::Body& body(int i) const { return record.world().bodies[static_cast<std::size_t>(i)]; }

  /// The time elapsed since the start at a time of the clock. Throws std::out_of_range.
  double elapsed(double t) const {
    if (t == result.end_time) return result.elapsed;
    const double since = t - result.start_time;
    if (direction * since >= 0.0 && direction * (known_until - since) >= 0.0) return since;
    // what the clock has no digits for
    const double rounding = 2.0 * std::numeric_limits<double>::epsilon() * std::abs(t);
    if (result.start_time != 0.0 && direction * since >= -rounding && direction * (known_until - since) >= -rounding)
      return direction * since < 0.0 ? 0.0 : known_until;
    throw std::out_of_range("t = " + shortest_text(t) + " s lies outside the motion, which is known from " +
                            shortest_text(result.start_time) + " s to " +
                            shortest_text(result.start_time + known_until) + " s");
  }

  /// Whether the answer at that time is the final state's.
  bool is_final(double since) const { return since == result.elapsed; }
  const BodyState& final_of(int i) const { return result.final.bodies[static_cast<std::size_t>(i)]; }

  /// The Segment of a group on which a time lies.
  const Segment<>& segment(int group, double since) const {
    return record.pieces(group)[indices[static_cast<std::size_t>(group)].find(since)].segment;
  }

  Vector3 position(int i, double t) const {
    const double since = elapsed(t);
    if (is_final(since)) return final_of(i).position;
    // four lie in one register of a processor
    return components<4>(track(i).segment(since), track(i).first, since).head<3>();
  }

  Vector3 velocity(int i, double t) const {
    const double since = elapsed(t);
    if (is_final(since)) return final_of(i).velocity;
    return components<4>(track(i).segment(since), track(i).first + 2, since).tail<3>();
  }

  /// The numbers of the orientation of a body that turns, as reports read them.
  std::array<double, 9> orientation_numbers(const World::Body& turning, const Segment<>& on, double since) const {
    std::array<double, 9> part{};
    const OrientationLayout& layout = turning.rotation->layout;
    for (int k = 0; k < layout.size(); ++k)
      part[static_cast<std::size_t>(k)] = on.value(turning.rotation->offset + k, since);
    layout.settle(part.data());
    return part;
  }

  Quaternion orientation(int i, double t) const {
    const double since = elapsed(t);
    if (is_final(since)) return final_of(i).orientation;
    const World::Body& turning = body(i);
    if (!turning.rotation) return turning.q_WB;
    const std::array<double, 9> part = orientation_numbers(turning, segment(turning.group, since), since);
    return reported_orientation(turning.rotation->layout, part.data());
  }

  Vector3 angular_velocity(int i, double t) const {
    const double since = elapsed(t);
    if (is_final(since)) return final_of(i).angular_velocity;
    const World::Body& turning = body(i);
    if (!turning.rotation) return Vector3(0, 0, 0);
    const Segment<>& on = segment(turning.group, since);
    const std::array<double, 9> part = orientation_numbers(turning, on, since);
    return in_world(turning.rotation->layout, part.data(),
                    components<3>(on, turning.slice().angular_velocity_index(), since));
  }

  BodyState state(int i, double t) const {
    const double since = elapsed(t);
    if (is_final(since)) return final_of(i);
    const Segment<>& on = segment(body(i).group, since);
    Eigen::VectorXd rate(on.dimension());
    for (int k = 0; k < on.dimension(); ++k) rate[k] = on.derivative(k, since);
    return body_state(body(i), state_at(record.world(), body(i).group, on, since), rate);
  }

  double value(int i, double t) const {
    const double since = elapsed(t);
    if (is_final(since)) return result.final.states[static_cast<std::size_t>(i)].value;
    const World::ExtraState& state = record.world().states[static_cast<std::size_t>(i)];
    return segment(state.group, since).value(state.offset, since);
  }

  MotionRecord record;
  RunResult result;
  double direction;
  double known_until;  // s since the start
  Places bodies, states;
  std::vector<PieceIndex> indices{};  // of each group
  std::vector<Track> tracks{};        // of each body
};

Motion::Motion(MotionRecord record, RunResult result)
    : data_(std::make_shared<const Data>(std::move(record), std::move(result))) {}

const RunResult& Motion::result() const { return data_->result; }
const MotionRecord& Motion::record() const { return data_->record; }

BodyMotion Motion::body(std::string_view name) const { return {data_, place(data_->bodies, name, "body")}; }
StateMotion Motion::extra_state(std::string_view name) const {
  return {data_, place(data_->states, name, "extra state")};
}

Vector3 Motion::position(std::string_view name, double t) const { return body(name).position(t); }
Vector3 Motion::velocity(std::string_view name, double t) const { return body(name).velocity(t); }
Quaternion Motion::orientation(std::string_view name, double t) const { return body(name).orientation(t); }
Vector3 Motion::angular_velocity(std::string_view name, double t) const { return body(name).angular_velocity(t); }
BodyState Motion::state(std::string_view name, double t) const { return body(name).state(t); }
double Motion::value(std::string_view name, double t) const { return extra_state(name).value(t); }

Sample Motion::state(double t) const {
  Sample sample;
  sample.time = t;
  sample.elapsed = data_->elapsed(t);
  for (std::size_t i = 0; i < world().bodies.size(); ++i) sample.bodies.push_back(data_->state(static_cast<int>(i), t));
  for (std::size_t i = 0; i < world().states.size(); ++i)
    sample.states.push_back({world().states[i].name, data_->value(static_cast<int>(i), t)});
  return sample;
}

Eigen::Matrix3Xd Motion::position(std::string_view name, std::span<const double> times) const {
  Eigen::Matrix3Xd p_WB(3, times.size());
  body(name).position(times, p_WB);
  return p_WB;
}

Eigen::Matrix3Xd Motion::velocity(std::string_view name, std::span<const double> times) const {
  Eigen::Matrix3Xd v_WB(3, times.size());
  body(name).velocity(times, v_WB);
  return v_WB;
}

Eigen::Matrix4Xd Motion::orientation(std::string_view name, std::span<const double> times) const {
  Eigen::Matrix4Xd q_WB(4, times.size());
  body(name).orientation(times, q_WB);
  return q_WB;
}

Eigen::Matrix3Xd Motion::angular_velocity(std::string_view name, std::span<const double> times) const {
  Eigen::Matrix3Xd w_WB(3, times.size());
  body(name).angular_velocity(times, w_WB);
  return w_WB;
}

Eigen::VectorXd Motion::value(std::string_view name, std::span<const double> times) const {
  Eigen::VectorXd values(times.size());
  extra_state(name).value(times, values);
  return values;
}

const std::string& BodyMotion::name() const { return data_->body(body_).name; }
Vector3 BodyMotion::position(double t) const { return data_->position(body_, t); }
Vector3 BodyMotion::velocity(double t) const { return data_->velocity(body_, t); }
Quaternion BodyMotion::orientation(double t) const { return data_->orientation(body_, t); }
Vector3 BodyMotion::angular_velocity(double t) const { return data_->angular_velocity(body_, t); }
BodyState BodyMotion::state(double t) const { return data_->state(body_, t); }

void BodyMotion::position(std::span<const double> times, Eigen::Ref<Eigen::Matrix3Xd> p_WB) const {
  for (std::size_t i = 0; i < times.size(); ++i)
    p_WB.col(static_cast<Eigen::Index>(i)) = data_->position(body_, times[i]);
}

void BodyMotion::velocity(std::span<const double> times, Eigen::Ref<Eigen::Matrix3Xd> v_WB) const {
  for (std::size_t i = 0; i < times.size(); ++i)
    v_WB.col(static_cast<Eigen::Index>(i)) = data_->velocity(body_, times[i]);
}

void BodyMotion::orientation(std::span<const double> times, Eigen::Ref<Eigen::Matrix4Xd> q_WB) const {
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Quaternion q = data_->orientation(body_, times[i]);
    q_WB.col(static_cast<Eigen::Index>(i)) << q.w(), q.vec();
  }
}

void BodyMotion::angular_velocity(std::span<const double> times, Eigen::Ref<Eigen::Matrix3Xd> w_WB) const {
  for (std::size_t i = 0; i < times.size(); ++i)
    w_WB.col(static_cast<Eigen::Index>(i)) = data_->angular_velocity(body_, times[i]);
}

const std::string& StateMotion::name() const {
  return data_->record.world().states[static_cast<std::size_t>(state_)].name;
}
double StateMotion::value(double t) const { return data_->value(state_, t); }

void StateMotion::value(std::span<const double> times, Eigen::Ref<Eigen::VectorXd> values) const {
  for (std::size_t i = 0; i < times.size(); ++i) values[static_cast<Eigen::Index>(i)] = data_->value(state_, times[i]);
}

Motion compute_motion(const Scene& scene, RunObserver* observer) { return compute_motion(make_world(scene), observer); }

Motion compute_motion(const World& world, RunObserver* observer) {
  MotionRecord record;
  ObserverList observers({&record, observer});
  RunResult result = run(world, &observers);
  return {std::move(record), std::move(result)};
}

std::string to_string(const Motion& motion) {
  const RunResult& result = motion.result();
  std::string text = result.title.empty() ? "" : result.title + "\n";
  text += std::string(name(result.status)) + " at t = " + shortest_text(result.end_time) + " s by " + result.method;
  if (!result.failure.empty()) text += ": " + result.failure;
  text += "\n" + counted(result.impacts.size(), "impact") + ", " + counted(result.events.size(), "event") + ", " +
          counted(result.contacts.size(), "lasting contact") + "\n";
  for (const std::string& warning : result.warnings) text += "warning: " + warning + "\n";
  return text;
}

}  // namespace trajet
