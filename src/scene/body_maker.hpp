#pragma once

#include <array>

#include "scene_numbers.hpp"
#include "trajet/law/program_builder.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// What a body may bounce off: nothing, things without friction, which turn all bodies but balls, or with it.
enum class Bounces { nowhere, smoothly, with_friction };

/// The numbers of a body's definition, but for its place in the state: shape, inertia, orientation, points, how it
/// turns. `bounces`: impacts make bodies turn that do not at the start. `is_turned`: so may something to which it
/// sticks. Throws InputError that points at the place.
World::Body make_body(const BodyDefinition& definition, const SceneNumbers& numbers, const MethodOptions& method,
                      Bounces bounces, bool is_turned);

/// The mass of an extended shape with a density, or of a compound's parts, kg; none if nothing says it. Throws
/// InputError if both the parts and the body say it.
std::optional<double> mass_from_solid(const BodyDefinition& definition, const SceneNumbers& numbers);

/// Position, velocity, orientation and angular velocity at the start.  // (6, or 6 + orientation + 3)
Eigen::VectorXd start_state(const BodyDefinition& definition, const World::Body& body, const SceneNumbers& numbers);

/// Adds the meanings of the names of a body's rotation: `prefix` is "" for its own laws or "NAME." for those of others.
/// What they compute becomes part of the builder's program where it is used.
void add_rotation_symbols(Symbols& symbols, const std::string& prefix, const World::Body& body,
                          ProgramBuilder& builder);

/// Appends the rates of a turning body's orientation and angular velocity to a group's law. `own`: the names of its
/// laws.
void add_rotation_law(const BodyDefinition& definition, const World::Body& body, const Symbols& own,
                      ProgramBuilder& law);

/// Appends the four parts w, x, y, z of the unit quaternion of roll, pitch and yaw (rad).
void add_quaternion(const std::array<ProgramBuilder::Value, 3>& roll_pitch_yaw, ProgramBuilder& builder);

/// A vector in the world's frame, written in that in which the state holds the body's angular velocity.
ProgramBuilder::Value in_frame_of_state(const ProgramBuilder::Value& vector_W, const World::Body& body,
                                        ProgramBuilder& builder);

}  // namespace trajet
