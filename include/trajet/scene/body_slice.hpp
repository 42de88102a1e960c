#pragma once

#include <optional>

#include "trajet/math/vector.hpp"
#include "trajet/rigid/orientation.hpp"

namespace trajet {

/// Where a body's numbers lie in the state of its group: position and velocity (world frame, m and m/s), and of a
/// turning body its orientation and its angular velocity (rad/s), both as the layout says. In a rate the same places
/// hold their rates.
///
/// The accessors take any vector of Eigen's, and give what `segment` gives: of one that can be changed, a part that
/// can.
struct BodySlice {
  int first = 0;                              ///< of the body's components
  std::optional<OrientationLayout> layout{};  ///< none: it does not turn

  static constexpr int kMovingSize = 6;  ///< of position and velocity

  int position_index() const { return first; }
  int velocity_index() const { return first + 3; }
  /// Of a turning body.
  int orientation_index() const { return first + kMovingSize; }
  int angular_velocity_index() const { return orientation_index() + layout->size(); }
  /// Of all its components.
  int size() const { return kMovingSize + (layout ? layout->size() + 3 : 0); }

  template <class V>
  auto position(V&& q) const {
    return q.template segment<3>(position_index());
  }
  template <class V>
  auto velocity(V&& q) const {
    return q.template segment<3>(velocity_index());
  }
  /// Position and velocity.
  template <class V>
  auto moving_part(V&& q) const {
    return q.template segment<kMovingSize>(first);
  }
  /// The numbers of a turning body's orientation, as its layout reads and writes them.
  template <class V>
  auto* orientation(V&& q) const {
    return q.data() + orientation_index();
  }
  template <class V>
  auto angular_velocity(V&& q) const {
    return q.template segment<3>(angular_velocity_index());
  }
};

}  // namespace trajet
