#include "refined_touch.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>

#include "separation.hpp"
#include "trajet/math/polynomial.hpp"

namespace trajet::detail {
namespace {

/// A vertex that is support, or nearly.
struct Corner {
  int vertex = 0;
  Vector3 point = Vector3::Zero();  ///< of its spread, farthest along the direction
  Matrix3 bend = Matrix3::Zero();   ///< how the point follows the direction: the second derivative of the height
  double height = 0.0;
};

/// One of the solids, seen along a direction of A's frame; of B everything turned to A.
struct Side {
  const ConvexCore& core;
  Vector3 p;
  Matrix3 R;

  /// Nothing where the direction is that of a disk: its farthest point jumps.
  std::optional<Corner> corner(int i, const Vector3& direction) const {
    const std::size_t k = static_cast<std::size_t>(i);
    Corner c{i, p + R * core.vertices[k], Matrix3::Zero(), 0.0};
    if (core.is_spread() && !core.spreads[k].isZero(0.0)) {
      const Matrix3 E = R * core.spreads[k];
      const Vector3 y = E.transpose() * direction;
      const double length = y.norm();
      constexpr double kFlat = 1e-7;
      if (!(length > kFlat * E.norm())) return std::nullopt;
      const Vector3 u = y / length;
      c.point += E * u;
      c.bend = E * (Matrix3::Identity() - u * u.transpose()) * E.transpose() / length;
    }
    c.height = direction.dot(c.point);
    return c;
  }
};

/// The vertices taken to touch, and their weights.
struct Active {
  std::vector<int> vertices{};
  std::vector<double> weights{};

  void drop(std::size_t i) {
    vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(i));
    weights.erase(weights.begin() + static_cast<std::ptrdiff_t>(i));
    double sum = 0.0;
    for (const double w : weights) sum += w;
    for (double& w : weights) w = sum > 0.0 ? w / sum : 1.0 / static_cast<double>(weights.size());
  }
};

/// All within a slack of the farthest; nothing where one of them jumps, or there are too many.
std::optional<Active> active(const Side& side, const Vector3& direction, double slack) {
  Active result;
  const int count = static_cast<int>(side.core.vertices.size());
  double highest = -std::numeric_limits<double>::infinity();
  std::vector<double> heights;
  for (int i = 0; i < count; ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    double h = direction.dot(side.R * side.core.vertices[k]);
    if (side.core.is_spread()) h += (side.core.spreads[k].transpose() * (side.R.transpose() * direction)).norm();
    heights.push_back(h);
    highest = std::max(highest, h);
  }
  for (int i = 0; i < count; ++i)
    if (heights[static_cast<std::size_t>(i)] >= highest - slack) result.vertices.push_back(i);
  constexpr std::size_t kMost = 8;
  if (result.vertices.size() > kMost) return std::nullopt;
  result.weights.assign(result.vertices.size(), 1.0 / static_cast<double>(result.vertices.size()));
  return result;
}

std::optional<std::vector<Corner>> corners(const Side& side, const Active& set, const Vector3& direction) {
  std::vector<Corner> result;
  for (const int i : set.vertices) {
    const std::optional<Corner> c = side.corner(i, direction);
    if (!c) return std::nullopt;
    result.push_back(*c);
  }
  return result;
}

Vector3 mean(const std::vector<Corner>& corners, const Active& set) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) sum += set.weights[i] * corners[i].point;
  return sum;
}

Matrix3 mean_bend(const std::vector<Corner>& corners, const Active& set) {
  Matrix3 sum = Matrix3::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) sum += set.weights[i] * corners[i].bend;
  return sum;
}

/// One Newton step; false where it cannot be made.
bool step(const Side& a, Active& of_a, const Side& b, Active& of_b, Vector3& normal) {
  const auto from_a = corners(a, of_a, normal), from_b = corners(b, of_b, -normal);
  if (!from_a || !from_b) return false;
  Eigen::Matrix<double, 3, 2> T;
  T.col(0) = normal.unitOrthogonal();
  T.col(1) = normal.cross(T.col(0));
  const std::size_t na = from_a->size(), nb = from_b->size();
  const Eigen::Index size = 2 + static_cast<Eigen::Index>(na - 1 + nb - 1);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd rest = Eigen::VectorXd::Zero(size);
  const double apart = normal.dot((*from_b)[0].point - (*from_a)[0].point);
  K.topLeftCorner<2, 2>() =
      -T.transpose() * (mean_bend(*from_a, of_a) + mean_bend(*from_b, of_b)) * T - apart * Eigen::Matrix2d::Identity();
  rest.head<2>() = -T.transpose() * ((*from_b)[0].point - (*from_a)[0].point);
  const auto put = [&](const std::vector<Corner>& all, Eigen::Index at, double sign) {
    for (std::size_t i = 1; i < all.size(); ++i, ++at) {
      const Vector3 between = sign * (all[i].point - all[0].point);
      const Eigen::Vector2d along = T.transpose() * between;
      K.block<2, 1>(0, at) = along;
      K.block<1, 2>(at, 0) = along.transpose();
      rest[at] = -normal.dot(between);
    }
  };
  put(*from_a, 2, -1.0);
  put(*from_b, 2 + static_cast<Eigen::Index>(na - 1), 1.0);
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  constexpr double kSingular = 1e-10;
  solver.setThreshold(kSingular);
  const Eigen::VectorXd x = solver.compute(K).solve(rest);
  constexpr double kLongest = 0.1;  // rad; the start is far better
  if (!x.allFinite() || x.head<2>().norm() > kLongest) return false;
  normal = (normal + T * x.head<2>()).normalized();
  const auto take = [&](Active& set, Eigen::Index at) {
    set.weights[0] = 1.0;
    for (std::size_t i = 1; i < set.weights.size(); ++i, ++at) set.weights[0] -= set.weights[i] = x[at];
  };
  take(of_a, 2);
  take(of_b, 2 + static_cast<Eigen::Index>(na - 1));
  return true;
}

/// Leaves out the vertex that would have to pull.
bool drop_pulling(Active& set) {
  constexpr double kZero = -1e-12;
  const auto least = std::min_element(set.weights.begin(), set.weights.end());
  if (set.weights.size() < 2 || *least >= kZero) return false;
  set.drop(static_cast<std::size_t>(least - set.weights.begin()));
  return true;
}

/// Takes in the vertex that lies farther than those that are taken to touch.
bool add_highest(const Side& side, Active& set, const Vector3& direction, double slack) {
  const Vector3 own = side.R.transpose() * direction;
  const CoreSupport farthest = support(side.core, own);
  double highest = -std::numeric_limits<double>::infinity();
  for (const int i : set.vertices) {
    const std::size_t k = static_cast<std::size_t>(i);
    double h = own.dot(side.core.vertices[k]);
    if (side.core.is_spread()) h += (side.core.spreads[k].transpose() * own).norm();
    highest = std::max(highest, h);
  }
  if (!(farthest.height > highest + slack) ||
      std::find(set.vertices.begin(), set.vertices.end(), farthest.vertex) != set.vertices.end())
    return false;
  set.vertices.push_back(farthest.vertex);
  set.weights.push_back(0.0);
  return true;
}

/// Between the points that are support within the slack.
std::vector<Vector3> lines(const Side& side, const Vector3& direction, double slack) {
  std::vector<Vector3> result;
  const std::optional<Active> set = active(side, direction, slack);
  if (!set) return result;
  const auto points = corners(side, *set, direction);
  if (!points) return result;
  for (std::size_t i = 0; i < points->size(); ++i)
    for (std::size_t j = i + 1; j < points->size(); ++j)
      if (const Vector3 d = (*points)[j].point - (*points)[i].point; d.norm() > slack)
        result.push_back(side.R.transpose() * d.normalized());
  return result;
}

}  // namespace

RefinedTouch refined_touch(const ConvexCore& A, const ConvexCore& B, const RelativePose& pose, const Vector3& normal) {
  const Side a{A, Vector3::Zero(), Matrix3::Identity()}, b{B, pose.p_AB, pose.R_AB};
  const double size = A.reach + B.reach;
  constexpr double kNear = 1e-6;  // of the size: as far as the first direction may be off
  const double rounding = 16.0 * kUnitRoundoff * (size + pose.p_AB.norm());
  RefinedTouch touch;
  touch.normal = normal;
  touch.gap = separation_along(A, B, pose, normal);
  touch.on_a = support(A, normal).point + A.rounding * normal;
  touch.on_b = pose.p_AB + pose.R_AB * support(B, -(pose.R_AB.transpose() * normal)).point - B.rounding * normal;

  std::optional<Active> of_a = active(a, normal, kNear * size), of_b = active(b, -normal, kNear * size);
  Vector3 n = normal;
  bool is_good = of_a && of_b;
  constexpr int kMaxSteps = 24;
  for (int i = 0; is_good && i < kMaxSteps; ++i) {
    const Vector3 before = n;
    is_good = step(a, *of_a, b, *of_b, n);
    if (!is_good) break;
    if (drop_pulling(*of_a) || drop_pulling(*of_b)) continue;
    constexpr double kStill = 1e-6;
    if ((n - before).norm() > kStill) continue;
    if (add_highest(a, *of_a, n, rounding) || add_highest(b, *of_b, -n, rounding)) continue;
    if ((n - before).norm() <= 4.0 * kUnitRoundoff) break;
  }
  if (is_good && separation_along(A, B, pose, n) >= touch.gap - rounding) {
    const auto from_a = corners(a, *of_a, n), from_b = corners(b, *of_b, -n);
    if (from_a && from_b) {
      touch.is_refined = true;
      touch.normal = n;
      touch.gap = separation_along(A, B, pose, n);
      touch.on_a = mean(*from_a, *of_a) + A.rounding * n;
      touch.on_b = mean(*from_b, *of_b) - B.rounding * n;
    }
  }
  touch.lines_a = lines(a, touch.normal, kNear * size);
  touch.lines_b = lines(b, -touch.normal, kNear * size);
  return touch;
}

}  // namespace trajet::detail
