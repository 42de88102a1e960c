#include "trajet/geom/closest_point.hpp"
#include "trajet/geom/distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "trajet/math/interval.hpp"

namespace trajet {
namespace {

const Matrix3 kTurned = Quaternion(0.8, 0.2, -0.4, 0.4).normalized().toRotationMatrix();

class DistanceTest : public testing::Test {
 protected:
  Vector3 random_vector(double size) {
    std::uniform_real_distribution<double> uniform(-size, size);
    return {uniform(engine_), uniform(engine_), uniform(engine_)};
  }
  double random_number() { return std::uniform_real_distribution<double>(0.0, 1.0)(engine_); }

  /// `closest` is on the shape at `distance` from p, and none of many random points of the shape is nearer.
  template <class RandomPoint>
  void expect_nearest(const Vector3& p, const Vector3& closest, double distance, const RandomPoint& point) {
    EXPECT_NEAR((p - closest).norm(), distance, 1e-14);
    for (int i = 0; i < 300; ++i) EXPECT_GE((p - point()).norm(), distance - 1e-14);
  }

  std::mt19937 engine_{17};
};

TEST_F(DistanceTest, OfPlaneAndSphereIsSigned) {
  const Plane plane = make_plane({0, 0, 1}, {0, 0, 5});
  EXPECT_EQ(signed_distance(plane, Vector3(7, 8, 3)), 2.0);
  EXPECT_EQ(signed_distance(plane, Vector3(7, 8, -3)), -4.0);
  EXPECT_EQ(closest_point(plane, Vector3(7, 8, 3)), Vector3(7, 8, 1));
  const Sphere sphere = make_sphere({1, 0, 0}, 2.0);
  EXPECT_EQ(signed_distance(sphere, Vector3(4, 4, 0)), 3.0);
  EXPECT_EQ(signed_distance(sphere, Vector3(1, 0, 0)), -2.0);
  EXPECT_TRUE(closest_point(sphere, Vector3(1, 0, 8)).isApprox(Vector3(1, 0, 2), 1e-15));
  EXPECT_EQ(closest_point(sphere, sphere.center), Vector3(3, 0, 0));
}

TEST_F(DistanceTest, OfDisk) {
  const Disk disk = make_disk({0.1, 0.2, 0.3}, kTurned.col(2) * 3.0, 0.7);
  for (int i = 0; i < 200; ++i) {
    const Vector3 p = random_vector(2.0);
    expect_nearest(p, closest_point(disk, p), distance(disk, p), [&] {
      const double angle = 2.0 * M_PI * random_number();
      return Vector3(disk.center + disk.radius * random_number() *
                                       (std::cos(angle) * kTurned.col(0) + std::sin(angle) * kTurned.col(1)));
    });
  }
}

TEST_F(DistanceTest, OfRectangle) {
  // `up` is made orthogonal to the normal.
  const Rectangle rectangle =
      make_rectangle({0.1, 0.2, 0.3}, kTurned.col(2), kTurned.col(1) + 0.3 * kTurned.col(2), 1.0, 0.6);
  EXPECT_NEAR(rectangle.up.dot(rectangle.normal), 0.0, 1e-16);
  for (int i = 0; i < 200; ++i) {
    const Vector3 p = random_vector(1.5);
    expect_nearest(p, closest_point(rectangle, p), distance(rectangle, p), [&] {
      return Vector3(rectangle.center + (random_number() - 0.5) * 1.0 * kTurned.col(0) +
                     (random_number() - 0.5) * 0.6 * kTurned.col(1));
    });
  }
}

TEST_F(DistanceTest, OfTriangle) {
  const Triangle triangle = make_triangle({0.1, 0.2, 0.3}, {1.0, -0.3, 0.2}, {0.4, 0.9, -0.5});
  for (int i = 0; i < 300; ++i) {
    const Vector3 p = random_vector(1.5);
    expect_nearest(p, closest_point(triangle, p), distance(triangle, p), [&] {
      double u = random_number();
      double v = random_number();
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      return Vector3(triangle.corners[0] + u * (triangle.corners[1] - triangle.corners[0]) +
                     v * (triangle.corners[2] - triangle.corners[0]));
    });
    const Vector3 foot = p - height(triangle, p) * triangle.normal;
    EXPECT_EQ(in_plane_gap(triangle, p) <= 0.0, (closest_point(triangle, p) - foot).norm() < 1e-14);
  }
}

TEST_F(DistanceTest, OfBoxInsideAndOutside) {
  const Box box = make_box({0.1, 0.2, 0.3}, {1.0, 0.6, 1.4}, kTurned);
  for (int i = 0; i < 300; ++i) {
    const Vector3 p = random_vector(1.5);
    const double signed_gap = signed_distance(box, p);
    EXPECT_EQ(face_gap(box, p) <= 0.0, signed_gap <= 0.0);
    EXPECT_NEAR((p - closest_point(box, p)).norm(), std::abs(signed_gap), 1e-14);
    if (signed_gap <= 0.0) {
      EXPECT_EQ(distance(box, p), 0.0);
      EXPECT_EQ(face_gap(box, p), signed_gap);
      continue;
    }
    expect_nearest(p, closest_point(box, p), distance(box, p), [&] {
      const Vector3 q((random_number() - 0.5) * 1.0, (random_number() - 0.5) * 0.6, (random_number() - 0.5) * 1.4);
      return Vector3(box.center + kTurned * q);
    });
  }
}

// Along a path that passes faces, edges and corners, on pieces of it: value, rate and second derivative are enclosed.
template <class Gap>
void expect_enclosed(const Gap& gap) {
  const auto path = [](const auto& t) {
    using T = std::decay_t<decltype(t)>;
    return Vector3T<T>(T(2.0) * t - T(1.0), T(0.3) + T(0.4) * t, T(1.0) - T(1.7) * t + T(0.9) * t * t);
  };
  for (int piece = 0; piece < 64; ++piece) {
    const double begin = -0.5 + piece / 32.0;
    const IntervalJet enclosure = gap(path(IntervalJet::variable(Interval(begin, begin + 1.0 / 32.0))));
    for (int i = 0; i <= 8; ++i) {
      const double t = begin + i / 256.0;
      // Central differences, whose errors of 1e-10 (rate) and 1e-6 (second derivative) are allowed for.
      constexpr double kStep = 1e-5;
      const double before = gap(path(t - kStep));
      const double value = gap(path(t));
      const double after = gap(path(t + kStep));
      EXPECT_LE(enclosure[0].lower(), value + 1e-15);
      EXPECT_GE(enclosure[0].upper(), value - 1e-15);
      if (i == 0 || i == 8) continue;
      EXPECT_LE(enclosure[1].lower(), (after - before) / (2.0 * kStep) + 1e-9);
      EXPECT_GE(enclosure[1].upper(), (after - before) / (2.0 * kStep) - 1e-9);
      const double half_curvature = 0.5 * ((after - value) - (value - before)) / (kStep * kStep);
      EXPECT_LE(enclosure[2].lower(), half_curvature + 1e-4);
      EXPECT_GE(enclosure[2].upper(), half_curvature - 1e-4);
    }
  }
}

TEST_F(DistanceTest, IsEnclosedOnIntervals) {
  const Box box = make_box({0.1, 0.4, 0.3}, {0.6, 0.2, 0.4}, kTurned);
  const Disk disk = make_disk({0.1, 0.4, 0.3}, kTurned.col(2), 0.3);
  const Rectangle rectangle = make_rectangle({0.1, 0.4, 0.3}, kTurned.col(2), kTurned.col(1), 0.5, 0.3);
  const Triangle triangle = make_triangle({0.1, 0.2, 0.3}, {0.5, 0.4, 0.2}, {0.0, 0.9, 0.1});
  const Sphere sphere = make_sphere({0.1, 0.4, 0.3}, 0.3);
  expect_enclosed([&](const auto& p) { return distance(box, p); });
  expect_enclosed([&](const auto& p) { return face_gap(box, p); });
  expect_enclosed([&](const auto& p) { return signed_distance(box, p); });
  expect_enclosed([&](const auto& p) { return distance(disk, p); });
  expect_enclosed([&](const auto& p) { return in_plane_gap(disk, p); });
  expect_enclosed([&](const auto& p) { return distance(rectangle, p); });
  expect_enclosed([&](const auto& p) { return in_plane_gap(rectangle, p); });
  expect_enclosed([&](const auto& p) { return distance(triangle, p); });
  expect_enclosed([&](const auto& p) { return in_plane_gap(triangle, p); });
  expect_enclosed([&](const auto& p) { return signed_distance(sphere, p); });
}

TEST_F(DistanceTest, BoundingBallsContainTheirShapes) {
  const Triangle triangle = make_triangle({0, 0, 0}, {3, 0, 0}, {0, 4, 0});
  for (const Vector3& corner : triangle.corners) {
    EXPECT_LE((corner - bounding_ball(triangle).center).norm(), bounding_ball(triangle).radius);
  }
  EXPECT_EQ(bounding_ball(make_box(Vector3::Zero(), {2, 4, 4}, kTurned)).radius, 3.0);
  EXPECT_EQ(bounding_ball(make_rectangle(Vector3::Zero(), Vector3::UnitZ(), Vector3::UnitY(), 6, 8)).radius, 5.0);
  EXPECT_EQ(bounding_ball(make_disk({1, 2, 3}, Vector3::UnitZ(), 2)).radius, 2.0);
  EXPECT_EQ(bounding_ball(make_sphere({1, 2, 3}, 2)).center, Vector3(1, 2, 3));
}

TEST(Shapes, RefuseWhatDescribesNone) {
  const Vector3 o = Vector3::Zero();
  const Vector3 x = Vector3::UnitX();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(make_plane(o, o), std::domain_error);
  EXPECT_THROW(make_plane({nan, 0, 0}, x), std::domain_error);
  EXPECT_THROW(make_plane(o, {infinity, 0, 0}), std::domain_error);
  EXPECT_THROW(make_disk(o, x, 0.0), std::domain_error);
  EXPECT_THROW(make_disk(o, x, -1.0), std::domain_error);
  EXPECT_THROW(make_disk(o, x, nan), std::domain_error);
  EXPECT_THROW(make_rectangle(o, x, x, 1.0, 1.0), std::domain_error);
  EXPECT_THROW(make_rectangle(o, x, Vector3::UnitY(), 0.0, 1.0), std::domain_error);
  EXPECT_THROW(make_triangle(o, x, 2.0 * x), std::domain_error);
  EXPECT_THROW(make_triangle(o, o, o), std::domain_error);
  EXPECT_THROW(make_sphere(o, infinity), std::domain_error);
  EXPECT_THROW(make_box(o, {1, -1, 1}, Matrix3::Identity()), std::domain_error);
  EXPECT_THROW(make_box(o, {1, 1, 1}, 2.0 * Matrix3::Identity()), std::domain_error);
  EXPECT_THROW(make_box(o, {1, 1, 1}, -Matrix3::Identity()), std::domain_error);
  // Any length of a direction will do.
  EXPECT_EQ(make_plane(o, {0, 0, 1e-200}).normal, Vector3::UnitZ());
  EXPECT_EQ(make_plane(o, {0, 0, 1e200}).normal, Vector3::UnitZ());
}

}  // namespace
}  // namespace trajet
