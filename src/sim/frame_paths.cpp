#include "frame_paths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "trajet/math/series.hpp"
#include "trajet/math/shift_rows.hpp"
#include "trajet/rigid/orientation.hpp"

namespace trajet {
namespace {

constexpr int kOrder = 24;
using Power = Series<double, kOrder>;

/// The unit quaternion of a matrix that is nearly a rotation, for any number type: of the four that its elements give,
/// the one that divides by the largest.
template <class T>
QuaternionT<T> quaternion_of(const Matrix3T<T>& R) {
  const T one(1.0), two(2.0), half(0.5);
  const T trace = R(0, 0) + R(1, 1) + R(2, 2);
  const auto value = [](const T& x) { return x[0]; };
  int largest = 3;  // w
  for (int i = 0; i < 3; ++i)
    if (value(R(i, i)) > (largest == 3 ? value(trace) : value(R(largest, largest)))) largest = i;
  if (largest == 3) {
    const T s = half * sqrt(one + trace), d = one / (two * two * s);
    return {s, d * (R(2, 1) - R(1, 2)), d * (R(0, 2) - R(2, 0)), d * (R(1, 0) - R(0, 1))};
  }
  const int i = largest, j = (i + 1) % 3, k = (i + 2) % 3;
  const T s = half * sqrt(one + R(i, i) - R(j, j) - R(k, k)), d = one / (two * two * s);
  T part[3];
  part[i] = s;
  part[j] = d * (R(j, i) + R(i, j));
  part[k] = d * (R(k, i) + R(i, k));
  return {d * (R(k, j) - R(j, k)), part[0], part[1], part[2]};
}

/// How long a series of numbers no larger than about 1 holds to rounding.
double duration_of(const Power& series) {
  constexpr double kRoundings = 4.0;
  double duration = std::numeric_limits<double>::infinity();
  for (const int k : {kOrder - 1, kOrder})
    if (series[k] != 0.0)
      duration = std::min(duration, std::pow(kRoundings * kUnitRoundoff / std::abs(series[k]), 1.0 / k));
  return duration;
}

}  // namespace

FramePath body_path(const World::Body& body, const Segment<>& segment, double from) {
  const auto& c = segment.coefficients();
  const BodySlice slice = body.slice();
  FramePath::Coefficients rows = FramePath::Coefficients::Zero(7, c.cols());
  FramePath::Values errors = FramePath::Values::Zero();
  rows.topRows<3>() = c.middleRows<3>(slice.position_index());
  errors.head<3>() = slice.position(segment.error_bound());
  if (!body.rotation) {
    const Quaternion& q = body.q_WB;
    rows.col(0).tail<4>() << q.w(), q.x(), q.y(), q.z();
    return {segment.t0(), segment.t1(), rows, errors};
  }
  const OrientationLayout& layout = body.rotation->layout;
  const int first = slice.orientation_index();
  if (layout.way != OrientationWay::matrix && layout.way != OrientationWay::rotation_vector) {
    rows.bottomRows<4>() = c.middleRows<4>(first);
    errors.tail<4>() = segment.error_bound().segment<4>(first);
    return {segment.t0(), segment.t1(), rows, errors};
  }

  Eigen::MatrixXd numbers = c.middleRows(first, layout.size());
  shift_rows(numbers, from - segment.t0());
  shift_rows(rows, from - segment.t0());
  std::vector<Power> part(static_cast<std::size_t>(layout.size()));
  for (int i = 0; i < layout.size(); ++i)
    for (int k = 0; k <= std::min<int>(kOrder, segment.degree()); ++k)
      part[static_cast<std::size_t>(i)][k] = numbers(i, k);
  const QuaternionT<Power> q =
      layout.way == OrientationWay::matrix ? quaternion_of(layout.matrix(part.data())) : layout.quaternion(part.data());
  rows.conservativeResizeLike(FramePath::Coefficients::Zero(7, std::max<Eigen::Index>(rows.cols(), kOrder + 1)));
  double duration = std::abs(segment.t1() - from);
  const Power components[] = {q.w(), q.x(), q.y(), q.z()};
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k <= kOrder; ++k) rows(3 + i, k) = components[i][k];
    duration = std::min(duration, duration_of(components[i]));
  }
  errors.tail<4>().setConstant(segment.error_bound().segment(first, layout.size()).norm());
  const double direction = segment.t1() < segment.t0() ? -1.0 : 1.0;
  const double end = duration < std::abs(segment.t1() - from) ? from + direction * duration : segment.t1();
  return {from, end, rows, errors};
}

FramePath driven_path(DrivenFrame& frame, const Vector3& p_WB_start, const Quaternion& q_WB_start, double from,
                      double until) {
  const Segment<7> piece = frame.piece(from, until);
  // where the frame's origin is against the pivot: the products of a unit quaternion's components, all of them
  using Product = Series<double, 2 * DrivenFrame::kOrder>;
  std::array<Product, 4> part;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k <= piece.degree(); ++k) part[static_cast<std::size_t>(i)][k] = piece.coefficients()(3 + i, k);
  const Vector3T<Product> arm =
      rotate<Product>({part[0], part[1], part[2], part[3]}, Vector3(p_WB_start - frame.drive().pivot).cast<Product>());
  const bool has_arm = p_WB_start != frame.drive().pivot;
  FramePath::Coefficients rows =
      FramePath::Coefficients::Zero(7, (has_arm && frame.drive().turns ? 2 : 1) * piece.degree() + 1);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < rows.cols(); ++k) rows(i, k) = arm[i][k];
  for (int k = 0; k <= piece.degree(); ++k) {
    const auto column = piece.coefficients().col(k);
    const Quaternion q = Quaternion(column[3], column[4], column[5], column[6]) * q_WB_start;
    rows.col(k).head<3>() += column.head<3>();
    rows.col(k).tail<4>() << q.w(), q.x(), q.y(), q.z();
  }
  FramePath::Values errors = piece.error_bound();
  errors.tail<4>().setConstant(errors.tail<4>().norm());
  return {piece.t0(), piece.t1(), rows, errors};
}

}  // namespace trajet
