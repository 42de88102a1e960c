// Bodies that meet bodies: times against closed forms, what is conserved, chains whose sequence is known, and no pair
// missed among many.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "body_scene.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/sim/run_observer.hpp"

namespace trajet {
namespace {

using test::BallOf;
using test::final_of;
using test::number;
using test::plane;
using test::room;
using test::run_text;
using test::vector;

/// All samples of a run.
class Samples : public RunObserver {
 public:
  RunWishes wishes() const override { return {.samples = true}; }
  void sample(const Sample& sample) override {
    if (sample.phase == SamplePhase::none) all.push_back(sample);
  }
  std::vector<Sample> all;
};

TEST(BodyMeetings, BallsAndPointsMeetWhenTheirDistanceIsTheSumOfTheRadii) {
  // |d + w t| = R, whatever pulls at both alike; then Newton's law along the line of the centres
  std::mt19937 random(3);
  std::uniform_real_distribution<> uniform(-1.0, 1.0);
  const auto draw = [&] { return Vector3(uniform(random), uniform(random), uniform(random)); };
  int met = 0;
  for (int i = 0; i < 1000; ++i) {
    const double a = i % 3 == 0 ? 0.0 : 0.3 + 0.2 * uniform(random), b = 0.4 + 0.2 * uniform(random), reach = a + b;
    const Vector3 at_a = draw(), at_b = at_a + 3.0 * draw(), v_a = draw();
    const Vector3 v_b = v_a - 0.7 * (at_b - at_a) + 0.3 * draw();
    const Vector3 d = at_b - at_a, w = v_b - v_a;
    if (d.norm() < reach) continue;
    const double along = d.dot(w), rest = along * along - w.squaredNorm() * (d.squaredNorm() - reach * reach);
    if (std::abs(rest) < 1e-6) continue;
    const double time = (-along - std::sqrt(rest)) / w.squaredNorm();
    const bool meet = rest > 0.0 && time > 0.0 && time < 10.0;
    const double e = 0.5 + 0.5 * uniform(random), m_a = 2.0 + uniform(random), m_b = 2.0 + uniform(random);
    const std::string falls = "acceleration = [0.3, 0, -9.8]\n";
    const BallOf first{"first", a, m_a, at_a, v_a, falls + "restitution = " + number(e) + "\n"};
    const BallOf second{"second", b, m_b, at_b, v_b, falls + "restitution = " + number(e) + "\n"};
    const RunResult result = run_text("[time]\nend = 10\n" + first.text() + second.text());
    SCOPED_TRACE(first.text() + second.text());
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    ASSERT_EQ(result.impacts.size(), meet ? 1u : 0u);
    if (!meet) continue;
    ++met;
    const Impact& impact = result.impacts[0];
    EXPECT_EQ(impact.body, "first");
    EXPECT_EQ(impact.with, "second");
    // of the roots' coefficients: some roundings, over the speed of approach
    EXPECT_NEAR(impact.time, time, impact.time_error_bound + 1e-14 * (1.0 + time) * (1.0 + 1.0 / std::sqrt(rest)));
    const Vector3 normal = -(d + w * time).normalized();
    const double u = normal.dot(w);
    ASSERT_GT(u, 0.0);
    const double impulse = (1.0 + e) * u * m_a * m_b / (m_a + m_b);
    constexpr double kRounding = 1e-10;  // a normal is off by what the time is, over the radius
    EXPECT_LT((impact.normal - normal).norm(), kRounding);
    EXPECT_LT((impact.impulse - impulse * normal).norm(), kRounding);
    ASSERT_TRUE(impact.partner);
    EXPECT_LT((impact.velocity_after - impact.velocity_before - impulse / m_a * normal).norm(), kRounding);
    EXPECT_LT((impact.partner->velocity_after - impact.partner->velocity_before + impulse / m_b * normal).norm(),
              kRounding);
    EXPECT_LT((impact.point - (impact.position - a * normal)).norm(), kRounding);
  }
  EXPECT_GT(met, 300);
}

TEST(BodyMeetings, AGasKeepsItsEnergyAndNoTwoOverlap) {
  std::mt19937 random(7);
  std::uniform_real_distribution<> uniform(-1.0, 1.0);
  constexpr int kSide = 3;
  std::vector<BallOf> balls;
  std::string text = "[time]\nend = 20\nsample = 0.05\n" + room(kSide);
  double energy = 0.0;
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    BallOf ball{"b" + std::to_string(i), 0.2 + 0.15 * uniform(random), 2.0 + uniform(random)};
    ball.position = Vector3(i % kSide + 0.5, i / kSide % kSide + 0.5, i / kSide / kSide + 0.5);
    ball.velocity = Vector3(uniform(random), uniform(random), uniform(random));
    energy += 0.5 * ball.mass * ball.velocity.squaredNorm();
    text += ball.text();
    balls.push_back(ball);
  }
  Samples samples;
  const RunResult result = run_text(text, &samples);
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  const auto between = std::count_if(result.impacts.begin(), result.impacts.end(),
                                     [](const Impact& impact) { return impact.partner.has_value(); });
  EXPECT_GT(between, 200);
  for (const Sample& sample : samples.all) {
    double sum = 0.0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const Vector3& p = sample.bodies[i].position;
      sum += 0.5 * balls[i].mass * sample.bodies[i].velocity.squaredNorm();
      EXPECT_GE(p.minCoeff(), balls[i].radius - 1e-12);
      EXPECT_LE(p.maxCoeff(), kSide - balls[i].radius + 1e-12);
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_GE((p - sample.bodies[k].position).norm(), balls[i].radius + balls[k].radius - 1e-12);
    }
    // each impact rounds the velocities that it changes
    EXPECT_NEAR(sum, energy, 1e-13 * energy * static_cast<double>(result.impacts.size()));
  }
}

TEST(BodyMeetings, ErrorsThatGrowBeyondAllNumbersAreToldAsSuch) {
  // three balls in a small box: each impact makes errors some times larger, some hundred make 1e-16 more than 1e308
  const double duration = 400.0;
  std::string text = "[time]\nend = 400\nsample = 400\n" + room(1.0);
  text += BallOf{"a", 0.2, 1.0, {0.3, 0.3, 0.3}, {1, 0.3, 0.1}}.text();
  text += BallOf{"b", 0.2, 2.0, {0.7, 0.7, 0.3}, {-0.3, 1, 0.2}}.text();
  text += BallOf{"c", 0.2, 3.0, {0.3, 0.7, 0.7}, {0.1, -0.4, 1}}.text();
  const RunResult result = run_text(text);
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  ASSERT_GT(result.impacts.size(), 1000u);
  EXPECT_LT(result.impacts[3].time_error_bound, 1e-10);
  EXPECT_EQ(result.impacts.back().time_error_bound, duration);
  EXPECT_EQ(*result.final.bodies[0].position_error_bound, std::numeric_limits<double>::infinity());
  // ties are told of, but not of each of a thousand
  EXPECT_FALSE(result.warnings.empty());
  EXPECT_LT(result.warnings.size(), 10u);
}

TEST(BodyMeetings, TimesOfChainsOfImpactsAreWithinTheirBounds) {
  // of a coarse method against a fine one: errors of flights and of both bodies' states are carried through impacts
  std::mt19937 random(2);
  std::uniform_real_distribution<> mass(0.5, 2.0), aside(-0.1, 0.1);
  double largest = 0.0;
  int compared = 0;
  for (int k = 0; k < 40; ++k) {
    const std::string pulled = "acceleration = \"-4*r - 0.3*norm(v)*v\"\n";
    std::string balls;
    for (int i = 0; i < 3; ++i)
      balls += BallOf{"b" + std::to_string(i),
                      0.2,
                      mass(random),
                      {i - 1.0, aside(random), aside(random)},
                      {std::array{1.5, 0.2, -1.2}[static_cast<std::size_t>(i)], 0, 0},
                      pulled}
                   .text();
    const auto run_with = [&](const char* method) {
      return run_text("[time]\nend = 3\n[method]\n" + std::string(method) + balls);
    };
    const RunResult coarse = run_with("name = \"dopri5\"\nrtol = 1e-6\natol = 1e-6\n");
    const RunResult fine = run_with("name = \"taylor\"\nrtol = 1e-13\natol = 1e-13\n");
    for (std::size_t i = 0; i < std::min(coarse.impacts.size(), fine.impacts.size()); ++i) {
      const Impact &a = coarse.impacts[i], &b = fine.impacts[i];
      if (a.body != b.body || a.with != b.with) break;  // two that are nearer than their bounds
      EXPECT_LE(std::abs(a.time - b.time), a.time_error_bound) << k << ' ' << i;
      largest = std::max(largest, std::abs(a.time - b.time) / a.time_error_bound);
      ++compared;
    }
  }
  EXPECT_GT(compared, 200);
  EXPECT_GT(largest, 0.05);  // measured: 0.2
}

TEST(BodyMeetings, OfACradleTheLastBallTakesTheVelocity) {
  for (const double gap : {0.0, 1e-3}) {
    std::string text = "[time]\nend = 1\n";
    for (int i = 0; i < 5; ++i) {
      const double x = i == 0 ? -0.5 : 0.2 * (i - 1) + gap * i;
      text += BallOf{"b" + std::to_string(i), 0.1, 1.0, Vector3(x, 0, 0), Vector3(i == 0 ? 1.0 : 0.0, 0, 0)}.text();
    }
    const RunResult result = run_text(text);
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    ASSERT_EQ(result.impacts.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(result.impacts[i].body, "b" + std::to_string(i));
      EXPECT_EQ(result.impacts[i].with, "b" + std::to_string(i + 1));
      EXPECT_NEAR(result.impacts[i].time, 0.3 + gap * static_cast<double>(i + 1), 1e-14);
    }
    for (int i = 0; i < 5; ++i)
      EXPECT_NEAR(final_of(result, "b" + std::to_string(i)).velocity.x(), i == 4 ? 1.0 : 0.0, 1e-14);
  }
}

TEST(BodyMeetings, ABallThatRestsOnTheFloorIsHitFromAboveAndFliesOn) {
  // what is hit leaves the floor by way of it: all energy is that of the fall
  const double g = 9.8, height = 0.8;
  const std::string falls = "acceleration = [0, 0, -9.8]\n";
  for (const double aside : {0.0, 0.02}) {
    const BallOf low{"low", 0.1, 1.0, {0, 0, 0.1}, {0, 0, 0}, falls};
    const BallOf high{"high", 0.1, 2.0, {aside, 0, 0.1 + std::sqrt(0.04 - aside * aside) + height}, {0, 0, 0}, falls};
    const RunResult result =
        run_text("[time]\nend = 3\n" + low.text() + high.text() + plane("floor", {0, 0, 0}, {0, 0, 1}));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    ASSERT_GT(result.impacts.size(), 4u);
    EXPECT_EQ(result.impacts[0].kind, ImpactKind::rest);
    const Impact& hit = result.impacts[1];
    EXPECT_NEAR(hit.time, std::sqrt(2.0 * height / g), 1e-13);
    EXPECT_EQ(result.impacts[2].with, "floor");
    EXPECT_EQ(result.impacts[2].time, hit.time);
    double energy = 0.0;
    for (const BallOf* ball : {&low, &high}) {
      const BodyState& last = final_of(result, ball->name);
      energy += ball->mass * (0.5 * last.velocity.squaredNorm() + g * last.position.z());
    }
    const double before = g * (low.mass * low.position.z() + high.mass * high.position.z());
    EXPECT_NEAR(energy, before, 1e-13 * before * static_cast<double>(result.impacts.size()));
  }
}

TEST(BodyMeetings, TheOrderInTheFileDoesNotMatter) {
  const std::vector<BallOf> balls{{"a", 0.3, 1.0, {0, 0, 1}, {1, 0.2, 0}},
                                  {"b", 0.2, 2.0, {2, 0.1, 1}, {-1, 0, 0.1}},
                                  {"c", 0.25, 0.5, {1, 2, 1.2}, {0.1, -1, 0}},
                                  {"d", 0.0, 0.1, {1, -2, 0.9}, {0, 1.1, 0}}};
  std::vector<int> order{0, 1, 2, 3};
  std::optional<RunResult> known;
  do {
    std::string text = "[time]\nend = 4\n" + room(6.0);
    for (const int i : order) {
      BallOf ball = balls[static_cast<std::size_t>(i)];
      ball.position += Vector3(1.5, 3, 0.5);
      text += ball.text();
    }
    const RunResult result = run_text(text);
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    if (!known) known = result;
    ASSERT_EQ(result.impacts.size(), known->impacts.size());
    // a chain of impacts makes roundings larger
    for (const BallOf& ball : balls)
      EXPECT_LT((final_of(result, ball.name).position - final_of(*known, ball.name).position).norm(), 1e-10);
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_GT(known->impacts.size(), 3u);
}

TEST(BodyMeetings, SearchesGrowWithTheImpactsNotWithThePairs) {
  const auto searches_per_event = [](int side) {
    std::mt19937 random(11);
    std::uniform_real_distribution<> uniform(-1.0, 1.0);
    std::string text = "[time]\nend = 2\nsample = 2\n" + room(side);
    for (int i = 0; i < side * side * side; ++i) {
      BallOf ball{"b" + std::to_string(i), 0.2};
      ball.position = Vector3(i % side + 0.5, i / side % side + 0.5, i / side / side + 0.5);
      ball.velocity = Vector3(uniform(random), uniform(random), uniform(random));
      text += ball.text();
    }
    const RunResult result = run_text(text);
    EXPECT_EQ(result.status, RunStatus::finished) << result.failure;
    return static_cast<double>(result.statistics.contact_searches) /
           static_cast<double>(result.impacts.size() + static_cast<std::size_t>(side * side * side));
  };
  const double few = searches_per_event(4), many = searches_per_event(9);
  // 11 times as many bodies, 130 times as many pairs
  EXPECT_LT(many, 1.5 * few);
}

TEST(BodyMeetings, SolidsKeepMomentumAngularMomentumAndEnergy) {
  std::mt19937 random(19);
  std::uniform_real_distribution<> uniform(-1.0, 1.0);
  const auto draw = [&] { return Vector3(uniform(random), uniform(random), uniform(random)); };
  const std::array<std::string, 4> shapes{
      "shape = \"box\"\nsize = [0.6, 0.4, 0.3]\n", "shape = \"cylinder\"\nradius = 0.2\nheight = 0.5\n",
      "shape = \"capsule\"\nradius = 0.15\nheight = 0.4\n", "shape = \"sphere\"\nradius = 0.25\n"};
  int met = 0;
  for (int i = 0; i < 60; ++i) {
    std::string text = "[time]\nend = 2\n";
    const Vector3 drift = draw();
    for (int k = 0; k < 2; ++k) {
      const Vector3 position = (k == 0 ? -1.0 : 1.0) * (Vector3(0.8, 0, 0) + 0.1 * draw());
      const Vector3 velocity = drift - 1.2 * position + 0.1 * draw();
      const std::string& shape = shapes[static_cast<std::size_t>(k == 0 ? i % 3 : (i / 3) % 4)];
      text += "[[body]]\nname = \"" + std::string(k == 0 ? "a" : "b") + "\"\n" + shape +
              "density = " + number(2.0 + uniform(random)) + "\nposition = " + vector(position) +
              "\nvelocity = " + vector(velocity) + "\nangular_velocity = " + vector(4.0 * draw()) + "\n";
    }
    SCOPED_TRACE(text);
    const World world = make_world(parse_scene(text, "test.toml"));
    const RunResult result = run(world);
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    if (result.impacts.empty()) continue;
    ++met;
    // all three of the impact itself: with mass and inertia of each, about the point of contact
    for (const Impact& impact : result.impacts) {
      ASSERT_TRUE(impact.partner);
      EXPECT_LT(impact.impulse.cross(impact.normal).norm(), 1e-12 * impact.impulse.norm());
      EXPECT_GT(impact.impulse.dot(impact.normal), 0.0);
    }
    const auto totals = [&](bool is_end) {
      Vector3 momentum = Vector3::Zero(), turning = Vector3::Zero();
      double energy = 0.0;
      for (std::size_t k = 0; k < 2; ++k) {
        const World::Body& body = world.bodies[k];
        const Eigen::VectorXd& start = world.groups[static_cast<std::size_t>(body.group)].start;
        const BodyState& last = result.final.bodies[k];
        double mass = 0.0;
        Evaluator<double> (*body.mass)(0.0, start.data(), &mass);
        const Vector3 r = is_end ? last.position : Vector3(body.slice().position(start));
        const Vector3 v = is_end ? last.velocity : Vector3(body.slice().velocity(start));
        const Matrix3 R = is_end ? last.rotation_matrix : rotation_matrix(body.q_WB);
        Vector3 w = is_end ? last.angular_velocity : Vector3(body.slice().angular_velocity(start));
        if (!is_end && body.rotation->layout.frame == Frame::body) w = R * w;
        // a ball keeps its spin
        const Matrix3 I = body.inertia ? Matrix3(R * *body.inertia * R.transpose()) : Matrix3(Matrix3::Zero());
        momentum += mass * v;
        turning += mass * r.cross(v) + I * w;
        energy += 0.5 * mass * v.squaredNorm() + 0.5 * w.dot(I * w);
      }
      Eigen::Matrix<double, 7, 1> all;
      all << momentum, turning, energy;
      return all;
    };
    // the tolerance of the steps, and what curved contact points are good for
    EXPECT_LT((totals(true) - totals(false)).norm(), 1e-6 * totals(false).norm());
  }
  EXPECT_GT(met, 40);
}

TEST(BodyMeetings, TwoPlatesThatMeetHeadOnDoNotPass) {
  const auto plate = [](const std::string& name, double x, double v, double tilt) {
    return "[[body]]\nname = \"" + name +
           "\"\nshape = \"box\"\nsize = [0.001, 1, 1]\nmass = 1\nposition = " + vector({x, 0, 0}) +
           "\nvelocity = " + vector({v, 0, 0}) + "\norientation = {axis = [0, 1, 0], angle = " + number(tilt) + "}\n";
  };
  for (const double tilt : {0.0, 1e-3, 0.02, 0.1, 0.3, 0.5}) {
    const RunResult result =
        run_text("[time]\nend = 1\n" + plate("a", -450.0, 900.0, 0.0) + plate("b", 450.0, -900.0, tilt));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    ASSERT_FALSE(result.impacts.empty());
    // the gap between a and the farthest corner of b: the plates' middles meet at 0.5 s
    const double reach = 0.0005 + 0.0005 * std::cos(tilt) + 0.5 * std::sin(tilt);
    EXPECT_NEAR(result.impacts[0].time, 0.5 - reach / 1800.0, 1e-12);
    EXPECT_LT(final_of(result, "a").position.x(), final_of(result, "b").position.x());
  }
}

}  // namespace
}  // namespace trajet
