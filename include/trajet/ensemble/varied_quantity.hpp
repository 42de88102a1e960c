#pragma once

#include <functional>
#include <string>

#include "trajet/scene/scene.hpp"

namespace trajet {

/// A number of a scene that differs from motion to motion: a parameter, or a key such as `ground.restitution`.
struct VariedQuantity {
  using Setter = std::function<void(double)>;

  std::string name;
  /// What gives the quantity a value (SI units) in that scene, which outlives it.
  std::function<Setter(Scene&)> bind;
};

}  // namespace trajet
