#include "drive_maker.hpp"

#include <array>
#include <string>
#include <utility>

#include "body_maker.hpp"
#include "trajet/law/program_number.hpp"
#include "trajet/math/quaternion.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

using NumberVector = Vector3T<ProgramNumber>;
using NumberQuaternion = QuaternionT<ProgramNumber>;

bool changes(const Expression& formula) {
  return ranges::any_of(formula.names(), [](const std::string& name) { return name == "t"; });
}
bool changes(const std::optional<Expression>& formula) { return formula && changes(*formula); }
bool changes(const std::vector<Expression>& formulas) {
  return ranges::any_of(formulas, [](const Expression& each) { return changes(each); });
}
bool changes(const OrientationDefinition& orientation) {
  return changes(orientation.axis) || changes(orientation.angle_rad) || changes(orientation.quaternion) ||
         changes(orientation.matrix) || changes(orientation.roll_pitch_yaw);
}

/// Writes a drive's program: formulas of t, the time elapsed since the start.
class DriveProgram {
 public:
  DriveProgram(const Symbols& constants, double epoch) : symbols_(&constants) {
    symbols_.set_node("t", builder_.clock(epoch));
  }

  ProgramNumber elapsed() { return {builder_, 0}; }
  ProgramNumber number(const Expression& formula) {
    return {builder_, builder_.compile_scalar(formula, symbols_).nodes[0]};
  }
  NumberVector vector(const Expression& formula) {
    const ProgramBuilder::Value value = builder_.compile_vector(formula, symbols_);
    return {{builder_, value.nodes[0]}, {builder_, value.nodes[1]}, {builder_, value.nodes[2]}};
  }

  NumberQuaternion orientation(const OrientationDefinition& given) {
    if (given.axis && given.angle_rad) return about(vector(*given.axis), number(*given.angle_rad));
    if (given.roll_pitch_yaw.size() == 3) {
      const auto turn = [&](int i) {
        return about(NumberVector(Vector3(Vector3::Unit(i)).cast<ProgramNumber>()),
                     number(given.roll_pitch_yaw[static_cast<std::size_t>(i)]));
      };
      return turn(2) * turn(1) * turn(0);
    }
    if (given.quaternion.size() == 4) {
      std::array<ProgramNumber, 4> part;
      for (std::size_t i = 0; i < 4; ++i) part[i] = number(given.quaternion[i]);
      const NumberQuaternion q(part[0], part[1], part[2], part[3]);
      return scaled(ProgramNumber(1.0) / sqrt(dot(q, q)), q);
    }
    throw InputError(given.where,
                     "an orientation that changes is given as {axis, angle}, {quaternion} or {roll, pitch, yaw}");
  }

  /// The rotation about an axis of any length.
  static NumberQuaternion about(const NumberVector& axis, const ProgramNumber& angle_rad) {
    const ProgramNumber half = ProgramNumber(0.5) * angle_rad;
    const NumberVector v = axis * (sin(half) / sqrt(axis.dot(axis)));
    return {cos(half), v.x(), v.y(), v.z()};
  }

  void add(const ProgramNumber& output) { builder_.add_output({false, {output.node(builder_), 0, 0}}); }
  Program build() const { return builder_.build(); }

 private:
  static constexpr int kOutputs = 7;
  ProgramBuilder builder_{1 + kOutputs};  // a series wants the outputs behind t; no formula reads them
  Symbols symbols_;
};

}  // namespace

std::shared_ptr<const World::Drive> make_drive(const ObstacleDefinition& obstacle, const Symbols& constants,
                                               const SceneNumbers& at_start, double epoch) {
  const bool moves = changes(obstacle.center), turns = obstacle.orientation && changes(*obstacle.orientation);
  if (!moves && !turns && !obstacle.velocity && !obstacle.angular_velocity) return nullptr;
  const std::string of = " of obstacle '" + obstacle.name + "'";
  if (moves && obstacle.velocity)
    throw InputError(obstacle.velocity->where(), "velocity" + of + " is there already: its place is a formula of t");
  if (turns && obstacle.angular_velocity)
    throw InputError(obstacle.angular_velocity->where(),
                     "angular_velocity" + of + " is there already: its orientation is a formula of t");

  World::Drive drive{.pivot = obstacle.center ? at_start.vector(*obstacle.center, "center" + of) : Vector3(0, 0, 0)};
  DriveProgram program(constants, epoch);
  NumberVector place = drive.pivot.cast<ProgramNumber>();
  if (moves) place = program.vector(*obstacle.center);
  if (obstacle.velocity)
    place += at_start.vector(*obstacle.velocity, "velocity" + of).cast<ProgramNumber>() * program.elapsed();
  NumberQuaternion turned = Quaternion::Identity().cast<ProgramNumber>();
  if (turns) {
    const Quaternion start = at_start.orientation(*obstacle.orientation, "orientation" + of);
    turned = program.orientation(*obstacle.orientation) * start.conjugate().cast<ProgramNumber>();
    drive.turns = true;
  }
  if (obstacle.angular_velocity) {
    const Vector3 w = at_start.vector(*obstacle.angular_velocity, "angular_velocity" + of);
    drive.turns = !w.isZero(0.0);
    if (drive.turns)
      turned = DriveProgram::about(w.cast<ProgramNumber>(), ProgramNumber(w.stableNorm()) * program.elapsed());
  }
  for (int i = 0; i < 3; ++i) program.add(place[i]);
  for (const ProgramNumber& part : {turned.w(), turned.x(), turned.y(), turned.z()}) program.add(part);
  drive.pose = program.build();
  return std::make_shared<const World::Drive>(std::move(drive));
}

}  // namespace trajet
