#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "trajet/io/scene_file.hpp"
#include "trajet/sim/motion.hpp"
#include "work_precision.hpp"

/// Questions to a motion: 1000 positions at a time, of 10^6 times within a circular orbit of 10^3 Segments, so that a
/// microsecond here is a nanosecond a position. The error is that of the radius.
namespace trajet::bench {
namespace {

constexpr std::size_t kTimes = 1'000'000, kAtOnce = 1000;

void add(const char* name, const Motion& motion, const std::vector<double>& times) {
  const auto at = std::make_shared<const std::vector<double>>(times);
  const auto next = std::make_shared<std::size_t>(0);
  const auto positions = std::make_shared<Eigen::Matrix3Xd>(3, kAtOnce);
  add_case({name, Contender::scene, "position"}, [body = motion.body("moon"), at, next, positions] {
    body.position(std::span(*at).subspan(*next, kAtOnce), *positions);
    *next = (*next + kAtOnce) % kTimes;
    return std::abs(positions->col(0).norm() - 1.0);
  });
}

}  // namespace

void add_motions() {
  const Motion motion = compute_motion(
      parse_scene("[time]\nend = 1000\n[method]\nmax_step = 1\n[[body]]\nname = \"moon\"\nposition = [1, 0, 0]\n"
                  "velocity = [0, 1, 0]\nacceleration = \"-r/norm(r)^3\"\n",
                  "orbit"));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> between(motion.start_time(), motion.end_time());
  std::vector<double> times(kTimes);
  std::generate(times.begin(), times.end(), [&] { return between(random); });
  add("Q1 1000 positions, any order", motion, times);
  std::sort(times.begin(), times.end());
  add("Q2 1000 positions, sorted", motion, times);
}

}  // namespace trajet::bench
