#include "trajet/collide/sustain/stuck_law.hpp"

#include <vector>

#include "trajet/law/program_number.hpp"
#include "trajet/rigid/kinematics.hpp"

namespace trajet {
namespace {

using NumberVector = Vector3T<ProgramNumber>;
using NumberMatrix = Eigen::Matrix<ProgramNumber, 3, 3>;

/// How a place of an obstacle and its angular velocity change with time: rates of a program of t alone.
class ObstacleMotion {
 public:
  ObstacleMotion(ProgramBuilder& builder, const Program& pose, int input_count) : builder_(builder) {
    of_time_.push_back(builder.constant_node({1.0}));
    of_time_.resize(static_cast<std::size_t>(input_count), builder.constant_node({0.0}));
    const std::vector<int> nodes = builder.insert(pose);
    const auto number = [&](std::size_t i) { return ProgramNumber(builder, nodes[i]); };
    pivot_ = {number(0), number(1), number(2)};
    R_ = rotation_matrix(QuaternionT<ProgramNumber>(number(3), number(4), number(5), number(6)));
  }

  /// `arm`: from the pivot, at the start.
  NumberVector place(const Vector3& arm) const { return pivot_ + R_ * arm.cast<ProgramNumber>(); }
  /// w~ = dR/dt R^T
  NumberVector angular_velocity() {
    NumberMatrix rate;
    for (int i = 0; i < 9; ++i) rate(i / 3, i % 3) = rate_of(R_(i / 3, i % 3));
    const NumberMatrix w_cross = rate * R_.transpose();
    return {w_cross(2, 1), w_cross(0, 2), w_cross(1, 0)};
  }
  NumberVector rate_of(const NumberVector& v) { return {rate_of(v[0]), rate_of(v[1]), rate_of(v[2])}; }
  bool has_derivatives() const { return has_derivatives_; }

 private:
  ProgramNumber rate_of(const ProgramNumber& number) {
    const std::optional<int> rate = builder_.derivative(number.node(builder_), of_time_);
    has_derivatives_ = has_derivatives_ && rate.has_value();
    return rate ? ProgramNumber(builder_, *rate) : ProgramNumber(0.0);
  }

  ProgramBuilder& builder_;
  std::vector<int> of_time_;
  NumberVector pivot_;
  NumberMatrix R_;
  bool has_derivatives_ = true;
};

}  // namespace

std::optional<Program> make_stuck_law(const Program& law, const SustainedBody& body, const SustainedContact& obstacle,
                                      const Vector3& place) {
  ProgramBuilder builder(law);
  const int count = static_cast<int>(law.outputs.size());
  std::vector<ProgramNumber> rates;
  for (int i = 0; i < count; ++i) rates.push_back(ProgramNumber::output_of_base(builder, i));
  const auto set = [&](int first, const NumberVector& rate) {
    for (int i = 0; i < 3; ++i) rates[static_cast<std::size_t>(first + i)] = rate[i];
  };
  NumberVector velocity, acceleration, turning;
  for (NumberVector* each : {&velocity, &acceleration, &turning}) each->setConstant(ProgramNumber(0.0));
  if (obstacle.pose) {
    ObstacleMotion motion(builder, *obstacle.pose, law.input_count);
    velocity = motion.rate_of(motion.place(place - obstacle.pivot));
    acceleration = motion.rate_of(velocity);
    if (body.layout && obstacle.turns) turning = motion.rate_of(motion.angular_velocity());
    if (!motion.has_derivatives()) return std::nullopt;
  }
  set(body.offset, velocity);
  set(body.offset + 3, acceleration);
  if (body.layout) {
    if (body.layout->frame == Frame::body) {
      std::vector<ProgramNumber> orientation;
      for (int i = 0; i < body.layout->size(); ++i) orientation.emplace_back(builder, 1 + body.rotation_offset + i);
      // R^T w has the rate R^T dw/dt, as w x w = 0
      turning = NumberVector(body.layout->rotation(orientation.data()).transpose() * turning);
    }
    set(body.rotation_offset + body.layout->size(), turning);
  }
  std::vector<int> nodes;
  for (const ProgramNumber& rate : rates) nodes.push_back(rate.node(builder));
  return builder.build(nodes);
}

}  // namespace trajet
