// A ball in the air, by two methods that know nothing of each other; the landing is at a zero of its height.
#include <trajet/collide/detect/contact_table.hpp>
#include <trajet/ode/solve.hpp>
#include <trajet/version.hpp>

#include <cmath>
#include <cstdio>

int main() {
  const auto law = [](const auto&, const auto& q, auto& dq) {
    const auto speed = sqrt(q[3] * q[3] + q[4] * q[4] + q[5] * q[5]);
    for (int i = 0; i < 3; ++i) dq[i] = q[i + 3];
    for (int i = 3; i < 6; ++i) dq[i] = -0.0126 * speed * q[i];
    dq[5] -= 9.81;
  };
  const Eigen::Vector<double, 6> start{0, 0, 1, 25, 3, 8};
  const auto series = trajet::solve(law, 0.0, start, 3.0);
  const auto pair = trajet::solve<trajet::Dopri5>(law, 0.0, start, 3.0);
  const bool agree = (series.end() - pair.end()).norm() < 1e-9;  // both at tolerances of 1e-12, over 3 s

  const trajet::Shape ground = trajet::make_plane({0, 0, 0}, {0, 0, 1});
  for (const auto& segment : series.segments) {
    const trajet::PointPath path(segment, 0);
    const auto contact = trajet::first_contact(ground, {path, 0.0, segment.t0(), segment.t1()});
    if (contact.status != trajet::ContactStatus::hit) continue;
    const bool landed = std::abs(series.state(contact.time)[2]) < 1e-12;  // a few roundings of its terms, about 10 m
    std::printf("trajet %s: %s, %s\n", trajet::kVersion, agree ? "agree" : "differ", landed ? "landed" : "hovers");
    return 0;
  }
  std::puts("no contact");
}
