// Queries of a simulator of rigid bodies: edges against edges, vertices against triangles, on motions that are linear
// in position and rotation vector; against bisection of signed volumes.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>

#include "trajet/collide/detect/turning_contact.hpp"
#include "trajet/math/series.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

using Points = std::vector<Vector3>;

struct Motion {
  Vector3 position[2], rotation[2];

  template <class T>
  Vector3T<T> at(const T& t, const Vector3 (&ends)[2]) const {
    const Vector3 from = ends[0], change = ends[1] - ends[0];
    return {T(from.x()) + t * T(change.x()), T(from.y()) + t * T(change.y()), T(from.z()) + t * T(change.z())};
  }
  template <class T>
  QuaternionT<T> orientation(const T& t) const {
    // cos(x/2) and sin(x/2)/x are series in x^2 that converge everywhere; within a turn or two they keep their digits
    using std::cos, std::sin, std::sqrt;
    const Vector3T<T> r = at<T>(t, rotation);
    const T square = r.dot(r);
    T w(1.0), s(0.5);
    if (rotation[0].norm() < 7.0 && rotation[1].norm() < 7.0) {
      T cosine(1.0), sine(0.5);
      for (int k = 1; k <= 24; ++k) {
        cosine = cosine * square * T(-0.25 / ((2 * k - 1) * (2 * k)));
        sine = sine * square * T(-0.25 / ((2 * k) * (2 * k + 1)));
        w = w + cosine;
        s = s + sine;
      }
    } else {
      const T angle = sqrt(square);
      w = cos(T(0.5) * angle);
      s = sin(T(0.5) * angle) / angle;
    }
    return {w, s * r.x(), s * r.y(), s * r.z()};
  }
  Vector3 point(double t, const Vector3& p_B) const {
    return at<double>(t, position) + rotation_matrix(orientation<double>(t)) * p_B;
  }
};

struct Query {
  bool is_edges = false;
  Motion a{}, b{};
  Points of_a{}, of_b{};
};

std::vector<Query> read_queries() {
  std::ifstream file(TRAJET_SOURCE_DIR "/tests/data/rigid_queries.txt");
  std::vector<Query> queries;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream words(line);
    std::string type;
    words >> type;
    Query query{.is_edges = type == "ee"};
    const auto read = [&](Vector3& v) { words >> v.x() >> v.y() >> v.z(); };
    for (Motion* motion : {&query.a, &query.b})
      for (int end = 0; end < 2; ++end) {
        read(motion->position[end]);
        read(motion->rotation[end]);
      }
    query.of_a.resize(query.is_edges ? 2 : 1);
    query.of_b.resize(query.is_edges ? 2 : 3);
    for (Points* points : {&query.of_a, &query.of_b})
      for (Vector3& point : *points) read(point);
    EXPECT_TRUE(words) << line;
    queries.push_back(query);
  }
  return queries;
}

/// A thin core of one, two or three corners: a point, a stretch, a plate.
ConvexCore core_of(const Points& points) {
  if (points.size() == 1) {
    ConvexCore core = convex_core(Point{});
    core.vertices[0] = points[0];
    core.reach = points[0].norm();
    return core;
  }
  if (points.size() == 3) return convex_core(TriangularPlate{{points[0], points[1], points[2]}});
  ConvexCore core = convex_core(Capsule{1.0, 1.0});
  core.rounding = 0.0;
  core.vertices = points;
  core.reach = std::max(points[0].norm(), points[1].norm());
  core.edges[0].direction = (points[1] - points[0]).normalized();
  core.edges[0].length = (points[1] - points[0]).norm();
  return core;
}

/// Stretches of the motion that are short enough for their polynomials: a fiftieth of a radian.
int piece_count(const Query& query) {
  const auto turn = [](const Motion& motion) { return (motion.rotation[1] - motion.rotation[0]).norm(); };
  return 4 + static_cast<int>(50.0 * (turn(query.a) + turn(query.b)));
}

/// One of equal stretches of the motion as polynomials.
FramePath path_of(const Motion& motion, int piece, int count) {
  constexpr int kOrder = 12;
  using Power = Series<double, kOrder>;
  const double from = static_cast<double>(piece) / count;
  const Power t = Power::variable(from);
  const Vector3T<Power> r = motion.at<Power>(t, motion.position);
  const QuaternionT<Power> q = motion.orientation<Power>(t);
  const Power rows[] = {r.x(), r.y(), r.z(), q.w(), q.x(), q.y(), q.z()};
  FramePath::Coefficients coefficients(7, kOrder + 1);
  for (int i = 0; i < 7; ++i)
    for (int k = 0; k <= kOrder; ++k) coefficients(i, k) = rows[i][k];
  return {from, static_cast<double>(piece + 1) / count, coefficients};
}

/// The volume that vanishes where the four points lie in a plane.
double volume(const Query& query, double t) {
  const auto a = [&](std::size_t i) { return query.a.point(t, query.of_a[i]); };
  const auto b = [&](std::size_t i) { return query.b.point(t, query.of_b[i]); };
  if (query.is_edges) return (a(1) - a(0)).cross(b(1) - b(0)).dot(b(0) - a(0));
  return (b(1) - b(0)).cross(b(2) - b(0)).dot(a(0) - b(0));
}

/// How far within both features the place lies where they are in one plane: negative outside, of their sizes.
double inside(const Query& query, double t) {
  const auto a = [&](std::size_t i) { return query.a.point(t, query.of_a[i]); };
  const auto b = [&](std::size_t i) { return query.b.point(t, query.of_b[i]); };
  if (query.is_edges) {
    const Vector3 u = a(1) - a(0), v = b(1) - b(0), d = b(0) - a(0), n = u.cross(v);
    const double s = d.cross(v).dot(n) / n.squaredNorm(), r = d.cross(u).dot(n) / n.squaredNorm();
    return std::min({s, 1.0 - s, r, 1.0 - r});
  }
  const Vector3 n = (b(1) - b(0)).cross(b(2) - b(0)), p = a(0);
  double least = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 from = b(i), to = b((i + 1) % 3);
    least = std::min(least, (to - from).cross(p - from).dot(n) / n.squaredNorm());
  }
  return least;
}

struct Truth {
  std::optional<double> time{};
  double border = 1.0;  ///< how near to the border of a feature, or to parallel, a decision was
};

Truth first_time(const Query& query) {
  const int samples = 1000 * piece_count(query);
  Truth truth;
  double before = volume(query, 0.0);
  for (int i = 1; i <= samples; ++i) {
    double from = static_cast<double>(i - 1) / samples, to = static_cast<double>(i) / samples;
    const double behind = volume(query, to);
    if ((before < 0.0) != (behind < 0.0)) {
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (from + to);
        ((volume(query, middle) < 0.0) == (before < 0.0) ? from : to) = middle;
      }
      const double depth = inside(query, to);
      truth.border = std::min(truth.border, std::abs(depth));
      if (depth >= 0.0) {
        truth.time = to;
        return truth;
      }
    }
    before = behind;
  }
  return truth;
}

/// The query with b moved so that a place of the one feature and one of the other coincide at a time.
Query touching(Query query, std::mt19937& random) {
  std::uniform_real_distribution<> within(0.1, 0.9);
  const double time = within(random), s = within(random), r = within(random);
  const auto place = [&](const Motion& motion, const Points& points) {
    Vector3 p_B = points[0];
    if (points.size() > 1) p_B += s * (points[1] - points[0]);
    if (points.size() > 2) p_B += r * s * (points[2] - points[1]);
    return motion.point(time, p_B);
  };
  const Vector3 shift = place(query.a, query.of_a) - place(query.b, query.of_b);
  for (Vector3& position : query.b.position) position += shift;
  return query;
}

struct Count {
  int hits = 0, misses = 0, unclear = 0;
};

void compare(const Query& query, Count& count) {
  // where all four are in a plane at the start, rounding says on which side they begin
  if (std::abs(volume(query, 0.0)) < 1e-12) {
    ++count.unclear;
    return;
  }
  const ConvexCore a = core_of(query.of_a), b = core_of(query.of_b);
  std::optional<TurningContact> found;
  TurningMemory memory;
  const int pieces = piece_count(query);
  for (int piece = 0; piece < pieces && !found; ++piece) {
    const FramePath path_a = path_of(query.a, piece, pieces), path_b = path_of(query.b, piece, pieces);
    const TurningContact contact = first_contact(a, path_a, b, path_b, path_a.t0(), path_a.t1(), memory);
    if (contact.status != ContactStatus::separated) found = contact;
    memory = contact.memory;
  }
  const Truth truth = first_time(query);
  // a place within 1e-6 of the end of an edge or the border of a face is decided by rounding here
  if (truth.border < 1e-6) {
    ++count.unclear;
    return;
  }
  ASSERT_EQ(found.has_value(), truth.time.has_value());
  ++(found ? count.hits : count.misses);
  if (!found) return;
  EXPECT_NE(found->status, ContactStatus::unresolved);
  // bisection ends where the volume rounds to zero: some roundings of the lengths that it is made of, over its rate
  const double step = 1e-6, rate = (volume(query, *truth.time) - volume(query, *truth.time - step)) / step;
  const double size = query.a.point(*truth.time, query.of_a[0]).norm();
  const double edges = std::max(1.0, std::pow((query.of_b[1] - query.of_b[0]).norm(), 2.0));
  const double rounding = 1e-15 * (1.0 + size) * edges / std::max(std::abs(rate), 1e-12);
  EXPECT_NEAR(found->time, *truth.time, found->time_error_bound + rounding + 1e-12);
}

TEST(RigidQueries, ContactsAreWhereTheSignedVolumesSay) {
  std::mt19937 random(5);
  Count as_given, moved;
  const std::vector<Query> queries = read_queries();
  for (std::size_t i = 0; i < queries.size(); ++i) {
    SCOPED_TRACE("query " + std::to_string(i) + (queries[i].is_edges ? " ee" : " fv"));
    // 30,000 and 400,000 radians in one step are no motion that anybody meant
    if (piece_count(queries[i]) > 20000) continue;
    compare(queries[i], as_given);
    for (int k = 0; k < 3; ++k) compare(touching(queries[i], random), moved);
  }
  EXPECT_GT(as_given.misses, 150);
  EXPECT_GT(moved.hits, 400);
  EXPECT_LT(moved.unclear, 40);
}

}  // namespace
}  // namespace trajet
