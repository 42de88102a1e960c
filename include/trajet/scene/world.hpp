#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trajet/geom/shapes.hpp"
#include "trajet/geom/solid.hpp"
#include "trajet/law/program.hpp"
#include "trajet/ode/registry.hpp"
#include "trajet/portable.hpp"
#include "trajet/rigid/orientation.hpp"
#include "trajet/scene/body_slice.hpp"
#include "trajet/scene/named_value.hpp"
#include "trajet/scene/scene.hpp"
#include "trajet/scene/surface.hpp"

namespace trajet {

/// A scene with numbers: all names resolved, all values checked, all laws compiled. What the simulation runs.
///
/// Bodies, extra states and events that refer to each other form a group, which is integrated together; groups know
/// nothing of each other and keep steps of their own. The state of a group is, for each of its bodies, position and
/// velocity (m, m/s; world frame) and, if it turns, orientation and angular velocity (rad/s), then its extra states.
/// Programs take t, elapsed since the start, and that state.
struct World {
  /// How a body turns.
  struct Rotation {
    OrientationLayout layout;
    int offset = 0;                    ///< of the orientation in the group's state; the angular velocity follows it
    bool is_free = false;              ///< no torque, or a constant angular velocity: there is a closed form
    std::optional<Matrix3> inertia{};  ///< about the centre of mass, body's frame, kg m^2; none: kinematics
  };

  struct Point {
    std::string name;
    Vector3 p_B;  ///< m
  };

  /// What bodies and obstacles have in common.
  struct Thing {
    std::string name;
    Solid solid;
    std::optional<RgbColor> color{};  ///< as the scene says
    SourceLocation where{};
  };

  /// A thing that is free to move.
  struct Body : Thing {
    std::vector<Point> points;
    int group = 0;
    int offset = 0;                       ///< of its numbers in the group's state: see `slice`
    Quaternion q_WB{1.0, 0.0, 0.0, 0.0};  ///< at the start, unit
    std::optional<Rotation> rotation;     ///< none: it does not turn
    std::optional<Program> mass;          ///< kg, one output
    std::optional<Matrix3> inertia{};     ///< of a solid that impacts can turn: about its centre, its frame, kg m^2
    Surface surface{.on_hit = OnHit::bounce};
    Company company{};

    BodySlice slice() const { return {offset, rotation ? std::optional(rotation->layout) : std::nullopt}; }
  };

  /// How a thing moves that is driven as the scene says, whatever hits it.
  struct Drive {
    Vector3 pivot{};  ///< a place of the thing, m, in the world, at the start
    Program pose{};   ///< of t: where that place is, m, and the unit quaternion by which the thing has turned about it
    bool turns = false;  ///< or the quaternion is 1
  };

  /// A thing that is fixed in the world, or driven.
  struct Obstacle : Thing {
    std::shared_ptr<const Drive> drive{};  ///< none: fixed
    Vector3 p_WB;                          ///< of the solid's frame at the start, m
    Quaternion q_WB{1.0, 0.0, 0.0, 0.0};   ///< unit
    Shape shape;                           ///< the solid where it stands at the start
    Surface surface{};
  };

  struct ExtraState {
    std::string name;
    int group = 0;
    int offset = 0;  ///< in the group's state
  };

  struct Event {
    std::string name;
    int group = 0;
    Program when;  ///< one output
    CrossingDirection direction = CrossingDirection::any;
    EventAction action = EventAction::record;
    Program set;               ///< new values, in the order of `targets`
    std::vector<int> targets;  ///< offsets in the group's state
  };

  /// A formula of the scene from which components of a group's rate are computed.
  struct LawFormula {
    std::string_view key;  ///< as scenes call it: `acceleration`, `rate`
    int body = -1;         ///< in World::bodies; -1: that of the extra state at `first`
    int first = 0;         ///< of the components
    int size = 1;
    Expression text;
  };

  struct Group {
    Program law;  ///< outputs: the rate of the group's state
    std::vector<LawFormula> formulas;
    Eigen::VectorXd start;
    std::vector<int> bodies;  ///< indices into World::bodies
    std::vector<int> events;  ///< indices into World::events
  };

  /// A part of the exact solution, as the scene's `[exact]` gives it.
  struct ClosedForm {
    std::string name;  ///< `ball.r`, `ball.v` or an extra state
    int group = 0;
    int offset = 0;  ///< of its first component in the group's state
    Program value;   ///< of t alone; one output or three
    SourceLocation where{};
  };

  /// The exact rotation of a turning body, as the scene's `[exact]` gives it; what it does not give is not known.
  struct ClosedRotation {
    enum class Form { axis_angle, quaternion, matrix };
    struct Orientation {
      Form form;
      Program value;  ///< of t: an axis and an angle in rad; w, x, y, z; or nine components, row by row
      SourceLocation where{};
    };
    struct AngularVelocity {
      Frame frame;
      Program value;  ///< of t; three outputs, rad/s
      SourceLocation where{};
    };

    int body = 0;  ///< in World::bodies
    std::optional<Orientation> orientation{};
    std::optional<AngularVelocity> angular_velocity{};
  };

  /// What the scene's numbers are in extended precision, where the method carries the state so: a start of 0.1 or a
  /// radius of 1/3 is none that doubles have.
  struct ExtendedNumbers {
    struct Sphere {
      Vector3T<Extended> center;
      Extended radius;
    };
    std::vector<Eigen::VectorX<Extended>> starts;  ///< of each group
    std::vector<Extended> radii;                   ///< of each body
    std::map<int, Sphere> spheres;                 ///< of the obstacles that are spheres
  };

  /// Whether a body and an obstacle meet, and what becomes of them then.
  bool meets_obstacle(int body, int obstacle) const;
  const Surface& surface(int body, int obstacle) const;
  /// Whether two bodies meet: both let it, and at least one has extent.
  bool bodies_meet(int first, int second) const;
  /// What becomes of two bodies that meet: they bounce, with the geometric mean of their restitutions, where the scene
  /// says nothing else.
  Surface surface_of_bodies(int first, int second) const;

  /// +1, or -1 for a run backward in time.
  double direction() const { return duration < 0.0 ? -1.0 : 1.0; }

  std::string scene;  ///< file name
  std::string title;
  UpAxis up = UpAxis::z;
  /// The time at the start, s, as the scene's `t` has it. Everything behind the scene counts from there: the t of
  /// programs, of Segments and steps is the time elapsed, whose digits do not depend on the year.
  double epoch = 0.0;
  double duration = 0.0;  ///< s; negative for a run backward in time
  double sample = 0.0;    ///< s, > 0
  const MethodInfo* method = nullptr;
  StepOptions step_options;
  /// The absolute tolerance is the method's own: `step_options.atol` is a part of how large each component is.
  bool atol_follows_scale = false;
  long max_steps = 0;
  std::optional<double> max_seconds{};  ///< s, > 0, of elapsed time that a run may take
  Locator locate = Locator::polynomial;
  Simultaneous simultaneous = Simultaneous::reflections;
  std::vector<NamedValue> parameters;
  std::map<std::string, std::shared_ptr<const LookupTable>> tables;
  std::vector<std::string> warnings;  ///< sentences on what the scene says in vain
  std::vector<Body> bodies;
  std::vector<Obstacle> obstacles;
  /// What becomes of pairs of which the scene says it: a body and an obstacle, and two bodies, the lower index first.
  std::map<std::pair<int, int>, Surface> obstacle_pairs, body_pairs;
  std::vector<ExtraState> states;
  std::vector<Event> events;
  std::vector<Group> groups;
  std::vector<ClosedForm> exact;
  std::vector<ClosedRotation> exact_rotations;
  std::optional<ExtendedNumbers> extended{};
};

/// Gives a scene its numbers. Throws InputError that points at the place.
World make_world(const Scene& scene);

}  // namespace trajet
