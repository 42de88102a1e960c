#include "driven_obstacle.hpp"

#include <algorithm>
#include <limits>
#include <variant>

#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/collide/detect/frame_view.hpp"
#include "trajet/event/path.hpp"

namespace trajet {
namespace {

double reach_of(const Shape& shape, const Vector3& pivot) {
  return std::visit(
      [&](const auto& s) {
        if constexpr (requires { bounding_ball(s); }) {
          const BoundingBall ball = bounding_ball(s);
          constexpr double kMargin = 1e-9;  // far above what the sums round to
          return (1.0 + kMargin) * ((ball.center - pivot).norm() + ball.radius + kMargin * pivot.norm());
        } else {
          return std::numeric_limits<double>::infinity();
        }
      },
      shape);
}

}  // namespace

DrivenObstacle::DrivenObstacle(const World::Obstacle& obstacle)
    : obstacle_(obstacle), frame_(*obstacle.drive), reach_(reach_of(obstacle.shape, obstacle.drive->pivot)) {}

double DrivenObstacle::near_from(const Segment<>& motion, int offset, double radius, double from, double to) {
  constexpr bool kTurns = false;
  const Sphere around{frame_.drive().pivot, reach_};
  while (from < to) {
    const Segment<3> view = view_from(frame_.piece(from, to), kTurns, around.center, motion, offset);
    const PointPath path(view, 0);
    const double end = std::min(to, view.t1());
    const ContactResult met = trajet::first_contact(Shape(around), {path, radius, from, end});
    if (met.status != ContactStatus::separated) return std::max(from, met.time);
    from = end;
  }
  return to;
}

ContactResult DrivenObstacle::first_contact(const Segment<>& motion, int offset, double radius, double from, double to,
                                            Locator locator, const ContactMemory& memory) {
  ContactResult result{.memory = memory};
  const bool turns = frame_.drive().turns;
  const bool is_bounded = turns && reach_ < std::numeric_limits<double>::infinity();
  while (from < to) {
    if (is_bounded) {
      const double near = near_from(motion, offset, radius, from, to);
      if (near > from) result.memory = {};
      from = near;
      if (!(from < to)) break;
    }
    const Segment<7> frame = frame_.piece(from, to);
    const Segment<3> view = view_from(frame, turns, frame_.drive().pivot, motion, offset);
    const PointPath path(view, 0);
    const double end = std::min(to, view.t1());
    if (!(end > from)) return {.status = ContactStatus::unresolved, .time = from, .memory = memory};
    result = trajet::first_contact(obstacle_.shape, {path, radius, from, end, locator}, result.memory);
    if (result.status != ContactStatus::separated) {
      const FrameMotion pose = frame_.at(result.time);
      result.point = pose.from_start(result.point);
      result.normal = pose.R * result.normal;
      result.position = pose.from_start(result.position);
      return result;
    }
    from = end;
  }
  return result;
}

}  // namespace trajet
