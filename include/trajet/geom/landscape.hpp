#pragma once

#include "trajet/geom/shapes.hpp"
#include "trajet/math/interval.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// A height over the plane z = 0 of a frame B that stands in the world, as a function of x and y of that frame.
class Landscape {
 public:
  Landscape(const Vector3& p_WB, const Matrix3& R_WB) : p_WB_(p_WB), R_WB_(R_WB) {}
  virtual ~Landscape() = default;
  Landscape(const Landscape&) = delete;
  Landscape& operator=(const Landscape&) = delete;

  const Vector3& p_WB() const { return p_WB_; }
  const Matrix3& R_WB() const { return R_WB_; }

  /// m; of places at which the formula has none, not a number.
  virtual double height(double x, double y) const = 0;
  /// Encloses it with its derivatives along a path.
  virtual IntervalJet height(const IntervalJet& x, const IntervalJet& y) const = 0;

 private:
  Vector3 p_WB_;
  Matrix3 R_WB_;
};

/// The point of the ground straight below or above a place, along z of the landscape's frame.
struct GroundPlace {
  Vector3 point;   ///< in the world
  Vector3 normal;  ///< unit, upward
  double above;    ///< m, along z
};
GroundPlace ground_below(const Terrain& terrain, const Vector3& p);

/// How far p is above the tangent plane of the ground straight below it, negative beneath: the distance near the
/// ground.
double signed_distance(const Terrain& terrain, const Vector3& p);

/// The nearest point of the ground, by steps from tangent plane to tangent plane; for p near the ground.
Vector3 closest_point(const Terrain& terrain, const Vector3& p);

/// To the digits of double.
template <class T>
Vector3T<T> closest_point(const Terrain& terrain, const Vector3T<T>& p) {
  return closest_point(terrain, Vector3(p.template cast<double>())).template cast<T>();
}

}  // namespace trajet
