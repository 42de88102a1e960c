#pragma once

// Random pairs of solids in flight.

#include <algorithm>
#include <cstdlib>

#include "moving_solid.hpp"

namespace trajet::turning {

class RandomFlights {
 public:
  explicit RandomFlights(std::uint64_t seed) : random_(seed) {}

  double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  Vector3 direction() {
    std::normal_distribution<double> n;
    return Vector3(n(random_), n(random_), n(random_)).normalized();
  }
  Quaternion turn() {
    std::normal_distribution<double> n;
    return Quaternion(n(random_), n(random_), n(random_), n(random_)).normalized();
  }

  ConvexCore core(const std::string& kind) {
    if (kind == "plane") return convex_core(HalfSpace{});
    if (kind == "box") return convex_core(Cuboid{{uniform(0.05, 0.4), uniform(0.05, 0.4), uniform(0.05, 0.4)}});
    if (kind == "ball") return convex_core(Ball{uniform(0.05, 0.3)});
    if (kind == "point") return convex_core(Point{});
    if (kind == "blade") return convex_core(Cuboid{{uniform(0.1, 0.3), uniform(0.1, 0.3), uniform(2e-4, 2e-3)}});
    if (kind == "plate") return convex_core(RectangularPlate{uniform(0.1, 0.3), uniform(0.1, 0.3)});
    if (kind == "capsule") return convex_core(Capsule{uniform(0.02, 0.2), uniform(0.05, 0.4)});
    if (kind == "soccer") return convex_core(SoccerBall{uniform(0.1, 0.3)});
    if (kind == "cylinder") return convex_core(Cylinder{uniform(0.05, 0.3), uniform(0.05, 0.3)});
    if (kind == "disk") return convex_core(RoundPlate{uniform(0.1, 0.3)});
    if (kind == "cone") {
      const double height = uniform(0.1, 0.5);
      return cone_core(uniform(0.05, 0.3), -0.25 * height, 0.75 * height);
    }
    if (kind == "ellipsoid") return ellipsoid_core({uniform(0.05, 0.4), uniform(0.05, 0.4), uniform(0.05, 0.4)});
    if (kind == "rounded-box") {
      ConvexCore box = convex_core(Cuboid{{uniform(0.05, 0.3), uniform(0.05, 0.3), uniform(0.05, 0.3)}});
      box.rounding = uniform(0.01, 0.1);
      box.reach += box.rounding;
      return box;
    }
    if (kind == "triangle")
      for (;;) {
        const Vector3 a = direction() * uniform(0.2, 0.8), b = direction() * uniform(0.2, 0.8), c = -a - b;
        if ((b - a).cross(c - a).norm() > 0.05) return polygon_core({a, b, c});
      }
    const Vector3 axes(uniform(0.1, 0.4), uniform(0.1, 0.4), uniform(0.1, 0.4));
    std::vector<Vector3> points;
    const int count = std::uniform_int_distribution<int>(4, 60)(random_);
    while (static_cast<int>(points.size()) < count) points.push_back(axes.cwiseProduct(direction()));
    return hull_core(convex_hull(points));
  }

  MovingSolid solid(const std::string& kind, const Vector3& r, const Vector3& v, double rate, double duration) {
    MovingSolid s;
    s.core = core(kind);
    const Vector3 d(uniform(0.3, 1), uniform(0.3, 1), uniform(0.3, 1));
    s.inertia = Vector3(d[1] + d[2], d[2] + d[0], d[0] + d[1]);
    set_flight(s, free_state(r, v, turn(), direction() * rate), 9.81, 0.0, duration);
    return s;
  }

  /// `b` flies towards `a`, which flies too, or rests where its name starts with "static-".
  Encounter encounter(const std::string& b, std::string a, double max_rate, double duration) {
    Encounter e;
    e.to = duration;
    const double rate = max_rate * std::pow(10.0, -uniform(0, 1.5));
    if (a == "plane") {
      e.a.core = core(a);
      rest(e.a, direction() * uniform(0, 0.3), turn());
      const FramePose pose = e.a.flight[0].pose(0.0);
      const Vector3 n = pose.R_WB.col(2);
      e.b = solid(b, Vector3::Zero(), -n * uniform(-0.5, 5.0) + direction() * uniform(0, 2), rate, duration);
      shift(e.b, pose.p_WB + n * (e.b.core.reach + uniform(0.001, 0.5)));
      return e;
    }
    const bool is_static = a.rfind("static-", 0) == 0;
    if (is_static) {
      e.a.core = core(a.substr(7));
      rest(e.a, direction() * uniform(0, 0.3), turn());
    } else {
      e.a = solid(a, direction() * uniform(0, 0.3), direction() * uniform(0, 3), rate * uniform(0.1, 1), duration);
    }
    const Vector3 v = direction() * uniform(0.5, 6);
    e.b = solid(b, Vector3::Zero(), v, rate, duration);
    const Vector3 target = e.a.flight[0].pose(0.0).p_WB;
    const double when = uniform(0.2, 1.2) * duration;
    Vector3 r = target + direction() * uniform(0, 0.8) * e.a.core.reach - v * when;
    if (is_static) r[2] += 0.5 * 9.81 * when * when;
    const double reach = e.a.core.reach + e.b.core.reach;
    if ((r - target).norm() < reach) r = target + (r - target).normalized() * (reach * uniform(1.0, 1.5));
    shift(e.b, r);
    return e;
  }

 private:
  std::mt19937_64 random_;
};

/// How many cases to run: more where the environment asks for it.
inline int cases(int count) {
  const char* factor = std::getenv("TRAJET_TURNING_CASES");
  return factor == nullptr ? count : static_cast<int>(count * std::atof(factor));
}

}  // namespace trajet::turning
