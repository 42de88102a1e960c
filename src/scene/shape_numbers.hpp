#pragma once

#include <string>
#include <utility>

#include "scene_numbers.hpp"
#include "trajet/scene/scene.hpp"

namespace trajet {

/// The numbers of a shape's definition. Messages end in whose they are: " of body 'ball'".
class ShapeNumbers {
 public:
  ShapeNumbers(const SceneNumbers& numbers, std::string of) : numbers_(numbers), of_(std::move(of)) {}

  double positive(const Expression& value, const char* key) const { return numbers_.positive(value, key + of_); }
  Vector3 vector(const Expression& value, const char* key) const { return numbers_.vector(value, key + of_); }
  Vector3 positive_vector(const Expression& value, const char* key) const {
    const Vector3 numbers = vector(value, key);
    if (!(numbers.minCoeff() > 0.0)) throw InputError(value.where(), key + of_ + " must be positive");
    return numbers;
  }
  Vector3 direction(const Expression& value, const char* key) const {
    const Vector3 numbers = vector(value, key);
    if (numbers.isZero(0.0)) throw InputError(value.where(), key + of_ + " must not be zero");
    return numbers;
  }
  Matrix3 rotation(const OrientationDefinition& orientation) const {
    return rotation_matrix(numbers_.orientation(orientation, "orientation" + of_));
  }

  std::optional<double> rounding(const std::optional<Expression>& value) const {
    return value ? std::optional(positive(*value, "rounding")) : std::nullopt;
  }
  /// Of whom, as messages end.
  const std::string& of() const { return of_; }
  const SceneNumbers& scene() const { return numbers_; }

 private:
  const SceneNumbers& numbers_;
  std::string of_;
};

inline TriangleMesh scaled(const MeshShape& mesh, const ShapeNumbers& numbers) {
  const double scale = numbers.positive(mesh.scale, "scale");
  TriangleMesh surface = mesh.mesh;
  for (Vector3& vertex : surface.vertices) vertex *= scale;
  return surface;
}

}  // namespace trajet
