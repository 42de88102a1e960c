// Events that can never happen are warned of, others are not.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene_run.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {
namespace {

std::vector<std::string> warnings_of(const std::string& when) {
  return make_world(parse_scene("[parameters]\nk = 2\n[time]\nend = 1\n[[body]]\nname = \"b\"\nvelocity = [1, 0, 0]\n"
                                "[[state]]\nname = \"m\"\nvalue = 1\nrate = -1\n[[event]]\nname = \"e\"\nwhen = \"" +
                                    when + "\"\n",
                                "test.toml"))
      .warnings;
}

TEST(NeverHappens, AnEventWhoseFunctionHasNoZeroIsWarnedOf) {
  for (const char* when : {"1", "-0.5", "k", "0", "b.x^2 + 1", "exp(m) + 2", "norm(b.r) + 1", "2 + sin(t)",
                           "where(b.x > 0, 1, 2)", "abs(m)*0"})
    EXPECT_EQ(warnings_of(when),
              std::vector<std::string>{"event 'e' can never happen: whatever time and state are, its "
                                       "'when', " +
                                       std::string(when) + ", does not cross zero"});
}

TEST(NeverHappens, AnEventThatMightHappenIsNot) {
  for (const char* when : {"b.x",
                           "t - 10",
                           "b.x^2 - 1",
                           "norm(b.r) - 5",
                           "sin(t)",
                           "log(m)",
                           "1/b.x",
                           "b.x^3 + m",
                           "where(b.x > 0, 1, -1)",
                           "atan2(b.y, b.x)",
                           "b.x - b.x*k",
                           "sqrt(m) - 1",
                           "m^1.5 - k",
                           "tan(t)",
                           "floor(b.x)",
                           "b.x/b.y",
                           "min(b.x, m)",
                           "cbrt(b.x)",
                           "b.x^99 + 1",
                           "b.x^k - 1",
                           "b.x^0.3 - 1"})
    EXPECT_TRUE(warnings_of(when).empty()) << when;
}

}  // namespace
}  // namespace trajet
