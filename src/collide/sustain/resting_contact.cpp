#include "trajet/collide/sustain/resting_contact.hpp"

#include <Eigen/QR>
#include <array>
#include <cmath>
#include <variant>

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

/// direction . p - limit, positive past an edge of a face
struct Edge {
  Vector3 direction;
  double limit;
};

/// The straight edges of the face of a shape on which a body rests.
class FaceEdges {
 public:
  explicit FaceEdges(const Vector3& normal) : normal_(normal) {}

  std::vector<Edge> operator()(const Plane&) const { return {}; }
  std::vector<Edge> operator()(const Sphere&) const { return {}; }
  std::vector<Edge> operator()(const Disk&) const { return {}; }
  std::vector<Edge> operator()(const Rectangle& rectangle) const {
    std::vector<Edge> edges;
    add_pair(edges, rectangle.center, rectangle.up.cross(rectangle.normal), 0.5 * rectangle.width);
    add_pair(edges, rectangle.center, rectangle.up, 0.5 * rectangle.height);
    return edges;
  }
  std::vector<Edge> operator()(const Triangle& triangle) const {
    std::vector<Edge> edges;
    for (int i = 0; i < 3; ++i)
      edges.push_back({triangle.edge_outward[i], triangle.edge_outward[i].dot(triangle.corners[i])});
    return edges;
  }
  std::vector<Edge> operator()(const Box& box) const {
    std::vector<Edge> edges;
    int face = 0;
    (box.R_WB.transpose() * normal_).cwiseAbs().maxCoeff(&face);
    for (int i = 0; i < 3; ++i)
      if (i != face) add_pair(edges, box.center, box.R_WB.col(i), box.half_size[i]);
    return edges;
  }

 private:
  static void add_pair(std::vector<Edge>& edges, const Vector3& center, const Vector3& direction, double half_length) {
    edges.push_back({direction, direction.dot(center) + half_length});
    edges.push_back({-direction, -direction.dot(center) + half_length});
  }

  Vector3 normal_;
};

/// The direction in which a face of a shape looks if it is flat there.
class FlatNormal {
 public:
  explicit FlatNormal(const Vector3& normal) : normal_(normal) {}

  bool operator()(const Plane& plane) const { return is_parallel(plane.normal); }
  bool operator()(const Disk& disk) const { return is_parallel(disk.normal); }
  bool operator()(const Rectangle& rectangle) const { return is_parallel(rectangle.normal); }
  bool operator()(const Triangle& triangle) const { return is_parallel(triangle.normal); }
  bool operator()(const Box& box) const {
    return is_parallel(box.R_WB.col(0)) || is_parallel(box.R_WB.col(1)) || is_parallel(box.R_WB.col(2));
  }
  bool operator()(const Sphere&) const { return false; }

 private:
  bool is_parallel(const Vector3& direction) const {
    constexpr double kTilt = 1e-9;  // rad: far above rounding, far below what an edge's normal is off
    return normal_.cross(direction).norm() < kTilt;
  }

  Vector3 normal_;
};

}  // namespace

bool is_flat_at(const Shape& shape, const Vector3& normal) { return std::visit(FlatNormal(normal), shape); }

bool moves_off(const Shape& shape, const Vector3& normal, const Vector3& position, const Vector3& velocity) {
  constexpr double kAtEdge = 1e-12;  // of the place and the size: far above rounding
  for (const Edge& edge : std::visit(FaceEdges(normal), shape)) {
    const double beyond = edge.direction.dot(position) - edge.limit;
    const double near = kAtEdge * (position.lpNorm<1>() + std::abs(edge.limit));
    if (beyond >= -near && edge.direction.dot(velocity) > 0.0) return true;
  }
  const auto* disk = std::get_if<Disk>(&shape);
  if (disk == nullptr) return false;
  Vector3 arm = position - disk->center;
  arm -= arm.dot(disk->normal) * disk->normal;
  const double near = kAtEdge * (position.lpNorm<1>() + disk->center.lpNorm<1>() + disk->radius);
  return arm.norm() >= disk->radius - near && arm.dot(velocity) > 0.0;
}

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
  for (const Edge& edge : std::visit(FaceEdges(contact.normal), shape)) {
    Program past = inputs;
    ProgramWriter writer(past);
    const int along = writer.along(edge.direction, {position, position + 1, position + 2});
    past.outputs = {writer.write(Opcode::add_constant, along, 0, -edge.limit)};
    conditions.past_edges.push_back(past);
  }
  if (const auto* disk = std::get_if<Disk>(&shape)) {
    // |p - c|^2 - (n . (p - c))^2 - R^2: past the rim
    Program past = inputs;
    ProgramWriter writer(past);
    std::array<int, 3> arm;
    for (int i = 0; i < 3; ++i)
      arm[static_cast<std::size_t>(i)] = writer.write(Opcode::add_constant, position + i, 0, -disk->center[i]);
    int sum = writer.write(Opcode::negate, writer.write(Opcode::square, writer.along(disk->normal, arm), 0), 0);
    for (const int component : arm) sum = writer.write(Opcode::add, sum, writer.write(Opcode::square, component, 0));
    past.outputs = {writer.write(Opcode::add_constant, sum, 0, -disk->radius * disk->radius)};
    conditions.past_edges.push_back(past);
  }
  return conditions;
}

}  // namespace trajet
