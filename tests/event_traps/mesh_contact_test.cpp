#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/geom/triangle_surface.hpp"
#include "trajet/ode/segment.hpp"

namespace trajet {
namespace {

Segment<6> flight(const Vector3& position, const Vector3& velocity, const Vector3& acceleration, double duration) {
  Segment<6> segment;
  segment.resize(6, 2);
  segment.set_interval(0.0, duration);
  segment.error_bound().setZero();
  segment.coefficients().col(0) << position, velocity;
  segment.coefficients().col(1) << velocity, acceleration;
  segment.coefficients().col(2) << 0.5 * acceleration, Vector3::Zero();
  return segment;
}

/// A level square of `count` x `count` cells of two triangles each, from (0, 0) to (1, 1), at heights z(x, y).
template <class Height>
TriangleMesh field(int count, const Height& height) {
  TriangleMesh mesh;
  for (int j = 0; j <= count; ++j)
    for (int i = 0; i <= count; ++i) {
      const double x = double(i) / count, y = double(j) / count;
      mesh.vertices.emplace_back(x, y, height(x, y));
    }
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i) {
      const int a = j * (count + 1) + i, b = a + 1, c = b + count + 1, d = a + count + 1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

TriangleMesh level(int count) {
  return field(count, [](double, double) { return 0.0; });
}

/// The corners of a cube of edge 2 around the origin, hull in triangles.
TriangleMesh cube() {
  std::vector<Vector3> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0);
  return convex_hull(corners);
}

struct Random {
  std::mt19937 engine{7};
  double uniform(double a, double b) { return a + (b - a) * double(engine()) / 4294967296.0; }
  Vector3 vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
};

/// All contacts of a flight, the body passing through.
std::vector<ContactResult> contacts(const Shape& shape, const Segment<6>& segment, double radius) {
  const PointPath path(segment, 0);
  std::vector<ContactResult> found;
  ContactMemory memory;
  double from = 0.0;
  while (found.size() < 100) {
    const ContactResult contact = first_contact(shape, {path, radius, from, segment.t1()}, memory);
    if (contact.status == ContactStatus::separated) break;
    found.push_back(contact);
    if (contact.status != ContactStatus::hit && contact.status != ContactStatus::graze) break;
    memory = contact.memory;
    from = contact.time;
  }
  return found;
}

TEST(MeshSurface, JoinsVerticesTurnsTrianglesAndKnowsWhatIsClosed) {
  TriangleMesh soup;  // no vertex shared, every second triangle turned around
  const TriangleMesh whole = cube();
  for (const auto& triangle : whole.triangles) {
    const int first = static_cast<int>(soup.vertices.size());
    for (const int corner : triangle) soup.vertices.push_back(whole.vertices[static_cast<std::size_t>(corner)]);
    soup.triangles.push_back(first % 2 == 0 ? std::array{first, first + 1, first + 2}
                                            : std::array{first, first + 2, first + 1});
  }
  soup.triangles.push_back({0, 0, 1});  // without area
  const MeshSurface surface = make_mesh_surface(soup);
  EXPECT_EQ(surface.triangles->mesh.vertices.size(), 8u);
  EXPECT_EQ(surface.triangles->size(), 12);
  EXPECT_TRUE(surface.triangles->is_closed);
  for (int i = 0; i < 12; ++i) {
    const Triangle triangle = surface.triangles->triangle(i);
    EXPECT_GT(triangle.normal.dot(triangle.corners[0]), 0.0);
  }
  EXPECT_FALSE(make_mesh_surface(level(3)).triangles->is_closed);
  EXPECT_NEAR(signed_distance(surface, Vector3(0.3, 0, 0)), -0.7, 1e-15);
  EXPECT_NEAR(signed_distance(surface, Vector3(3, 0, 0)), 2.0, 1e-15);
  EXPECT_NEAR(signed_distance(make_mesh_surface(level(3)), Vector3(0.5, 0.5, -2)), 2.0, 1e-15);
  EXPECT_THROW(make_mesh_surface(TriangleMesh{}), std::domain_error);
}

TEST(MeshContact, APointThroughAnEdgeOrACornerIsOneHit) {
  constexpr int kCount = 4;
  const Shape shape = make_mesh_surface(level(kCount));
  Random random;
  for (int i = 0; i < 2000; ++i) {
    // aimed at inner corners, at edges along the axes, at diagonals
    double x = (1 + i % 3) / 4.0, y = (1 + (i / 3) % 3) / 4.0;
    if (i % 4 == 1) x = random.uniform(0.05, 0.95);
    if (i % 4 == 2) y = random.uniform(0.05, 0.95);
    if (i % 4 == 3) x = y = random.uniform(0.05, 0.95);
    const Vector3 target(x, y, 0.0), acceleration = random.vector(1.0);
    Vector3 velocity = random.vector(1.0);
    velocity.z() = -random.uniform(0.001, 2.0);
    const double t = random.uniform(0.2, 1.5);
    const Vector3 start = target - t * velocity - 0.5 * t * t * acceleration;
    const Segment<6> segment = flight(start, velocity, acceleration, t + 1.0);
    const std::vector<ContactResult> found = contacts(shape, segment, 0.0);
    int at_target = 0;
    for (const ContactResult& contact : found) at_target += std::abs(contact.time - t) < 1e-9;
    // crossing rate z' = v_z + a_z t; nearly grazing flights cross twice at once
    if (std::abs(velocity.z() + acceleration.z() * t) < 0.05) continue;
    EXPECT_EQ(at_target, 1) << i;
  }
}

TEST(MeshContact, NoPointLeaksIntoAClosedSurface) {
  const MeshSurface surface = make_mesh_surface(cube());
  const TriangleMesh& mesh = surface.triangles->mesh;
  Random random;
  for (int i = 0; i < 3000; ++i) {
    // from outside to a place within, through a corner or a place on an edge
    const auto& triangle = mesh.triangles[static_cast<std::size_t>(random.uniform(0.0, 11.999))];
    const Vector3 &a = mesh.vertices[static_cast<std::size_t>(triangle[0])],
                  &b = mesh.vertices[static_cast<std::size_t>(triangle[1])];
    const Vector3 through = i % 3 == 0 ? a : Vector3(a + random.uniform(0.0, 1.0) * (b - a));
    const Vector3 inside = random.vector(0.9);
    const Vector3 velocity = inside - through;
    const Segment<6> segment = flight(through - velocity, velocity, Vector3::Zero(), 2.0);
    const std::vector<ContactResult> found = contacts(surface, segment, 0.0);
    ASSERT_EQ(found.size(), 1u) << i;
    EXPECT_NEAR(found[0].time, 1.0, 1e-12);
    EXPECT_EQ(found[0].direction, ContactDirection::entering);
    EXPECT_LT(found[0].normal.dot(velocity), 0.0);
  }
}

TEST(MeshContact, ABallMeetsALevelMeshAsThePlane) {
  const Shape shape = make_mesh_surface(level(5));
  const Shape plane = make_plane(Vector3::Zero(), Vector3::UnitZ());
  Random random;
  for (int i = 0; i < 500; ++i) {
    const double radius = random.uniform(0.02, 0.2), t = random.uniform(0.2, 1.0);
    // aimed at corners and edges of the cells, from above
    const Vector3 target(i % 2 == 0 ? 0.4 : random.uniform(0.25, 0.75), 0.6, radius);
    const Vector3 velocity(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), -random.uniform(0.5, 2.0));
    const Vector3 acceleration(0, 0, -9.81);
    const Vector3 start = target - t * velocity - 0.5 * t * t * acceleration;
    const Segment<6> segment = flight(start, velocity, acceleration, t + 0.001);
    const std::vector<ContactResult> on_mesh = contacts(shape, segment, radius),
                                     on_plane = contacts(plane, segment, radius);
    ASSERT_GE(on_mesh.size(), 1u);
    ASSERT_GE(on_plane.size(), 1u);
    EXPECT_NEAR(on_mesh[0].time, on_plane[0].time, 1e-13);
    EXPECT_LT((on_mesh[0].normal - Vector3::UnitZ()).norm(), 1e-6);
  }
}

TEST(MeshContact, ABallMeetsACubeOfTrianglesAsTheBox) {
  const Shape mesh = make_mesh_surface(cube());
  const Shape box = make_box(Vector3::Zero(), Vector3(2, 2, 2), Matrix3::Identity());
  Random random;
  int hits = 0;
  for (int i = 0; i < 1500; ++i) {
    const double radius = random.uniform(0.05, 0.5), t = random.uniform(0.3, 1.0);
    const Vector3 target = 1.6 * random.vector(1.0), velocity = random.vector(4.0), acceleration = random.vector(5.0);
    const Vector3 start = target - t * velocity - 0.5 * t * t * acceleration;
    if (std::get<Box>(box).half_size.norm() + radius > start.norm()) continue;
    const Segment<6> segment = flight(start, velocity, acceleration, 2.0 * t);
    const PointPath path(segment, 0);
    const ContactResult expected = first_contact(box, {path, radius, 0.0, 2.0 * t}),
                        found = first_contact(mesh, {path, radius, 0.0, 2.0 * t});
    ASSERT_EQ(found.status, expected.status) << i;
    if (found.status == ContactStatus::separated) continue;
    ++hits;
    EXPECT_NEAR(found.time, expected.time, 4.0 * (found.time_error_bound + expected.time_error_bound) + 1e-15);
    EXPECT_LT((found.point - expected.point).norm(), 1e-9);
  }
  EXPECT_GT(hits, 200);
}

}  // namespace
}  // namespace trajet
