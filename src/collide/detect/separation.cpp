#include "separation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "rounded_gap.hpp"
#include "trajet/math/roots.hpp"

namespace trajet::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kDegree = WindowPolynomial::kMaxDegree;
constexpr int kSize = WindowPolynomial::kSize;

/// Column k: the Bernstein coefficients of u^k on [-1, 1], in degree kDegree: the mean of all products of k of n signs,
/// of which i are +. At most 1.
const Eigen::Array<double, kSize, kSize>& bernstein_of_powers() {
  static const Eigen::Array<double, kSize, kSize> table = [] {
    std::array<std::array<double, kSize>, kSize> choose{};
    for (std::size_t n = 0; n < kSize; ++n)
      for (std::size_t k = 0; k <= n; ++k) choose[n][k] = k == 0 ? 1.0 : choose[n - 1][k - 1] + choose[n - 1][k];
    Eigen::Array<double, kSize, kSize> t;
    for (int i = 0; i < kSize; ++i)
      for (int k = 0; k < kSize; ++k) {
        double sum = 0.0;
        for (int plus = std::max(0, k - (kDegree - i)); plus <= std::min(i, k); ++plus)
          sum += ((k - plus) % 2 == 0 ? 1.0 : -1.0) *
                 choose[static_cast<std::size_t>(i)][static_cast<std::size_t>(plus)] *
                 choose[static_cast<std::size_t>(kDegree - i)][static_cast<std::size_t>(k - plus)];
        t(i, k) = sum / choose[kDegree][static_cast<std::size_t>(k)];
      }
    return t;
  }();
  return table;
}

Vector3 sizes(const WindowVector& v, double (WindowPolynomial::*of)() const) {
  return {(v[0].*of)(), (v[1].*of)(), (v[2].*of)()};
}

/// n without its part along the unit vector e.
WindowVector across(const WindowVector& n, const Vector3& e) {
  const WindowPolynomial along = dot(e, n);
  WindowVector result;
  for (std::size_t i = 0; i < 3; ++i) {
    LinearSum sum;
    sum.add(1.0, n[i]);
    sum.add(-e[static_cast<int>(i)], along);
    result[i] = sum.value();
  }
  return result;
}

/// E^T v
WindowVector spread(const Matrix3& E, const WindowVector& v) {
  return {dot(Vector3(E.col(0)), v), dot(Vector3(E.col(1)), v), dot(Vector3(E.col(2)), v)};
}

const Vector3& vertex(const ConvexCore& core, int i) { return core.vertices[static_cast<std::size_t>(i)]; }
const CoreEdge& edge(const ConvexCore& core, int i) { return core.edges[static_cast<std::size_t>(i)]; }

/// Bernstein coefficients of what each vertex adds to w s, or a lower bound of it: -+axis . p, less the spread's
/// length.
template <class Controls>
Eigen::Array<double, kSize, Eigen::Dynamic> vertex_rows(const ConvexCore& core, const Controls& axis, double sign) {
  const int count = static_cast<int>(core.vertices.size());
  Eigen::Array<double, kSize, Eigen::Dynamic> rows(kSize, count);
  for (int i = 0; i < count; ++i) {
    const Vector3 p = sign * vertex(core, i);
    rows.col(i) = (p[0] * axis.row(0) + p[1] * axis.row(1) + p[2] * axis.row(2)).transpose();
    if (core.is_spread())
      rows.col(i) -=
          (core.spreads[static_cast<std::size_t>(i)].transpose() * axis.matrix()).colwise().norm().transpose().array();
  }
  return rows;
}

}  // namespace

Separation::Separation(const ConvexCore& A, const ConvexCore& B, const RelativeMotion& motion, const WitnessAxis& axis)
    : A_(A), B_(B), rounding_(A.rounding + B.rounding), w_(motion.D()) {
  switch (axis.kind) {
    case AxisKind::in_a:
      take_in_a(motion, axis.direction);
      break;
    case AxisKind::in_b:
      take_in_b(motion, axis.direction);
      break;
    case AxisKind::edges:
      take_edges(motion, axis);
      break;
    case AxisKind::edge_vertex:
    case AxisKind::vertices:
      take_points_in_a(motion, axis);
      break;
    case AxisKind::vertex_edge:
      take_points_in_b(motion, axis);
      break;
    case AxisKind::balls:
      break;
  }
  take_errors();
}

/// A's height along n is a number.
void Separation::take_in_a(const RelativeMotion& motion, const Vector3& n) {
  const double height = A_.is_half_space ? 0.0 : support(A_, n).height;
  const WindowVector n_W = motion.a().N * n;
  LinearSum base;
  base.add(1.0, motion.b().D * dot(n_W, motion.apart()));
  base.add(-(height + rounding_), motion.D());
  base_ = base.value();
  b_ = transposed_times(motion.b().N, n_W);
  has_a_ = false;
}

void Separation::take_in_b(const RelativeMotion& motion, const Vector3& n) {
  const double height = support(B_, -n).height;
  const WindowVector n_W = motion.b().N * n;
  LinearSum base;
  base.add(1.0, motion.a().D * dot(n_W, motion.apart()));
  base.add(-(height + rounding_), motion.D());
  base_ = base.value();
  a_ = transposed_times(motion.a().N, n_W);
  has_b_ = false;
}

void Separation::take_edges(const RelativeMotion& motion, const WitnessAxis& axis) {
  const Vector3 e = axis.sign * line_of_a(A_, axis), f = line_of_b(B_, axis);
  const WindowVector e_W = motion.a().N * e, f_W = motion.b().N * f;
  base_ = dot(e_W, cross(f_W, motion.apart()));
  a_ = cross(e, transposed_times(motion.a().N, f_W));
  b_ = cross(-f, transposed_times(motion.b().N, e_W));
  is_turning_ = true;
  if (axis.a >= 0) skip_a_ = edge(A_, axis.a).to;
  if (axis.b >= 0) skip_b_ = edge(B_, axis.b).to;
}

/// From a vertex of A, or across an edge of it, to a vertex of B.
void Separation::take_points_in_a(const RelativeMotion& motion, const WitnessAxis& axis) {
  const bool is_edge = axis.kind == AxisKind::edge_vertex;
  const Vector3& a = vertex(A_, is_edge ? edge(A_, axis.a).from : axis.a);
  const WindowVector point = motion.M() * vertex(B_, axis.b);
  WindowVector n;
  for (std::size_t i = 0; i < 3; ++i) {
    LinearSum sum;
    sum.add(1.0, motion.X()[i]);
    sum.add(1.0, point[i]);
    sum.add(-a[static_cast<int>(i)], motion.D());
    n[i] = sum.value();
  }
  if (is_edge) {
    n = across(n, edge(A_, axis.a).direction);
    skip_a_ = edge(A_, axis.a).to;
  }
  base_ = dot(n, motion.X());
  a_ = motion.D() * n;
  b_ = transposed_times(motion.M(), n);
  is_turning_ = true;
}

/// From a vertex of A across an edge of B, in B's frame.
void Separation::take_points_in_b(const RelativeMotion& motion, const WitnessAxis& axis) {
  const Vector3& b = vertex(B_, edge(B_, axis.b).from);
  const WindowVector point = transposed_times(motion.M(), vertex(A_, axis.a)), Y = motion.Y();
  WindowVector n;
  for (std::size_t i = 0; i < 3; ++i) {
    LinearSum sum;
    sum.add(1.0, Y[i]);
    sum.add(-1.0, point[i]);
    sum.add(b[static_cast<int>(i)], motion.D());
    n[i] = sum.value();
  }
  n = across(n, edge(B_, axis.b).direction);
  skip_b_ = edge(B_, axis.b).to;
  base_ = dot(n, Y);
  a_ = motion.M() * n;
  b_ = motion.D() * n;
  is_turning_ = true;
}

void Separation::take_errors() {
  const auto all = [&](double (WindowPolynomial::*of)() const) {
    return (base_.*of)() + (has_a_ ? (A_.reach + rounding_) * sizes(a_, of).norm() : 0.0) +
           (has_b_ ? B_.reach * sizes(b_, of).norm() : 0.0);
  };
  error_ = all(&WindowPolynomial::error);
  is_coarse_ = all(&WindowPolynomial::cut) > 0.5 * error_;
  size_ = all(&WindowPolynomial::norm);
  degree_ = std::max(base_.degree(), w_.degree());
  for (std::size_t i = 0; i < 3; ++i) {
    if (has_a_) degree_ = std::max(degree_, a_[i].degree());
    if (has_b_) degree_ = std::max(degree_, b_[i].degree());
  }
  roundings_ = kUnitRoundoff * (2.0 * degree_ + 8.0) * size_;
}

Separation::Controls Separation::controls(double begin) const {
  Controls c = Controls::Zero();
  const auto put = [&](int row, const WindowPolynomial& p) { c.row(row) = p.coefficients().transpose(); };
  put(0, base_);
  for (int i = 0; i < 3; ++i) {
    if (has_a_) put(1 + i, a_[static_cast<std::size_t>(i)]);
    if (has_b_) put(4 + i, b_[static_cast<std::size_t>(i)]);
  }
  put(7, w_);
  if (begin != -1.0) {
    // around the middle of [begin, 1]
    const double middle = 0.5 * (begin + 1.0), half = 0.5 * (1.0 - begin);
    for (int i = 0; i < degree_; ++i)
      for (int k = degree_ - 1; k >= i; --k) c.col(k) += middle * c.col(k + 1);
    double power = 1.0;
    for (int k = 1; k <= degree_; ++k) c.col(k) *= power *= half;
  }
  const auto& table = bernstein_of_powers();
  Controls b;
  for (int i = 0; i < kSize; ++i) {
    Eigen::Array<double, 8, 1> sum = c.col(0);
    for (int k = 1; k <= degree_; ++k) sum += table(i, k) * c.col(k);
    b.col(i) = sum;
  }
  return b;
}

double Separation::weight(double u) const { return is_turning_ ? value(a_, u).norm() : w_(u); }

std::optional<SeparationZero> Separation::first_zero(double begin, double begin_tolerance) const {
  stays_at_zero_ = false;
  begin_tolerance *= weight(begin);
  const Controls c = controls(begin);
  // A term of a control vector passes 2n roundings in the shift, n + 1 as a power, 2 with the table, n + 1 as a sum,
  // and a few in what is made of the vectors here; no shift and no powers where the search begins with the window.
  const double roundings = kUnitRoundoff * (begin == -1.0 ? degree_ + 12.0 : 4.0 * degree_ + 14.0);
  const double error = error_ + roundings * size_;

  Row bound = c.row(0).transpose();
  if (rounding_ > 0.0 && is_turning_)
    bound -= rounding_ * (c.middleRows<3>(1).matrix().colwise().norm().transpose().array());
  Eigen::Array<double, kSize, Eigen::Dynamic> of_a = Eigen::Array<double, kSize, 1>::Zero(), of_b = of_a;
  if (has_a_) of_a = vertex_rows(A_, c.middleRows<3>(1), -1.0);
  if (has_b_) of_b = vertex_rows(B_, c.middleRows<3>(4), +1.0);
  const Row least_a = of_a.rowwise().minCoeff(), least_b = of_b.rowwise().minCoeff();
  if ((bound + least_a + least_b).minCoeff() > error) return std::nullopt;

  // What is never the least, or never near zero even with the least of the other solid, is out.
  const auto candidates = [&](const auto& rows, const Row& least_of_other, int skip, bool is_spread) {
    std::vector<int> in;
    for (int i = 0; i < rows.cols(); ++i)
      if (i != skip && !((bound + rows.col(i) + least_of_other).minCoeff() > error)) in.push_back(i);
    if (is_spread) return in;
    for (const int k : {0, kDegree, kDegree / 2}) {
      if (in.size() < 2) break;
      const int best = *std::min_element(in.begin(), in.end(), [&](int i, int j) { return rows(k, i) < rows(k, j); });
      std::erase_if(in, [&](int i) { return i != best && (rows.col(i) - rows.col(best)).minCoeff() > 2.0 * error; });
    }
    return in;
  };
  const std::vector<int> in_a = candidates(of_a, least_b, skip_a_, A_.is_spread() && has_a_);
  const std::vector<int> in_b = candidates(of_b, least_a, skip_b_, B_.is_spread() && has_b_);
  std::optional<SeparationZero> first;
  double end = 1.0;
  for (const int i : in_a)
    for (const int j : in_b) {
      if ((bound + of_a.col(i) + of_b.col(j)).minCoeff() > error) continue;
      search(has_a_ ? i : -1, has_b_ ? j : -1, begin, begin_tolerance, end, first);
      if (end == begin) return first;
    }
  return first;
}

/// The roots of one pair of vertices, up to the earliest so far.
void Separation::search(int i, int j, double begin, double begin_tolerance, double& end,
                        std::optional<SeparationZero>& first) const {
  LinearSum sum;
  sum.add(1.0, base_);
  for (int c = 0; c < 3; ++c) {
    if (i >= 0) sum.add(-vertex(A_, i)[c], a_[static_cast<std::size_t>(c)]);
    if (j >= 0) sum.add(vertex(B_, j)[c], b_[static_cast<std::size_t>(c)]);
  }
  const WindowPolynomial s = sum.value();
  std::array<WindowVector, 3> lengths;
  std::size_t count = 0;
  if (is_turning_ && rounding_ > 0.0) lengths[count++] = spread(rounding_ * Matrix3::Identity(), a_);
  if (i >= 0 && A_.is_spread()) lengths[count++] = spread(A_.spreads[static_cast<std::size_t>(i)], a_);
  if (j >= 0 && B_.is_spread()) lengths[count++] = spread(B_.spreads[static_cast<std::size_t>(j)], b_);
  double error = s.error();
  for (std::size_t m = 0; m < count; ++m) error += sizes(lengths[m], &WindowPolynomial::error).norm();
  if (count == 0)
    return search(PolynomialFunction(s.span(), begin, end, 2.0 * error), error, i, j, begin, begin_tolerance, end,
                  first);
  RoundedGap gap(s, begin, end, 2.0 * error);
  for (std::size_t m = 0; m < count; ++m) gap.subtract_length_of(lengths[m]);
  search(gap, error, i, j, begin, begin_tolerance, end, first);
}

template <class Function>
void Separation::search(const Function& function, double error, int i, int j, double begin, double begin_tolerance,
                        double& end, std::optional<SeparationZero>& first) const {
  const auto take = [&](const Root& root) {
    first = zero_at(root, function.at(root.time), error, i, j, begin);
    end = first->u;
  };
  // A proof begins at a separation that is not negative, or at a contact that is left, negative by the rounding of
  // time.
  const FunctionSample start = function.at(begin);
  const Root at_begin{begin, 0.0, RootKind::crossing, 0, -1, true, false};
  bool is_below = start.jet.value < -start.tolerance;
  if (is_below && start.jet.value < -2.0 * start.tolerance - begin_tolerance) return take(at_begin);
  if (end == begin) return;
  const SearchStatus status = visit_roots(function, [&](const Root& root) {
    const bool departs = root.kind == RootKind::crossing && root.sign_after > 0;
    if (departs) is_below = false;
    if (root.kind != RootKind::unresolved && (root.at_begin || departs) && root.sign_after >= 0) return true;
    // no earlier than another pair's, and what it does behind that is not seen
    if (first && root.at_end && root.kind != RootKind::unresolved) return true;
    take(root);
    return false;
  });
  if (status == SearchStatus::identically_zero) stays_at_zero_ = true;
  if (is_below && status == SearchStatus::complete) take(at_begin);
}

SeparationZero Separation::zero_at(const Root& root, const FunctionSample& sample, double error, int i, int j,
                                   double begin) const {
  SeparationZero zero;
  zero.u = root.at_begin ? begin : root.time;
  zero.a = i;
  zero.b = j;
  zero.at_begin = root.at_begin;
  zero.at_end = root.at_end;
  zero.kind = root.kind;
  // s = (w s) / w, at its zero
  const double w = weight(zero.u);
  double w_rate = 0.0;
  if (is_turning_) {
    for (const WindowPolynomial& x : a_) w_rate += x(zero.u) * evaluate_polynomial(x.span(), zero.u).jet.rate / w;
  } else {
    w_rate = evaluate_polynomial(w_.span(), zero.u).jet.rate;
  }
  zero.rate = sample.jet.rate / w;
  zero.curvature = (sample.jet.curvature - 2.0 * zero.rate * w_rate) / w;
  const double value_error = sample.value_error + error;
  const double bound =
      std::min(value_error / std::abs(sample.jet.rate),
               std::sqrt(2.0 * std::max(sample.tolerance, value_error) / std::abs(sample.jet.curvature)));
  zero.error = std::max(root.error_bound, std::isfinite(bound) ? bound : 0.0);
  return zero;
}

Vector3 line_of_a(const ConvexCore& A, const WitnessAxis& axis) {
  return axis.a < 0 ? axis.direction : edge(A, axis.a).direction;
}

Vector3 line_of_b(const ConvexCore& B, const WitnessAxis& axis) {
  return axis.b < 0 ? axis.line_b : edge(B, axis.b).direction;
}

Vector3 axis_direction(const ConvexCore& A, const ConvexCore& B, const RelativePose& pose, const WitnessAxis& axis) {
  const auto unit = [](const Vector3& v, double least) {
    const double norm = v.norm();
    return norm > least ? Vector3(v / norm) : Vector3(Vector3::Zero());
  };
  const auto across_edge = [](const Vector3& p, const Vector3& e) { return Vector3(p - e * e.dot(p)); };
  constexpr double kParallel = 1e-8;
  const auto in_a = [&](int i) { return Vector3(pose.p_AB + pose.R_AB * vertex(B, i)); };
  switch (axis.kind) {
    case AxisKind::in_a:
      return axis.direction;
    case AxisKind::in_b:
      return pose.R_AB * axis.direction;
    case AxisKind::edges:
      return axis.sign * unit(line_of_a(A, axis).cross(pose.R_AB * line_of_b(B, axis)), kParallel);
    case AxisKind::edge_vertex:
      return unit(across_edge(in_a(axis.b) - vertex(A, edge(A, axis.a).from), edge(A, axis.a).direction), 0.0);
    case AxisKind::vertex_edge:
      return unit(across_edge(in_a(edge(B, axis.b).from) - vertex(A, axis.a), pose.R_AB * edge(B, axis.b).direction),
                  0.0);
    case AxisKind::vertices:
      return unit(in_a(axis.b) - vertex(A, axis.a), 0.0);
    case AxisKind::balls:
      break;
  }
  return unit(pose.p_AB, 0.0);
}

double separation_along(const ConvexCore& A, const ConvexCore& B, const RelativePose& pose, const Vector3& direction) {
  if (direction.isZero(0.0)) return -kInfinity;
  const double height_a = A.is_half_space ? 0.0 : support(A, direction).height;
  return direction.dot(pose.p_AB) - support(B, -(pose.R_AB.transpose() * direction)).height - height_a - A.rounding -
         B.rounding;
}

}  // namespace trajet::detail
