#pragma once

#include <array>

#include "grown_gap.hpp"

namespace trajet::detail {

/// A triangle to which distances are enclosed, feature by feature. Over the inside the distance is |h|, the height;
/// beyond edge i, between its ends, it has the components h and m_i, how far the foot is past the edge; beyond corner i
/// also t_i, how far along edge i. Where a piece of a path may be near several features, the hull of what each says.
class TriangleDistance {
 public:
  TriangleDistance(const PointPath& path, const Triangle& triangle)
      : height_(path, triangle.normal, triangle.corners[0]) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3& corner = triangle.corners[i];
      const Vector3 edge = triangle.corners[(i + 1) % 3] - corner;
      length_[i] = edge.norm();
      past_[i] = Coordinate(path, edge_outward(triangle, static_cast<int>(i)), corner);
      along_[i] = Coordinate(path, edge / length_[i], corner);
    }
  }

  template <class Enclose>
  IntervalJet distance(const Enclose& enclose, double far) const {
    const IntervalJet h = enclose(height_);
    double least = least_size(h[0]);
    if (least > far) return far_away(least);
    std::array<IntervalJet, 3> m;
    bool is_inside = true, may_be_inside = true;
    for (std::size_t i = 0; i < 3; ++i) {
      m[i] = enclose(past_[i]);
      least = std::max(least, m[i][0].lower());
      is_inside = is_inside && m[i][0].upper() < 0.0;
      may_be_inside = may_be_inside && m[i][0].lower() <= 0.0;
    }
    if (least > far) return far_away(least);
    if (is_inside) return size_of(h);

    std::array<IntervalJet, 3> t;
    for (std::size_t i = 0; i < 3; ++i) t[i] = enclose(along_[i]);
    Hull result;
    if (may_be_inside) result.add(size_of(h));
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t before = (i + 2) % 3;
      const bool may_be_past = m[i][0].upper() >= 0.0;
      const bool may_be_between = t[i][0].upper() >= 0.0 && t[i][0].lower() <= length_[i];
      if (may_be_past && may_be_between) result.add(distance_of(std::array{h, clipped(m[i])}));
      const bool may_be_at_corner = t[i][0].lower() <= 0.0 && t[before][0].upper() >= length_[before];
      if (may_be_at_corner) result.add(distance_of(std::array{h, m[i], t[i]}));
    }
    return result.is_empty ? far_away(least) : result.hull;
  }

 private:
  struct Hull {
    IntervalJet hull{};
    bool is_empty = true;

    void add(const IntervalJet& f) {
      hull = is_empty ? f : IntervalJet::from([&](int k) { return boost::numeric::hull(hull[k], f[k]); });
      is_empty = false;
    }
  };

  /// |x|
  static IntervalJet size_of(const IntervalJet& x) {
    if (x[0].lower() > 0.0) return x;
    if (x[0].upper() < 0.0) return -x;
    IntervalJet size(Interval(0.0, std::max(x[0].upper(), -x[0].lower())));
    size[1] = boost::numeric::hull(x[1], -x[1]);
    size[2] = Interval::whole();
    return size;
  }

  /// Past an edge, values below 0 are none.
  static IntervalJet clipped(IntervalJet x) {
    x[0] = Interval(std::max(0.0, x[0].lower()), std::max(0.0, x[0].upper()));
    return x;
  }

  Coordinate height_;
  std::array<Coordinate, 3> past_, along_;
  std::array<double, 3> length_;
};

}  // namespace trajet::detail
