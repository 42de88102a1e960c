#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "trajet/ode/integrate.hpp"
#include "trajet/ode/segment.hpp"
#include "trajet/ode/segment_list.hpp"

namespace trajet {

/// A solution as a function of time: the Segments of an integration, in its order.
template <int Dim>
struct Trajectory {
  using State = Eigen::Matrix<double, Dim, 1>;

  double start_time = 0.0;
  State start;
  SegmentList<Dim> segments;
  IntegrationStatus status = IntegrationStatus::finished;
  StepStatistics statistics;
  std::vector<std::string> warnings;

  /// How far the solution goes; the end asked for if `status` is `finished`.
  double end_time() const { return segments.empty() ? start_time : segments.end_time(); }

  /// The state at the end.
  State end() const { return state(end_time()); }

  /// The state at any time from the start to the end. Throws std::out_of_range elsewhere.
  State state(double t) const {
    const double direction = end_time() < start_time ? -1.0 : 1.0;
    if (!((t - start_time) * direction >= 0.0 && (end_time() - t) * direction >= 0.0))
      throw std::out_of_range("the time lies outside the trajectory");
    if (segments.empty()) return start;
    return segments[segments.find(t, direction)].state(t);
  }
};

}  // namespace trajet
