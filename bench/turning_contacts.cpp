#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "boxes.hpp"
#include "trajet/collide/detect/turning_contact.hpp"
#include "trajet/ode/solve.hpp"
#include "work_precision.hpp"

/// First contacts of tumbling solids, one query of one pair on one Segment of each. The error is that of the time of
/// contact, the largest of all queries, in s: what is left of the separation there over the speed of approach.
namespace trajet::bench {
namespace {

struct Query {
  std::shared_ptr<const ConvexCore> a{};
  std::shared_ptr<const ConvexCore> b{};
  std::shared_ptr<const FramePath> path_a{};
  std::shared_ptr<const FramePath> path_b{};
  double from = 0.0;
  double to = 0.0;
  TurningMemory memory{};  ///< of the Segment before

  TurningContact operator()() const { return first_contact(*a, *path_a, *b, *path_b, from, to, memory); }
};

class QueryMaker {
 public:
  using Core = std::shared_ptr<const ConvexCore>;

  Core box() { return core(convex_core(Cuboid{{size(), size(), size()}})); }
  Core hull(int count) {
    std::vector<Vector3> points;
    while (static_cast<int>(points.size()) < count) points.push_back(0.3 * direction());
    return core(hull_core(convex_hull(points)));
  }
  static Core core(ConvexCore c) { return std::make_shared<const ConvexCore>(std::move(c)); }

  /// The queries of a flight of b past a, or onto the ground, up to their contact.
  void add(const Core& a, const Core& b) {
    constexpr double kDuration = 0.25;
    const bool is_ground = a->is_half_space;
    const auto path_a = is_ground ? std::vector{std::make_shared<const FramePath>(
                                        FramePath::at_rest(Vector3::Zero(), Quaternion::Identity()))}
                                  : fly(Vector3::Zero(), Vector3::Zero(), kDuration);
    const Vector3 v = is_ground ? Vector3(0, 0, -3) : Vector3(direction() * 8.0);
    const Vector3 r = is_ground ? Vector3(0, 0, 0.9) : Vector3(-0.2 * v + 0.2 * direction());
    const auto path_b = fly(r, v, kDuration);
    Query query{a, b, path_a[0], path_b[0], 0.0, 0.0, {}};
    for (std::size_t i = 0, j = 0; query.from < kDuration;) {
      query.path_a = path_a[i];
      query.path_b = path_b[j];
      query.to = is_ground ? path_b[j]->t1() : std::min(path_a[i]->t1(), path_b[j]->t1());
      const TurningContact c = query();
      queries.push_back(query);
      if (c.status != ContactStatus::separated) return;
      query.memory = c.memory;
      query.from = query.to;
      if (!is_ground && path_a[i]->t1() <= query.to) ++i;
      if (path_b[j]->t1() <= query.to) ++j;
    }
  }

  std::vector<Query> queries{};

 private:
  double size() { return std::uniform_real_distribution<>(0.1, 0.4)(random_); }
  Vector3 direction() {
    std::normal_distribution<> n;
    return Vector3(n(random_), n(random_), n(random_)).normalized();
  }
  std::vector<std::shared_ptr<const FramePath>> fly(const Vector3& r, const Vector3& v, double duration) {
    const Quaternion q = from_axis_angle<double>(direction(), 2.0 * size());
    Eigen::Matrix<double, 13, 1> start;
    start << r, v, q.w(), q.x(), q.y(), q.z(), 10.0 * direction();
    SolveOptions options;
    options.rtol = options.atol = 1e-13;
    const auto run = solve<Taylor>(FreeBox{{1.0, 1.5, 2.0}}, 0.0, start, duration, options);
    std::vector<std::shared_ptr<const FramePath>> paths;
    for (const auto& s : run.segments) {
      FramePath::Coefficients c(7, s.coefficients().cols());
      c << s.coefficients().topRows<3>(), s.coefficients().middleRows<4>(6);
      paths.push_back(std::make_shared<const FramePath>(s.t0(), s.t1(), c));
    }
    return paths;
  }

  std::mt19937_64 random_{1};
};

/// By all vertices, along the normal that was told.
double time_error(const Query& q, const TurningContact& c) {
  const FramePose a = q.path_a->pose(c.time), b = q.path_b->pose(c.time);
  const double low =
      q.a->is_half_space ? 0.0 : c.normal.dot(a.p_WB) - support(*q.a, -(a.R_WB.transpose() * c.normal)).height;
  const double high = c.normal.dot(b.p_WB) + support(*q.b, b.R_WB.transpose() * c.normal).height;
  return std::abs((low - high) / c.gap_rate);
}

void add(const char* name, const QueryMaker& maker) {
  double worst = 0.0;
  for (const Query& q : maker.queries)
    if (const TurningContact c = q(); c.status == ContactStatus::hit) worst = std::max(worst, time_error(q, c));
  const auto queries = std::make_shared<const std::vector<Query>>(maker.queries);
  const auto next = std::make_shared<std::size_t>(0);
  add_case({name, Contender::law, "first_contact"}, [queries, next, worst] {
    const TurningContact c = (*queries)[*next]();
    benchmark::DoNotOptimize(c.time);
    *next = (*next + 1) % queries->size();
    return worst;
  });
}

}  // namespace

void add_turning_contacts() {
  constexpr int kFlights = 200;
  QueryMaker plane, boxes, hulls;
  const auto ground = QueryMaker::core(convex_core(HalfSpace{}));
  for (int i = 0; i < kFlights; ++i) {
    plane.add(ground, plane.box());
    boxes.add(boxes.box(), boxes.box());
    hulls.add(hulls.hull(40), hulls.hull(40));
  }
  add("C1 box over plane", plane);
  add("C2 box and box", boxes);
  add("C3 hulls of 40 corners", hulls);
}

}  // namespace trajet::bench
