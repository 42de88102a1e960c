#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "trajet/collide/detect/contact.hpp"
#include "trajet/collide/respond/simultaneous.hpp"
#include "trajet/error.hpp"
#include "trajet/event/crossing.hpp"
#include "trajet/geom/triangle_mesh.hpp"
#include "trajet/law/expression.hpp"
#include "trajet/law/lookup_table.hpp"
#include "trajet/rigid/orientation.hpp"
#include "trajet/scene/rgb_color.hpp"

namespace trajet {

/// A scene: everything that a motion is made of, as plain data. The scene file and C++ programs fill the same struct.
///
/// Every quantity is an Expression over the parameters, SI units, world frame W; only laws (`acceleration`, `force`,
/// `torque`, `angular_acceleration`, `position_rate`, `rate`, `when`, `set`) may also use t and the states. `World`
/// gives it numbers and checks it.

struct NamedExpression {
  std::string name;
  Expression value;
  SourceLocation where{};
};

struct TimeOptions {
  Expression start = 0.0;            ///< s
  std::optional<Expression> end;     ///< s; required
  std::optional<Expression> sample;  ///< s; default: (end - start) / 200
};

struct MethodOptions {
  std::string name = "taylor";
  std::optional<Expression> rtol;      ///< default 1e-12
  std::optional<Expression> atol;      ///< default 1e-12 of each component's scale, of 1 at most
  std::optional<Expression> step;      ///< s
  std::optional<Expression> max_step;  ///< s; no step is longer
  std::vector<Expression> steps;       ///< s; unequal steps of a fixed-step method, one after the other
  int order = 0;                       ///< series methods; 0: the method chooses
  SourceLocation order_where{};
  long max_steps = 1'000'000;
  std::optional<Expression> max_seconds{};                             ///< s of elapsed time; none: no limit
  Locator locate = Locator::polynomial;                                ///< how the times of impacts are found
  Simultaneous simultaneous = Simultaneous::reflections;               ///< what becomes of impacts at one instant
  OrientationWay orientation = OrientationWay::quaternion_normalized;  ///< how orientations are carried
  SourceLocation where{};                                              ///< of the name, or of the table
  SourceLocation orientation_where{};
};

/// Shapes, in the frame of what has them: bodies and obstacles share them, though not all suit both.
struct PointShape {};
struct BallShape {
  Expression radius;  ///< m
};
struct CuboidShape {
  Expression size;  ///< full edge lengths, m
};
struct CylinderShape {
  Expression radius, height;  ///< m; along z
};
struct CapsuleShape {
  Expression radius, height;  ///< m; along z; the height without the half spheres
};
/// Along z: the centre of mass at the origin, the base at -height/4, the tip at 3/4 of the height.
struct ConeShape {
  Expression radius, height;  ///< m
};
struct EllipsoidShape {
  Expression radii;  ///< along x, y, z; m
};
struct SoccerBallShape {
  Expression radius;  ///< of the corners of the truncated icosahedron, m
};
struct HullShape {
  std::vector<Expression> points;  ///< m
};
struct MeshShape {
  TriangleMesh mesh;
  Expression scale = 1.0;  ///< of the mesh's coordinates, m
};
/// Matter fills the side away from the normal. A plane, a disk and a rectangle lie around the origin.
struct PlaneShape {
  Expression normal;  ///< any length
};
struct DiskShape {
  Expression normal;  ///< any length; of a body along z of its frame
  Expression radius;  ///< m
};
struct RectangleShape {
  Expression normal;         ///< any length
  Expression up;             ///< direction of the height, made orthogonal to the normal
  Expression width, height;  ///< m, full edge lengths; the height along `up`
};
struct TriangleShape {
  Expression a, b, c;  ///< corners, m
};
/// The ground beneath a height above the plane z = 0 of its frame.
struct TerrainShape {
  Expression height;  ///< m, a formula of x and y
};
struct PartDefinition;
struct CompoundShape {
  std::vector<PartDefinition> parts;
};
using ShapeDefinition = std::variant<PointShape, BallShape, CuboidShape, CylinderShape, CapsuleShape, ConeShape,
                                     EllipsoidShape, SoccerBallShape, HullShape, MeshShape, PlaneShape, DiskShape,
                                     RectangleShape, TriangleShape, TerrainShape, CompoundShape>;

/// Exactly one of the four, or none for the identity.
struct OrientationDefinition {
  std::optional<Expression> axis, angle_rad;
  std::vector<Expression> quaternion;  ///< w, x, y, z; normalised
  std::vector<Expression> matrix;      ///< three rows; a rotation
  /// Three angles, rad: R_WB = Rz(yaw) Ry(pitch) Rx(roll), about the axes of the world in the order x, y, z, which is
  /// about those of the turning body in the order z, y, x.
  std::vector<Expression> roll_pitch_yaw;
  SourceLocation where{};
};

/// A part of a compound: a shape that stands in the compound's own frame.
struct PartDefinition {
  ShapeDefinition shape = PointShape{};
  std::optional<Expression> rounding{};    ///< m
  Expression position = Vector3(0, 0, 0);  ///< of the origin of its shape's frame, m
  OrientationDefinition orientation{};
  std::optional<Expression> mass{};     ///< kg; or:
  std::optional<Expression> density{};  ///< kg/m^3; neither: all parts have that of the body
  SourceLocation where{};
};

/// What a body lets itself be met by. A pair meets if both sides agree; obstacles agree to all.
struct CollidesWith {
  enum class Kind { all, obstacles, none, listed };
  Kind kind = Kind::all;
  std::vector<std::string> names{};  ///< of bodies and obstacles; of `listed`
  SourceLocation where{};
};

enum class OnHit { stop, bounce, pass, stick };

/// What ends the restitution of an impact with friction: the work that compression has done times e^2 is given back
/// (Stronge), its impulse times e (Poisson), or the normal speed times e (Newton).
enum class ImpactLaw { stronge, poisson, newton };

/// How a surface resists what slides, rolls or spins on it. What is left out is 0, or as friction alone decides.
struct FrictionDefinition {
  std::optional<Expression> friction{};                ///< Coulomb's coefficient, >= 0
  std::optional<Expression> tangential_restitution{};  ///< -1..1, of the slip at the point of contact that grips
  std::optional<Expression> rolling_friction{};        ///< m, >= 0: torque over normal force
  std::optional<Expression> spinning_friction{};       ///< m, >= 0: the same about the normal
  std::optional<ImpactLaw> impact{};
};

/// A moving body. Its name is usable in every law as NAME.r, NAME.vx, ….
struct BodyDefinition {
  std::string name;
  /// Its centre of mass is the origin of the body's frame: hulls, meshes and compounds are moved there. Planes and
  /// what is thin are no bodies, but for disks.
  ShapeDefinition shape = PointShape{};
  std::optional<Expression> rounding{};       ///< radius of the shape's edges and corners, inside it, m; none: sharp
  Expression position = Vector3(0, 0, 0);     ///< p_WB at the start, m
  Expression velocity = Vector3(0, 0, 0);     ///< v_WB at the start, m/s
  std::optional<Expression> acceleration{};   ///< m/s^2; or `force` with `mass`; neither: uniform motion
  std::optional<Expression> force{};          ///< N
  std::optional<Expression> mass{};           ///< kg, may depend on t and the states
  std::optional<Expression> position_rate{};  ///< dr/dt in m/s; default: the velocity

  OrientationDefinition orientation{};                ///< at the start
  std::optional<Expression> angular_velocity{};       ///< w_WB_W at the start, rad/s; or:
  std::optional<Expression> angular_velocity_body{};  ///< w_WB_B
  std::optional<Expression> angular_acceleration{};   ///< rad/s^2 in the world's frame; or:
  std::optional<Expression>
      angular_acceleration_body{};          ///< in the body's; neither: Euler's equations, if it has an inertia
  std::optional<Expression> torque{};       ///< N m about the centre of mass, in the world's frame
  std::optional<Expression> torque_body{};  ///< N m, in the body's frame; the two add up
  std::optional<Expression>
      force_point{};                    ///< where the force acts, in the body's frame, m; default: the centre of mass
  std::optional<Expression> density{};  ///< kg/m^3, of an extended shape; instead of the mass
  std::optional<Expression> principal_inertia{};  ///< about the centre of mass along the body's axes, kg m^2; or:
  std::vector<Expression> inertia{};              ///< three rows, body's frame
  std::vector<NamedExpression> points{};          ///< of the body, in its frame, m, to be reported
  /// Of its surface, for impacts with other bodies, 0..1; may be a formula of `u`, the speed of approach along the
  /// normal, m/s; none: 1
  std::optional<Expression> restitution{};
  std::shared_ptr<const FrictionDefinition> friction{};  ///< of its surface, for impacts with other bodies
  CollidesWith collides_with{};
  std::optional<RgbColor> color{};  ///< in pictures; none: one that tells bodies apart
  SourceLocation where{};
};

/// The closed form of a body's orientation: formulas over t and the parameters.
struct ExactOrientation {
  std::string name;  ///< `ball.orientation`
  OrientationDefinition value;
  SourceLocation where{};
};

/// The axis of the world that points up in pictures. Nothing in a motion depends on it.
enum class UpAxis { y, z };

/// Something that bodies meet: at rest, or moving as told, whatever hits it.
struct ObstacleDefinition {
  std::string name;
  ShapeDefinition shape;                 ///< any but a point and a soccer ball
  std::optional<Expression> rounding{};  ///< radius of the shape's edges and corners, inside it, m; none: sharp
  /// Hollow: bodies live inside. Of a ball, a cuboid, a cylinder, a capsule, an ellipsoid.
  bool is_hollow = false;
  /// Where the origin of the shape's frame is, m; none: at that of the world. May be a formula of t.
  std::optional<Expression> center{};
  /// Of the shape's frame; none: that of the world. Its parts may be formulas of t. Of a hundred thousand obstacles few
  /// have one.
  std::shared_ptr<const OrientationDefinition> orientation{};
  /// Of the frame, from the start on, m/s; instead of a `center` that is a formula of t.
  std::optional<Expression> velocity{};
  /// Of the frame about its origin, world axes, rad/s; instead of an `orientation` by formulas of t.
  std::optional<Expression> angular_velocity{};
  OnHit on_hit = OnHit::stop;
  std::optional<RgbColor> color{};  ///< in pictures; none: grey
  /// 0..1, for bounce; may be a formula of `u`, the speed of approach along the normal, m/s; none: 1
  std::optional<Expression> restitution{};
  std::shared_ptr<const FrictionDefinition> friction{};  ///< of a hundred thousand obstacles few have one
  SourceLocation where{};
};

/// What becomes of two things where they touch, where that is not what follows from each of them.
struct PairDefinition {
  std::string first, second;                ///< a body and another body or an obstacle
  std::optional<OnHit> on_hit{};            ///< none: of bodies bounce, else the obstacle's
  std::optional<Expression> restitution{};  ///< as the obstacle's; none: of bodies the mean, else the obstacle's
  std::shared_ptr<const FrictionDefinition> friction{};  ///< what it leaves out is as with restitution
  SourceLocation where{};
};

/// A further ordinary differential equation d(name)/dt = rate.
struct StateDefinition {
  std::string name;
  Expression value;
  Expression rate;
  SourceLocation where{};
};

enum class EventAction { record, stop, set };

/// Something to notice when `when` crosses zero.
struct EventDefinition {
  std::string name;
  Expression when;
  CrossingDirection direction = CrossingDirection::any;
  EventAction action = EventAction::record;
  /// For `set`: new values, all computed from the state before. A name is an extra state or a part of a body: `ball.v`,
  /// `ball.vz`.
  std::vector<NamedExpression> set{};
  SourceLocation where{};
};

struct Scene {
  std::string title{};
  UpAxis up = UpAxis::z;
  std::string file{};  ///< where it was read from; empty for a scene built in C++
  std::vector<NamedExpression> parameters{};
  /// What `table("NAME", x)` of its formulas looks up, by name.
  std::map<std::string, std::shared_ptr<const LookupTable>> tables{};
  TimeOptions time{};
  MethodOptions method{};
  std::vector<BodyDefinition> bodies{};
  std::vector<ObstacleDefinition> obstacles{};
  std::vector<PairDefinition> pairs{};
  std::vector<StateDefinition> states{};
  std::vector<EventDefinition> events{};
  /// Closed forms over t and the parameters, by name: `ball.r`, `ball.v`, `ball.w`, `ball.w_body`, or an extra state.
  std::vector<NamedExpression> exact{};
  std::vector<ExactOrientation> exact_orientations{};
  std::vector<std::string> warnings{};  ///< sentences on what was assumed when it was made
};

}  // namespace trajet
