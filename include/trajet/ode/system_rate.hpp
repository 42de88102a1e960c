#pragma once

#include <Eigen/Core>

#include "trajet/ode/system.hpp"

namespace trajet {

/// Lets a run-time System be the rate of a stepper of run-time dimension. The System must outlive it.
class SystemRate {
 public:
  explicit SystemRate(System& system) : system_(&system) {}

  void operator()(double t, const Eigen::VectorXd& q, Eigen::VectorXd& dq) const {
    system_->rate(t, q.data(), dq.data());
  }
  void jacobian(double t, const Eigen::VectorXd& q, Eigen::MatrixXd& dg_dq, Eigen::VectorXd& dg_dt) const {
    system_->jacobian(t, q.data(), dg_dq.data(), dg_dt.data());
  }

 private:
  System* system_;
};

}  // namespace trajet
