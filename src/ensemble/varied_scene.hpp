#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "trajet/ensemble/varied_quantity.hpp"

namespace trajet {

/// A scene whose varied quantities can be given values again and again.
class VariedScene {
 public:
  /// `quantity(i)` for i below `count`: what varies.
  template <class Quantity>
  VariedScene(Scene scene, std::size_t count, const Quantity& quantity) : scene_(std::move(scene)) {
    for (std::size_t i = 0; i < count; ++i) setters_.push_back(quantity(i).bind(scene_));
  }
  VariedScene(const VariedScene&) = delete;  // the setters refer to the scene
  VariedScene& operator=(const VariedScene&) = delete;

  const Scene& with(std::span<const double> values) {
    for (std::size_t i = 0; i < setters_.size(); ++i) setters_[i](values[i]);
    return scene_;
  }

 private:
  Scene scene_;
  std::vector<VariedQuantity::Setter> setters_;
};

}  // namespace trajet
