#include <array>

#include "body_maker.hpp"
#include "trajet/law/program_number.hpp"

namespace trajet {
namespace {

using NumberVector = Vector3T<ProgramNumber>;

NumberVector numbers(ProgramBuilder& builder, const ProgramBuilder::Value& vector) {
  return {ProgramNumber(builder, vector.nodes[0]), ProgramNumber(builder, vector.nodes[1]),
          ProgramNumber(builder, vector.nodes[2])};
}

std::array<int, 3> nodes(ProgramBuilder& builder, const NumberVector& v) {
  return {v.x().node(builder), v.y().node(builder), v.z().node(builder)};
}

/// The state of a turning body as ProgramNumbers of a program over t and the group's state.
struct TurningBody {
  TurningBody(const World::Body& body, ProgramBuilder& builder) : layout(body.rotation->layout) {
    const int first = 1 + body.rotation->offset;
    for (int i = 0; i < layout.size() + 3; ++i) part.emplace_back(builder, first + i);
    const auto size = static_cast<std::size_t>(layout.size());
    w = {part[size], part[size + 1], part[size + 2]};
    R_WB = layout.rotation(part.data());
  }

  NumberVector to_world(const NumberVector& v_B) const { return R_WB * v_B; }
  NumberVector to_body(const NumberVector& v_W) const { return R_WB.transpose() * v_W; }

  OrientationLayout layout;
  std::vector<ProgramNumber> part;  // orientation, angular velocity
  NumberVector w;                   // in the layout's frame
  Matrix3T<ProgramNumber> R_WB;
};

void add_quaternion_symbols(Symbols& symbols, const std::string& prefix, const TurningBody& body,
                            ProgramBuilder& builder) {
  constexpr std::array kNames{"qw", "qx", "qy", "qz"};
  if (body.layout.way == OrientationWay::matrix) {
    for (const char* name : kNames)
      symbols.forbid(prefix + name,
                     "orientation = \"matrix\" carries no quaternion: use Rxx … Rzz, or another orientation");
    return;
  }
  QuaternionT<ProgramNumber> q = body.layout.quaternion(body.part.data());
  if (body.layout.way != OrientationWay::quaternion) q = scaled(ProgramNumber(1.0) / sqrt(dot(q, q)), q);
  const std::array<ProgramNumber, 4> parts{q.w(), q.x(), q.y(), q.z()};
  for (std::size_t i = 0; i < 4; ++i) symbols.set_node(prefix + kNames[i], parts[i].node(builder));
}

}  // namespace

void add_rotation_symbols(Symbols& symbols, const std::string& prefix, const World::Body& body,
                          ProgramBuilder& builder) {
  constexpr std::array kAxes{"x", "y", "z"};
  Matrix3T<ProgramNumber> R_WB = rotation_matrix(body.q_WB).cast<ProgramNumber>();
  NumberVector w_W(ProgramNumber(0.0), ProgramNumber(0.0), ProgramNumber(0.0)), w_B = w_W;
  if (body.rotation) {
    const TurningBody turning(body, builder);
    const bool in_world = turning.layout.frame == Frame::world;
    R_WB = turning.R_WB;
    w_W = in_world ? turning.w : turning.to_world(turning.w);
    w_B = in_world ? turning.to_body(turning.w) : turning.w;
    add_quaternion_symbols(symbols, prefix, turning, builder);
  } else {
    symbols.set_constant(prefix + "qw", body.q_WB.w());
    for (int i = 0; i < 3; ++i)
      symbols.set_constant(prefix + "q" + kAxes[static_cast<std::size_t>(i)], body.q_WB.vec()[i]);
  }
  symbols.set_nodes(prefix + "w", nodes(builder, w_W));
  symbols.set_nodes(prefix + "w_body", nodes(builder, w_B));
  for (int i = 0; i < 3; ++i) {
    const std::string row = kAxes[static_cast<std::size_t>(i)];
    symbols.set_node(prefix + "w" + row, w_W[i].node(builder));
    for (int j = 0; j < 3; ++j)
      symbols.set_node(prefix + "R" + row + kAxes[static_cast<std::size_t>(j)], R_WB(i, j).node(builder));
  }
}

void add_rotation_law(const BodyDefinition& definition, const World::Body& body, const Symbols& own,
                      ProgramBuilder& law) {
  const TurningBody turning(body, law);
  const auto compiled = [&](const Expression& formula) { return numbers(law, law.compile_vector(formula, own)); };

  NumberVector acceleration(ProgramNumber(0.0), ProgramNumber(0.0), ProgramNumber(0.0));
  if (definition.angular_acceleration) {
    acceleration = compiled(*definition.angular_acceleration);
  } else if (definition.angular_acceleration_body) {
    acceleration = compiled(*definition.angular_acceleration_body);
  } else if (const auto& inertia = body.rotation->inertia) {
    NumberVector torque_B = acceleration;
    if (definition.torque) torque_B += turning.to_body(compiled(*definition.torque));
    if (definition.torque_body) torque_B += compiled(*definition.torque_body);
    if (definition.force_point) {
      const NumberVector force_B = turning.to_body(compiled(*definition.force));
      torque_B += cross_matrix(compiled(*definition.force_point)) * force_B;
    }
    acceleration = angular_acceleration_body<ProgramNumber>(*inertia, inertia->inverse(), turning.w, torque_B);
  }

  std::vector<ProgramNumber> rates(static_cast<std::size_t>(turning.layout.size()));
  turning.layout.rate(turning.part.data(), turning.w, rates.data());
  for (const ProgramNumber& rate : rates) law.add_output({false, {rate.node(law), 0, 0}});
  law.add_output({true, nodes(law, acceleration)});
}

void add_quaternion(const std::array<ProgramBuilder::Value, 3>& roll_pitch_yaw, ProgramBuilder& builder) {
  std::array<ProgramNumber, 3> c, s;  // of half the angles
  for (std::size_t i = 0; i < 3; ++i) {
    const ProgramNumber half = ProgramNumber(0.5) * ProgramNumber(builder, roll_pitch_yaw[i].nodes[0]);
    c[i] = cos(half);
    s[i] = sin(half);
  }
  // q_z(yaw) q_y(pitch) q_x(roll)
  for (const ProgramNumber& part : {c[0] * c[1] * c[2] + s[0] * s[1] * s[2], s[0] * c[1] * c[2] - c[0] * s[1] * s[2],
                                    c[0] * s[1] * c[2] + s[0] * c[1] * s[2], c[0] * c[1] * s[2] - s[0] * s[1] * c[2]})
    builder.add_output({false, {part.node(builder), 0, 0}});
}

ProgramBuilder::Value in_frame_of_state(const ProgramBuilder::Value& vector_W, const World::Body& body,
                                        ProgramBuilder& builder) {
  if (body.rotation->layout.frame == Frame::world) return vector_W;
  return {true, nodes(builder, TurningBody(body, builder).to_body(numbers(builder, vector_W)))};
}

}  // namespace trajet
