#include "trajet/collide/sustain/resting_contact.hpp"

#include <Eigen/QR>
#include <array>
#include <cmath>
#include <variant>

#include "trajet/law/program_number.hpp"

namespace trajet {
namespace {

using NumberVector = Vector3T<ProgramNumber>;

/// The numbers of a program that was opened again: three of its outputs, or of its inputs, from `first` on.
NumberVector outputs(ProgramBuilder& builder, int first) {
  return {ProgramNumber::output_of_base(builder, first), ProgramNumber::output_of_base(builder, first + 1),
          ProgramNumber::output_of_base(builder, first + 2)};
}
NumberVector inputs(ProgramBuilder& builder, int first) {
  return {ProgramNumber(builder, first), ProgramNumber(builder, first + 1), ProgramNumber(builder, first + 2)};
}

ProgramNumber along(const Vector3& direction, const NumberVector& vector) {
  return direction.cast<ProgramNumber>().dot(vector);
}

/// The program of one number alone.
Program program_of(ProgramBuilder& builder, const ProgramNumber& number) {
  builder.add_output({false, {number.node(builder), 0, 0}});
  return builder.build();
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
  ProgramBuilder builder(law);
  const int count = static_cast<int>(law.outputs.size());
  std::vector<ProgramNumber> rate;
  for (int i = 0; i < count; ++i) rate.push_back(ProgramNumber::output_of_base(builder, i));
  for (const int first : {offset, offset + kVelocity}) {
    NumberVector u = outputs(builder, first);
    u -= along(direction, u) * direction.cast<ProgramNumber>();
    for (int i = 0; i < 3; ++i) rate[static_cast<std::size_t>(first + i)] = u[i];
  }
  for (const ProgramNumber& each : rate) builder.add_output({false, {each.node(builder), 0, 0}});
  return builder.build();
}

ReleaseConditions release_conditions(const Program& law, const Shape& shape, const RestingContact& contact) {
  ReleaseConditions conditions;
  ProgramBuilder pull(law);
  conditions.pull = program_of(pull, along(contact.release, outputs(pull, contact.offset + kVelocity)));

  const int position = 1 + contact.offset;  // behind t
  for (const Edge& edge : std::visit(FaceEdges(contact.normal), shape)) {
    ProgramBuilder past(law.input_count);
    conditions.past_edges.push_back(
        program_of(past, along(edge.direction, inputs(past, position)) - ProgramNumber(edge.limit)));
  }
  if (const auto* disk = std::get_if<Disk>(&shape)) {
    // |p - c|^2 - (n . (p - c))^2 - R^2: past the rim
    ProgramBuilder past(law.input_count);
    const NumberVector arm = inputs(past, position) - disk->center.cast<ProgramNumber>();
    const ProgramNumber height = along(disk->normal, arm);
    conditions.past_edges.push_back(
        program_of(past, arm.dot(arm) - height * height - ProgramNumber(disk->radius * disk->radius)));
  }
  return conditions;
}

}  // namespace trajet
