#include "instant.hpp"

namespace trajet {

Instant::Instant(const Course& course, double time)
    : q(course.state(time)),
      contacts(course.contacts()),
      derivative(Eigen::MatrixXd::Identity(q.size(), q.size())),
      course_(course),
      time_(time),
      before_(q) {}

Eigen::VectorXd Instant::rate() const {
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
