#include "instant.hpp"

#include "trajet/law/evaluate.hpp"
#include "trajet/portable.hpp"

namespace trajet {

Instant::Instant(const Course& course, double time)
    : q(course.state(time)),
      contacts(course.held_law().contacts()),
      holds(course.held_law().holds()),
      derivative(Eigen::MatrixXd::Identity(q.size(), q.size())),
      course_(course),
      time_(time),
      before_(q) {
  if (course.is_extended())
    extended_ = course.extended_state(static_cast<Extended>(time) - static_cast<Extended>(course.segment().t0()));
}

void Instant::set_extended(int first, const Vector3T<Extended>& part) {
  if (!extended_) return;
  extended_->segment<3>(first) = part;
  q.segment<3>(first) = part.cast<double>();
}

std::optional<Eigen::VectorX<Extended>> Instant::extended() const {
  if (!extended_) return std::nullopt;
  // what has changed since is known in double precision only
  Eigen::VectorX<Extended> all = q.cast<Extended>();
  for (Eigen::Index i = 0; i < q.size(); ++i)
    if (static_cast<double>((*extended_)[i]) == q[i]) all[i] = (*extended_)[i];
  return all;
}

Eigen::VectorXd Instant::rate() const {
  const bool all_plain = ranges::all_of(course_.group().bodies, [&](int body) { return are_plain(contacts, body); });
  if (!all_plain) {
    const Program law = course_.held_law().with(contacts, {});
    Eigen::VectorXd rate(q.size());
    Evaluator<double> evaluate(law);
    evaluate(time_, q.data(), rate.data());
    return rate;
  }
  Eigen::VectorXd rate = course_.free_rate(time_, q);
  for (const int body : course_.group().bodies) {
    const int offset = course_.world().bodies[static_cast<std::size_t>(body)].offset;
    for (const Vector3& direction : support(offset).blocked)
      for (const int first : {offset, offset + 3}) {
        auto part = rate.segment<3>(first);
        part -= part.dot(direction) * direction;
      }
  }
  return rate;
}

Vector3 Instant::free_acceleration(int offset) const { return course_.free_rate(time_, q).segment<3>(offset + 3); }

void Instant::stop_blocked_velocity(int offset) {
  auto velocity = q.segment<3>(offset + 3);
  for (const Vector3& direction : support(offset).blocked) {
    velocity -= velocity.dot(direction) * direction;
    for (const int first : {offset, offset + 3}) {
      auto rows = derivative.middleRows<3>(first);
      rows -= direction * (direction.transpose() * rows).eval();
    }
  }
}

}  // namespace trajet
