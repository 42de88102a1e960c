#include "polyline.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace trajet::detail {

namespace {

/// Which part of the line from `a` to `b` lies within a box: Liang and Barsky's way, one axis after the other.
std::optional<std::pair<double, double>> part_within(const Vector3& a, const Vector3& b,
                                                     const Eigen::AlignedBox3d& box) {
  double from = 0.0, to = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.min()[axis] - a[axis], high = box.max()[axis] - a[axis], way = b[axis] - a[axis];
    if (way == 0.0) {
      if (low > 0.0 || high < 0.0) return std::nullopt;
      continue;
    }
    from = std::max(from, std::min(low / way, high / way));
    to = std::min(to, std::max(low / way, high / way));
  }
  if (from > to) return std::nullopt;
  return std::pair(from, to);
}

}  // namespace

std::vector<std::vector<Vector3>> clipped(const std::vector<Vector3>& points, const Eigen::AlignedBox3d& box) {
  std::vector<std::vector<Vector3>> parts;
  bool goes_on = false;  // the last part ends at the point that comes next
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vector3 &a = points[i - 1], &b = points[i];
    const auto part = a.allFinite() && b.allFinite() ? part_within(a, b, box) : std::nullopt;
    if (!part) {
      goes_on = false;
      continue;
    }
    const auto at = [&](double t) { return t == 1.0 ? b : Vector3(a + t * (b - a)); };
    if (!goes_on) parts.push_back({at(part->first)});
    parts.back().push_back(at(part->second));
    goes_on = part->second == 1.0;
  }
  if (points.size() == 1 && points.front().allFinite() && box.contains(points.front())) parts.push_back(points);
  return parts;
}

}  // namespace trajet::detail
