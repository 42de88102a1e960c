// Wherever a ball goes, it is never inside anything: the distances at many times are the oracle, which knows nothing of
// searches, trees of boxes or events.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "scene_run.hpp"

namespace trajet::test {
namespace {

constexpr double kBallRadius = 0.1;

std::string vector_text(const Vector3& v) {
  return "[" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + "]";
}

/// A sphere, or a cuboid along the axes.
struct Peg {
  bool is_sphere;
  Vector3 center;
  Vector3 half_size;  ///< m; of a sphere three times its radius

  std::string text(int index) const {
    const std::string begin = "[[obstacle]]\nname = \"peg" + std::to_string(index) +
                              "\"\non_hit = \"bounce\"\ncenter = " + vector_text(center);
    return is_sphere ? begin + "\nshape = \"sphere\"\nradius = " + number(half_size.x()) + "\n"
                     : begin + "\nshape = \"box\"\nsize = " + vector_text(2.0 * half_size) + "\n";
  }
  double distance(const Vector3& p) const {
    if (is_sphere) return (p - center).norm() - half_size.x();
    return ((p - center).cwiseAbs() - half_size).cwiseMax(0.0).norm();
  }
};

/// Walls without bounds around bounded pegs, so many that they are found by their boxes.
class Hall {
 public:
  Hall(unsigned seed, bool has_walls) : has_walls_(has_walls), random_(seed) {
    while (pegs_.size() < 12) {
      const double size = uniform(0.05, 0.25);
      const bool is_sphere = pegs_.size() % 2 == 0;
      const Peg peg{is_sphere, Vector3(uniform(-0.9, 0.9), uniform(-0.9, 0.9), uniform(-0.9, 0.9)),
                    is_sphere ? Vector3::Constant(size) : Vector3(size, uniform(0.05, 0.25), uniform(0.05, 0.25))};
      if (peg.distance(Vector3::Zero()) > 2.0 * kBallRadius) pegs_.push_back(peg);
    }
  }

  std::string text() {
    std::string scene = "[time]\nend = 3\nsample = 0.002\n[[body]]\nname = \"ball\"\nshape = \"sphere\"\nradius = " +
                        number(kBallRadius) +
                        "\nvelocity = " + vector_text({uniform(-6.0, 6.0), uniform(-6.0, 6.0), uniform(-6.0, 6.0)}) +
                        "\nacceleration = [0, 0, -9.81]\n";
    for (std::size_t i = 0; i < pegs_.size(); ++i) scene += pegs_[i].text(static_cast<int>(i));
    for (int side = 0; has_walls_ && side < 6; ++side) {
      const Vector3 normal = (side % 2 == 0 ? 1.0 : -1.0) * Vector3::Unit(side / 2);
      scene += "[[obstacle]]\nname = \"wall" + std::to_string(side) +
               "\"\nshape = \"plane\"\non_hit = \"bounce\"\npoint = " + vector_text(-normal) +
               "\nnormal = " + vector_text(normal) + "\n";
    }
    return scene;
  }

  /// How far the ball's surface is from everything, negative inside.
  double clearance(const Vector3& p) const {
    double least = has_walls_ ? 1.0 - p.lpNorm<Eigen::Infinity>() : 1e9;
    for (const Peg& peg : pegs_) least = std::min(least, peg.distance(p));
    return least - kBallRadius;
  }

 private:
  double uniform(double a, double b) { return a + (b - a) * (static_cast<double>(random_()) / 4294967296.0); }

  bool has_walls_;
  std::mt19937 random_;
  std::vector<Peg> pegs_;
};

class Watcher : public RunObserver {
 public:
  explicit Watcher(const Hall& hall) : hall_(hall) {}
  RunWishes wishes() const override { return {.samples = true}; }
  void sample(const Sample& sample) override {
    least = std::min(least, hall_.clearance(sample.bodies.front().position));
  }

  double least = 1e9;

 private:
  const Hall& hall_;
};

TEST(NobodyInside, ABallAmongManyPegsWithAndWithoutWalls) {
  long with_pegs = 0;
  for (const bool has_walls : {true, false})
    for (unsigned seed = 1; seed <= 150; ++seed) {
      Hall hall(seed, has_walls);
      Watcher watcher(hall);
      const RunResult result = run_text(hall.text(), &watcher);
      ASSERT_NE(result.status, RunStatus::failed) << seed << ": " << result.failure;
      // bounces multiply the errors of the state; none of these comes near a micrometre
      EXPECT_GE(watcher.least, -1e-6) << "seed " << seed << (has_walls ? " with walls" : "");
      with_pegs += std::ranges::count_if(result.impacts, [](const Impact& i) { return i.with.starts_with("peg"); });
    }
  EXPECT_GT(with_pegs, 1000);
}

}  // namespace
}  // namespace trajet::test
