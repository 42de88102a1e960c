// Balls and solids that bounce with friction, as scenes run: closed forms, measured bounces, and what every impact
// keeps.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "scene_run.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {
namespace {

using test::final_of;
using test::number;
using test::run_text;

constexpr double kRounding = 1e-12;

std::string array(const Vector3& v) { return "[" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + "]"; }

std::string floor_of(const std::string& keys, const std::string& on_hit = "bounce") {
  return "[[obstacle]]\nname = \"floor\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\non_hit = \"" +
         on_hit + "\"\n" + keys;
}

/// A uniform ball of 1 kg and radius 1 m.
std::string ball(const Vector3& position, const Vector3& velocity, const Vector3& w = Vector3::Zero(),
                 const std::string& keys = "", const std::string& name = "ball") {
  return "[[body]]\nname = \"" + name + "\"\nshape = \"sphere\"\nradius = 1\nmass = 1\nposition = " + array(position) +
         "\nvelocity = " + array(velocity) + "\nangular_velocity = " + array(w) + "\n" + keys;
}

/// The one impact of a ball that flies at the floor without gravity.
Impact impact_on_floor(const Vector3& velocity, const Vector3& w, const std::string& keys) {
  const RunResult result = run_text("[time]\nend = 4\n" + ball({0, 0, 1.5}, velocity, w) + floor_of(keys));
  EXPECT_EQ(result.status, RunStatus::finished) << result.failure;
  EXPECT_EQ(result.impacts.size(), 1u);
  return result.impacts.empty() ? Impact{} : result.impacts[0];
}

TEST(FrictionImpacts, SuperballComesBackFromUnderATable) {
  // floor, table, floor with e = 1 and all slip turned round: v_x and R w of rational numbers
  const RunResult result = run_text(
      "[time]\nend = 12\n[[body]]\nname = \"ball\"\nshape = \"sphere\"\nradius = 1\nmass = 1\n"
      "position = [0, 0, 2]\nvelocity = [1, 0, -1]\n" +
      floor_of("tangential_restitution = 1\n") +
      "[[obstacle]]\nname = \"table\"\nshape = \"plane\"\npoint = [0, 0, 6]\nnormal = [0, 0, -1]\n"
      "on_hit = \"bounce\"\ntangential_restitution = 1\n");
  ASSERT_EQ(result.impacts.size(), 3u);
  const std::array<double, 3> v{3.0 / 7.0, -31.0 / 49.0, -333.0 / 343.0};
  const std::array<double, 3> w{10.0 / 7.0, -60.0 / 49.0, -130.0 / 343.0};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(result.impacts[i].velocity_after.x(), v[i], kRounding);
    EXPECT_NEAR(result.impacts[i].angular_velocity_after.y(), w[i], kRounding);
  }
}

TEST(FrictionImpacts, BallsGripUpToTheirLimit) {
  // |u_t| = mu (1 + e) (1 + 1/k) |u_n| / (1 + e_t), k = 2/5; a golf ball on granite: 39.876 degrees from the surface
  const double mu = 0.18, e = 0.9;
  for (const double e_t : {0.0, 0.3}) {
    const double limit = mu * (1.0 + e) * 3.5 / (1.0 + e_t);
    if (e_t == 0.0) {
      EXPECT_NEAR(std::atan(1.0 / limit) * 180.0 / M_PI, 39.876, 5e-4);
    }
    for (const double part : {0.3, 0.999999, 1.000001, 3.0}) {
      const double u = part * limit;
      const Impact hit =
          impact_on_floor({u, 0, -1}, Vector3::Zero(),
                          "restitution = 0.9\nfriction = 0.18\ntangential_restitution = " + number(e_t) + "\n");
      const double rub = std::min(mu * (1.0 + e), (1.0 + e_t) * u / 3.5);
      EXPECT_NEAR(hit.impulse.x(), -rub, kRounding);
      EXPECT_NEAR(hit.velocity_after.x(), u - rub, kRounding);
      EXPECT_NEAR(hit.angular_velocity_after.y(), 2.5 * rub, kRounding);
      const double slip = hit.velocity_after.x() - hit.angular_velocity_after.y();
      EXPECT_EQ(std::abs(slip + e_t * u) < 1e-9, part < 1.0) << slip;
    }
  }
}

TEST(FrictionImpacts, SpinOverSpeedInItsThreeWays) {
  for (const double angle : {0.2, 0.7, 1.2}) {
    const Vector3 v(std::cos(angle), 0, -std::sin(angle));
    const double e = 0.7, mu = 0.01;
    EXPECT_NEAR(impact_on_floor(v, Vector3::Zero(), "friction = 100\nrestitution = 0.7\n").angular_velocity_after.y(),
                5.0 / 7.0 * std::cos(angle), kRounding);
    EXPECT_NEAR(impact_on_floor(v, Vector3::Zero(), "tangential_restitution = 1\nrestitution = 0.7\n")
                    .angular_velocity_after.y(),
                10.0 / 7.0 * std::cos(angle), kRounding);
    EXPECT_NEAR(impact_on_floor(v, Vector3::Zero(), "friction = 0.01\nrestitution = 0.7\n").angular_velocity_after.y(),
                2.5 * mu * (1.0 + e) * std::sin(angle), kRounding);
  }
}

TEST(FrictionImpacts, AllLawsAreOneForBalls) {
  for (const std::string law : {"stronge", "poisson", "newton"}) {
    const Impact hit =
        impact_on_floor({1, 2, -3}, {3, -1, 2}, "friction = 0.2\nrestitution = 0.6\nimpact = \"" + law + "\"\n");
    const Vector3 slip(1.0 - -1.0, 2.0 + 3.0, 0.0);  // v + w x (-z): (v_x - w_y, v_y + w_x)
    EXPECT_NEAR(hit.velocity_after.z(), 1.8, kRounding);
    EXPECT_LT((hit.impulse - (4.8 * Vector3::UnitZ() - 0.2 * 4.8 * slip.normalized())).norm(), kRounding);
    EXPECT_NEAR(hit.angular_velocity_after.z(), 2.0, kRounding);
  }
}

/// Two balls on a table seen from above, the second at rest; cut by `angle`.
RunResult shot(double angle, double spin, double e, double mu, double speed = 1.0) {
  const std::string surface = "restitution = " + number(e) + "\nfriction = " + number(mu) + "\n";
  const Vector3 at(-2.0 * std::cos(angle) - 3.0, -2.0 * std::sin(angle), 0);
  return run_text("[time]\nend = 100\nsample = 100\n" + ball(at, {speed, 0, 0}, {0, 0, spin}, surface, "cue") +
                  ball({0, 0, 0}, {0, 0, 0}, {0, 0, 0}, surface, "eight"));
}

TEST(FrictionImpacts, CutShotsThrowAsFrictionLetsThem) {
  const double e = 0.95;
  for (const double mu : {0.05, 0.3})
    for (const double angle : {0.05, 0.3, 0.8, 1.2}) {
      const RunResult result = shot(angle, 0.0, e, mu);
      ASSERT_EQ(result.impacts.size(), 1u);
      const Impact& hit = result.impacts[0];
      const Vector3 line(std::cos(angle), std::sin(angle), 0), across(-std::sin(angle), std::cos(angle), 0);
      const Vector3 thrown = hit.partner->velocity_after;
      EXPECT_NEAR(-thrown.dot(across) / thrown.dot(line), std::min(mu, 2.0 * std::tan(angle) / (7.0 * (1.0 + e))),
                  1e-11);
      EXPECT_LT((hit.velocity_after + thrown - Vector3(1, 0, 0)).norm(), kRounding);
      // both get the same spin: the same impulse across, on opposite sides
      EXPECT_LT((hit.angular_velocity_after - hit.partner->angular_velocity_after).norm(), kRounding);
    }
}

TEST(FrictionImpacts, GearingSpinDoesNotThrow) {
  for (const double angle : {0.1, 0.5, 1.0})
    for (const double speed : {0.3, 4.0}) {
      // the point of contact of the cue ball moves with v_t + w_z R: R w_z = v sin(angle) as seen from here
      const RunResult result = shot(angle, speed * std::sin(angle), 1.0, 0.4, speed);
      ASSERT_EQ(result.impacts.size(), 1u);
      const Impact& hit = result.impacts[0];
      const Vector3 line(std::cos(angle), std::sin(angle), 0);
      EXPECT_LT(hit.partner->velocity_after.cross(line).norm(), 1e-11 * speed);
      EXPECT_LT(hit.partner->angular_velocity_after.norm(), 1e-11 * speed);
      // and with e = 1 equal balls part at a right angle
      EXPECT_NEAR(hit.velocity_after.dot(hit.partner->velocity_after), 0.0, 1e-11 * speed * speed);
    }
}

TEST(FrictionImpacts, TennisBallsBounceAsMeasured) {
  // [Cross2002]: what the normal and the tangential speeds show as restitutions tells the spin, as far as a ball
  // that keeps its shape can
  struct Bounce {
    double v_x, v_y, v_x_after, v_y_after, spin, e, mu;
  };
  const Bounce bounces[] = {
      {3.496, 1.272, 2.918, 1.016, 34.9, 0.80, 0.252}, {2.687, 2.687, 1.613, 1.949, 58.2, 0.73, 0},
      {3.317, 1.207, 1.992, 1.024, 78.5, 0.85, 0},     {2.616, 2.616, 1.663, 2.076, 49.9, 0.79, 0},
      {3.148, 1.146, 1.955, 0.846, 76.7, 0.74, 0},     {2.546, 2.546, 1.735, 2.017, 50.6, 0.79, 0}};
  const double R = 0.033, m = 0.057, I = 0.55 * m * R * R;
  for (const Bounce& bounce : bounces) {
    // of the slip before: 1 + e_t = (1 + 1/k) (v_x - v_x') / v_x
    const double e_t = (1.0 + 1.0 / 0.55) * (bounce.v_x - bounce.v_x_after) / bounce.v_x - 1.0;
    const std::string surface = bounce.mu > 0.0 ? "friction = " + number(bounce.mu) + "\n"
                                                : "friction = 0.8\ntangential_restitution = " + number(e_t) + "\n";
    const RunResult result = run_text(
        "[time]\nend = 0.2\n[[body]]\nname = \"ball\"\nshape = \"sphere\"\nradius = 0.033\nmass = 0.057\ninertia = " +
        array({I, I, I}) + "\nposition = [0, 0, 0.1]\nvelocity = " + array({bounce.v_x, 0, -bounce.v_y}) + "\n" +
        floor_of("restitution = " + number(bounce.e) + "\n" + surface));
    ASSERT_EQ(result.impacts.size(), 1u);
    const Impact& hit = result.impacts[0];
    const double speed = std::hypot(bounce.v_x_after, bounce.v_y_after);
    EXPECT_NEAR(hit.velocity_after.norm() / speed, 1.0, 0.02);
    EXPECT_NEAR(hit.angular_velocity_after.y() / bounce.spin, 1.0, 0.15);
  }
}

TEST(FrictionImpacts, MovingWallsCarryAlong) {
  // the same as seen from a train, which the wall is on
  const Vector3 train(0.7, -0.4, 0.2);
  const std::string surface = "friction = 0.3\nrestitution = 0.8\n";
  const RunResult at_rest =
      run_text("[time]\nend = 1\n" + ball({0, 0, 1.5}, {1, 2, -3}, {3, -1, 2}) + floor_of(surface));
  const RunResult moving = run_text("[time]\nend = 1\n" + ball({0, 0, 1.5}, Vector3(1, 2, -3) + train, {3, -1, 2}) +
                                    floor_of(surface + "velocity = " + array(train) + "\n"));
  ASSERT_EQ(at_rest.impacts.size(), 1u);
  ASSERT_EQ(moving.impacts.size(), 1u);
  EXPECT_LT((moving.impacts[0].velocity_after - at_rest.impacts[0].velocity_after - train).norm(), kRounding);
  EXPECT_LT((moving.impacts[0].angular_velocity_after - at_rest.impacts[0].angular_velocity_after).norm(), kRounding);
  EXPECT_LT((moving.impacts[0].impulse - at_rest.impacts[0].impulse).norm(), kRounding);
  EXPECT_LT((moving.final.bodies[0].position - at_rest.final.bodies[0].position - train).norm(), 1e-11);

  // a ball that falls on a turntable 2 m from its axis: where it grips, 2/7 of the table's speed
  const RunResult turned = run_text("[time]\nend = 1\n" + ball({2, 0, 1.5}, {0, 0, -1}) +
                                    floor_of("friction = 10\nangular_velocity = [0, 0, 3]\n"));
  ASSERT_EQ(turned.impacts.size(), 1u);
  EXPECT_LT((turned.impacts[0].velocity_after - Vector3(0, 12.0 / 7.0, 1)).norm(), kRounding);
  EXPECT_LT((turned.impacts[0].angular_velocity_after - Vector3(30.0 / 7.0, 0, 0)).norm(), kRounding);
}

TEST(FrictionImpacts, PointsRubWithoutSpin) {
  const RunResult result =
      run_text("[time]\nend = 1\n[[body]]\nname = \"p\"\nposition = [0, 0, 0.5]\nvelocity = [1, 0, -1]\n" +
               floor_of("friction = 0.2\nrestitution = 0.5\n"));
  ASSERT_EQ(result.impacts.size(), 1u);
  EXPECT_LT((result.impacts[0].velocity_after - Vector3(0.7, 0, 0.5)).norm(), kRounding);
  EXPECT_LT((result.impacts[0].impulse - Vector3(-0.3, 0, 1.5)).norm(), kRounding);
}

TEST(FrictionImpacts, BallsWithoutMassSayWhatTheyNeed) {
  const RunResult result = run_text(
      "[time]\nend = 1\n[[body]]\nname = \"b\"\nshape = \"sphere\"\nradius = 1\nposition = [0, 0, 1.5]\n"
      "velocity = [1, 0, -1]\n" +
      floor_of("friction = 0.2\n"));
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_NE(result.failure.find("give it a `mass`"), std::string::npos) << result.failure;
  EXPECT_EQ(result.impacts.size(), 1u);
}

TEST(FrictionImpacts, FrictionThatVanishesChangesNothing) {
  const std::string start =
      "[time]\nend = 3\n" + ball({0, 0, 1.5}, {1, 0, -1}, {0, 2, 0}, "acceleration = [0, 0, -9.8]\n");
  const RunResult none = run_text(start + floor_of("restitution = 0.9\n"));
  const RunResult zero = run_text(start + floor_of("restitution = 0.9\nfriction = 0\n"));
  const RunResult tiny = run_text(start + floor_of("restitution = 0.9\nfriction = 1e-13\n"));
  ASSERT_GT(none.impacts.size(), 2u);
  ASSERT_EQ(zero.impacts.size(), none.impacts.size());
  ASSERT_EQ(tiny.impacts.size(), none.impacts.size());
  for (std::size_t i = 0; i < none.impacts.size(); ++i) {
    EXPECT_EQ(zero.impacts[i].time, none.impacts[i].time);
    EXPECT_EQ(zero.impacts[i].velocity_after, none.impacts[i].velocity_after);
    EXPECT_NEAR(tiny.impacts[i].time, none.impacts[i].time, 1e-12);
    EXPECT_LT((tiny.impacts[i].velocity_after - none.impacts[i].velocity_after).norm(), 1e-11);
  }
}

/// Boxes with friction: a random start.
class Boxes {
 public:
  explicit Boxes(unsigned seed) : random_(seed) {}

  Vector3 any(double half) {
    std::uniform_real_distribution<> uniform(-half, half);
    return {uniform(random_), uniform(random_), uniform(random_)};
  }
  std::string box(const std::string& name, const Vector3& position, const Vector3& velocity, const std::string& keys) {
    return "[[body]]\nname = \"" + name +
           "\"\nshape = \"box\"\nsize = [1, 0.6, 0.4]\nmass = 2.5\nposition = " + array(position) +
           "\nvelocity = " + array(velocity) + "\nangular_velocity = " + array(any(4.0)) +
           "\norientation = {axis = " + array(any(1.0)) + ", angle = " + number(any(3.0).x()) + "}\n" + keys;
  }

 private:
  std::mt19937 random_;
};

Matrix3 inertia_of_box(const BodyState& state) {
  const Vector3 squares(1.0, 0.36, 0.16);
  const Vector3 moments(squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y());
  return state.rotation_matrix * (2.5 / 12.0 * moments).asDiagonal() * state.rotation_matrix.transpose();
}

TEST(FrictionImpacts, SolidsKeepTheirAngularMomentumAboutThePointOfContact) {
  Boxes boxes(5);
  int gained = 0;
  for (int i = 0; i < 150; ++i) {
    const std::string law = i % 3 == 0 ? "newton" : i % 3 == 1 ? "poisson" : "stronge";
    const std::string start =
        "[time]\nend = 10\n" + boxes.box("b", {0, 0, 1.5}, Vector3(0, 0, -1.5) + boxes.any(0.7), "");
    const RunResult result =
        run_text(start + floor_of("friction = 0.4\nrestitution = 0.9\nimpact = \"" + law + "\"\n"));
    if (result.impacts.empty()) continue;
    const Impact& hit = result.impacts[0];
    // the orientation at the impact: a run that ends there
    const RunResult until = run_text(start + floor_of("", "stop"));
    ASSERT_EQ(until.status, RunStatus::stopped);
    const Matrix3 inertia = inertia_of_box(until.final.bodies[0]);
    const auto momentum = [&](const Vector3& v, const Vector3& w) {
      return Vector3(2.5 * (hit.position - hit.point).cross(v) + inertia * w);
    };
    EXPECT_LT((momentum(hit.velocity_after, hit.angular_velocity_after) -
               momentum(hit.velocity_before, hit.angular_velocity_before))
                  .norm(),
              1e-10);
    EXPECT_LT((hit.impulse - 2.5 * (hit.velocity_after - hit.velocity_before)).norm(), kRounding * 10);
    EXPECT_LE(hit.impulse.head<2>().norm(), 0.4 * hit.impulse.z() * (1.0 + 1e-12));
    const auto energy = [&](const Vector3& v, const Vector3& w) {
      return 1.25 * v.squaredNorm() + 0.5 * w.dot(inertia * w);
    };
    const double gain = energy(hit.velocity_after, hit.angular_velocity_after) -
                        energy(hit.velocity_before, hit.angular_velocity_before);
    bool says = false;
    for (const std::string& warning : result.warnings) says = says || warning.find(" gains ") != std::string::npos;
    EXPECT_TRUE(says || gain <= 1e-9);
    if (law != "newton") {
      EXPECT_LE(gain, 1e-10);
      EXPECT_FALSE(says);
    }
    gained += gain > 1e-9 ? 1 : 0;
  }
  EXPECT_GT(gained, 0);
}

TEST(FrictionImpacts, BodiesKeepMomentumWhateverTheirOrder) {
  Boxes boxes(11);
  int met = 0;
  for (int i = 0; i < 60; ++i) {
    const std::string surface = "restitution = 0.8\nfriction = 0.5\n";
    const std::string a = boxes.box("a", {0, 0, 0}, boxes.any(0.2), surface);
    const std::string b = boxes.box("b", {2, 0, 0}, Vector3(-1, 0, 0) + boxes.any(0.2), surface);
    const std::string time = "[time]\nend = 1.6\n";
    const RunResult result = run_text(time + a + b), swapped = run_text(time + b + a);
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    ASSERT_EQ(result.impacts.size(), swapped.impacts.size());
    if (result.impacts.empty()) continue;
    ++met;
    const auto momentum = [](const Sample& sample) {
      Vector3 linear(0, 0, 0), angular(0, 0, 0);
      for (const BodyState& body : sample.bodies) {
        linear += 2.5 * body.velocity;
        angular += 2.5 * body.position.cross(body.velocity) + inertia_of_box(body) * body.angular_velocity;
      }
      return std::pair(linear, angular);
    };
    const auto before = momentum(run_text("[time]\nend = 0\n" + a + b).final), after = momentum(result.final);
    EXPECT_LT((after.first - before.first).norm(), 1e-10) << i;
    EXPECT_LT((after.second - before.second).norm(), 1e-10) << i;
    for (const char* name : {"a", "b"})
      EXPECT_LT((final_of(result, name).position - final_of(swapped, name).position).norm(), 1e-10) << i;
    const Impact& hit = result.impacts[0];
    const double push = hit.normal.dot(hit.impulse);
    EXPECT_GT(push, 0.0);
    EXPECT_LE((hit.impulse - push * hit.normal).norm(), 0.5 * push * (1.0 + 1e-11));
  }
  EXPECT_GT(met, 30);
}

TEST(FrictionImpacts, ErrorsAreCarriedThroughThem) {
  const auto scene = [](double friction, const std::string& method) {
    return "[time]\nend = 2.5\nsample = 2.5\n[method]\n" + method +
           "[[body]]\nname = \"ball\"\nshape = \"sphere\"\nradius = 0.1\nmass = 1\nposition = [0, 0, 1]\n"
           "velocity = [2, 1, 0]\nangular_velocity = [10, 5, 3]\nforce = \"[0, 0, -9.8] - 0.2*norm(v)*v\"\n" +
           floor_of("friction = " + number(friction) + "\nrestitution = 0.85\n");
  };
  const RunResult exact = run_text(scene(0.15, "name = \"taylor\"\nrtol = 1e-14\natol = 1e-14\n"));
  ASSERT_GT(exact.impacts.size(), 4u);
  for (const double tolerance : {1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10}) {
    const std::string method =
        "name = \"dopri5\"\nrtol = " + number(tolerance) + "\natol = " + number(tolerance) + "\n";
    const BodyState coarse = final_of(run_text(scene(0.15, method)), "ball");
    const BodyState smooth = final_of(run_text(scene(0.0, method)), "ball");
    EXPECT_LT((coarse.position - final_of(exact, "ball").position).norm(), *coarse.position_error_bound) << tolerance;
    // what the impacts make of errors is not far from what they make of them without friction
    EXPECT_NEAR(std::log10(*coarse.position_error_bound / *smooth.position_error_bound), 0.0, 0.5) << tolerance;
    EXPECT_NEAR(std::log10(*coarse.velocity_error_bound / *smooth.velocity_error_bound), 0.0, 0.5) << tolerance;
  }
}

}  // namespace
}  // namespace trajet
