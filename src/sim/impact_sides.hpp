#pragma once

#include <Eigen/Core>
#include <string>

#include "trajet/collide/respond/frictional_impact.hpp"
#include "trajet/scene/body_slice.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

class Instant;

/// kg; 1 where the body has none: impulses are per mass then.
double mass_of(const World::Body& body, double t, const Eigen::VectorXd& q);

/// The same at an instant, for impacts with other bodies: infinite of a body that sticks to an obstacle, which no
/// impulse moves.
double mass_in_meetings(const World& world, int body, const Instant& instant);

/// What a surface has of friction in impacts.
ImpactFriction friction_of(const Surface& surface);

/// Why a body cannot answer to an impact on a surface as a rigid body does; empty if it can.
std::string why_it_cannot_bounce(const World::Body& body, const Surface& surface);

/// Why a restitution at a speed of approach, m/s, does not tell what becomes of an impact. `owner`: whose it is,
/// "obstacle 'ground'".
std::string describe_impossible_restitution(const std::string& owner, const Surface& surface, double restitution,
                                            double speed);

/// R_WB of a body whose numbers stand at `slice` of a state.
Matrix3 rotation_of(const World::Body& body, const BodySlice& slice, const Eigen::VectorXd& q);

/// The body as one side of an impact at a point of the world. `velocity`: of its centre, m/s. An infinite mass: no
/// impulse moves or turns it.
ImpactSide impact_side(const World::Body& body, const BodySlice& slice, const Eigen::VectorXd& q,
                       const Vector3& velocity, double mass, const Vector3& point);

/// Puts what an impact made of a side into the state.
void put(const World::Body& body, const BodySlice& slice, const ImpactSide& before, const ImpactSide& after,
         Eigen::VectorXd& q);

/// How a point that is fixed in a body moves, world frame: m/s and m/s^2. `rate`: of the state.
struct MaterialMotion {
  Vector3 velocity;
  Vector3 acceleration;
};
MaterialMotion motion_at(const World::Body& body, const Eigen::VectorXd& q, const Eigen::VectorXd& rate,
                         const Vector3& point);

/// Adds how far a point fixed in the body moves along `direction` with the numbers of the state: to each component's
/// place in `gradient`, m per unit of it.
void add_gradient(const World::Body& body, const BodySlice& slice, const Eigen::VectorXd& q, const Vector3& point,
                  const Vector3& direction, Eigen::VectorXd& gradient);

/// By how much a number of a state is changed for a difference that keeps half of the digits.
double small_part(double value);

}  // namespace trajet
