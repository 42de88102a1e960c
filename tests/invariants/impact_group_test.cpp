// Impacts at several contacts at one instant, as a function of velocities alone: what they keep, whatever the bodies.

#include "trajet/collide/respond/impact_group.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "trajet/collide/respond/frictional_impact.hpp"

namespace trajet::test {
namespace {

Vector3 random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

struct Scene {
  std::vector<GroupBody> bodies;
  std::vector<Vector3> places;  // of the centres, m
  std::vector<GroupContact> contacts;

  double speed(const std::vector<GroupBody>& moving, const GroupContact& contact) const {
    const GroupBody &a = moving[static_cast<std::size_t>(contact.first)],
                    &b = moving[static_cast<std::size_t>(contact.second)];
    return contact.normal.dot(a.velocity + a.angular_velocity.cross(contact.arm_first) - b.velocity -
                              b.angular_velocity.cross(contact.arm_second));
  }
  double energy(const std::vector<GroupBody>& moving) const {
    double sum = 0.0;
    for (const GroupBody& body : moving) sum += kinetic_energy(body);
    return sum;
  }
};

/// Points, balls and solids of masses over four orders, some fixed, with contacts anywhere.
Scene random_scene(std::mt19937& random, bool with_fixed) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  Scene scene;
  scene.bodies.resize(2 + random() % 4);
  for (GroupBody& body : scene.bodies) {
    scene.places.push_back(random_vector(random));
    if (with_fixed && part(random) < 0.25) continue;
    body.velocity = random_vector(random);
    body.inverse_mass = std::pow(10.0, 4.0 * part(random) - 2.0);
    if (part(random) < 0.3) continue;  // a point
    body.angular_velocity = random_vector(random);
    Matrix3 any;
    for (int i = 0; i < 9; ++i) any(i) = part(random) - 0.5;
    body.inverse_inertia = body.inverse_mass * (any * any.transpose() + 0.1 * Matrix3::Identity());
  }
  const int count = 1 + static_cast<int>(random() % 6), size = static_cast<int>(scene.bodies.size());
  const double common = part(random);
  const auto kind = random() % 4;
  while (static_cast<int>(scene.contacts.size()) < count) {
    const int first = static_cast<int>(random() % static_cast<unsigned>(size));
    const int second = static_cast<int>(random() % static_cast<unsigned>(size));
    if (first == second) continue;
    const Vector3 point = random_vector(random);
    const double e = kind == 0 ? 1.0 : kind == 1 ? 0.0 : kind == 2 ? common : part(random);
    scene.contacts.push_back({first, second, random_vector(random).normalized(),
                              point - scene.places[static_cast<std::size_t>(first)],
                              point - scene.places[static_cast<std::size_t>(second)], e});
    // points have no lever
    for (const int each : {first, second})
      if (scene.bodies[static_cast<std::size_t>(each)].inverse_inertia.isZero())
        (each == first ? scene.contacts.back().arm_first : scene.contacts.back().arm_second).setZero();
  }
  return scene;
}

constexpr Simultaneous kRules[] = {Simultaneous::reflections, Simultaneous::group};

double largest_speed(const std::vector<GroupBody>& bodies) {
  double most = 0.0;
  for (const GroupBody& body : bodies) most = std::max({most, body.velocity.norm(), body.angular_velocity.norm()});
  return most;
}

/// Coefficients from smooth to such that hold whatever slips.
void add_friction(Scene& scene, std::mt19937& random) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (GroupContact& contact : scene.contacts) contact.friction = random() % 3 == 0 ? 0.0 : 1.5 * part(random);
}

TEST(ImpactGroup, EnergyNeverGrowsAndNothingApproachesBehind) {
  std::mt19937 random(1);
  for (int sample = 0; sample < 50'000; ++sample) {
    Scene scene = random_scene(random, true);
    if (sample % 200 < 2) add_friction(scene, random);
    const Simultaneous rule = kRules[sample % 2];
    const GroupResponse response = resolve_group(scene.bodies, scene.contacts, rule);
    ASSERT_EQ(response.status, GroupResponse::Status::resolved) << sample;
    const double before = scene.energy(scene.bodies), after = scene.energy(response.after);
    ASSERT_LE(after, before * (1.0 + 1e-14)) << sample;
    // in Extended: of the velocities, rounded to double, and the arms, which are a few metres
    const double rounding = 1e-13 * std::max(largest_speed(scene.bodies), largest_speed(response.after));
    bool is_elastic = true;
    for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
      const GroupContact& contact = scene.contacts[i];
      is_elastic = is_elastic && contact.restitution.is_constant(1.0) && contact.friction == 0.0;
      ASSERT_GE(response.impulses[i], 0.0) << sample;
      ASSERT_LE(response.frictions[i].norm(), contact.friction * response.impulses[i] * (1.0 + 1e-14)) << sample;
      const bool moves = scene.bodies[static_cast<std::size_t>(contact.first)].inverse_mass > 0.0 ||
                         scene.bodies[static_cast<std::size_t>(contact.second)].inverse_mass > 0.0;
      ASSERT_TRUE(!moves || scene.speed(response.after, contact) >= -rounding) << sample;
    }
    // between contacts that let no velocity out, reflections have no end: the projection is it
    const bool is_reflected = is_elastic && !(response.rounds.size() > 0 && response.rounds.back().is_projection);
    ASSERT_TRUE(!is_reflected || after >= before * (1.0 - 1e-12)) << sample;
  }
}

TEST(ImpactGroup, MomentumAndAngularMomentumStay) {
  std::mt19937 random(2);
  for (int sample = 0; sample < 5'000; ++sample) {
    Scene scene = random_scene(random, false);
    for (GroupBody& body : scene.bodies)
      if (body.inverse_inertia.isZero()) body.inverse_inertia = body.inverse_mass * Matrix3::Identity();
    for (GroupContact& contact : scene.contacts) {
      const Vector3 point = scene.places[static_cast<std::size_t>(contact.first)] + contact.arm_first;
      contact.arm_second = point - scene.places[static_cast<std::size_t>(contact.second)];
    }
    if (sample % 100 < 2) add_friction(scene, random);
    const GroupResponse response = resolve_group(scene.bodies, scene.contacts, kRules[sample % 2]);
    Vector3 momentum = Vector3::Zero(), angular = Vector3::Zero();
    double size = 0.0;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const GroupBody &from = scene.bodies[i], &to = response.after[i];
      const Vector3 p = (to.velocity - from.velocity) / from.inverse_mass;
      const Vector3 L =
          scene.places[i].cross(p) + from.inverse_inertia.inverse() * (to.angular_velocity - from.angular_velocity);
      momentum += p;
      angular += L;
      size += (from.velocity.norm() + to.velocity.norm() + from.angular_velocity.norm() + to.angular_velocity.norm()) *
              10.0 / from.inverse_mass;
    }
    ASSERT_LE(momentum.norm(), 1e-13 * size) << sample;
    ASSERT_LE(angular.norm(), 1e-12 * size) << sample;
  }
}

TEST(ImpactGroup, TheOrderOfBodiesAndContactsDoesNotMatter) {
  std::mt19937 random(3);
  for (int sample = 0; sample < 5'000; ++sample) {
    Scene scene = random_scene(random, true);
    if (sample % 100 < 2) add_friction(scene, random);
    Scene other;
    const auto n = scene.bodies.size();
    std::vector<std::size_t> place(n);
    for (std::size_t i = 0; i < n; ++i) place[i] = i;
    std::shuffle(place.begin(), place.end(), random);
    other.bodies.resize(n);
    for (std::size_t i = 0; i < n; ++i) other.bodies[place[i]] = scene.bodies[i];
    for (GroupContact contact : scene.contacts) {
      contact.first = static_cast<int>(place[static_cast<std::size_t>(contact.first)]);
      contact.second = static_cast<int>(place[static_cast<std::size_t>(contact.second)]);
      if (random() % 2 == 0) {
        std::swap(contact.first, contact.second);
        std::swap(contact.arm_first, contact.arm_second);
        contact.normal = -contact.normal;
      }
      other.contacts.push_back(contact);
    }
    std::shuffle(other.contacts.begin(), other.contacts.end(), random);
    const Simultaneous rule = kRules[sample % 2];
    const GroupResponse a = resolve_group(scene.bodies, scene.contacts, rule),
                        b = resolve_group(other.bodies, other.contacts, rule);
    // one round after the other multiplies what one has rounded
    const double rounding =
        1e-12 * static_cast<double>(a.rounds.size()) * std::max(largest_speed(scene.bodies), largest_speed(a.after));
    if (a.rounds.size() > 30) continue;
    for (std::size_t i = 0; i < n; ++i) {
      ASSERT_NEAR((a.after[i].velocity - b.after[place[i]].velocity).norm(), 0.0, rounding) << sample;
      ASSERT_NEAR((a.after[i].angular_velocity - b.after[place[i]].angular_velocity).norm(), 0.0, rounding) << sample;
    }
  }
}

/// The conditions by which the projection is the only one are its proof: impulses push, only where contact stays, and
/// nothing approaches. With one restitution for all that come together, Moreau's law is (1 + e) P(v) - e v.
TEST(ImpactGroup, MoreausLawIsTheProjectionAndItsMirror) {
  std::mt19937 random(4);
  for (int sample = 0; sample < 20'000; ++sample) {
    Scene scene = random_scene(random, true);
    std::erase_if(scene.contacts, [&](const GroupContact& each) { return scene.speed(scene.bodies, each) > 0.0; });
    for (GroupContact& contact : scene.contacts) contact.restitution = 0.0;
    const GroupResponse plastic = resolve_group(scene.bodies, scene.contacts, Simultaneous::group),
                        reflected = resolve_group(scene.bodies, scene.contacts, Simultaneous::reflections);
    const double scale = largest_speed(scene.bodies) + largest_speed(plastic.after);
    for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
      const double speed = scene.speed(plastic.after, scene.contacts[i]);
      ASSERT_NEAR(plastic.impulses[i] * speed, 0.0, 1e-12 * scale * (1.0 + plastic.impulses[i])) << sample;
    }
    std::uniform_real_distribution<double> part(0.0, 1.0);
    const double e = part(random);
    for (GroupContact& contact : scene.contacts) contact.restitution = e;
    const GroupResponse bounced = resolve_group(scene.bodies, scene.contacts, Simultaneous::group);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const GroupBody& from = scene.bodies[i];
      ASSERT_EQ(plastic.after[i].velocity, reflected.after[i].velocity) << sample;
      const Vector3 v = (1.0 + e) * plastic.after[i].velocity - e * from.velocity;
      const Vector3 w = (1.0 + e) * plastic.after[i].angular_velocity - e * from.angular_velocity;
      ASSERT_NEAR((bounced.after[i].velocity - v).norm(), 0.0, 1e-12 * scale) << sample;
      ASSERT_NEAR((bounced.after[i].angular_velocity - w).norm(), 0.0, 1e-12 * scale) << sample;
    }
  }
}

std::vector<double> chain(Simultaneous rule, std::vector<double> velocities, double restitution = 1.0) {
  std::vector<GroupBody> balls(velocities.size());
  std::vector<GroupContact> contacts;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    balls[i].velocity = {velocities[i], 0.0, 0.0};
    balls[i].inverse_mass = 1.0;
    const int left = static_cast<int>(i) - 1;
    if (i > 0) contacts.push_back({left + 1, left, Vector3::UnitX(), {-1, 0, 0}, {1, 0, 0}, restitution});
  }
  const GroupResponse response = resolve_group(balls, contacts, rule);
  for (std::size_t i = 0; i < balls.size(); ++i) velocities[i] = response.after[i].velocity.x();
  return velocities;
}

TEST(ImpactGroup, OfATouchingCradleAsManyBallsLeaveAsCome) {
  using List = std::vector<double>;
  EXPECT_EQ(chain(Simultaneous::reflections, {1, 0, 0}), (List{0, 0, 1}));
  EXPECT_EQ(chain(Simultaneous::reflections, {1, 0, 0, 0, 0}), (List{0, 0, 0, 0, 1}));
  EXPECT_EQ(chain(Simultaneous::reflections, {1, 1, 0, 0, 0}), (List{0, 0, 0, 1, 1}));
  EXPECT_EQ(chain(Simultaneous::reflections, {1, 1, 1, 0, 0}), (List{0, 0, 1, 1, 1}));
  EXPECT_EQ(chain(Simultaneous::reflections, {1, 0, -1}), (List{-1, 0, 1}));
  // published: Moreau's law
  EXPECT_EQ(chain(Simultaneous::group, {1, 0, 0}), (List{-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0}));
  EXPECT_EQ(chain(Simultaneous::reflections, {3, 0, 0}, 0.0), (List{1, 1, 1}));
}

/// Of two balls friction is what the law of one contact says: it slides or grips.
TEST(ImpactGroup, FrictionOfTwoBallsIsThatOfTheLawOfOneContact) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  int grips = 0, slides = 0;
  for (int sample = 0; sample < 2'000; ++sample) {
    std::vector<GroupBody> balls(2);
    std::vector<ImpactSide> sides(2);
    const Vector3 normal = random_vector(random).normalized();
    std::vector<GroupContact> contacts{{.first = 0, .second = 1, .normal = normal, .restitution = part(random)}};
    for (std::size_t i = 0; i < 2; ++i) {
      const double radius = 0.5 + part(random);
      balls[i].velocity = random_vector(random);
      balls[i].angular_velocity = random_vector(random);
      balls[i].inverse_mass = 0.1 + part(random);
      balls[i].inverse_inertia = 2.5 / (radius * radius) * balls[i].inverse_mass * Matrix3::Identity();
      (i == 0 ? contacts[0].arm_first : contacts[0].arm_second) = (i == 0 ? -radius : radius) * normal;
      sides[i].velocity = balls[i].velocity;
      sides[i].angular_velocity = balls[i].angular_velocity;
      sides[i].inverse_mass = balls[i].inverse_mass;
      sides[i].inverse_inertia = balls[i].inverse_inertia;
      sides[i].arm = i == 0 ? contacts[0].arm_first : contacts[0].arm_second;
    }
    contacts[0].friction = 0.6 * part(random);
    const GroupResponse response = resolve_group(balls, contacts, kRules[sample % 2]);
    const FrictionalImpact alone = frictional_impact(sides[0], sides[1], normal, contacts[0].restitution.at(0.0),
                                                     {.coefficient = contacts[0].friction});
    (alone.grips ? grips : slides) += alone.impulse.isZero(0.0) ? 0 : 1;
    const Vector3 impulse = response.impulses[0] * normal + response.frictions[0];
    ASSERT_NEAR((impulse - alone.impulse).norm(), 0.0, 1e-12 * (1.0 + impulse.norm())) << sample;
  }
  EXPECT_GT(grips, 100);
  EXPECT_GT(slides, 100);
}

TEST(ImpactGroup, WallsThatCloseInOnABodyJamIt) {
  std::vector<GroupBody> bodies(3);
  bodies[0].inverse_mass = 1.0;
  bodies[1].velocity = Vector3::UnitX();
  bodies[2].velocity = -Vector3::UnitX();
  std::vector<GroupContact> contacts(2);
  contacts[0] = {.first = 0, .second = 1, .normal = Vector3::UnitX(), .restitution = 0.5};
  contacts[1] = {.first = 0, .second = 2, .normal = -Vector3::UnitX(), .restitution = 0.5};
  for (const Simultaneous rule : kRules)
    EXPECT_EQ(resolve_group(bodies, contacts, rule).status, GroupResponse::Status::jammed);
}

}  // namespace
}  // namespace trajet::test
