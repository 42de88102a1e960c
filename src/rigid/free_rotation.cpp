#include "trajet/rigid/free_rotation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "trajet/portable.hpp"
#include "trajet/rigid/principal_axes.hpp"

namespace trajet {
namespace {

/// The shortest rotation that takes the unit vector l to the third axis; l is not opposite to it.
Quaternion to_third_axis(const Vector3& l) { return Quaternion(1.0 + l.z(), l.y(), -l.x(), 0.0).normalized(); }

/// The integral of dphi / (1 - n sin^2 phi) from 0 to phi, n < 1.
double circular_integral(double n, double phi) {
  using std::numbers::pi;
  const double root = std::sqrt(1.0 - n);
  const double half_turns = std::nearbyint(phi / pi);
  const double rest = phi - half_turns * pi;
  return (half_turns * pi + std::atan2(root * std::sin(rest), std::cos(rest))) / root;
}

/// The rotation from principal axes P to axes C in another order whose third is the axis of index `third` of P and
/// along which w has no negative part.
Matrix3 reordered(const std::array<int, 3>& order, const Vector3& w_P) {
  Matrix3 R_CP = Matrix3::Zero();
  for (int i = 0; i < 3; ++i) R_CP(i, order[static_cast<std::size_t>(i)]) = 1.0;
  if (w_P[order[2]] < 0.0) R_CP.row(2) *= -1.0;
  if (R_CP.determinant() < 0.0) R_CP.row(0) *= -1.0;
  return R_CP;
}

}  // namespace

FreeRotation::FreeRotation(const Quaternion& q_WB, const Vector3& w_WB_B, const Matrix3& inertia)
    : q_WB_(q_WB), w_WB_W_(rotate<double>(q_WB, w_WB_B)), tumbling_(tumbling(q_WB, w_WB_B, inertia)) {}

std::optional<FreeRotation::Tumbling> FreeRotation::tumbling(const Quaternion& q_WB, const Vector3& w_WB_B,
                                                             const Matrix3& inertia) {
  const PrincipalAxes principal = principal_axes(inertia);
  const Vector3 w_P = principal.R_BP.transpose() * w_WB_B;
  // The torque that would keep w constant, w x I w; as a difference of products rounding would leave some of it.
  const Vector3& moments = principal.moments;
  const Vector3 gyroscopic(w_P.y() * w_P.z() * (moments.z() - moments.y()),
                           w_P.z() * w_P.x() * (moments.x() - moments.z()),
                           w_P.x() * w_P.y() * (moments.y() - moments.x()));
  if (gyroscopic.isZero(0.0)) return std::nullopt;

  // The momentum turns around the axis of the largest moment c if L^2 >= 2 T b, that is c (c - b) w_c^2 >= a (b - a)
  // w_a^2 for a <= b <= c, else around that of the least; around that of a symmetric top in any case.
  std::array<int, 3> order{0, 1, 2};
  ranges::sort(order, {}, [&](int i) { return principal.moments[i]; });
  const auto moment = [&](std::size_t i) { return principal.moments[order[i]]; };
  const auto square = [&](std::size_t i) { return w_P[order[i]] * w_P[order[i]]; };
  const double around_largest = moment(2) * (moment(2) - moment(1)) * square(2);
  const double around_least = moment(0) * (moment(1) - moment(0)) * square(0);
  const bool is_prolate = moment(2) == moment(1);
  const double difference = std::abs(around_largest - around_least);
  if (is_prolate || around_largest < around_least) std::swap(order[0], order[2]);

  const Matrix3 R_CP = reordered(order, w_P);
  const Vector3 w = R_CP * w_P;
  const Vector3 I(moment(0), moment(1), moment(2));
  const Vector3 L = I.cwiseProduct(w);
  // w = (A cn u, B sn u, C dn u) solves Euler's equations for
  // A^2 = (L^2 - 2 T I3) / (I1 (I1 - I3)), C^2 = (L^2 - 2 T I1) / (I3 (I3 - I1)), written without cancellation,
  // p^2 = (I1 - I3) (I2 - I3) C^2 / (I1 I2), B = (I3 - I1) A C / (I2 p), 1 - m = |L^2 - 2 T I2| / (I3 |I2 - I3| C^2)
  const double A = std::sqrt(w.x() * w.x() + I.y() * (I.y() - I.z()) / (I.x() * (I.x() - I.z())) * w.y() * w.y());
  const double C = std::sqrt(w.z() * w.z() + I.y() * (I.y() - I.x()) / (I.z() * (I.z() - I.x())) * w.y() * w.y());
  const double p = std::sqrt((I.x() - I.z()) * (I.y() - I.z()) / (I.x() * I.y())) * C;
  const double B = (I.z() - I.x()) / I.y() * A * C / p;
  const double complement =
      I.x() == I.y() ? 1.0 : std::min(1.0, difference / (I.z() * std::abs(I.y() - I.z()) * C * C));

  const JacobiFunctions functions(complement);
  // the integrals grow with the phase: start within a quarter period of 0
  const double phi = std::atan2(w.y() / B, w.x() / A);
  const double n = -I.z() * (I.x() - I.y()) / (I.x() * (I.y() - I.z()));
  const Quaternion q_CB = from_rotation_matrix(R_CP * principal.R_BP.transpose());
  return Tumbling{.q_CB = q_CB,
                  .start = q_WB * q_CB.conjugate() * to_third_axis(L.normalized()).conjugate(),
                  .functions = functions,
                  .w1 = A,
                  .w2 = B,
                  .w3 = C,
                  .rate = p,
                  .phase = functions.inverse_amplitude(phi),
                  .inertia = I,
                  .momentum = L.norm(),
                  .n = n,
                  .third_kind_start = functions.third_kind(n, phi),
                  .circular_start = circular_integral(n, phi)};
}

Vector3 FreeRotation::w_WB_B(double time) const {
  if (!tumbling_) return rotate<double>(q_WB_.conjugate(), w_WB_W_);
  const Tumbling& top = *tumbling_;
  const JacobiValues at = top.functions(top.rate * time + top.phase);
  const Vector3 w_C(top.w1 * at.cn, top.w2 * at.sn, top.w3 * at.dn);
  return rotate<double>(top.q_CB.conjugate(), w_C);
}

Vector3 FreeRotation::w_WB_W(double time) const {
  return tumbling_ ? rotate<double>(q_WB(time), w_WB_B(time)) : w_WB_W_;
}

Quaternion FreeRotation::q_WB(double time) const {
  if (!tumbling_) return (from_rotation_vector<double>(w_WB_W_ * time) * q_WB_).normalized();
  const Tumbling& top = *tumbling_;
  const JacobiValues at = top.functions(top.rate * time + top.phase);
  const Vector3& I = top.inertia;
  const Vector3 momentum_C(I.x() * top.w1 * at.cn, I.y() * top.w2 * at.sn, I.z() * top.w3 * at.dn);
  // Between the frame whose third axis is L and C lies the shortest rotation of one to the other and a turn about L by
  // chi, chi' = L/I3 - (L^2 - 2 T I3) / (I3 (L + I3 w3)), whose integral is
  // chi = L t/I3 - (I1 - I3) / (I1 I3 p) (L Pi(n; am u) - I3 C circular(n; am u)), from time 0 to t
  const double third_kind = top.functions.third_kind(top.n, at.am) - top.third_kind_start;
  const double circular = circular_integral(top.n, at.am) - top.circular_start;
  const double chi = top.momentum / I.z() * time - (I.x() - I.z()) / (I.x() * I.z() * top.rate) *
                                                       (top.momentum * third_kind - I.z() * top.w3 * circular);
  const Quaternion turn = from_rotation_vector<double>(Vector3(0.0, 0.0, chi));
  return (top.start * turn * to_third_axis(momentum_C.normalized()) * top.q_CB).normalized();
}

}  // namespace trajet
