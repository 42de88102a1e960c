// Cylinders, disks, cones and ellipsoids: against exact gaps where there are any, and by their proofs: the chain of
// witnesses up to the contact, and a common point at it.

#include <gtest/gtest.h>

#include "random_flights.hpp"
#include "separation_oracle.hpp"

namespace trajet::turning {
namespace {

/// h(n) of a core in extended precision.
Extended height(const ConvexCore& core, const VectorX3& n) {
  Extended most = -1e30L;
  for (std::size_t i = 0; i < core.vertices.size(); ++i) {
    Extended h = n.dot(core.vertices[i].cast<Extended>());
    if (core.is_spread()) h += (core.spreads[i].cast<Extended>().transpose() * n).norm();
    most = std::max(most, h);
  }
  return most + Extended(core.rounding) * n.norm();
}

/// Of a link, at one time; for axes that are fixed in one of the solids or orthogonal to lines of both, and for the
/// balls around them.
Extended separation(const Encounter& e, const FramePath& a, const FramePath& b, const WitnessAxis& axis, Extended t) {
  const ExtendedPose pa(a, t), pb(b, t);
  const VectorX3 d = pb.r - pa.r;
  if (axis.kind == AxisKind::balls && e.a.core.is_half_space) return pa.R.col(2).dot(d) - Extended(e.b.core.reach);
  if (axis.kind == AxisKind::balls) return d.norm() - Extended(e.a.core.reach) - Extended(e.b.core.reach);
  VectorX3 n =
      axis.kind == AxisKind::in_b ? pb.R * axis.direction.cast<Extended>() : pa.R * axis.direction.cast<Extended>();
  if (axis.kind == AxisKind::edges) {  // of lines that are no edges
    EXPECT_LT(axis.a, 0);
    n = n.cross(pb.R * axis.line_b.cast<Extended>()).normalized() * Extended(axis.sign);
  } else {
    EXPECT_TRUE(axis.kind == AxisKind::in_a || axis.kind == AxisKind::in_b);
  }
  const Extended of_a =
      e.a.core.is_half_space ? pa.R.col(2).dot(n) > 1 - 1e-14L ? 0.0L : 1e30L : height(e.a.core, pa.R.transpose() * n);
  return n.dot(d) - of_a - height(e.b.core, -(pb.R.transpose() * n));
}

/// How far a point is outside of a core, or a lower bound of it: its height over all of many planes.
double outside(const ConvexCore& core, const FramePath& path, double t, const Vector3& p_W, RandomFlights& random) {
  const FramePose pose = path.pose(t);
  const Vector3 p = pose.R_WB.transpose() * (p_W - pose.p_WB);
  if (core.is_half_space) return p.z();
  double most = -1e300;
  const auto look = [&](const Vector3& n) {
    most = std::max(most, n.dot(p) - static_cast<double>(height(core, n.cast<Extended>())));
  };
  for (const CoreFace& f : core.faces) look(f.normal);
  Vector3 best = p.normalized();
  for (int k = 0; k < 2000; ++k) {
    const double before = most;
    const Vector3 n = (best + random.direction() * std::pow(10.0, -random.uniform(0, 6))).normalized();
    look(n);
    if (most > before) best = n;
  }
  return most;
}

struct Kind {
  const char* moving;
  const char* other;
};
class CurvedFlight : public testing::TestWithParam<Kind> {};

TEST_P(CurvedFlight, TheChainAndACommonPointProveTheContact) {
  const Kind& kind = GetParam();
  int contacts = 0, grazes = 0;
  for (int k = 0; k < cases(60); ++k) {
    SCOPED_TRACE(k);
    RandomFlights random(1000003ULL * static_cast<unsigned>(k) + 29);
    const Encounter e = random.encounter(kind.moving, kind.other, 30.0, 0.25);
    std::vector<WitnessLink> chain;
    const TurningContact c = search(e, e.from, e.to, {}, &chain);
    ASSERT_TRUE(is_contact(c) || c.status == ContactStatus::separated) << static_cast<int>(c.status);
    double reached = e.from;
    for (const WitnessLink& link : chain) {
      EXPECT_EQ(link.from, reached);
      reached = link.to;
      each_piece(e, link.from, link.to, [&](const FramePath& a, const FramePath& b, double from, double to) {
        for (int i = 0; i <= 16; ++i) EXPECT_GT(separation(e, a, b, link.axis, from + (to - from) * i / 16), -1e-12L);
        return true;
      });
    }
    if (!is_contact(c)) {
      EXPECT_EQ(reached, e.to);
      continue;
    }
    ++contacts;
    grazes += c.status == ContactStatus::graze;
    // what the chain leaves open before the contact is within its bound
    EXPECT_LE(c.time - reached, c.time_error_bound + 1e-15);
    EXPECT_LT(c.time_error_bound, 1e-9);
    EXPECT_LE(c.gap_rate, 1e-6);
    each_piece(e, std::min(c.time, 0.9999 * e.to), e.to, [&](const FramePath& a, const FramePath& b, double, double) {
      EXPECT_LT(outside(e.a.core, a, c.time, c.point, random), 2e-7);
      EXPECT_LT(outside(e.b.core, b, c.time, c.point, random), 2e-7);
      return false;
    });
  }
  EXPECT_GT(contacts, 5);
  EXPECT_LE(grazes, 1);
}

INSTANTIATE_TEST_SUITE_P(Turning, CurvedFlight,
                         testing::Values(Kind{"cylinder", "plane"}, Kind{"disk", "plane"}, Kind{"cone", "plane"},
                                         Kind{"ellipsoid", "plane"}, Kind{"cylinder", "static-box"},
                                         Kind{"cylinder", "cylinder"}, Kind{"disk", "box"}, Kind{"disk", "disk"},
                                         Kind{"cone", "hull"}, Kind{"ellipsoid", "box"}, Kind{"ellipsoid", "ellipsoid"},
                                         Kind{"ellipsoid", "cylinder"}, Kind{"ball", "cylinder"}),
                         [](const testing::TestParamInfo<Kind>& kind) {
                           std::string name = std::string(kind.param.moving) + "_on_" + kind.param.other;
                           std::erase(name, '-');
                           return name;
                         });

/// Falls without turning, so that times are exact.
TEST(Curved, LandingsOfKnownTimes) {
  const ConvexCore ground = convex_core(HalfSpace{});
  const FramePath at_rest = FramePath::at_rest(Vector3::Zero(), Quaternion::Identity());
  const auto land = [&](const ConvexCore& core, const Quaternion& q, double lowest) {
    FramePath::Coefficients c = FramePath::Coefficients::Zero(7, 3);
    c.col(0) << 0, 0, 0.5 + lowest, q.w(), q.x(), q.y(), q.z();
    c(2, 2) = -0.5 * 9.81;
    const FramePath path(0.0, 1.0, c);
    const TurningContact contact = first_contact(core, path, ground, at_rest, 0.0, 1.0);
    EXPECT_EQ(contact.status, ContactStatus::hit);
    EXPECT_NEAR(contact.time, std::sqrt(1.0 / 9.81), 1e-14);
    EXPECT_LT((contact.normal - Vector3::UnitZ()).norm(), 1e-12);
    return contact;
  };
  for (const double tilt : {0.0, 1e-12, 1e-8, 1e-4, 0.3, 1.0}) {
    const Quaternion q = from_axis_angle<double>(Vector3::UnitX(), tilt);
    const double s = std::sin(tilt), c = std::cos(tilt);
    land(convex_core(Cylinder{0.2, 0.3}), q, 0.2 * s + 0.3 * c);
    land(convex_core(RoundPlate{0.2}), q, 0.2 * s);
    land(ellipsoid_core({0.1, 0.2, 0.3}), q, std::hypot(0.2 * s, 0.3 * c));
    land(cone_core(0.2, -0.1, 0.3), q, std::max(0.2 * s + 0.1 * c, -0.3 * c));
  }
  EXPECT_EQ(land(convex_core(Cylinder{0.2, 0.3}), Quaternion::Identity(), 0.3).feature_a, Feature::face);
  EXPECT_EQ(land(ellipsoid_core({0.1, 0.2, 0.3}), Quaternion::Identity(), 0.3).feature_a, Feature::surface);
}

}  // namespace
}  // namespace trajet::turning
