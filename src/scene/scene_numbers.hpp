#pragma once

#include <string>

#include "trajet/law/symbols.hpp"
#include "trajet/scene/scene.hpp"

namespace trajet {

/// Gives the constant quantities of a scene their values. Every error is an InputError that points at the quantity.
class SceneNumbers {
 public:
  explicit SceneNumbers(const Symbols& constants) : constants_(constants) {}

  const Symbols& constants() const { return constants_; }

  /// Whether a formula has a value: it needs constants only.
  bool knows(const Expression& formula) const;
  /// A finite number. `what` names it in messages: "radius of body 'ball'".
  double scalar(const Expression& value, const std::string& what) const;
  double positive(const Expression& value, const std::string& what) const;
  double not_negative(const Expression& value, const std::string& what) const;
  double within(const Expression& value, double lowest, double highest, const std::string& what) const;
  /// Three finite numbers.
  Vector3 vector(const Expression& value, const std::string& what) const;
  /// A unit quaternion, w >= 0 where it was a matrix. Throws InputError if a matrix is no rotation.
  Quaternion orientation(const OrientationDefinition& orientation, const std::string& what) const;

 private:
  const Symbols& constants_;
};

}  // namespace trajet
