#include "trajet/rigid/free_invariants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trajet {

FreeInvariants::FreeInvariants(const Quaternion& q_WB, const Vector3& w_WB_B, const Matrix3& inertia)
    : principal_(principal_axes(inertia)) {
  const Vector3& I = principal_.moments;
  const double middle = std::max(std::min(I.x(), I.y()), std::min(std::max(I.x(), I.y()), I.z()));
  excess_moments_ = I.cwiseProduct(I - Vector3::Constant(middle));
  const Vector3 w = principal_.R_BP.transpose() * w_WB_B;
  twice_energy_ = w.dot(I.cwiseProduct(w));
  excess_ = w.dot(excess_moments_.cwiseProduct(w));
  momentum_W_ = rotate<double>(q_WB, inertia * w_WB_B).stableNormalized();
}

void FreeInvariants::restore(Quaternion& q_WB, Vector3& w_WB_B) const {
  if (twice_energy_ == 0.0) return;
  const Vector3 start = principal_.R_BP.transpose() * w_WB_B;
  // w + a g + b h with e = w . g - 2 T = 0, f = w . h - (L^2 - 2 T I_middle) = 0, g = I w, h = I (I - I_middle) w:
  // Newton's method for a and b; the derivatives are twice the products of g and h
  Vector3 w = start;
  constexpr int kMostIterations = 5;
  for (int i = 0; i < kMostIterations; ++i) {
    const Vector3 g = principal_.moments.cwiseProduct(w), h = excess_moments_.cwiseProduct(w);
    const double e = w.dot(g) - twice_energy_, f = w.dot(h) - excess_;
    constexpr double kInvariantRounding = 2.0 * std::numeric_limits<double>::epsilon();
    if (std::abs(e) <= kInvariantRounding * twice_energy_ &&
        std::abs(f) <= kInvariantRounding * w.cwiseAbs().dot(h.cwiseAbs()))
      break;
    const double gg = g.dot(g), gh = g.dot(h), hh = h.dot(h);
    const double determinant = g.cross(h).squaredNorm();  // gg hh - gh^2 without cancellation
    // about a principal axis the gradients are parallel: then the energy alone is kept
    constexpr double kParallel = 1e-12;  // of the squared sine of their angle
    const bool is_parallel = !(determinant > kParallel * gg * hh);
    const double a = is_parallel ? -0.5 * e / gg : -0.5 * (e * hh - f * gh) / determinant;
    const double b = is_parallel ? 0.0 : -0.5 * (f * gg - e * gh) / determinant;
    w += a * g + b * h;
  }
  constexpr double kNear = 0.1;  // Newton's method went astray beyond
  if (!((w - start).norm() <= kNear * start.norm())) return;
  w_WB_B = principal_.R_BP * w;

  const Vector3 momentum_B = principal_.R_BP * principal_.moments.cwiseProduct(w);
  const Vector3 from = rotate<double>(q_WB, momentum_B).stableNormalized();
  const Vector3 axis = from.cross(momentum_W_);
  const double cosine = from.dot(momentum_W_);
  if (!(cosine > 0.0)) return;
  q_WB = (Quaternion(1.0 + cosine, axis.x(), axis.y(), axis.z()) * q_WB).normalized();
}

}  // namespace trajet
