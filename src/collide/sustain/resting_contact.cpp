#include "trajet/collide/sustain/resting_contact.hpp"

#include <Eigen/QR>
#include <array>

#include "trajet/geom/flat_faces.hpp"
#include "trajet/law/program_number.hpp"
#include "trajet/portable.hpp"

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

/// What is left of a unit vector depends on others if it is less: far above rounding, as of two faces of one plane.
constexpr double kDependent = 1e-9;

/// What a vector has outside the space of orthonormal ones.
Vector3 part_outside(const std::vector<Vector3>& orthonormal, Vector3 vector) {
  for (const Vector3& direction : orthonormal) vector -= vector.dot(direction) * direction;
  return vector;
}

}  // namespace

const RestingContact* sticking_contact(const std::vector<RestingContact>& contacts, int body) {
  const auto found =
      ranges::find_if(contacts, [body](const RestingContact& each) { return each.body == body && each.stuck_at; });
  return found != contacts.end() ? &*found : nullptr;
}

Support support(const std::vector<Vector3>& normals) {
  Support support;
  if (normals.empty()) return support;
  Eigen::Matrix3Xd n(3, static_cast<Eigen::Index>(normals.size()));
  for (std::size_t i = 0; i < normals.size(); ++i) {
    n.col(static_cast<Eigen::Index>(i)) = normals[i];
    const Vector3 rest = part_outside(support.blocked, normals[i]);
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

ReleaseConditions release_conditions(const Program& law, const Shape& shape, const RestingContact& contact,
                                     const std::vector<Vector3>& blocked) {
  ReleaseConditions conditions;
  ProgramBuilder pull(law);
  conditions.pull = program_of(pull, along(contact.release, outputs(pull, contact.offset + kVelocity)));

  const int position = 1 + contact.offset;  // behind t
  const FaceOutline outline = face_outline(shape, contact.point, contact.normal);
  for (const FaceEdge& edge : outline.edges) {
    if (part_outside(blocked, edge.direction).norm() <= kDependent) continue;
    ProgramBuilder past(law.input_count);
    conditions.past_edges.push_back(
        program_of(past, along(edge.direction, inputs(past, position)) - ProgramNumber(edge.limit)));
  }
  if (const auto& rim = outline.rim) {
    // |p - c|^2 - (n . (p - c))^2 - R^2: past the rim
    ProgramBuilder past(law.input_count);
    const NumberVector arm = inputs(past, position) - rim->center.cast<ProgramNumber>();
    const ProgramNumber height = along(rim->normal, arm);
    conditions.past_edges.push_back(
        program_of(past, arm.dot(arm) - height * height - ProgramNumber(rim->radius * rim->radius)));
  }
  return conditions;
}

}  // namespace trajet
