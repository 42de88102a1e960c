#include "trajet/collide/sustain/resting_contact.hpp"

#include <Eigen/QR>
#include <array>

#include "trajet/geom/flat_faces.hpp"

namespace trajet {
namespace {

/// Appends instructions to a program.
class ProgramWriter {
 public:
  explicit ProgramWriter(Program& program) : program_(program) {}

  int write(Opcode opcode, int a, int b, double constant = 0.0) {
    Instruction instruction;
    instruction.opcode = opcode;
    instruction.a = a;
    instruction.b = b;
    instruction.constant = constant;
    instruction.result = program_.slot_count++;
    program_.instructions.push_back(instruction);
    return instruction.result;
  }

  /// n . (x, y, z)
  int along(const Vector3& normal, const std::array<int, 3>& vector) {
    int sum = write(Opcode::multiply_constant, vector[0], 0, normal[0]);
    for (int i = 1; i < 3; ++i) {
      const int term = write(Opcode::multiply_constant, vector[static_cast<std::size_t>(i)], 0, normal[i]);
      sum = write(Opcode::add, sum, term);
    }
    return sum;
  }

 private:
  Program& program_;
};

/// The outputs `first`, `first` + 1 and `first` + 2.
std::array<int, 3> output_vector(const Program& program, int first) {
  const auto i = static_cast<std::size_t>(first);
  return {program.outputs[i], program.outputs[i + 1], program.outputs[i + 2]};
}

constexpr int kVelocity = 3;  // behind the position

}  // namespace

Support support(const std::vector<Vector3>& normals) {
  Support support;
  if (normals.empty()) return support;
  Eigen::Matrix3Xd n(3, static_cast<Eigen::Index>(normals.size()));
  for (std::size_t i = 0; i < normals.size(); ++i) {
    n.col(static_cast<Eigen::Index>(i)) = normals[i];
    Vector3 rest = normals[i];
    for (const Vector3& direction : support.blocked) rest -= rest.dot(direction) * direction;
    constexpr double kDependent = 1e-9;  // far above rounding: two faces of one plane
    if (rest.norm() > kDependent) support.blocked.push_back(rest.normalized());
  }
  const Eigen::MatrixXd inverse = n.completeOrthogonalDecomposition().pseudoInverse();
  for (Eigen::Index i = 0; i < inverse.rows(); ++i) support.release.push_back(inverse.row(i).transpose());
  return support;
}

Program hold(const Program& law, int offset, const Vector3& direction) {
  Program held = law;
  ProgramWriter writer(held);
  for (const int first : {offset, offset + kVelocity}) {
    const std::array<int, 3> vector = output_vector(held, first);
    const int along = writer.along(direction, vector);
    // u - (u . d) d
    for (int i = 0; i < 3; ++i) {
      const int part = writer.write(Opcode::multiply_constant, along, 0, direction[i]);
      const auto k = static_cast<std::size_t>(i);
      held.outputs[static_cast<std::size_t>(first + i)] = writer.write(Opcode::subtract, vector[k], part);
    }
  }
  return held;
}

ReleaseConditions release_conditions(const Program& law, const Shape& shape, const RestingContact& contact) {
  ReleaseConditions conditions{law, {}};
  conditions.pull.outputs = {
      ProgramWriter(conditions.pull).along(contact.release, output_vector(law, contact.offset + kVelocity))};

  const int position = 1 + contact.offset;  // behind t
  Program inputs;
  inputs.input_count = inputs.slot_count = law.input_count;
  const FaceOutline outline = face_outline(shape, contact.point, contact.normal);
  for (const FaceEdge& edge : outline.edges) {
    Program past = inputs;
    ProgramWriter writer(past);
    const int along = writer.along(edge.direction, {position, position + 1, position + 2});
    past.outputs = {writer.write(Opcode::add_constant, along, 0, -edge.limit)};
    conditions.past_edges.push_back(past);
  }
  if (const auto& rim = outline.rim) {
    // |p - c|^2 - (n . (p - c))^2 - R^2: past the rim
    Program past = inputs;
    ProgramWriter writer(past);
    std::array<int, 3> arm;
    for (int i = 0; i < 3; ++i)
      arm[static_cast<std::size_t>(i)] = writer.write(Opcode::add_constant, position + i, 0, -rim->center[i]);
    int sum = writer.write(Opcode::negate, writer.write(Opcode::square, writer.along(rim->normal, arm), 0), 0);
    for (const int component : arm) sum = writer.write(Opcode::add, sum, writer.write(Opcode::square, component, 0));
    past.outputs = {writer.write(Opcode::add_constant, sum, 0, -rim->radius * rim->radius)};
    conditions.past_edges.push_back(past);
  }
  return conditions;
}

}  // namespace trajet
