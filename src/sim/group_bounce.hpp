#pragma once

#include <map>
#include <optional>
#include <vector>

#include "contact_group.hpp"
#include "instant.hpp"
#include "trajet/collide/respond/impact_group.hpp"

namespace trajet {

/// The impacts of several contacts at one instant: what becomes of the bodies, and of the errors of their
/// states.
class GroupBounce {
 public:
  /// \param instants  of the courses of all bodies, by the course, as they come to the contacts
  /// \param surfaces  of each contact how its obstacle moves, if it is one that does
  GroupBounce(const World& world, const std::vector<GroupedContact>& contacts, std::map<int, Instant>& instants,
              std::vector<std::optional<FrameMotion>> surfaces);

  /// Its contacts are the points at which solids touch.
  const GroupResponse& response() const { return response_; }
  /// Of which of the contacts a point of the response is.
  std::size_t contact_of(int point) const { return touches_[static_cast<std::size_t>(point)].contact; }
  /// Whether nothing pushes but the first contact, and that at its one point.
  bool is_of_first_alone() const;
  /// Of a contact: its impulse on the first body, N s; the greatest speed at which one of its points was approached
  /// when it pushed first, m/s; and where its impulse acts.
  Vector3 impulse(std::size_t contact) const;
  double approach(std::size_t contact) const;
  Vector3 point(std::size_t contact) const;

  /// Changes the states of the instants, and what becomes of their errors. `errors`: of each course, as
  /// Course::error_columns gives them.
  ///
  /// The derivative is that of the rounds that were taken. States near these have each contact at a time of its own,
  /// which the derivative has to first order, for a body of several contacts their mean by the impulses. What would
  /// become of another order of contacts is not in it.
  void apply(const std::map<int, Eigen::MatrixXd>& errors);

 private:
  /// A point of a contact as the states of the bodies see it.
  struct Touch {
    std::size_t contact = 0;
    Vector3 place = Vector3::Zero();    ///< world
    bool is_round = false;              ///< the normal is the line of two centres
    Matrix3 turning = Matrix3::Zero();  ///< of a ball on an obstacle: the derivative of the normal by its place, 1/m
    int normal_owner = -1;              ///< the body with which the normal turns
    int point_owner = -1;               ///< the body in which the point is fixed
    Vector3 normal = Vector3::Zero();   ///< in the frame of its owner, or in the world
    Vector3 point = Vector3::Zero();    ///< likewise
  };
  struct Setting {
    std::vector<GroupBody> bodies{};
    std::vector<GroupContact> contacts{};
  };

  const World::Body& body(int index) const { return world_.bodies[static_cast<std::size_t>(index)]; }
  BodySlice slice(int body) const;
  Touch round_touch(const GroupedContact& contact, const std::optional<FrameMotion>& surface) const;
  Touch solid_touch(const GroupedContact& contact, const Vector3& place) const;
  Setting setting(const Eigen::VectorXd& q) const;
  /// Of a point, on the first body, N s.
  Vector3 impulse_at(std::size_t point) const {
    return response_.impulses[point] * normals_[point] + response_.frictions[point];
  }
  /// Puts velocities into a joint state.
  void put_after(const Setting& before, const std::vector<GroupBody>& after, Eigen::VectorXd& q) const;
  Eigen::MatrixXd derivative_at_fixed_time() const;
  /// How the time of a point's own contact changes with the joint state, s per unit.
  Eigen::RowVectorXd time_gradient(std::size_t point) const;

  const World& world_;
  const std::vector<GroupedContact>& contacts_;
  std::map<int, Instant>& instants_;
  std::vector<std::optional<FrameMotion>> surfaces_;
  std::map<int, int> offsets_;  // of each course in the joint state
  std::map<int, int> places_;   // of each body among those of the response
  Eigen::VectorXd before_;      // of all courses, one behind the other
  Eigen::VectorXd rate_;
  std::vector<Touch> touches_;
  std::vector<Vector3> normals_;  // of each touch
  GroupResponse response_;
};

}  // namespace trajet
