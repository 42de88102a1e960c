#pragma once

#include "frame_paths.hpp"
#include "trajet/collide/detect/contact.hpp"
#include "trajet/scene/driven_frame.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// An obstacle that moves as it is told, on its way: where it is, and what runs into it.
class DrivenObstacle {
 public:
  /// `obstacle` has a drive, and lives as long as this.
  explicit DrivenObstacle(const World::Obstacle& obstacle);

  FrameMotion at(double t) { return frame_.at(t); }
  /// Of the frame of its solid, from `from` on towards `until`: see `driven_path`.
  FramePath path(double from, double until) { return driven_path(frame_, obstacle_.p_WB, obstacle_.q_WB, from, until); }

  /// The first contact of a ball of that radius between two times on its Segment, where its position begins at
  /// component `offset`: as `first_contact` of collide/detect, whose path is what the obstacle sees of the ball's. In
  /// the world.
  ContactResult first_contact(const Segment<>& motion, int offset, double radius, double from, double to,
                              Locator locator, const ContactMemory& memory);

 private:
  /// From when on, within two times, the ball may be near the obstacle whatever its orientation.
  double near_from(const Segment<>& motion, int offset, double radius, double from, double to);

  const World::Obstacle& obstacle_;
  DrivenFrame frame_;
  double reach_;  // m; of the obstacle, from its pivot
};

}  // namespace trajet
