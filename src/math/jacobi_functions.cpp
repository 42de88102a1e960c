#include "trajet/math/jacobi_functions.hpp"

#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>
#include <cassert>
#include <cmath>
#include <numbers>

namespace trajet {

using std::numbers::pi;

JacobiFunctions::JacobiFunctions(double m1) : m1_(m1) {
  assert(m1 >= 0.0 && m1 <= 1.0);
  if (m1 == 0.0) return;
  a_[0] = 1.0;
  b_[0] = std::sqrt(m1);
  constexpr double kNegligible = 1e-17;  // c_n is the square of what the next one would be
  for (std::size_t n = 1; n <= kMostHalvings; ++n) {
    a_[n] = 0.5 * (a_[n - 1] + b_[n - 1]);
    b_[n] = std::sqrt(a_[n - 1] * b_[n - 1]);
    c_[n] = 0.5 * (a_[n - 1] - b_[n - 1]);
    halvings_ = static_cast<int>(n);
    if (c_[n] <= kNegligible * a_[n]) break;
  }
  quarter_period_ = 0.5 * pi / a_[static_cast<std::size_t>(halvings_)];
}

JacobiValues JacobiFunctions::operator()(double u) const {
  if (m1_ == 0.0) {  // sn = tanh, cn = dn = sech
    const double sech = 1.0 / std::cosh(u);
    return {std::atan(std::sinh(u)), std::tanh(u), sech, sech};
  }
  // am(u + 2 j K) = am(u) + j pi
  const double half_periods = std::nearbyint(u / (2.0 * quarter_period_));
  const double rest = u - half_periods * 2.0 * quarter_period_;
  // phi_N = 2^N a_N u;  sin(2 phi_{n-1} - phi_n) = c_n / a_n sin phi_n, whose cosine is sqrt(b_n^2 + c_n^2 cos^2 phi_n)
  // / a_n
  double phi = std::ldexp(a_[static_cast<std::size_t>(halvings_)] * rest, halvings_);
  for (auto n = static_cast<std::size_t>(halvings_); n > 0; --n)
    phi = 0.5 * (phi + std::atan2(c_[n] * std::sin(phi), std::hypot(b_[n], c_[n] * std::cos(phi))));
  const double sign = std::fmod(half_periods, 2.0) == 0.0 ? 1.0 : -1.0;
  const double sine = std::sin(phi), cosine = std::cos(phi);
  return {phi + half_periods * pi, sign * sine, sign * cosine, std::hypot(cosine, b_[0] * sine)};
}

double JacobiFunctions::inverse_amplitude(double phi) const {
  const double half_periods = std::nearbyint(phi / pi);
  const double sine = std::sin(phi - half_periods * pi), cosine = std::cos(phi - half_periods * pi);
  // Carlson's form, [DLMF2024] 19.25.5, with 1 - m sin^2 = cos^2 + m1 sin^2
  const double first = sine * boost::math::ellint_rf(cosine * cosine, cosine * cosine + m1_ * sine * sine, 1.0);
  return half_periods == 0.0 ? first : half_periods * 2.0 * quarter_period_ + first;
}

double JacobiFunctions::third_kind(double n, double phi) const {
  // [DLMF2024] 19.25.14
  const auto within_quarter = [&](double sine, double cosine) {
    const double x = cosine * cosine, y = x + m1_ * sine * sine, p = 1.0 - n * sine * sine;
    const double rj = n == 0.0 ? 0.0 : boost::math::ellint_rj(x, y, 1.0, p);
    return sine * (boost::math::ellint_rf(x, y, 1.0) + n / 3.0 * sine * sine * rj);
  };
  const double half_periods = std::nearbyint(phi / pi);
  const double rest = phi - half_periods * pi;
  const double first = within_quarter(std::sin(rest), std::cos(rest));
  return half_periods == 0.0 ? first : half_periods * 2.0 * within_quarter(1.0, 0.0) + first;
}

}  // namespace trajet
