#include "motion_scale.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "trajet/geom/closest_point.hpp"
#include "trajet/math/polynomial.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

/// So many obstacles are looked at for a length.
constexpr std::size_t kFewObstacles = 64;
/// Steps after which what rounding leaves of the law is looked at again.
constexpr long kStepsBetweenRoundings = 16;
/// Roundings of a component that a tolerance is at least.
constexpr double kRoundings = 2.0 * kUnitRoundoff;

/// The least of both that are not zero; zero if both are.
double least_known(double a, double b) { return a == 0.0 ? b : b == 0.0 ? a : std::min(a, b); }

LinearLaw linearise(double t, const Eigen::VectorXd& q, System& law) {
  LinearLaw linear{Eigen::VectorXd(q.size()), Eigen::MatrixXd(q.size(), q.size())};
  Eigen::VectorXd by_time(q.size());
  law.rate(t, q.data(), linear.rate.data());
  law.jacobian(t, q.data(), linear.by_state.data(), by_time.data());
  const auto finite = [](double x) { return std::isfinite(x) ? x : 0.0; };
  linear.rate = linear.rate.unaryExpr(finite);
  linear.by_state = linear.by_state.unaryExpr(finite);
  return linear;
}

/// The time (s) in which the law alone changes components `first` to `first + size` by themselves, or by what they do
/// to another one that acts back; infinite where nothing does.
double own_time(const Eigen::MatrixXd& by_state, int first, int size) {
  double fastest = 0.0;
  for (int i = first; i < first + size; ++i)
    for (Eigen::Index j = 0; j < by_state.cols(); ++j)
      fastest = std::max(fastest, std::abs(by_state(i, j) * by_state(j, i)));
  return 1.0 / std::sqrt(fastest);
}

}  // namespace

MotionScale::MotionScale(const World& world, int group, double factor)
    : world_(world), group_(group), tolerance_(factor * world.step_options.atol) {
  const World::Group& of = world.groups[static_cast<std::size_t>(group)];
  tolerances_ = std::make_shared<std::vector<double>>(static_cast<std::size_t>(of.start.size()), tolerance_);
  for (const int b : of.bodies) {
    const BodySlice slice = world.bodies[static_cast<std::size_t>(b)].slice();
    add(slice.position_index(), 3);
    add(slice.velocity_index(), 3);
    if (slice.layout) add(slice.angular_velocity_index(), 3);
  }
  for (const World::ExtraState& state : world.states)
    if (state.group == group) add(state.offset, 1);
}

bool MotionScale::is_small() const {
  return ranges::any_of(parts_, [](const Part& part) { return part.scale < 1.0; });
}

void MotionScale::begin(double t, const Eigen::VectorXd& q, System& law) {
  take(q);
  if (ranges::any_of(parts_, [](const Part& part) { return part.scale == 0.0; })) foresee(t, q, law);
  if (is_small()) find_rounding(linearise(t, q, law), q, 0.0);
  steps_ = 0;
  update_tolerances();
}

void MotionScale::grow(double t, const Eigen::VectorXd& q, double step, System& law) {
  take(q);
  if (is_small() && steps_++ % kStepsBetweenRoundings == 0) find_rounding(linearise(t, q, law), q, std::abs(step));
  update_tolerances();
}

void MotionScale::take(const Eigen::VectorXd& q) {
  for (Part& part : parts_)
    if (const double size = part.of(q); std::isfinite(size)) part.scale = std::max(part.scale, size);
}

void MotionScale::update_tolerances() {
  for (const Part& part : parts_) {
    const double scaled = tolerance_ * (part.scale > 0.0 ? std::min(part.scale, 1.0) : 1.0);
    const double rounding = kRoundings * part.scale + part.rounding;
    const auto first = tolerances_->begin() + part.first;
    std::fill(first, first + part.size,
              std::max(scaled, std::min(rounding, std::max(tolerance_, kRoundings * part.scale))));
  }
}

void MotionScale::foresee(double t, const Eigen::VectorXd& q, System& law) {
  const LinearLaw linear = linearise(t, q, law);
  const double duration = std::abs(world_.duration);
  const auto time_of = [&](const Part& part) {
    return std::min(duration, own_time(linear.by_state, part.first, part.size));
  };
  for (const int b : world_.groups[static_cast<std::size_t>(group_)].bodies) {
    const World::Body& body = world_.bodies[static_cast<std::size_t>(b)];
    const auto part_at = [&](int first) { return ranges::find(parts_, first, &Part::first); };
    Part& position = *part_at(body.slice().position_index());
    Part& velocity = *part_at(body.slice().velocity_index());
    if (position.scale > 0.0 && velocity.scale > 0.0) continue;
    const double length = length_near(body, body.slice().position(q));
    const double pull = velocity.of(linear.rate);
    double time = time_of(velocity);
    if (pull > 0.0 && length > 0.0) time = std::min(time, std::sqrt(length / pull));
    if (pull > 0.0 && velocity.scale > 0.0) time = std::min(time, velocity.scale / pull);
    if (velocity.scale == 0.0) velocity.scale = pull * time;
    if (position.scale == 0.0) position.scale = velocity.scale * time;
  }
  for (Part& part : parts_)
    if (part.scale == 0.0) part.scale = part.of(linear.rate) * time_of(part);
}

double MotionScale::length_near(const World::Body& body, const Vector3& position) const {
  double length = position.norm();
  if (world_.obstacles.size() > kFewObstacles) return length;
  for (const World::Obstacle& obstacle : world_.obstacles) {
    const Vector3 near = std::visit([&](const auto& s) { return closest_point(s, position); }, obstacle.shape);
    length = least_known(length, std::abs((near - position).norm() - bounding_radius(body.solid)));
  }
  return length;
}

void MotionScale::find_rounding(const LinearLaw& law, const Eigen::VectorXd& q, double step) {
  const Eigen::VectorXd terms = law.by_state.cwiseAbs() * q.cwiseAbs();
  // the next step may be so much longer
  constexpr double kLonger = 10.0;
  double longest = kLonger * step;
  if (step == 0.0) {
    longest = std::abs(world_.duration);
    for (const Part& part : parts_) {
      longest = std::min(longest, own_time(law.by_state, part.first, part.size));
      if (const double rate = part.of(law.rate); rate > 0.0) longest = std::min(longest, part.scale / rate);
    }
  }
  for (Part& part : parts_) part.rounding = kRoundings * longest * part.of(terms);
}

}  // namespace trajet
