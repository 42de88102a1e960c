// Random flights of turning solids against the oracle: no contact missed, none invented, each at its time, and the
// chain of witnesses true.

#include <gtest/gtest.h>

#include "random_flights.hpp"
#include "separation_oracle.hpp"

namespace trajet::turning {
namespace {

struct Kind {
  const char* moving;
  const char* other;
  double rate = 50.0;  // rad/s, the fastest
  double duration = 0.25;
};

/// A chain without holes from the begin to `end`, and at samples of each link no overlap.
void expect_true(const Encounter& e, const std::vector<WitnessLink>& chain, double end) {
  double reached = e.from;
  for (const WitnessLink& link : chain) {
    EXPECT_EQ(link.from, reached);
    reached = link.to;
    each_piece(e, link.from, link.to, [&](const FramePath& a, const FramePath& b, double from, double to) {
      const SeparationOracle oracle(e.a.core, a, e.b.core, b, 0.0L);
      for (int k = 0; k <= 4; ++k) EXPECT_GT(oracle.gap(from + (to - from) * k / 4), -1e-12L);
      return true;
    });
  }
  EXPECT_NEAR(reached, end, 1e-15 + 1e-12 * std::abs(end));
}

class RandomFlight : public testing::TestWithParam<Kind> {};

TEST_P(RandomFlight, ContactsAreThoseOfTheOracle) {
  const Kind& kind = GetParam();
  const int count = cases(60);
  double worst = 0.0;  // error of a time over its bound
  int contacts = 0;
  for (int k = 0; k < count; ++k) {
    SCOPED_TRACE(k);
    RandomFlights random(1000003ULL * static_cast<unsigned>(k) + 17);
    const Encounter e = random.encounter(kind.moving, kind.other, kind.rate, kind.duration);
    std::vector<WitnessLink> chain;
    const TurningContact c = search(e, e.from, e.to, {}, &chain);
    const Truth t = truth(e, e.from, e.to);
    ASSERT_EQ(is_contact(c), t.time.has_value()) << static_cast<int>(c.status) << " clearance " << t.clearance;
    if (k % 10 == 0) expect_true(e, chain, t.time ? c.time : e.to);
    if (!t.time) {
      EXPECT_EQ(c.status, ContactStatus::separated);
      continue;
    }
    ++contacts;
    const auto error = static_cast<double>(std::abs(*t.time - Extended(c.time)));
    EXPECT_LE(error, c.time_error_bound + 1e-16);  // the oracle's own resolution
    EXPECT_LT(error, 1e-11);
    EXPECT_LE(c.gap_rate, 1e-9);
    worst = std::max(worst, error / c.time_error_bound);
  }
  EXPECT_GT(contacts, count / 12);
  // a bound that is hundreds of times too large would say nothing; of 20,000 flights the worst is at 0.2 of it
  EXPECT_GT(worst, 0.003);
}

INSTANTIATE_TEST_SUITE_P(Turning, RandomFlight,
                         testing::Values(Kind{"box", "plane"}, Kind{"hull", "plane"}, Kind{"capsule", "plane"},
                                         Kind{"triangle", "plane"}, Kind{"rounded-box", "plane"},
                                         Kind{"box", "static-box"}, Kind{"box", "static-triangle"}, Kind{"box", "box"},
                                         Kind{"box", "hull"}, Kind{"box", "capsule"}, Kind{"box", "ball"},
                                         Kind{"box", "plate"}, Kind{"hull", "static-triangle"}, Kind{"hull", "hull"},
                                         Kind{"hull", "capsule"}, Kind{"capsule", "static-box"},
                                         Kind{"capsule", "static-triangle"}, Kind{"capsule", "capsule"},
                                         Kind{"soccer", "box"}, Kind{"triangle", "triangle"},
                                         Kind{"rounded-box", "rounded-box"}, Kind{"rounded-box", "box"}),
                         [](const testing::TestParamInfo<Kind>& kind) {
                           std::string name = std::string(kind.param.moving) + "_on_" + kind.param.other;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace trajet::turning
