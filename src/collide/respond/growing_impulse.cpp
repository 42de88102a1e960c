#include "growing_impulse.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "trajet/math/polynomial.hpp"

namespace trajet {
namespace {

constexpr int kOrder = 20;  // of the series
constexpr double kNever = std::numeric_limits<double>::infinity();

using Coefficients = std::array<double, kOrder + 1>;

double value(const Coefficients& c, double tau) {
  double sum = c[kOrder];
  for (int k = kOrder - 1; k >= 0; --k) sum = sum * tau + c[static_cast<std::size_t>(k)];
  return sum;
}

double slope(const Coefficients& c, double tau) {
  double sum = kOrder * c[kOrder];
  for (int k = kOrder - 1; k >= 1; --k) sum = sum * tau + k * c[static_cast<std::size_t>(k)];
  return sum;
}

/// Where a polynomial that is negative at 0 and not at `end` becomes zero: Newton's iteration within a bracket.
double crossing(const Coefficients& c, double end) {
  double low = 0.0, high = end, tau = end;
  for (int i = 0; i < 200; ++i) {
    const double f = value(c, tau);
    (f < 0.0 ? low : high) = tau;
    double next = tau - f / slope(c, tau);
    if (!(low < next && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - tau) <= 0.5 * kUnitRoundoff * end || !(low < next && next < high)) return next;
    tau = next;
  }
  return tau;
}

/// The sum of a_i b_(k-i), i from `first` to `last`.
double convolution(const Coefficients& a, const Coefficients& b, int k, int first, int last) {
  double sum = 0.0;
  for (int i = first; i <= last; ++i) sum += a[static_cast<std::size_t>(i)] * b[static_cast<std::size_t>(k - i)];
  return sum;
}

/// Velocity, impulse and the work of the normal impulse as series in tau, where dp = |u_t| dtau along the normal
/// impulse p. Slip that stops does so at infinite tau: the series have no end before.
struct SlipSeries {
  std::array<Coefficients, 3> u{}, J{};
  Coefficients work{}, slip{};

  /// du/dtau = K dJ/dtau, dJ/dtau = |u_t| n - mu u_t, dW/dtau = |u_t| u_n
  SlipSeries(const Matrix3& K, double friction, const Vector3& velocity, const Vector3& impulse, double work_before) {
    for (std::size_t i = 0; i < 3; ++i) {
      u[i][0] = velocity[static_cast<Eigen::Index>(i)];
      J[i][0] = impulse[static_cast<Eigen::Index>(i)];
    }
    work[0] = work_before;
    slip[0] = std::hypot(u[0][0], u[1][0]);
    for (int k = 0; k < kOrder; ++k) {
      const auto at = static_cast<std::size_t>(k);
      if (k > 0) {
        const double square = convolution(u[0], u[0], k, 0, k) + convolution(u[1], u[1], k, 0, k);
        slip[at] = (square - convolution(slip, slip, k, 1, k - 1)) / (2.0 * slip[0]);
      }
      const Vector3 push(-friction * u[0][at], -friction * u[1][at], slip[at]);
      const Vector3 change = K * push / (k + 1);
      for (std::size_t i = 0; i < 3; ++i) {
        u[i][at + 1] = change[static_cast<Eigen::Index>(i)];
        J[i][at + 1] = push[static_cast<Eigen::Index>(i)] / (k + 1);
      }
      work[at + 1] = convolution(slip, u[2], k, 0, k) / (k + 1);
    }
  }

  /// How far the series of the slip is right to rounding.
  double reach(double longest) const {
    double tau = longest;
    for (const int k : {kOrder - 1, kOrder}) {
      const auto at = static_cast<std::size_t>(k);
      const double size = std::hypot(u[0][at], u[1][at]);
      constexpr double kTruncation = 1e-17;
      if (size > 0.0) tau = std::min(tau, std::pow(kTruncation * slip[0] / size, 1.0 / k));
    }
    return tau;
  }
};

class GrowingImpulse {
 public:
  explicit GrowingImpulse(const ImpactInContactFrame& impact)
      : impact_(impact), K_(impact.K), mu_(impact.friction), u_(impact.velocity) {}

  GrownImpulse grow() {
    if (slip() > 0.0 && (slide_and_turn() || slide_straight())) return {J_, false};
    u_.head<2>().setZero();
    const SteadiestPush steadiest = steadiest_push(K_, mu_);
    push(steadiest.direction, kNever);
    return {J_, steadiest.holds};
  }

 private:
  double slip() const { return std::hypot(u_.x(), u_.y()); }
  /// n - mu s
  Vector3 push_of_slip() const {
    const double scale = -mu_ / slip();
    return {scale * u_.x(), scale * u_.y(), 1.0};
  }

  /// Whether slip keeps its direction, up to rounding.
  bool is_straight() const {
    const Vector3 change = K_ * push_of_slip();
    const double across = (u_.x() * change.y() - u_.y() * change.x()) / slip();
    const double size = K_.topRightCorner<2, 1>().norm() + mu_ * K_.topLeftCorner<2, 2>().norm();
    return std::abs(across) <= 16.0 * kUnitRoundoff * size;
  }

  /// Slip that changes its direction: true where restitution ends in it.
  bool slide_and_turn() {
    const double gone = kUnitRoundoff * kUnitRoundoff * u_.norm();
    const double longest = 4.0 / (K_.topRightCorner<2, 1>().norm() + mu_ * K_.topLeftCorner<2, 2>().norm());
    // what turns so slowly that this does not suffice goes straight as good as for ever
    constexpr int kMostSteps = 10000;
    for (int step = 0; step < kMostSteps && slip() > gone && !is_straight(); ++step) {
      const SlipSeries series(K_, mu_, u_, J_, work_);
      double tau = series.reach(longest);
      Coefficients gap = is_compressing_ ? series.u[2] : quantity_of(series);
      if (!is_compressing_) gap[0] -= target_;
      const bool ends = value(gap, tau) >= 0.0;
      if (ends) tau = crossing(gap, tau);
      for (std::size_t i = 0; i < 3; ++i) {
        u_[static_cast<Eigen::Index>(i)] = value(series.u[i], tau);
        J_[static_cast<Eigen::Index>(i)] = value(series.J[i], tau);
      }
      work_ = value(series.work, tau);
      if (!compresses_again() && ends && end_phase()) return true;
    }
    return false;
  }

  /// Slip that keeps its direction: true where restitution ends in it.
  bool slide_straight() {
    if (!(slip() > 0.0)) return false;
    const Vector3 direction = push_of_slip();
    const double faster = (K_ * direction).head<2>().dot(u_.head<2>()) / slip();
    return push(direction, faster < 0.0 ? slip() / -faster : kNever);
  }

  /// The impulse grows along d, by `left` of its normal part at most. True where restitution ends before.
  bool push(const Vector3& d, double left) {
    const Vector3 change = K_ * d;
    const double faster = change.z();
    assert(left < kNever || !(faster <= 0.0));
    while (true) {
      const double until = until_phase_ends(faster);
      const double step = std::min(until, left);
      if (!(step < kNever)) return true;  // not finite, as what it was given is
      work_ += step * (u_.z() + 0.5 * step * faster);
      u_ += step * change;
      J_ += step * d;
      left -= step;
      const bool comes_back = compresses_again();
      if (step < until) return false;
      if (!comes_back && end_phase()) return true;
    }
  }

  /// The normal impulse up to the end of compression or restitution, where the normal speed grows by `faster` with it.
  double until_phase_ends(double faster) const {
    if (is_compressing_) return faster > 0.0 ? std::max(0.0, -u_.z()) / faster : kNever;
    switch (impact_.measure) {
      case RestitutionOf::impulse:
        return std::max(0.0, target_ - J_.z());
      case RestitutionOf::speed:
        return faster > 0.0 ? std::max(0.0, target_ - u_.z()) / faster : kNever;
      case RestitutionOf::work:
        break;
    }
    // W + u_n p + u_n' p^2/2 = target
    const double lacking = std::max(0.0, target_ - work_);
    const double square = u_.z() * u_.z() + 2.0 * faster * lacking;
    if (square < 0.0) return kNever;
    return lacking > 0.0 ? 2.0 * lacking / (u_.z() + std::sqrt(square)) : 0.0;
  }

  const Coefficients& quantity_of(const SlipSeries& series) const {
    switch (impact_.measure) {
      case RestitutionOf::impulse:
        return series.J[2];
      case RestitutionOf::speed:
        return series.u[2];
      case RestitutionOf::work:
        break;
    }
    return series.work;
  }

  /// Where the slip turns, the bodies may approach each other again in restitution: that is compression.
  bool compresses_again() {
    const bool comes_back = !is_compressing_ && u_.z() < 0.0;
    if (comes_back) is_compressing_ = true;
    return comes_back;
  }

  /// From compression to restitution; true where that has ended.
  bool end_phase() {
    if (!is_compressing_) return true;
    is_compressing_ = false;
    u_.z() = 0.0;
    const double e = impact_.restitution;
    switch (impact_.measure) {
      case RestitutionOf::impulse:
        target_ = (1.0 + e) * J_.z();
        break;
      case RestitutionOf::speed:
        target_ = -e * impact_.velocity.z();
        break;
      case RestitutionOf::work:
        target_ = (1.0 - e * e) * work_;
        break;
    }
    return e == 0.0;
  }

  const ImpactInContactFrame& impact_;
  const Matrix3& K_;
  double mu_;
  Vector3 u_;
  Vector3 J_ = Vector3::Zero();
  double work_ = 0.0;  // of the normal impulse, J
  bool is_compressing_ = true;
  double target_ = 0.0;  // at the end of restitution: the work, the normal impulse, or the normal speed
};

}  // namespace

SteadiestPush steadiest_push(const Matrix3& K, double friction) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(K.topLeftCorner<2, 2>());
  const Eigen::Vector2d along = axes.eigenvectors().transpose() * K.topRightCorner<2, 1>();
  // x = -(K_tt + sigma)^-1 K_tn, where sigma = 0 or |x| = mu: Newton's iteration for 1/|x|, which is concave in sigma
  double sigma = 0.0;
  Eigen::Vector2d x;
  constexpr int kMostIterations = 100;
  for (int i = 0; i < kMostIterations; ++i) {
    const Eigen::Vector2d stiffness = axes.eigenvalues().array() + sigma;
    x = -along.cwiseQuotient(stiffness);
    const double size = x.norm();
    if (!(size > friction * (1.0 + 4.0 * kUnitRoundoff))) break;
    sigma += size * size / x.dot(x.cwiseQuotient(stiffness)) * (size - friction) / friction;
  }
  const Eigen::Vector2d along_surface = axes.eigenvectors() * x;
  return {Vector3(along_surface.x(), along_surface.y(), 1.0), sigma == 0.0};
}

GrownImpulse grown_impulse(const ImpactInContactFrame& impact) { return GrowingImpulse(impact).grow(); }

}  // namespace trajet
