// Laws that jump or turn where their power series go on: angles at their cuts, functions at hidden poles.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "scene_run.hpp"
#include "trajet/ode/solve.hpp"

namespace trajet {
namespace {

constexpr double kPi = std::numbers::pi;

/// Integral of atan from 0 to u.
double area_of_atan(double u) { return u * std::atan(u) - 0.5 * std::log1p(u * u); }

/// Integral from 0 to t of a wave of slope 1 that jumps from pi/2 to -pi/2 at odd multiples of pi/2.
double area_of_sawtooth(double t) { return 0.5 * std::pow(std::remainder(t, kPi), 2); }

struct Case {
  const char* rate;
  double end;  ///< of q(10), q(0) = 0
};

const Case kCases[] = {
    {"atan2(t - 1, -1)", -(kPi - area_of_atan(1.0)) + 9.0 * kPi - area_of_atan(9.0)},
    {"atan2(1 - t, -1)", kPi - area_of_atan(1.0) - 9.0 * kPi + area_of_atan(9.0)},
    {"atan2(sin(t), cos(t))", 0.5 * std::pow(10.0 - 4.0 * kPi, 2)},
    {"atan(tan(t))", area_of_sawtooth(10.0)},
    // atan(1/x) = pi/2 - atan x for x > 0
    {"atan(1/(t - 1))", -(kPi / 2 - area_of_atan(1.0)) + 9.0 * kPi / 2 - area_of_atan(9.0)},
    {"atan((t + 3)/(t - 1) - 1)",  // = atan(4/x) = pi/2 - atan(x/4) for x > 0
     -(kPi / 2 - 4.0 * area_of_atan(0.25)) + 9.0 * kPi / 2 - 4.0 * area_of_atan(2.25)},
    // triangular waves between 0 and pi, and between -pi/2 and pi/2
    {"acos(cos(t))", 1.5 * kPi* kPi + 0.5 * kPi* kPi - 0.5 * std::pow(4.0 * kPi - 10.0, 2)},
    {"asin(sin(t))", kPi* kPi / 4 - 0.5 * std::pow(10.0 - 3.0 * kPi, 2)},
    {"sign(1/(t - 2))", 6.0},
    {"where(1/(t - 2) < 3, 1, 2)", 10.0 + 1.0 / 3.0},
};

// One step of Runge and Kutta's method leads past a cut, on the wrong side of which it starts: errors below 3e-9,
// measured.
TEST(BranchCuts, SeriesEndAtThem) {
  for (const char* method : {"taylor", "taylor-extended"})
    for (const Case& c : kCases) {
      const RunResult result = test::run_text("[time]\nend = 10\n[method]\nname = \"" + std::string(method) +
                                              "\"\n[[state]]\nname = \"q\"\nvalue = 0\nrate = \"" + c.rate + "\"\n");
      ASSERT_EQ(result.status, RunStatus::finished) << c.rate << result.failure;
      EXPECT_NEAR(test::state_of(result, "q"), c.end, 1e-8) << method << " " << c.rate;
    }
}

// A body on a circle meets the cut of its own angle: r'' = -r + (0, 0, angle/10), z in closed form by superposition.
TEST(BranchCuts, OfAStateThatTheyMove) {
  const RunResult result = test::run_text(R"(
[time]
end = 10
[[body]]
name = "b"
position = [1, 0, 0]
velocity = [0, 1, 0]
acceleration = "-r + [0, 0, 0.1*atan2(y, x)]"
)");
  // the response to an angle t is t - sin t, to a jump of -2 pi at pi or 3 pi -2 pi (1 - cos(t - jump))
  const double t = 10.0;
  double z = t - std::sin(t);
  for (const double jump : {kPi, 3.0 * kPi}) z -= 2.0 * kPi * (1.0 - std::cos(t - jump));
  EXPECT_NEAR(test::final_of(result, "b").position.z(), 0.1 * z, 1e-10);
}

using Vector1 = Eigen::Matrix<double, 1, 1>;

template <class Law>
double end_of(const Law& law) {
  return solve(law, 0.0, Vector1(0.0), 10.0).end()[0];
}

TEST(BranchCuts, OfLawsInCpp) {
  const auto angle = [](const auto& t, const auto&, auto& dq) {
    using std::atan2;
    dq[0] = atan2(t - 1.0, -1.0 + 0.0 * t);
  };
  EXPECT_NEAR(end_of(angle), kCases[0].end, 1e-10);
  const auto wave = [](const auto& t, const auto&, auto& dq) {
    using std::asin, std::sin;
    dq[0] = asin(sin(t));
  };
  EXPECT_NEAR(end_of(wave), kPi * kPi / 4 - 0.5 * std::pow(10.0 - 3.0 * kPi, 2), 1e-9);
}

const char* const kCircle = R"toml(
[[body]]
name = "b"
position = [1, 0, 0]
velocity = [0, 1, 0]
acceleration = "-r"
[[event]]
name = "angle"
when = "atan2(b.y, b.x)"
[[event]]
name = "late"
when = "atan2(b.y, b.x) - 0.5"
)toml";

// The angle jumps from pi to -pi at pi and 3 pi, and rises through 0 at 2 pi.
TEST(BranchCuts, EventsSeeTheJump) {
  for (const char* method : {"taylor", "dopri5", "dop853"}) {
    const std::string head = "[time]\nend = 10\n[method]\nname = \"" + std::string(method) + "\"\n";
    const RunResult result = test::run_text(head + kCircle);
    ASSERT_EQ(result.status, RunStatus::finished) << method << result.failure;
    const struct {
      const char* event;
      std::vector<std::pair<double, int>> crossings;
    } expected[] = {{"angle", {{kPi, -1}, {2 * kPi, 1}, {3 * kPi, -1}}},
                    {"late", {{0.5, 1}, {kPi, -1}, {2 * kPi + 0.5, 1}, {3 * kPi, -1}}}};
    for (const auto& [event, crossings] : expected) {
      std::vector<EventRecord> seen;
      for (const EventRecord& record : result.events)
        if (record.event == event) seen.push_back(record);
      ASSERT_EQ(seen.size(), crossings.size()) << method << " " << event;
      for (std::size_t i = 0; i < seen.size(); ++i) {
        EXPECT_NEAR(seen[i].time, crossings[i].first, 1e-10) << method << " " << event;
        EXPECT_EQ(seen[i].direction, crossings[i].second) << method << " " << event;
      }
    }
  }
}

// Where `when` has no value nothing crosses; what was before a gap does not tell what crosses behind it.
TEST(BranchCuts, EventsPassOverGapsAndPoles) {
  const struct {
    const char* when;
    std::vector<std::pair<double, int>> crossings;
  } cases[] = {{"sqrt(q - 5) - 1", {{6.0, 1}}},
               {"sqrt(5 - q) - 1", {{4.0, -1}}},
               {"sqrt((q - 5)^2 - 1) - 1", {{5.0 - std::sqrt(2.0), -1}, {5.0 + std::sqrt(2.0), 1}}},
               {"log(q - 5)", {{6.0, 1}}},
               {"1/(t - 5)", {{5.0, 1}}},
               {"1/(q - 5)^2", {}},
               {"1/(q - 5) - 1", {{5.0, 1}, {6.0, -1}}},
               {"tan(q)", {{kPi / 2, -1}, {kPi, 1}, {1.5 * kPi, -1}, {2 * kPi, 1}, {2.5 * kPi, -1}, {3 * kPi, 1}}}};
  for (const char* method : {"taylor", "dopri5", "dop853"})
    for (const auto& [when, crossings] : cases) {
      const RunResult result = test::run_text(
          "[time]\nstart = 0.01\nend = 10\n[method]\nname = \"" + std::string(method) +
          "\"\n[[state]]\nname = \"q\"\nvalue = 0.01\nrate = 1\n[[event]]\nname = \"e\"\nwhen = \"" + when + "\"\n");
      ASSERT_EQ(result.status, RunStatus::finished) << method << " " << when << ": " << result.failure;
      ASSERT_EQ(result.events.size(), crossings.size()) << method << " " << when;
      for (std::size_t i = 0; i < crossings.size(); ++i) {
        EXPECT_NEAR(result.events[i].time, crossings[i].first, 1e-9) << method << " " << when;
        EXPECT_EQ(result.events[i].direction, crossings[i].second) << method << " " << when;
      }
    }
}

}  // namespace
}  // namespace trajet
