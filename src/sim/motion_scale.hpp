#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "trajet/ode/system.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// A law near a state: its rate there, and the derivative of the rate.
struct LinearLaw {
  Eigen::VectorXd rate;
  Eigen::MatrixXd by_state;
};

/// How large the components of a group's state are in its motion, and the absolute tolerances that follow from it.
///
/// The components of a vector — a position, a velocity, an angular velocity — share a scale, the largest length that
/// the vector has had so far; so does not depend on the axes what a step may be off by. What is zero at first has the
/// scale that the law will give it; what has none is taken for 1. A tolerance is a part of the scale, of 1 at most, and
/// never below what rounding leaves of the law or of the state.
class MotionScale {
 public:
  /// `factor`: the part of `StepOptions::atol` that is asked for.
  MotionScale(const World& world, int group, double factor);

  /// Of each component, in its unit: for StepOptions::component_atol. Changes as the motion goes on.
  std::shared_ptr<const std::vector<double>> tolerances() const { return tolerances_; }

  /// The motion starts or goes on from (t, q) under the law.
  void begin(double t, const Eigen::VectorXd& q, System& law);
  /// A step of length `step` (s) has ended in (t, q).
  void grow(double t, const Eigen::VectorXd& q, double step, System& law);

 private:
  /// Components that share a scale.
  struct Part {
    int first = 0;
    int size = 1;
    double scale = 0.0;     ///< the largest so far; 0: not known
    double rounding = 0.0;  ///< that the law leaves of it in a step
    double of(const Eigen::VectorXd& q) const { return q.segment(first, size).norm(); }
  };

  void add(int first, int size) { parts_.push_back({first, size}); }
  void take(const Eigen::VectorXd& q);
  void update_tolerances();
  /// What the law makes of what is zero.
  void foresee(double t, const Eigen::VectorXd& q, System& law);
  /// The distance (m) to what is nearest to the body, its own from the origin or an obstacle's; 0: there is none.
  double length_near(const World::Body& body, const Vector3& position) const;
  /// `step`: of the last step, s; 0: there was none.
  void find_rounding(const LinearLaw& law, const Eigen::VectorXd& q, double step);
  bool is_small() const;

  const World& world_;
  int group_;
  double tolerance_;         // of a scale of 1
  std::vector<Part> parts_;  // of each body position and velocity, and of a turning one its angular velocity; states
  long steps_ = 0;           // since rounding was looked at
  std::shared_ptr<std::vector<double>> tolerances_;
};

}  // namespace trajet
