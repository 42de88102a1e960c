#include "jump_derivative.hpp"

#include <variant>

#include "trajet/geom/closest_point.hpp"
#include "trajet/geom/distance.hpp"
#include "trajet/geom/flat_faces.hpp"
#include "trajet/law/program_jacobian.hpp"
#include "trajet/rigid/kinematics.hpp"

namespace trajet {
namespace {

Vector3 normal_at(const Shape& shape, const Vector3& position, const Vector3& normal) {
  const Vector3 arm = position - std::visit([&](const auto& s) { return closest_point(s, position); }, shape);
  return (arm.dot(normal) < 0.0 ? -arm : arm).normalized();
}

/// The derivative of a shape's normal by the position of the centre of a ball that touches it, 1/m.
Matrix3 curvature(const Shape& shape, const Vector3& point, const Vector3& position, const Vector3& normal,
                  double radius) {
  if (is_flat_at(shape, point, normal)) return Matrix3::Zero();
  // A point on the surface itself has no direction to it: one a little above has. Differences over a step of a
  // thousandth of that height keep half of the digits, and more are not needed of an error.
  const double height = radius > 0.0 ? radius : 1e-4 * (1.0 + position.norm());
  const Vector3 above = radius > 0.0 ? position : Vector3(position + height * normal);
  const double step = 1e-3 * height;
  Matrix3 result;
  for (int i = 0; i < 3; ++i) {
    const Vector3 shift = step * Vector3::Unit(i);
    result.col(i) = (normal_at(shape, above + shift, normal) - normal_at(shape, above - shift, normal)) / (2.0 * step);
  }
  return result;
}

}  // namespace

Matrix3 normal_derivative(const World& world, const Pair& pair, const std::optional<FrameMotion>& surface,
                          const Vector3& position) {
  const Shape& shape = world.obstacles[static_cast<std::size_t>(pair.id.obstacle)].shape;
  const double radius = bounding_radius(world.bodies[static_cast<std::size_t>(pair.id.body)].solid);
  const Vector3& n = pair.contact.normal;
  if (!surface) return curvature(shape, pair.contact.point, position, n, radius);
  const Matrix3& R = surface->R;
  return R *
         curvature(shape, surface->to_start(pair.contact.point), surface->to_start(position), R.transpose() * n,
                   radius) *
         R.transpose();
}

Eigen::MatrixXd derivative_of_bounce(const World& world, const Pair& pair, const std::optional<FrameMotion>& surface,
                                     const Instant& instant, const Eigen::VectorXd& rate) {
  const World::Body& body = world.bodies[static_cast<std::size_t>(pair.id.body)];
  const Vector3& n = pair.contact.normal;
  const Vector3 position = instant.before().segment<3>(body.offset);
  const Vector3 surface_velocity = surface ? surface->velocity_at(position) : Vector3(0, 0, 0);
  const Vector3 approach = rate.segment<3>(body.offset) - surface_velocity;
  const double speed = approach.dot(n);
  Eigen::MatrixXd derivative = instant.derivative;
  if (!(speed < 0.0)) return derivative;

  // v+ = v - (1 + e(u)) (c . n) n with u = -c . n and c = r' - s, r' moving as v does; s is the surface's velocity
  const RestitutionLaw& restitution = world.surface(pair.id.body, pair.id.obstacle).restitution;
  const double factor = 1.0 + restitution.at(-speed);
  const double speed_factor = restitution.change_rate(-speed);
  // how normal and surface velocity change from place to place
  const Matrix3 N = normal_derivative(world, pair, surface, position);
  Matrix3 S = Matrix3::Zero();
  Vector3 moved = Vector3::Zero();  // how v+ changes where the obstacle alone moves on
  if (surface) {
    S = cross_matrix(surface->w);
    const Vector3 turned = surface->w.cross(n) - N * surface_velocity;
    const Vector3 faster =
        surface->acceleration + surface->w_rate.cross(position - surface->p) - surface->w.cross(surface->v);
    moved = -(speed_factor * (approach.dot(turned) - n.dot(faster)) * n + factor * speed * turned);
  }
  derivative.block<3, 3>(body.offset + 3, body.offset) =
      -(speed_factor * n * (approach.transpose() * N - n.transpose() * S) + factor * speed * N);
  derivative.block<3, 3>(body.offset + 3, body.offset + 3) = Matrix3::Identity() - speed_factor * n * n.transpose();
  Eigen::RowVectorXd time = Eigen::RowVectorXd::Zero(rate.size());
  time.segment<3>(body.offset) = -n / speed;
  Eigen::VectorXd jump = derivative * rate - instant.rate();
  jump.segment<3>(body.offset + 3) += moved;
  derivative += jump * time;
  return derivative;
}

Eigen::MatrixXd derivative_of_set(const World::Event& event, const Instant& instant, const Eigen::VectorXd& rate) {
  const Eigen::Index size = rate.size();
  const double t = instant.time();
  const auto differentiate = [&](const Program& program) {
    const auto rows = static_cast<Eigen::Index>(program.outputs.size());
    Eigen::MatrixXd by_state(rows, size + 1);  // the last column: by time
    ProgramJacobian jacobian(program);
    jacobian(t, instant.before().data(), by_state.data(), by_state.col(size).data());
    return by_state;
  };
  const Eigen::MatrixXd set = differentiate(event.set), when = differentiate(event.when);
  Eigen::MatrixXd derivative = instant.derivative;
  Eigen::VectorXd moved = rate;  // the rate of the new state along the motion before
  for (std::size_t i = 0; i < event.targets.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    derivative.row(event.targets[i]) = set.row(row).head(size);
    moved[event.targets[i]] = set.row(row).head(size).dot(rate) + set(row, size);
  }
  const double when_rate = when.row(0).head(size).dot(rate) + when(0, size);
  if (when_rate != 0.0) derivative += (moved - instant.rate()) * (-when.row(0).head(size) / when_rate);
  return derivative.allFinite() ? derivative : instant.derivative;
}

}  // namespace trajet
