#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "course.hpp"
#include "trajet/collide/detect/contact.hpp"
#include "trajet/portable.hpp"

namespace trajet {

/// A body and an obstacle, by their indices in the World.
struct PairId {
  int body;
  int obstacle;
  bool operator==(const PairId&) const = default;
};

/// One course at an instant at which its motion changes, while it is being decided what becomes of it.
///
/// It begins as the course is: in its state, with its lasting contacts. Responses change the instant; the course stays
/// as it was until it takes the instant as a whole (`Course::restart`).
class Instant {
 public:
  Instant(const Course& course, double time);

  double time() const { return time_; }
  const Course& course() const { return course_; }
  /// The state in which the course came here.
  const Eigen::VectorXd& before() const { return before_; }

  Eigen::VectorXd q;                     ///< the state in which the course goes on
  std::vector<RestingContact> contacts;  ///< the lasting contacts with which it goes on
  std::vector<EventHold> holds;          ///< the events at which it stays
  /// What is known of pairs behind this instant.
  std::vector<std::pair<PairId, ContactMemory>> memories;

  /// The derivative of `q` by `before`, at one time: what an error of the state becomes.  // (state x state)
  Eigen::MatrixXd derivative;
  /// What errors of another course have become of, each a column.  // (state x any number)
  Eigen::MatrixXd further_errors{};

  /// Where the course carries its state in extended precision: three components of the new state, from `first` on, with
  /// all their digits. `q` takes them rounded.
  void set_extended(int first, const Vector3T<Extended>& part);
  /// `q` with the digits behind double precision that are known of it, if there are any: of what was set so, and of
  /// what is as it was before.
  std::optional<Eigen::VectorX<Extended>> extended() const;

  /// dq/dt in state `q`, the forces of `contacts` included.
  Eigen::VectorXd rate() const;
  /// The acceleration in state `q` of the body at `offset` that the law alone gives it, m/s^2.
  Vector3 free_acceleration(int offset) const;
  /// What `contacts` of the body at `offset` do together.
  Support support(int offset) const { return support_of(contacts, offset); }
  /// Takes out of the velocity of the body at `offset` what its contacts do not let pass.
  void stop_blocked_velocity(int offset);

 private:
  const Course& course_;
  double time_;
  Eigen::VectorXd before_;
  std::optional<Eigen::VectorX<Extended>> extended_;  // as it was before, or as it was set
};

}  // namespace trajet
