// A search that goes on where another one ended: after a contact, at the joint of two paths, backward in time.

#include <gtest/gtest.h>

#include "random_flights.hpp"
#include "separation_oracle.hpp"

namespace trajet::turning {
namespace {

const ConvexCore kGround = convex_core(HalfSpace{});
const ConvexCore kBrick = convex_core(Cuboid{{0.3, 0.2, 0.1}});

/// The state of a free body at a time of its flight.
FreeState state_at(const MovingSolid& solid, double t) {
  std::size_t i = 0;
  while (i + 1 < solid.flight.size() && solid.flight[i].t1() < t) ++i;
  const FramePose pose = solid.flight[i].pose(t);
  return free_state(pose.p_WB, pose.v_WB, Quaternion(pose.R_WB), pose.R_WB.transpose() * pose.w_WB_W);
}

/// Both bodies go on with a frictionless bounce of restitution 0.8: the reported contact is left, and the next one
/// found.
TEST(Restart, ABounceIsLeftBehindAndTheNextContactFound) {
  int bounces = 0, again = 0;
  for (const auto& [moving, other] : std::vector<std::pair<const char*, const char*>>{
           {"box", "plane"}, {"hull", "plane"}, {"box", "static-box"}, {"box", "box"}, {"hull", "capsule"}}) {
    const int count = cases(60);
    for (int k = 0; k < count; ++k) {
      SCOPED_TRACE(std::string(moving) + " on " + other + " " + std::to_string(k));
      RandomFlights random(104729ULL * static_cast<unsigned>(k) + 5);
      const double duration = 0.25;
      Encounter e = random.encounter(moving, other, 50.0, duration);
      const TurningContact c = search(e);
      if (c.status != ContactStatus::hit || !(c.gap_rate < 0.0)) continue;
      ++bounces;
      const bool is_static = e.a.flight[0].is_at_rest();
      const auto mobility = [&](const MovingSolid& s) {
        const FreeState q = state_at(s, c.time);
        const Matrix3 R = Quaternion(q[6], q[7], q[8], q[9]).toRotationMatrix();
        const Vector3 arm = R.transpose() * (c.point - Vector3(q.head<3>())).cross(c.normal);
        return 1.0 + arm.dot(arm.cwiseQuotient(0.02 * s.inertia));
      };
      // the normal is that of b, towards a
      const double impulse = -1.8 * c.gap_rate / (mobility(e.b) + (is_static ? 0.0 : mobility(e.a)));
      const auto kick = [&](MovingSolid& s, double j) {
        FreeState q = state_at(s, c.time);
        const Matrix3 R = Quaternion(q[6], q[7], q[8], q[9]).toRotationMatrix();
        const Vector3 arm = (c.point - Vector3(q.head<3>())).cross(c.normal);
        q.segment<3>(3) += j * c.normal;
        q.tail<3>() += (R.transpose() * arm * j).cwiseQuotient(0.02 * s.inertia);
        set_flight(s, q, 9.81, c.time, c.time + duration);
      };
      kick(e.b, -impulse);
      if (!is_static) kick(e.a, impulse);
      const double later = c.time + 1e-10;  // by then the oracle sees the gap open
      const Truth t = truth(e, later, c.time + duration);
      if (t.time && *t.time - Extended(later) < 1e-12L) {  // the bounce drives another place in: a hit at the start
        const TurningContact next = search(e, c.time, c.time + duration, c.memory);
        EXPECT_TRUE(is_contact(next));
        EXPECT_LT(next.time, later);
        ++again;
        continue;
      }
      const TurningContact next = search(e, c.time, c.time + duration, c.memory);
      ASSERT_EQ(is_contact(next), t.time.has_value()) << static_cast<int>(next.status) << " at " << next.time;
      if (t.time) {
        EXPECT_NEAR(next.time, static_cast<double>(*t.time), std::max(1e-14, next.time_error_bound));
      }
    }
  }
  EXPECT_GT(bounces, 100);
  RecordProperty("driven_in_again", again);
}

FramePath line(double t0, double t1, const Vector3& r, const Vector3& v) {
  FramePath::Coefficients c = FramePath::Coefficients::Zero(7, 2);
  c.col(0) << r, 1, 0, 0, 0;
  c.col(1).head<3>() = v;
  return {t0, t1, c};
}

TEST(Restart, AContactAtTheJointOfTwoPathsIsFoundOnce) {
  const FramePath ground = FramePath::at_rest(Vector3::Zero(), Quaternion::Identity());
  // reaches the ground at t = 1, exactly and by rounding; then bounces, or goes on
  for (const double height : {0.6, std::nextafter(0.6, 0.0), std::nextafter(0.6, 1.0), 0.6 + 1e-15, 0.6 - 1e-15})
    for (const double up : {1.0, -1.0}) {
      const FramePath down = line(0.0, 1.0, {0, 0, height}, {0, 0, -0.5});
      int contacts = 0;
      TurningContact c = first_contact(kBrick, down, kGround, ground, 0.0, 1.0);
      contacts += is_contact(c);
      if (is_contact(c)) {
        EXPECT_NEAR(c.time, 1.0, 1e-14);
      }
      const bool is_first = is_contact(c);
      const double joint = is_first ? c.time : 1.0;
      const FramePath next = line(joint, 2.0, {0, 0, height - 0.5 * joint}, {0, 0, 0.5 * up});
      c = first_contact(kBrick, next, kGround, ground, joint, 2.0, c.memory);
      contacts += is_contact(c);
      // what goes on inward behind a contact that was reported is a hit at the start
      EXPECT_EQ(contacts, up < 0.0 && is_first ? 2 : 1) << height << ' ' << up;
      EXPECT_LE(contacts, 2);
      if (is_contact(c)) {
        EXPECT_NEAR(c.time, 1.0, 1e-14);
      }
    }
}

TEST(Restart, AStartInContactDepartsGoesInOrOverlaps) {
  const FramePath ground = FramePath::at_rest(Vector3::Zero(), Quaternion::Identity());
  const auto start = [&](double height, double speed) {
    return first_contact(kBrick, line(0, 1, {0, 0, height}, {0, 0, speed}), kGround, ground, 0.0, 1.0);
  };
  EXPECT_EQ(start(0.1, 1.0).status, ContactStatus::separated);
  EXPECT_EQ(start(0.1, -1.0).status, ContactStatus::hit);
  EXPECT_EQ(start(0.1, -1.0).time, 0.0);
  EXPECT_EQ(start(0.1, 0.0).status, ContactStatus::separated);  // stays in contact, which is no hit
  EXPECT_EQ(start(0.0999, 1.0).status, ContactStatus::overlapping_at_start);
  EXPECT_EQ(start(0.1001, -1.0).status, ContactStatus::hit);
}

TEST(Restart, BackwardInTimeTheSameContactsAreMet) {
  for (const auto& [moving, other] :
       std::vector<std::pair<const char*, const char*>>{{"box", "plane"}, {"box", "box"}, {"capsule", "static-box"}}) {
    int contacts = 0;
    for (int k = 0; k < cases(60); ++k) {
      SCOPED_TRACE(k);
      RandomFlights random(7919ULL * static_cast<unsigned>(k) + 1);
      const Encounter e = random.encounter(moving, other, 50.0, 0.25);
      // in the mirror: t -> -t, so that forward there is backward here
      Encounter mirrored = e;
      for (MovingSolid* s : {&mirrored.a, &mirrored.b}) {
        std::vector<FramePath> paths;
        for (const FramePath& p : s->flight) {
          if (p.is_at_rest()) {
            paths.push_back(p);
            continue;
          }
          FramePath::Coefficients c = p.coefficients();
          for (Eigen::Index i = 1; i < c.cols(); i += 2) c.col(i) *= -1.0;
          // a path that begins late: written from its later end, t1 before t0
          paths.insert(paths.begin(), FramePath(-p.t0(), -p.t1(), c));
        }
        s->flight = paths;
      }
      const TurningContact forward = search(e);
      TurningContact backward;
      TurningMemory memory;
      for (double t = 0.0; t > -0.25;) {
        const auto on = [&](const MovingSolid& s) -> const FramePath& {
          for (const FramePath& p : s.flight)
            if (p.is_at_rest() || (p.t0() >= t && p.t1() < t)) return p;
          return s.flight.front();
        };
        const FramePath &a = on(mirrored.a), &b = on(mirrored.b);
        const double end = std::max({-0.25, a.is_at_rest() ? -1.0 : a.t1(), b.is_at_rest() ? -1.0 : b.t1()});
        backward = first_contact(mirrored.a.core, a, mirrored.b.core, b, t, end, memory);
        memory = backward.memory;
        if (backward.status != ContactStatus::separated) break;
        t = end;
      }
      ASSERT_EQ(forward.status, backward.status);
      if (!is_contact(forward)) continue;
      ++contacts;
      EXPECT_NEAR(forward.time, -backward.time, 1e-14 + forward.time_error_bound);
      EXPECT_NEAR(forward.gap_rate, -backward.gap_rate, 1e-6 * std::abs(forward.gap_rate) + 1e-9);
      EXPECT_LT((forward.point - backward.point).norm(), 1e-9);
    }
    EXPECT_GT(contacts, 10);
  }
}

}  // namespace
}  // namespace trajet::turning
