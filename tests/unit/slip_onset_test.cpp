#include "src/collide/sustain/slip_onset.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

namespace trajet {
namespace {

/// A plane body that stands on points with constant normal forces, and what accelerates it.
struct Standing {
  double mass = 0.0, inertia = 0.0, friction = 0.0;
  Eigen::Vector3d free = Eigen::Vector3d::Zero();  // of the centre of mass, and of the angle
  std::vector<Eigen::Vector2d> places{};           // from the centre of mass
  std::vector<double> normals{};

  static Eigen::Vector2d at(const Eigen::Vector3d& rate, const Eigen::Vector2d& place) {
    return {rate.x() - rate.z() * place.y(), rate.y() + rate.z() * place.x()};
  }
  /// What the acceleration makes least: Gauss's constraint and the power of friction.
  double cost(const Eigen::Vector3d& rate) const {
    const Eigen::Vector3d d = rate - free;
    double sum = 0.5 * mass * d.head<2>().squaredNorm() + 0.5 * inertia * d.z() * d.z();
    for (std::size_t i = 0; i < places.size(); ++i) sum += friction * normals[i] * at(rate, places[i]).norm();
    return sum;
  }
  std::vector<OnsetPoint> points() const {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& place : places) middle += place / static_cast<double>(places.size());
    std::vector<OnsetPoint> points;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Eigen::Vector2d arm = places[i] - middle;
      OnsetPoint point;
      point.free = at(free, places[i]);
      point.normal = normals[i];
      point.share.leftCols(2).setIdentity();
      point.share.col(2) << -arm.y(), arm.x();
      for (int j = 0; j < 3; ++j) {
        const Eigen::Vector2d force = j < 2 ? Eigen::Vector2d(Eigen::Vector2d::Unit(j)) : Eigen::Vector2d(0.0, 0.0);
        const double moment = j < 2 ? middle.x() * force.y() - middle.y() * force.x() : 1.0;
        const Eigen::Vector3d rate(force.x() / mass, force.y() / mass, moment / inertia);
        point.by_wrench.col(j) = at(rate, places[i]);
      }
      points.push_back(point);
    }
    return points;
  }
};

/// The acceleration of the whole by those of two of its points.
Eigen::Vector3d whole(const Standing& body, const SlipOnset& onset) {
  const Eigen::Vector2d apart = body.places[1] - body.places[0], faster = onset.rates[1] - onset.rates[0];
  const double turning = (apart.x() * faster.y() - apart.y() * faster.x()) / apart.squaredNorm();
  const Eigen::Vector2d& place = body.places[0];
  return {onset.rates[0].x() + turning * place.y(), onset.rates[0].y() - turning * place.x(), turning};
}

// The oracle is the convex function itself: no acceleration nearby, and so none at all, makes it less. Where all points
// hold it is least at rest; where one does, the others turn about it.
TEST(SlipOnset, FrictionLeavesTheAccelerationThatIsLeast) {
  std::mt19937_64 random(20261128);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  int holding = 0, turning = 0, sliding = 0;
  for (int k = 0; k < 2000; ++k) {
    SCOPED_TRACE(k);
    Standing body;
    body.mass = between(0.1, 3.0);
    body.inertia = body.mass * between(0.05, 1.0);
    body.friction = between(0.05, 1.0);
    const double most = std::exp(between(std::log(0.1), std::log(10.0)));
    body.free = {between(-most, most), between(-most, most), between(-most, most)};
    const int count = 2 + static_cast<int>(random() % 4);
    for (int i = 0; i < count; ++i) {
      body.places.push_back({between(-1.0, 1.0), between(-1.0, 1.0)});
      body.normals.push_back(between(0.1, 10.0));
    }
    const SlipOnset onset = find_onset(body.points(), body.friction);
    ASSERT_TRUE(onset.is_found);
    const auto held = std::count(onset.holds.begin(), onset.holds.end(), true);
    const Eigen::Vector3d rate = onset.hold_all() ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : whole(body, onset);
    (onset.hold_all() ? holding : held == 1 ? turning : sliding) += 1;
    const double least = body.cost(rate), size = 1.0 + rate.norm() + body.free.norm();
    for (int i = 0; i < 200; ++i) {
      Eigen::Vector3d aside(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0));
      aside *= size * std::pow(10.0, between(-6.0, 0.0)) / aside.norm();
      // rounding of the sum, and the bend of the cost over the error of the rate, 1e-9 measured
      EXPECT_GE(body.cost(rate + aside) - least, -1e-11 * (1.0 + least));
    }
    if (held != 1 || onset.hold_all()) continue;
    const auto center =
        static_cast<std::size_t>(std::find(onset.holds.begin(), onset.holds.end(), true) - onset.holds.begin());
    EXPECT_LE(onset.rates[center].norm(), 1e-6 * size);
  }
  // each of the three comes often enough to be tested
  EXPECT_GT(holding, 200);
  EXPECT_GT(turning, 100);
  EXPECT_GT(sliding, 200);
}

}  // namespace
}  // namespace trajet
