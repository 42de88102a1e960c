#pragma once

#include <vector>

#include "trajet/scene/world.hpp"
#include "trajet/study/compare.hpp"

namespace trajet {

/// Keeps of each quantity the value that is worse.
void raise(RotationDeviation& worst, const RotationDeviation& value);

/// Measures what becomes of the orientations, energies and angular momenta of the bodies that turn.
class RotationMeter {
 public:
  RotationMeter() = default;
  /// The World outlives the meter.
  explicit RotationMeter(const World& world);

  bool empty() const { return bodies_.empty(); }
  /// Of the bodies of a group in a state, its orientations settled; `reference` is not-a-number where it is not known.
  RotationDeviation measure(int group, const Eigen::VectorXd& state, const Eigen::VectorXd& reference) const;

 private:
  struct Body {
    int group;
    const World::Rotation* rotation;
    double energy = 0.0;                 // J, at the start
    Vector3 momentum = Vector3::Zero();  // N m s, world frame, at the start

    RotationDeviation measure(const double* state, const double* reference) const;
    bool keeps_energy() const { return rotation->is_free && rotation->inertia.has_value(); }
  };
  std::vector<Body> bodies_;
};

}  // namespace trajet
