#include "trajet/ode/structure.hpp"

#include <gtest/gtest.h>

#include "problems/drag.hpp"
#include "problems/driven.hpp"
#include "problems/kepler.hpp"
#include "problems/lotka_volterra.hpp"
#include "problems/oscillator.hpp"

namespace trajet {
namespace {

using Components = std::vector<int>;

template <class Law>
Structure structure(const Law& law, int dimension) {
  return structure_of(law, dimension);
}

TEST(Structure, SaysWhatEachRateUsesAndWhichAreCopies) {
  const Structure kepler = structure(problems::Kepler(), 4);
  EXPECT_EQ(kepler[0].uses, (Components{2, 3}));
  EXPECT_EQ(kepler[1].uses, (Components{2, 3}));
  EXPECT_EQ(kepler[2].uses, (Components{0}));
  EXPECT_EQ(kepler[2].copy_of, 0);
  EXPECT_EQ(kepler[3].copy_of, 1);
  EXPECT_FALSE(kepler[0].copy_of);
  const Structure oscillator = structure(problems::Oscillator(), 2);
  EXPECT_EQ(oscillator[0].uses, (Components{1}));
  EXPECT_FALSE(oscillator[0].copy_of) << "-x is no copy of x";
  EXPECT_EQ(oscillator[1].copy_of, 0);
}

TEST(Structure, OfALawThatDecidesByAnIfIsEverything) {
  const auto law = [](const auto&, const auto& q, auto& dq) {
    dq[0] = 1.0;
    if (q[1] < 0.0) dq[0] = q[1];
    dq[1] = 0.0;
  };
  EXPECT_EQ(structure(law, 2)[1].uses, (Components{0, 1}));
}

TEST(Levels, PutEachRateAboveWhatItUses) {
  // q0' = t, q1' = q2^2, q2' = q0, q3' = 1: levels {0, 3}, {2}, {1}
  const auto law = [](const auto& t, const auto& q, auto& dq) {
    dq[0] = t;
    dq[1] = q[2] * q[2];
    dq[2] = q[0];
    dq[3] = 1.0;
  };
  const LevelsResult result = find_levels(structure(law, 4));
  EXPECT_FALSE(result.unsuitable);
  EXPECT_EQ(result.levels, (Levels{{0, 3}, {2}, {1}}));
}

TEST(Levels, BlameARateThatDependsOnItsOwnSolution) {
  EXPECT_EQ(find_levels(structure(problems::Drag(), 6)).unsuitable->component, 0);
  // dr/dt = v is not to blame
  EXPECT_EQ(find_levels(structure(problems::Oscillator(), 2)).unsuitable->component, 0);
  // q0 is fine, q1 only uses q2, and q2 uses itself
  const auto law = [](const auto& t, const auto& q, auto& dq) {
    dq[0] = t;
    dq[1] = 2.0 * q[2];
    dq[2] = 2.0 * q[2];
  };
  EXPECT_EQ(find_levels(structure(law, 3)).unsuitable->component, 2);
}

TEST(Parts, AreVelocitiesAndPositions) {
  const PartsResult kepler = find_parts(structure(problems::Kepler(), 4));
  EXPECT_FALSE(kepler.unsuitable);
  EXPECT_EQ(kepler.is_position, (std::vector<bool>{false, false, true, true}));
  const PartsResult driven = find_parts(structure(problems::Driven(), 2));
  EXPECT_EQ(driven.is_position, (std::vector<bool>{false, true}));
}

TEST(Parts, BlameARateThatDependsOnItsOwnHalf) {
  EXPECT_EQ(find_parts(structure(problems::Drag(), 6)).unsuitable->component, 0);
  EXPECT_TRUE(find_parts(structure(problems::LotkaVolterra(), 2)).unsuitable);
  // a circle of three copies: one of them has to use its own half
  const auto circle = [](const auto&, const auto& q, auto& dq) {
    for (int i = 0; i < 3; ++i) dq[i] = q[(i + 1) % 3];
  };
  EXPECT_TRUE(find_parts(structure(circle, 3)).unsuitable);
}

}  // namespace
}  // namespace trajet
