#pragma once

#include "instant.hpp"
#include "meetings.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

/// How the gap of two bodies that touch changes: m/s and m/s^2 of what is fixed in either, along the contact's normal.
struct GapMotion {
  double speed;
  double acceleration;
};
/// In the states of the two bodies' groups, which have the rates.
GapMotion gap_motion(const World& world, const Meeting& meeting, const Eigen::VectorXd& q_first,
                     const Eigen::VectorXd& rate_first, const Eigen::VectorXd& q_second,
                     const Eigen::VectorXd& rate_second);

/// How far the gap of a meeting may be off at its contact, m.
double gap_error(const World& world, const Meeting& meeting, Course& first, Course& second);

/// The impact of two bodies: changes the states of both instants, which are one where the bodies are of
/// one course, and what becomes of the states' errors; tells `impact` what came of it.
///
/// \param errors_first, errors_second  of the states before, as Course::error_columns gives them
/// Returns the energy that Newton's law of impact has gained, J.
double bounce_bodies(const World& world, const Meeting& meeting, const Surface& surface, double restitution,
                     const Eigen::MatrixXd& errors_first, const Eigen::MatrixXd& errors_second, Instant& first,
                     Instant& second, Impact& impact);

}  // namespace trajet
