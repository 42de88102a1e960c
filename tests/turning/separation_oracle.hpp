#pragma once

// Whether two solids overlap at a time, and when first, by brute force in extended precision. Shares with the search
// under test the numbers that describe solids and paths, and nothing else.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "moving_solid.hpp"
#include "trajet/portable.hpp"

namespace trajet::turning {

using VectorX3 = Eigen::Matrix<Extended, 3, 1>;

/// Points of a path at one time.
struct ExtendedPose {
  VectorX3 r = VectorX3::Zero();
  Eigen::Matrix<Extended, 3, 3> R = Eigen::Matrix<Extended, 3, 3>::Identity();

  ExtendedPose(const FramePath& path, Extended t) {
    const Extended tau = path.is_at_rest() ? Extended(0) : t - Extended(path.t0());
    const FramePath::Coefficients rows = path.coefficients();
    Extended x[7];
    for (int i = 0; i < 7; ++i) {
      x[i] = 0;
      for (Eigen::Index k = rows.cols(); k-- > 0;) x[i] = x[i] * tau + Extended(rows(i, k));
    }
    r << x[0], x[1], x[2];
    const Extended w = x[3], a = x[4], b = x[5], c = x[6], n = w * w + a * a + b * b + c * c;
    R << (w * w + a * a - b * b - c * c) / n, 2 * (a * b - w * c) / n, 2 * (a * c + w * b) / n, 2 * (a * b + w * c) / n,
        (w * w - a * a + b * b - c * c) / n, 2 * (b * c - w * a) / n, 2 * (a * c - w * b) / n, 2 * (b * c + w * a) / n,
        (w * w - a * a - b * b + c * c) / n;
  }
  VectorX3 operator()(const Vector3& p) const { return r + R * p.cast<Extended>(); }
};

class SeparationOracle {
 public:
  /// `speed`: an upper bound of that of any point against any of the other solid.
  SeparationOracle(const ConvexCore& A, const FramePath& a, const ConvexCore& B, const FramePath& b, Extended speed)
      : A_(A), B_(B), a_(a), b_(b), speed_(speed), p_(A.vertices.size()), q_(B.vertices.size()) {}

  /// Positive exactly where the solids are apart, and then no more than their distance. Any lower bound above `enough`
  /// will do.
  Extended gap(Extended t, Extended enough = 1e30L) const {
    const ExtendedPose pa(a_, t), pb(b_, t);
    const Extended rounding = Extended(A_.rounding) + Extended(B_.rounding);
    for (std::size_t i = 0; i < p_.size(); ++i) p_[i] = pa(A_.vertices[i]);
    for (std::size_t j = 0; j < q_.size(); ++j) q_[j] = pb(B_.vertices[j]);
    if (A_.is_half_space) return over(pa, q_) - rounding;
    if (B_.is_half_space) return over(pb, p_) - rounding;
    const Extended balls = (pb.r - pa.r).norm() - Extended(A_.reach) - Extended(B_.reach);
    if (balls > enough) return balls;
    return (rounding > 0 ? feature_distance() : axes(enough)) - rounding;
  }

  /// The first time, from `from` to the later `to`, at which the gap is not positive, or nothing: time is halved until
  /// the speed excludes a contact, down to 1e-16 s, so that nothing is passed over.
  std::optional<Extended> first(Extended from, Extended to) const { return first(from, to, 0); }
  /// The least gap that was met.
  Extended clearance() const { return clearance_; }
  /// The least gap and its time, to 1e-4 m.
  std::pair<Extended, Extended> least(Extended from, Extended to) const {
    std::pair<Extended, Extended> best{1e30L, from};
    descend(from, to, best);
    return best;
  }

 private:
  using Points = std::vector<VectorX3>;

  std::optional<Extended> first(Extended from, Extended to, int depth) const {
    const Extended middle = (from + to) / 2, reach = speed_ * (to - from) / 2, g = gap(middle, reach);
    clearance_ = std::min(clearance_, g);
    if (g > reach) return std::nullopt;
    if (to - from < 2e-16L || depth > 90) return g <= 0 ? std::optional(middle) : std::nullopt;
    if (const auto left = first(from, middle, depth + 1)) return left;
    if (g <= 0) return middle;
    return first(middle, to, depth + 1);
  }
  void descend(Extended from, Extended to, std::pair<Extended, Extended>& best) const {
    const Extended middle = (from + to) / 2, reach = speed_ * (to - from) / 2, g = gap(middle, best.first + reach);
    if (g < best.first) best = {g, middle};
    if (g - reach > best.first - 1e-4L || to - from < 2e-9L) return;
    descend(from, middle, best);
    descend(middle, to, best);
  }

  static Extended over(const ExtendedPose& plane, const Points& points) {
    Extended least = 1e30L;
    for (const VectorX3& q : points) least = std::min(least, plane.R.col(2).dot(q - plane.r));
    return least;
  }

  /// Along one direction or its opposite.
  Extended along(const VectorX3& n) const {
    const Extended norm = n.norm();
    if (norm < 1e-12L) return -1e30L;
    Extended low_a = 1e30L, high_a = -1e30L, low_b = 1e30L, high_b = -1e30L;
    for (const VectorX3& p : p_) low_a = std::min(low_a, n.dot(p)), high_a = std::max(high_a, n.dot(p));
    for (const VectorX3& q : q_) low_b = std::min(low_b, n.dot(q)), high_b = std::max(high_b, n.dot(q));
    return std::max(low_b - high_a, low_a - high_b) / norm;
  }
  static VectorX3 edge(const Points& x, const CoreEdge& e) { return at(x, e.to) - at(x, e.from); }
  static const VectorX3& at(const Points& x, int i) { return x[static_cast<std::size_t>(i)]; }
  static VectorX3 normal(const Points& x, const CoreFace& f) {
    return (at(x, f.loop[1]) - at(x, f.loop[0])).cross(at(x, f.loop[2]) - at(x, f.loop[0]));
  }

  /// All faces and all pairs of edges; the last best axis first.
  Extended axes(Extended enough) const {
    const std::size_t na = A_.faces.size(), nb = B_.faces.size(), ne = B_.edges.size();
    const auto axis = [&](std::size_t k) {
      if (k < na) return normal(p_, A_.faces[k]);
      if (k < na + nb) return normal(q_, B_.faces[k - na]);
      if (ne == 0 || A_.edges.empty()) return VectorX3(VectorX3::Zero());
      return VectorX3(edge(p_, A_.edges[(k - na - nb) / ne]).cross(edge(q_, B_.edges[(k - na - nb) % ne])));
    };
    Extended best = along(axis(last_));
    if (best > enough) return best;
    const auto offer = [&](std::size_t k, Extended s) {
      if (s > best) best = s, last_ = k;
    };
    for (std::size_t k = 0; k < na + nb; ++k) offer(k, along(axis(k)));
    if (best > enough) return best;
    if (A_.edges.size() * ne <= 400) {
      for (std::size_t k = na + nb; k < na + nb + A_.edges.size() * ne; ++k) offer(k, along(axis(k)));
      return best;
    }
    // of many edges only those that are support along their product, by the vertices of the faces beside them
    const auto beside_a = beside(A_), beside_b = beside(B_);
    for (std::size_t i = 0; i < A_.edges.size(); ++i)
      for (std::size_t j = 0; j < ne; ++j) {
        const VectorX3 n = edge(p_, A_.edges[i]).cross(edge(q_, B_.edges[j]));
        Extended most = -1e30L, least = 1e30L;
        for (const int v : beside_a[i]) {
          const Extended h = n.dot(at(p_, v) - at(p_, A_.edges[i].from));
          most = std::max(most, h), least = std::min(least, h);
        }
        for (const int v : beside_b[j]) {
          const Extended h = -n.dot(at(q_, v) - at(q_, B_.edges[j].from));
          most = std::max(most, h), least = std::min(least, h);
        }
        constexpr Extended kSlack = 1e-14L;
        if (most <= kSlack || least >= -kSlack) offer(na + nb + i * ne + j, along(n));
      }
    return best;
  }
  static std::vector<std::vector<int>> beside(const ConvexCore& core) {
    std::map<std::pair<int, int>, std::vector<int>> of;
    for (const CoreFace& f : core.faces)
      for (std::size_t k = 0; k < f.loop.size(); ++k) {
        const int v = f.loop[k], w = f.loop[(k + 1) % f.loop.size()];
        of[{std::min(v, w), std::max(v, w)}].push_back(f.loop[(k + 2) % f.loop.size()]);
      }
    std::vector<std::vector<int>> all;
    for (const CoreEdge& e : core.edges) all.push_back(of[{std::min(e.from, e.to), std::max(e.from, e.to)}]);
    return all;
  }

  static Extended to_stretch(const VectorX3& x, const VectorX3& o, const VectorX3& d) {
    const Extended s = d.squaredNorm() > 0 ? std::clamp<Extended>(d.dot(x - o) / d.squaredNorm(), 0, 1) : 0;
    return (x - o - s * d).norm();
  }
  static Extended stretches(const VectorX3& p, const VectorX3& d, const VectorX3& q, const VectorX3& e) {
    Extended best =
        std::min({to_stretch(p, q, e), to_stretch(p + d, q, e), to_stretch(q, p, d), to_stretch(q + e, p, d)});
    const VectorX3 n = d.cross(e), r = q - p;
    const Extended n2 = n.squaredNorm();
    if (n2 > 0) {
      const Extended s = n.dot(r.cross(e)) / n2, t = n.dot(r.cross(d)) / n2;
      if (s > 0 && s < 1 && t > 0 && t < 1) best = std::min(best, std::abs(n.dot(r)) / std::sqrt(n2));
    }
    return best;
  }
  /// Of the cores; zero where they meet.
  Extended feature_distance() const {
    Extended best = 1e30L;
    for (const VectorX3& p : p_)
      for (const VectorX3& q : q_) best = std::min(best, (q - p).norm());
    for (const CoreEdge& e : A_.edges)
      for (const VectorX3& q : q_) best = std::min(best, to_stretch(q, at(p_, e.from), edge(p_, e)));
    for (const CoreEdge& f : B_.edges)
      for (const VectorX3& p : p_) best = std::min(best, to_stretch(p, at(q_, f.from), edge(q_, f)));
    for (const CoreEdge& e : A_.edges)
      for (const CoreEdge& f : B_.edges)
        best = std::min(best, stretches(at(p_, e.from), edge(p_, e), at(q_, f.from), edge(q_, f)));
    return std::min({best, to_faces(A_, p_, B_, q_), to_faces(B_, q_, A_, p_)});
  }
  static bool is_over(const CoreFace& f, const Points& x, const VectorX3& n, const VectorX3& z) {
    for (std::size_t k = 0; k < f.loop.size(); ++k) {
      const VectorX3 e = at(x, f.loop[(k + 1) % f.loop.size()]) - at(x, f.loop[k]);
      if (n.cross(e).dot(z - at(x, f.loop[k])) < 0) return false;
    }
    return true;
  }
  /// Of the vertices of T over the faces of S; zero where a vertex is inside or an edge goes through a face.
  static Extended to_faces(const ConvexCore& S, const Points& x, const ConvexCore& T, const Points& y) {
    Extended best = 1e30L;
    std::vector<Extended> highest(y.size(), -1e30L);
    for (const CoreFace& f : S.faces) {
      const VectorX3 n = normal(x, f).normalized(), &o = at(x, f.loop[0]);
      for (std::size_t j = 0; j < y.size(); ++j) {
        const Extended h = n.dot(y[j] - o);
        highest[j] = std::max(highest[j], h);
        if (h >= 0 && is_over(f, x, n, y[j])) best = std::min(best, h);
      }
      for (const CoreEdge& e : T.edges) {
        const VectorX3 &u = at(y, e.from), &v = at(y, e.to);
        const Extended g = n.dot(u - o), h = n.dot(v - o);
        if ((g < 0) != (h < 0) && is_over(f, x, n, u + (v - u) * (g / (g - h)))) return 0;
      }
    }
    if (S.faces.size() > 2)
      for (const Extended h : highest)
        if (h < 0) return 0;
    return best;
  }

  const ConvexCore& A_;
  const ConvexCore& B_;
  const FramePath& a_;
  const FramePath& b_;
  Extended speed_;
  mutable Points p_;
  mutable Points q_;
  mutable std::size_t last_ = 0;
  mutable Extended clearance_ = 1e30L;
};

/// What the oracle says of two flights.
struct Truth {
  std::optional<Extended> time{};
  Extended clearance = 1e30L;
};

inline Truth truth(const Encounter& e, double from, double to) {
  Truth result;
  each_piece(e, from, to, [&](const FramePath& a, const FramePath& b, double begin, double end) {
    const SeparationOracle oracle(e.a.core, a, e.b.core, b, Extended(e.a.speed + e.b.speed) + 1e-3L);
    result.time = oracle.first(begin, end);
    result.clearance = std::min(result.clearance, oracle.clearance());
    return !result.time;
  });
  return result;
}

}  // namespace trajet::turning
