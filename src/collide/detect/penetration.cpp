#include "penetration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "trajet/math/polynomial.hpp"
#include "trajet/portable.hpp"

namespace trajet::detail {
namespace {

/// Of A - B, all in A's frame, rounding included.
class Difference {
 public:
  Difference(const ConvexCore& A, const ConvexCore& B, const RelativePose& pose) : A_(A), B_(B), pose_(pose) {}

  Vector3 farthest(const Vector3& n) const {
    return support(A_, n).point - pose_.p_AB - pose_.R_AB * support(B_, -(pose_.R_AB.transpose() * n)).point +
           (A_.rounding + B_.rounding) * n;
  }

 private:
  const ConvexCore& A_;
  const ConvexCore& B_;
  const RelativePose& pose_;
};

/// A triangle of the inner polytope.
struct Facet {
  std::array<int, 3> corners{};
  Vector3 normal = Vector3::Zero();
  double height = 0.0;  ///< of its plane over the origin
  double outer = 0.0;   ///< ... of the plane that supports the difference
  Vector3 farthest = Vector3::Zero();
};

/// Grows from inside, always where it is nearest to the origin.
class InnerPolytope {
 public:
  explicit InnerPolytope(const Difference& difference) : difference_(difference) {}

  /// From four points; false if they lie in a plane.
  bool begin() {
    const auto add = [&](const Vector3& n) { points_.push_back(difference_.farthest(n)); };
    add(Vector3::UnitX());
    add(-Vector3::UnitX());
    if (points_[0] == points_[1]) return false;
    Vector3 across = (points_[0] - points_[1]).unitOrthogonal();
    add(across);
    const auto off_line = [&](const Vector3& p) {
      return (points_[0] - points_[1]).normalized().cross(p - points_[1]).norm();
    };
    add(-across);
    if (off_line(points_[3]) > off_line(points_[2])) std::swap(points_[2], points_[3]);
    points_.pop_back();
    const Vector3 n = (points_[0] - points_[1]).cross(points_[2] - points_[1]);
    if (!(n.norm() > 0.0)) return false;
    const Vector3 up = n.normalized(), high = difference_.farthest(up), low = difference_.farthest(-up);
    const double above = up.dot(high - points_[0]), below = up.dot(points_[0] - low);
    points_.push_back(above > below ? high : low);
    if (!(std::max(above, below) > 0.0)) return false;
    const Vector3 middle = 0.25 * (points_[0] + points_[1] + points_[2] + points_[3]);
    for (const std::array<int, 3>& c :
         {std::array{0, 1, 2}, std::array{0, 1, 3}, std::array{0, 2, 3}, std::array{1, 2, 3}})
      if (!add_facet(c, middle)) return false;
    inside_ = middle;
    return true;
  }

  const Facet& nearest() const {
    return *std::min_element(facets_.begin(), facets_.end(),
                             [](const Facet& a, const Facet& b) { return a.height < b.height; });
  }
  double least_outer() const {
    double least = std::numeric_limits<double>::infinity();
    for (const Facet& f : facets_) least = std::min(least, f.outer);
    return least;
  }
  const Facet& least_outer_facet() const {
    return *std::min_element(facets_.begin(), facets_.end(),
                             [](const Facet& a, const Facet& b) { return a.outer < b.outer; });
  }

  /// Takes in the farthest point over a facet; false where rounding leaves nothing to gain.
  bool grow(const Facet& facet) {
    const Vector3 p = facet.farthest;
    const int index = static_cast<int>(points_.size());
    points_.push_back(p);
    std::vector<std::pair<int, int>> rim;
    std::vector<Facet> kept;
    for (const Facet& f : facets_) {
      if (!(f.normal.dot(p) - f.height > 0.0)) {
        kept.push_back(f);
        continue;
      }
      for (std::size_t i = 0; i < 3; ++i) {
        const std::pair<int, int> edge{f.corners[i], f.corners[(i + 1) % 3]};
        const auto back = ranges::find(rim, std::pair<int, int>{edge.second, edge.first});
        if (back != rim.end()) {
          rim.erase(back);
        } else {
          rim.push_back(edge);
        }
      }
    }
    // a closed surface of n corners has 2 n - 4 triangles; what rounding has torn has more
    if (rim.empty() || kept.size() + rim.size() > 2 * points_.size()) return false;
    facets_ = std::move(kept);
    return ranges::all_of(rim, [&](const std::pair<int, int>& edge) {
      return add_facet({edge.first, edge.second, index}, inside_);
    });
  }

 private:
  bool add_facet(std::array<int, 3> c, const Vector3& inside) {
    const auto at = [&](std::size_t i) -> const Vector3& { return points_[static_cast<std::size_t>(c[i])]; };
    Vector3 n = (at(1) - at(0)).cross(at(2) - at(0));
    const double area = n.norm();
    if (!(area > 0.0)) return false;
    n /= area;
    if (n.dot(at(0) - inside) < 0.0) {
      std::swap(c[1], c[2]);
      n = -n;
    }
    Facet facet{c, n, n.dot(at(0)), 0.0, difference_.farthest(n)};
    facet.outer = n.dot(facet.farthest);
    facets_.push_back(facet);
    return true;
  }

  const Difference& difference_;
  std::vector<Vector3> points_;
  std::vector<Facet> facets_;
  Vector3 inside_ = Vector3::Zero();
};

}  // namespace

Penetration penetration(const ConvexCore& A, const ConvexCore& B, const RelativePose& pose, double relative,
                        double absolute) {
  if (A.is_half_space) {
    const Vector3 down = -(pose.R_AB.transpose() * Vector3::UnitZ());
    const double depth = support(B, down).height + B.rounding - pose.p_AB.z();
    return {std::max(0.0, depth), depth, Vector3::UnitZ()};
  }
  const Difference difference(A, B, pose);
  InnerPolytope polytope(difference);
  Penetration result{0.0, std::numeric_limits<double>::infinity(), Vector3::UnitX()};
  if (!polytope.begin()) return result;
  constexpr int kMostPoints = 300;
  for (int i = 0; i < kMostPoints; ++i) {
    const Facet nearest = polytope.nearest(), &best = polytope.least_outer_facet();
    if (best.outer < result.at_most) {
      result.at_most = best.outer;
      result.normal = best.normal;
    }
    result.at_least = std::max(0.0, nearest.height);
    constexpr double kClear = 16.0;
    if (result.at_most < -kClear * absolute ||
        result.at_most - nearest.height <= std::max(absolute, relative * result.at_most))
      break;
    if (!(nearest.outer - nearest.height > 4.0 * kUnitRoundoff * (A.reach + B.reach)) || !polytope.grow(nearest)) break;
  }
  return result;
}

}  // namespace trajet::detail
