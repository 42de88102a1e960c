#include "trajet/ensemble/sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scene_run.hpp"
#include "trajet/io/scene_overrides.hpp"
#include "trajet/io/sweep_csv.hpp"
#include "trajet/io/variation_text.hpp"

namespace trajet {
namespace {

using test::number;

const std::string kThrow = R"toml(
[parameters]
theta = "40 deg"
v0 = "12 m/s"
wind = [1, 0, 0]
[time]
end = "6 s"
[[body]]
name = "ball"
shape = "sphere"
radius = "5 cm"
mass = 1
velocity = "v0*[cos(theta), 0, sin(theta)]"
position = [0, 0, 1]
acceleration = "[0, 0, -9.81] - 0.02*norm(v - wind)*(v - wind)"
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "bounce"
restitution = 0.7
friction = 0.3
[[obstacle]]
name = "wall"
shape = "rectangle"
center = [9, 0, 1]
normal = [-1, 0, 0]
up = [0, 0, 1]
size = [4, 3]
on_hit = "bounce"
)toml";

const std::function<bool()> kNever = [] { return false; };

/// A sweep of a scene with the texts of a command line.
Sweep make_sweep(const std::string& text, const std::vector<std::string>& vary, const std::vector<std::string>& sample,
                 std::uint64_t count, std::vector<std::string> columns) {
  Scene scene = parse_scene(text, "test.toml");
  SweepPlan plan{.samples_per_node = count, .seed = 5};
  for (const std::string& each : vary) plan.axes.push_back(read_range(each, "--vary", scene));
  for (const std::string& each : sample) plan.samples.push_back(read_sample(each, "--sample", scene));
  return {std::move(scene), std::move(plan), std::move(columns), {"--report"}};
}

double cell(const SweepRow& row, std::size_t column) {
  const auto* value = std::get_if<double>(&row.cells[column]);
  return value == nullptr ? std::nan("") : *value;
}

std::string word(const SweepRow& row, std::size_t column) {
  const auto* value = std::get_if<std::string>(&row.cells[column]);
  return value == nullptr ? "" : *value;
}

TEST(Sweep, RowsAreWhatRunsWithTheirValuesReport) {
  const std::vector<std::string> columns{"t",
                                         "ball.x",
                                         "norm(ball.v)",
                                         "speed",
                                         "hit",
                                         "impact(1).t",
                                         "impact(2).with",
                                         "impact(2).point",
                                         "impact(3).vz",
                                         "status",
                                         "x/v0",
                                         "ball.speed + 1",
                                         "hit == 'wall'",
                                         "ball.r",
                                         "norm(wind)*2",
                                         "impact(1).with != 'wall'",
                                         "ball.wy",
                                         "dot(impact(1).normal, [0, 0, 1])"};
  EXPECT_THROW(make_sweep(kThrow, {"theta=0.1:1.2:3"}, {}, 1, columns), InputError) << "a vector is no column";
  std::vector<std::string> scalars = columns;
  scalars[7] = "norm(impact(2).point)";
  scalars[13] = "norm(ball.r)";
  const Sweep sweep = make_sweep(kThrow, {"theta=0.1rad:1.2 rad:12"}, {"v0=normal(12m/s, 2 m/s)"}, 3, scalars);
  Sweep::Worker worker(sweep);
  int walls = 0;
  for (std::uint64_t i = 0; i < sweep.plan().count(); ++i) {
    const SweepRow row = worker(i, kNever);
    // by hand: the same numbers as --set
    Scene scene = parse_scene(kThrow, "test.toml");
    apply({.parameters = {"theta=" + number(row.values[0]) + " rad", "v0=" + number(row.values[1]) + " m/s"}}, scene);
    const RunResult result = run(scene);
    std::vector<const Impact*> met;
    for (const Impact& impact : result.impacts)
      if (impact.kind == ImpactKind::hit || impact.kind == ImpactKind::graze) met.push_back(&impact);
    ASSERT_GE(met.size(), 3U);
    const BodyState& ball = result.final.bodies[0];
    EXPECT_EQ(cell(row, 0), result.end_time);
    EXPECT_EQ(cell(row, 1), ball.position.x());
    EXPECT_DOUBLE_EQ(cell(row, 2), ball.velocity.norm());
    EXPECT_EQ(cell(row, 3), cell(row, 2));
    EXPECT_EQ(word(row, 4), met[0]->with);
    EXPECT_EQ(row.hit, met[0]->with);
    EXPECT_EQ(cell(row, 5), met[0]->time);
    EXPECT_EQ(word(row, 6), met[1]->with);
    EXPECT_DOUBLE_EQ(cell(row, 7), met[1]->point.norm());
    EXPECT_EQ(cell(row, 8), met[2]->velocity_before.z());
    EXPECT_EQ(word(row, 9), "finished");
    EXPECT_DOUBLE_EQ(cell(row, 10), ball.position.x() / row.values[1]);
    EXPECT_DOUBLE_EQ(cell(row, 11), ball.velocity.norm() + 1.0);
    EXPECT_EQ(cell(row, 12), met[0]->with == "wall" ? 1.0 : 0.0);
    EXPECT_DOUBLE_EQ(cell(row, 13), ball.position.norm());
    EXPECT_EQ(cell(row, 14), 2.0);
    EXPECT_EQ(cell(row, 15), met[0]->with == "wall" ? 0.0 : 1.0);
    EXPECT_EQ(cell(row, 16), ball.angular_velocity.y());
    EXPECT_DOUBLE_EQ(cell(row, 17), met[0]->normal.z());
    walls += met[0]->with == "wall" ? 1 : 0;
  }
  EXPECT_GT(walls, 3) << "both kinds are tried";
  EXPECT_LT(walls, 33);
}

/// The table of a sweep as text.
std::string table(const Sweep& sweep, int threads, std::uint64_t block, std::uint64_t first = 0) {
  std::string text;
  run_sweep(
      sweep, {.first = first, .last = sweep.plan().count(), .block = block, .threads = threads},
      [&](SweepBlock&& rows) {
        for (const SweepRow& row : rows.rows) append_csv_line(row, sweep.columns().texts().size(), text);
        return true;
      },
      kNever);
  return text;
}

TEST(Sweep, HasTheSameBitsWhateverThreadsAndBlocks) {
  const Sweep sweep = make_sweep(kThrow, {}, {"theta=uniform(10 deg,80 deg)", "ball.radius=lognormal(5cm,1cm)"}, 60,
                                 {"t", "ball.x", "max(ball.z)", "hit", "impact(1).t"});
  const std::string one = table(sweep, 1, 64);
  EXPECT_EQ(table(sweep, 4, 1), one);
  EXPECT_EQ(table(sweep, 3, 7), one);
  const std::string tail = table(sweep, 2, 5, 41);
  EXPECT_EQ(one.substr(one.size() - tail.size()), tail);
  EXPECT_EQ(tail.substr(0, 3), "41,");
}

TEST(Sweep, FindsExtremesOfFlightsToRounding) {
  const std::string scene = R"toml(
[parameters]
climb = 5
[time]
end = 3
[[body]]
name = "ball"
velocity = "[2, 0, climb]"
position = [0, 0, 1]
acceleration = [0, 0, -10]
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "bounce"
restitution = 0.5
)toml";
  const Sweep sweep =
      make_sweep(scene, {"climb=0:8:9"}, {}, 1,
                 {"max(z)", "min(z)", "max(speed)", "min(vz)", "max(vz)", "max(sin(40*t))", "min(abs(z - 0.3))",
                  "max(max(x, z))", "max(z) - min(z)", "min(norm(r - [3, 0, 0]))"});
  Sweep::Worker worker(sweep);
  for (std::uint64_t i = 0; i < 9; ++i) {
    const SweepRow row = worker(i, kNever);
    const double vz = static_cast<double>(i);
    const double top = 1.0 + vz * vz / 20.0, fall = std::sqrt(vz * vz + 20.0);
    EXPECT_NEAR(cell(row, 0), top, 4e-16 * top);
    EXPECT_NEAR(cell(row, 1), 0.0, 1e-14) << "rounding of heights of metres";
    EXPECT_NEAR(cell(row, 2), std::sqrt(4.0 + fall * fall), 1e-14);
    EXPECT_NEAR(cell(row, 3), -fall, 2e-15 * fall);
    // just behind the first bounce, or at the start
    EXPECT_NEAR(cell(row, 4), std::max(vz, 0.5 * fall), 2e-15 * fall);
    EXPECT_NEAR(cell(row, 5), 1.0, 1e-15);
    EXPECT_NEAR(cell(row, 6), 0.0, 1e-12) << "a kink";
    EXPECT_NEAR(cell(row, 7), 6.0, 1e-14);
    EXPECT_EQ(cell(row, 8), cell(row, 0) - cell(row, 1));
    // against the smallest of many samples
    double least = INFINITY;
    Scene variant = sweep.variant(i);
    variant.time.sample = Expression(0.001);
    struct Nearest : RunObserver {
      explicit Nearest(double& value) : value_(value) {}
      RunWishes wishes() const override { return {.samples = true}; }
      void sample(const Sample& s) override {
        value_ = std::min(value_, (s.bodies[0].position - Vector3(3, 0, 0)).norm());
      }
      double& value_;
    } nearest(least);
    run(variant, &nearest);
    EXPECT_LE(cell(row, 9), least + 1e-14);
    EXPECT_GT(cell(row, 9), least - 1e-3);
  }
}

TEST(Sweep, TellsMotionsThatFail) {
  const std::string scene = R"toml(
[parameters]
size = 1
[time]
end = 2
[method]
max_steps = 2000
[[body]]
name = "ball"
shape = "sphere"
radius = "size"
acceleration = "where(t < 1, [0, 0, 0], [0, 0, 1/(1 - t/(1 + size))^2])"
)toml";
  const Sweep sweep = make_sweep(scene, {"size=-1:1:3"}, {}, 1, {"t", "x", "status"});
  Sweep::Worker worker(sweep);
  const SweepRow wrong = worker(0, kNever);
  EXPECT_EQ(wrong.status, RunStatus::failed);
  EXPECT_EQ(word(wrong, 2), "failed");
  EXPECT_TRUE(std::isnan(cell(wrong, 0)) && std::isnan(cell(wrong, 1)));
  EXPECT_NE(wrong.failure.find("radius of body 'ball' must be positive"), std::string::npos) << wrong.failure;
  // a motion behind one that failed is as it would be alone
  const SweepRow right = worker(2, kNever);
  EXPECT_EQ(right.status, RunStatus::failed) << "a pole at its end";
  EXPECT_EQ(make_sweep(scene, {"size=2:3:2"}, {}, 1, {"t"}).plan().count(), 2U);
  const Sweep other = make_sweep(scene, {"size=-1:3:3"}, {}, 1, {"t", "status"});
  Sweep::Worker again(other);
  again(0, kNever);
  EXPECT_EQ(cell(again(2, kNever), 0), 2.0);
}

TEST(Sweep, StopsWhereItIsTold) {
  const Sweep sweep = make_sweep(kThrow, {"theta=0.1 rad:1.2 rad:400"}, {}, 1, {"t"});
  std::uint64_t taken = 0;
  run_sweep(
      sweep, {.last = 400, .block = 10, .threads = 2},
      [&](SweepBlock&& block) {
        EXPECT_EQ(block.first, taken);
        taken += block.rows.size();
        return taken < 50;
      },
      kNever);
  EXPECT_EQ(taken, 50U);
  std::atomic<int> asked{0};
  taken = 0;
  run_sweep(
      sweep, {.last = 400, .block = 10, .threads = 2},
      [&](SweepBlock&& block) {
        taken += block.rows.size();
        return true;
      },
      [&] { return ++asked > 1000; });
  EXPECT_LT(taken, 400U);
  EXPECT_EQ(taken % 10, 0U) << "whole blocks only";
}

TEST(ReportColumns, SayWhatIsWrong) {
  const auto message = [](const std::string& column) -> std::string {
    try {
      make_sweep(kThrow, {"theta=0.1 rad:1 rad:2"}, {}, 1, {column});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message("ball.zz").find("ball.z"), std::string::npos) << message("ball.zz");
  EXPECT_EQ(message("ball.zz").find("--report"), 0U) << message("ball.zz");
  EXPECT_NE(message("impact(0).t").find("from 1"), std::string::npos);
  EXPECT_NE(message("impact(1).tt").find("did you mean 't'"), std::string::npos) << message("impact(1).tt");
  EXPECT_NE(message("impact(1)").find("impact(N).t expected"), std::string::npos);
  EXPECT_NE(message("hit + 1").find("is a word"), std::string::npos) << message("hit + 1");
  EXPECT_NE(message("max(impact(1).t)").find("over the flight"), std::string::npos);
  EXPECT_NE(message("").find("missing"), std::string::npos);
  EXPECT_NE(message("ball.r").find("scalar"), std::string::npos) << message("ball.r");
}

}  // namespace
}  // namespace trajet
