// Solids go through obstacles that let them pass: they are told in and out exactly where their surfaces touch, whatever
// their shapes, however deep; also those that start inside.

#include <gtest/gtest.h>

#include <algorithm>

#include "solid_kinds.hpp"
#include "trajet/sim/run_observer.hpp"

namespace trajet::test {
namespace {

/// Whether the body overlaps the obstacle, at each sample.
class Watch : public RunObserver {
 public:
  struct Look {
    double time;
    bool is_inside;
  };

  explicit Watch(const Drive& drive) : oracle_(drive) {}
  RunWishes wishes() const override { return {.motion = false, .samples = true}; }
  void begin(const World& world) override { oracle_.begin(world); }
  void sample(const Sample& sample) override {
    if (sample.phase != SamplePhase::none) return;
    looks.push_back({sample.time, oracle_.overlaps(sample.bodies.front(), sample.time)});
  }

  std::vector<Look> looks;

 private:
  OverlapOracle oracle_;
};

class SolidCrossings : public testing::TestWithParam<std::size_t> {};

TEST_P(SolidCrossings, InAndOutAreWhereSurfacesTouch) {
  const Kind& other = obstacles()[GetParam()];
  int crossings = 0, starts_inside = 0;
  for (std::size_t b = 0; b < bodies().size(); ++b)
    for (int k = 0; k < 4; ++k) {
      const Kind& body = bodies()[b];
      SCOPED_TRACE(body.name + " through " + other.name + " " + std::to_string(k));
      Throw thrown =
          random_throw(body, other, k % 2 == 1, "on_hit = \"pass\"\n", 2.5,
                       static_cast<unsigned>(7919 * GetParam() + 104729 * b + 1009 * static_cast<std::size_t>(k) + 5));
      if (k >= 2) {
        thrown.position.z() = -0.2;
        thrown.scene.bodies.front().position = thrown.position;
        thrown.scene.bodies.front().velocity = Vector3(thrown.velocity + Vector3(0.0, 0.0, 4.0));
      }
      thrown.scene.time.sample = 2e-3;
      Watch watch(thrown.drive);
      const RunResult result = run(thrown.scene, &watch);
      ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
      std::vector<double> times;
      for (const Impact& impact : result.impacts)
        if (impact.kind == ImpactKind::hit) times.push_back(impact.time);
      crossings += static_cast<int>(times.size());
      starts_inside += watch.looks.front().is_inside;
      // the oracle takes what overlaps by less than 1e-10 of the size for touching
      constexpr double kClose = 1e-6;
      std::size_t passed = 0;
      bool is_inside = watch.looks.front().is_inside;
      int wrong = 0;
      for (const Watch::Look& look : watch.looks) {
        while (passed < times.size() && times[passed] <= look.time) {
          ++passed;
          is_inside = !is_inside;
        }
        const bool is_close =
            std::any_of(times.begin(), times.end(), [&](double t) { return std::abs(t - look.time) < kClose; });
        if (!is_close) wrong += look.is_inside != is_inside;
      }
      EXPECT_EQ(wrong, 0) << "of " << watch.looks.size() << " samples, crossings " << times.size();
    }
  EXPECT_GT(crossings, 20);
  EXPECT_GT(starts_inside, 3);
}

// a room is left and entered by points and balls only; of a compound each part is met on its own
constexpr std::size_t kSingle = 13;
INSTANTIATE_TEST_SUITE_P(Solids, SolidCrossings, testing::Range<std::size_t>(0, kSingle),
                         [](const testing::TestParamInfo<std::size_t>& kind) { return obstacles()[kind.param].name; });

/// How far the middle of a ball is from a box of 0.5 x 0.3 x 0.2 m, m.
double distance_from_box(const BodyState& state, const Vector3& center) {
  const Vector3 p = state.rotation_matrix.transpose() * (center - state.position);
  return (p.cwiseAbs() - Vector3(0.25, 0.15, 0.1)).cwiseMax(0.0).norm();
}

TEST(SolidPasses, ABoxGoesThroughABallAtExactTimes) {
  Random random(3);
  int crossings = 0;
  for (int k = 0; k < 20; ++k) {
    // every second one starts inside; without acceleration, turning about an axis of its own
    const Vector3 start =
        k % 2 == 0 ? Vector3(-2.0, random.between(-0.6, 0.6), random.between(-0.6, 0.6)) : Vector3(random.vector(0.3));
    const std::string text =
        "sample = 10\n[[body]]\nname = \"b\"\nshape = \"box\"\nsize = [0.5, 0.3, 0.2]\nmass = "
        "1\nposition = " +
        array(start) + "\nvelocity = [" + number(random.between(1.0, 3.0)) +
        ", 0.1, 0.2]\nangular_velocity = " + array(random.vector(6.0)) +
        "\n[[obstacle]]\nname = \"o\"\nshape = \"sphere\"\ncenter = [0, 0, 0]\nradius = "
        "0.8\non_hit = \"pass\"\n";
    const RunResult result = run_text("[time]\nend = 4\n" + text);
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    ASSERT_EQ(result.impacts.size() % 2, static_cast<std::size_t>(k % 2)) << k;
    for (std::size_t i = 0; i < result.impacts.size(); ++i) {
      ++crossings;
      const double t = result.impacts[i].time;
      // far above what the time rounds to, far below what is between crossings
      constexpr double kBefore = 1e-10;
      const auto gap = [&](double time) {
        return distance_from_box(final_of(run_text("[time]\nend = " + number(time) + "\n" + text), "b"),
                                 Vector3::Zero()) -
               0.8;
      };
      const double leaves = (i + static_cast<std::size_t>(k)) % 2 == 0 ? -1.0 : 1.0;
      EXPECT_LT(leaves * gap(t - kBefore), 0.0) << k << " at " << t;
      EXPECT_GT(leaves * gap(t + kBefore), 0.0) << k << " at " << t;
    }
  }
  EXPECT_GT(crossings, 20);
}

}  // namespace
}  // namespace trajet::test
