#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "trajet/scene/world.hpp"

namespace trajet {

/// Whether an absolute tolerance that was asked for is coarser than a motion: then the steps may miss all of it.
class ToleranceCheck {
 public:
  /// The motion of a group starts.
  ToleranceCheck(const World& world, int group);
  /// It has come to state q.
  void take(const Eigen::VectorXd& q);
  /// A sentence on the first body or state that moves less than the tolerance can tell; empty if there is none.
  std::string warning() const;

 private:
  struct Part {
    std::string name;  ///< of the body or the state, as sentences have it
    std::string unit;
    int first = 0, size = 1;
    double reach = 0.0;    ///< how far it has come from its start
    double largest = 0.0;  ///< its length at most
  };

  double atol_;
  Eigen::VectorXd start_;
  std::vector<Part> parts_;
};

}  // namespace trajet
