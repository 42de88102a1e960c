#pragma once

#include <array>
#include <limits>

namespace trajet {

/// Jacobi's elliptic functions at one argument.
struct JacobiValues {
  double am;  ///< the amplitude phi, rad; it goes on growing over the periods
  double sn, cn, dn;
};

/// Jacobi's elliptic functions for a parameter m = 1 - m1 between 0 and 1, given by its complement m1.
///
/// Near m = 1, where a free top lingers at its intermediate axis, the period is the logarithm of m1: a function of the
/// modulus, such as Boost's, cannot know it to more digits than 1 - k^2 keeps. By the arithmetic-geometric mean,
/// [AbramowitzStegun1964] 16.4 and 17.6; all values are right to a few roundings of 1.
class JacobiFunctions {
 public:
  /// 0 <= m1 <= 1.
  explicit JacobiFunctions(double m1);

  double complement() const { return m1_; }
  /// K(m), a quarter of the period of sn and cn; infinite for m1 = 0.
  double quarter_period() const { return quarter_period_; }

  JacobiValues operator()(double u) const;

  /// u with am(u) = phi, for any phi if m1 > 0, else |phi| < pi/2: F(phi | m).
  double inverse_amplitude(double phi) const;
  /// The integral of dphi / ((1 - n sin^2 phi) sqrt(1 - m sin^2 phi)) from 0 to phi; n < 1: Pi(n; phi | m).
  double third_kind(double n, double phi) const;

 private:
  static constexpr int kMostHalvings = 12;  // the mean converges quadratically: enough from any double m1

  double m1_;
  double quarter_period_ = std::numeric_limits<double>::infinity();
  int halvings_ = 0;
  std::array<double, kMostHalvings + 1> a_{}, b_{},
      c_{};  // a_n and b_n approach the mean, c_n = (a_{n-1} - b_{n-1}) / 2
};

}  // namespace trajet
