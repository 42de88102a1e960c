#include "passages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "trajet/event/composed_function.hpp"
#include "trajet/event/path.hpp"
#include "trajet/math/number.hpp"
#include "trajet/portable.hpp"
#include "trajet/sim/names.hpp"

namespace trajet {
namespace {

constexpr std::size_t kMostLegs = 101;

/// Half the rate of the squared distance to the origin: d . dd/dt, of the components d, dd/dt.
struct Approach {
  template <class Components>
  IntervalJet operator()(const IntervalJet&, const Components& x) const {
    return x[0] * x[3] + x[1] * x[4] + x[2] * x[5];
  }
};

/// A way together with its rate.
Segment<6> with_rate(const Segment<3>& way) {
  Segment<6> result;
  const int degree = way.degree();
  result.resize(6, degree);
  result.set_interval(way.t0(), way.t1());
  result.coefficients().topRows<3>() = way.coefficients();
  for (int k = 0; k <= degree; ++k) {
    if (k < degree)
      result.coefficients().block<3, 1>(3, k) = (k + 1.0) * way.coefficients().col(k + 1);
    else
      result.coefficients().block<3, 1>(3, k).setZero();
  }
  result.error_bound().setZero();
  return result;
}

/// Something that changed the motion of the body all at once.
struct Turn {
  double time = 0.0;
  std::string label{};  ///< all that has led to it
  bool is_bounce = false;
};

bool changes_motion(const Impact& impact) {
  if (impact.kind == ImpactKind::graze) return false;
  return impact.kind != ImpactKind::hit || impact.velocity_before != impact.velocity_after ||
         impact.angular_velocity_before != impact.angular_velocity_after;
}

bool involves(const Impact& impact, const std::string& body) {
  return impact.body == body || (impact.partner && impact.with == body);
}

/// The impacts up to number `last` that the motion of the body depends on behind it, in words.
std::string label_of(const std::vector<Impact>& impacts, std::size_t last, const std::string& body) {
  std::set<std::string> involved{body};
  std::vector<std::string> words;
  for (std::size_t i = last + 1; i-- > 0;) {
    const Impact& impact = impacts[i];
    if (!changes_motion(impact)) continue;
    if (involved.count(impact.body) == 0 && !(impact.partner && involved.count(impact.with) > 0)) continue;
    involved.insert(impact.body);
    if (impact.partner) involved.insert(impact.with);
    words.push_back(impact.body + ">" + impact.with);
    // off a face and off an edge are two ways
    if (impact.touched)
      words.back() += std::to_string(static_cast<int>(impact.touched->of_body)) +
                      std::to_string(static_cast<int>(impact.touched->of_obstacle));
    if (impact.kind != ImpactKind::hit) words.back() += std::string("~") + std::string(name(impact.kind));
  }
  std::string label;
  for (std::size_t i = words.size(); i-- > 0;) label += words[i] + ";";
  return label;
}

std::vector<Turn> turns_of(const World& world, const RunResult& result, int body) {
  const World::Body& own = world.bodies[static_cast<std::size_t>(body)];
  std::vector<Turn> turns;
  std::size_t impacts = 0;
  for (std::size_t i = 0; i < result.impacts.size() && impacts + 1 < kMostLegs; ++i) {
    const Impact& impact = result.impacts[i];
    if (!involves(impact, own.name) || !changes_motion(impact)) continue;
    ++impacts;
    turns.push_back({impact.elapsed, label_of(result.impacts, i, own.name), impact.kind == ImpactKind::hit});
  }
  for (const EventRecord& event : result.events) {
    const auto definition = ranges::find(world.events, event.event, &World::Event::name);
    const bool sets = definition != world.events.end() && definition->action == EventAction::set;
    if (sets && definition->group == own.group) turns.push_back({event.elapsed, "event " + event.event + ";", false});
  }
  std::stable_sort(turns.begin(), turns.end(), [](const Turn& a, const Turn& b) { return a.time < b.time; });
  // an event's label is its own, an impact's holds those before
  std::string events;
  for (Turn& turn : turns) {
    if (turn.label.starts_with("event ")) events += turn.label;
    turn.label = turn.label.starts_with("event ") ? events : events + turn.label;
  }
  return turns;
}

/// Follows the motion piece by piece, leg by leg.
class PassageSearch {
 public:
  PassageSearch(int offset, AimPoint& target) : offset_(offset), target_(target) {}

  void begin_leg(std::string label, int bounces) {
    end_leg();
    label_ = std::move(label);
    bounces_ = bounces;
    number_ = 0;
    sign_ = 0;
    is_new_ = true;
    last_time_ = -INFINITY;
  }

  void follow(const RecordedPiece& piece) {
    for (double from = piece.from; from < piece.to;) {
      const Segment<3> way = target_.relative(piece.segment, offset_, from, piece.to);
      const double until = std::min(piece.to, way.t1());
      if (!(until > from) || !way.coefficients().allFinite()) return;
      search(with_rate(way), piece.segment, from, until);
      from = until;
    }
  }

  /// The last leg has been followed.
  void end_leg() {
    if (sign_ < 0) add_end();
    sign_ = 0;
  }

  std::vector<Passage> found() && { return std::move(found_); }

 private:
  void search(const Segment<6>& relative, const Segment<>& motion, double from, double until) {
    constexpr std::array<int, 6> kAll{0, 1, 2, 3, 4, 5};
    const Path<6> path(relative, std::span<const int>(kAll));
    const double begin = from - relative.t0(), end = until - relative.t0();
    const ComposedFunction<6, Approach> approach(path, Approach{}, begin, end);
    const auto add = [&](double tau) { add_passage(path.value(tau), motion, relative.t0() + tau); };

    const FunctionSample first = approach.at(begin);
    if (sign_ < 0 && first.jet.value > first.tolerance) add(begin);  // between this piece and the one before
    visit_roots(approach, [&](const Root& root) {
      if (root.kind != RootKind::crossing && !root.at_begin) return true;
      const bool is_start = is_new_ && root.at_begin;
      const int before = root.at_begin && sign_ != 0 ? sign_ : root.sign_before;
      if (before < 0 && root.sign_after > 0 && !is_start) add(root.time);
      if (root.at_end) sign_ = root.sign_after;
      return true;
    });
    const FunctionSample last = approach.at(end);
    if (std::abs(last.jet.value) > last.tolerance) sign_ = last.jet.value > 0.0 ? 1 : -1;
    end_relative_ = path.value(end);
    end_time_ = until;
    for (int i = 0; i < 3; ++i) end_position_[i] = motion.value(offset_ + i, until);
    is_new_ = false;
  }

  /// x: relative position and velocity.
  void add_passage(const Eigen::Matrix<double, 6, 1>& x, const Segment<>& motion, double time) {
    constexpr double kJoint = 1e-13;  // a root at the joint of two pieces is found on both
    if (time - last_time_ <= kJoint * (1.0 + std::abs(time))) return;
    last_time_ = time;
    Passage passage = labelled();
    const Vector3 d = x.head<3>(), w = x.tail<3>();
    passage.direction = w.stableNormalized();
    passage.residual = d - passage.direction * passage.direction.dot(d);
    passage.miss = d.norm();
    passage.time = time;
    for (int i = 0; i < 3; ++i) passage.position[i] = motion.value(offset_ + i, time);
    found_.push_back(std::move(passage));
  }

  void add_end() {
    Passage passage = labelled();
    const Vector3 d = end_relative_.head<3>(), w = end_relative_.tail<3>();
    passage.direction = w.stableNormalized();
    passage.residual = d - passage.direction * passage.direction.dot(d);
    passage.miss = d.norm();
    passage.time = end_time_;
    passage.position = end_position_;
    passage.is_end = true;
    found_.push_back(std::move(passage));
  }

  Passage labelled() {
    Passage passage;
    passage.label = label_ + std::to_string(++number_);
    passage.bounces = bounces_;
    return passage;
  }

  int offset_;
  AimPoint& target_;
  std::vector<Passage> found_;
  std::string label_;
  int bounces_ = 0;
  int number_ = 0;                // of passages in this leg
  int sign_ = 0;                  // of the rate of the distance where the last piece ended, 0 unknown
  bool is_new_ = true;            // nothing of this leg was searched yet
  double last_time_ = -INFINITY;  // of the last passage of this leg
  Eigen::Matrix<double, 6, 1> end_relative_ = Eigen::Matrix<double, 6, 1>::Zero();
  double end_time_ = 0.0;
  Vector3 end_position_{0, 0, 0};
};

}  // namespace

std::vector<Passage> find_passages(const World& world, const RunResult& result,
                                   const std::vector<RecordedPiece>& pieces, int body, AimPoint& target) {
  const std::vector<Turn> turns = turns_of(world, result, body);
  PassageSearch search(world.bodies[static_cast<std::size_t>(body)].offset, target);
  std::size_t next = 0;
  int bounces = 0;
  constexpr double kSameTime = 8.0 * kUnitRoundoff;
  search.begin_leg("", 0);
  for (const RecordedPiece& piece : pieces) {
    const std::size_t before = next;
    for (; next < turns.size() && turns[next].time <= piece.from + kSameTime * std::abs(piece.from); ++next)
      if (turns[next].is_bounce) ++bounces;
    if (next != before) {
      if (next + 1 >= kMostLegs) break;
      search.begin_leg(turns[next - 1].label, bounces);
    }
    search.follow(piece);
  }
  search.end_leg();
  return std::move(search).found();
}

}  // namespace trajet
