// Bodies that go through obstacles, past several of them, and start in contact: through whole runs.

#include <gtest/gtest.h>

#include <cmath>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::run_text;
using test::Way;

std::vector<Way> ways() {
  return {{"taylor", "name = \"taylor\"\n"},
          {"dopri5", "name = \"dopri5\"\n"},
          test::fixed("rk4", 0.25),
          test::fixed("rk4", 0.1)};
}

std::string names(const RunResult& result) {
  std::string all;
  for (const Impact& impact : result.impacts) all += impact.with + " ";
  return all;
}

TEST(Passing, InAndOutInOrder) {
  // Along x at 1 m/s: through a sphere, a box, a disk inside the box, a second sphere that overlaps the box.
  for (const Way& way : ways()) {
    for (const double radius : {0.0, 0.125}) {
      const std::string shape = radius > 0.0 ? "shape = \"sphere\"\nradius = 0.125\n" : "";
      const RunResult result =
          run_text("[time]\nend = 12\n[method]\n" + way.lines + "[[body]]\nname = \"probe\"\n" + shape + R"(
velocity = [1, 0, 0]
[[obstacle]]
name = "late"
shape = "sphere"
center = [8, 0, 0]
radius = 1.5
on_hit = "pass"
[[obstacle]]
name = "box"
shape = "box"
center = [6, 0, 0]
size = [2, 2, 2]
on_hit = "pass"
[[obstacle]]
name = "disk"
shape = "disk"
center = [6, 0, 0]
normal = [1, 0, 0]
radius = 0.5
on_hit = "pass"
[[obstacle]]
name = "early"
shape = "sphere"
center = [2, 0, 0]
radius = 1
on_hit = "pass"
)");
      SCOPED_TRACE(way.name);
      ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
      struct Crossing {
        std::string with;
        double x;
        double side;  // of the radius: -1 before, 1 behind, 0 for a point
      };
      std::vector<Crossing> expected = {{"early", 1, -1}, {"early", 3, 1},   {"box", 5, -1}, {"disk", 6, -1},
                                        {"disk", 6, 1},   {"late", 6.5, -1}, {"box", 7, 1},  {"late", 9.5, 1}};
      if (radius == 0.0) expected.erase(expected.begin() + 4);  // a thin obstacle has no inside for a point
      ASSERT_EQ(result.impacts.size(), expected.size()) << names(result);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(result.impacts[i].with, expected[i].with) << i;
        EXPECT_EQ(result.impacts[i].kind, ImpactKind::hit);
        // an enclosure of x over up to 12 m, at 1 m/s
        EXPECT_NEAR(result.impacts[i].time, expected[i].x + expected[i].side * radius, 1e-13) << i;
        EXPECT_EQ(result.impacts[i].velocity_after, Vector3(1, 0, 0));
      }
    }
  }
}

TEST(Passing, ThroughAPlaneAndBackAgain) {
  for (const Way& way : ways()) {
    const RunResult result = run_text("[time]\nend = 10\n[method]\n" + way.lines + R"(
[[body]]
name = "spring"
position = [0, 0, 1]
acceleration = "-r"
[[obstacle]]
name = "plane"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "pass"
)");
    // z = cos t
    ASSERT_EQ(result.impacts.size(), 3u) << way.name;
    // rk4 at 0.25 s errs by 1e-4 in phase over 10 s
    const double tolerance = way.name.starts_with("rk4") ? 5e-4 : 1e-10;
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(result.impacts[static_cast<std::size_t>(i)].time, (i + 0.5) * M_PI, tolerance) << way.name;
  }
}

TEST(Passing, TheFirstOfSeveralStopsWhateverTheirOrderInTheScene) {
  const std::string near =
      "[[obstacle]]\nname = \"near\"\nshape = \"disk\"\ncenter = [2, 0, 0]\nnormal = [1, 0, 0]\nradius = 1\n";
  const std::string far = "[[obstacle]]\nname = \"far\"\nshape = \"sphere\"\ncenter = [4, 0, 0]\nradius = 1\n";
  const std::string body = "[time]\nend = 10\n[[body]]\nname = \"a\"\nvelocity = [1, 0, 0]\n";
  for (const std::string& obstacles : {near + far, far + near}) {
    const RunResult result = run_text(body + obstacles);
    EXPECT_EQ(names(result), "near ");
    EXPECT_EQ(result.end_time, 2.0);
  }
}

TEST(Passing, ARestitutionWithoutABounceIsWarnedOf) {
  const std::string scene =
      "[time]\nend = 10\n[[body]]\nname = \"a\"\nvelocity = [1, 0, 0]\n[[obstacle]]\nname = \"near\"\nshape = "
      "\"disk\"\n"
      "center = [2, 0, 0]\nnormal = [1, 0, 0]\nradius = 1\n";
  EXPECT_TRUE(run_text(scene).warnings.empty());
  EXPECT_TRUE(run_text(scene + "on_hit = \"bounce\"\nrestitution = 0.5\n").warnings.empty());
  const RunResult result = run_text(scene + "restitution = 0.5\n");
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("'near' has a restitution"), std::string::npos) << result.warnings[0];
  EXPECT_THROW(run_text(scene + "restitution = 2\n"), InputError);
}

TEST(Passing, ManyBodiesMayHitAtOneInstant) {
  std::string scene =
      "[time]\nend = 1\n[[obstacle]]\nname = \"floor\"\nshape = \"plane\"\npoint = [0, 0, 0]\n"
      "normal = [0, 0, 1]\non_hit = \"bounce\"\n";
  constexpr int kBodies = 1200;  // more than one body may hit at one instant
  for (int i = 0; i < kBodies; ++i)
    scene += "[[body]]\nname = \"b" + std::to_string(i) + "\"\nposition = [0, 0, 0.5]\nvelocity = [0, 0, -1]\n";
  const RunResult result = run_text(scene);
  EXPECT_EQ(result.status, RunStatus::finished) << result.failure;
  EXPECT_EQ(result.impacts.size(), static_cast<std::size_t>(kBodies));
}

TEST(Passing, ACornerBouncesOffBothPlanes) {
  // Into the corner of the floor and a wall, both met at t = 1 exactly, or 1e-15 s apart.
  for (const double shift : {0.0, 1e-15, -1e-15}) {
    for (const Way& way : ways()) {
      const RunResult result =
          run_text("[time]\nend = 3\n[method]\n" + way.lines + "[[body]]\nname = \"ball\"\nposition = [" +
                   test::number(2.0 + shift) + R"(, 0, 3]
velocity = [-2, 0.5, -3]
[[obstacle]]
name = "floor"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "bounce"
[[obstacle]]
name = "wall"
shape = "plane"
point = [0, 0, 0]
normal = [1, 0, 0]
on_hit = "bounce"
)");
      SCOPED_TRACE(way.name + " " + test::number(shift));
      ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
      ASSERT_EQ(result.impacts.size(), 2u) << names(result);
      EXPECT_NEAR(result.impacts[0].time, 1.0, 1e-15);
      EXPECT_NEAR(result.impacts[1].time, 1.0, 1e-15);
      EXPECT_EQ(test::final_of(result, "ball").velocity, Vector3(2, 0.5, 3));
      EXPECT_NEAR(test::final_of(result, "ball").position.x(), 4.0, 1e-14);
      EXPECT_NEAR(test::final_of(result, "ball").position.z(), 6.0, 1e-14);
    }
  }
}

TEST(Passing, TiesAreReported) {
  const std::string scene = R"(
[time]
end = 3
[[body]]
name = "ball"
position = [2, 0, 2]
velocity = [-1, 0, -1]
[[obstacle]]
name = "floor"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
ON_HIT
[[obstacle]]
name = "wall"
shape = "plane"
point = [0, 0, 0]
normal = [1, 0, 0]
ON_HIT
)";
  for (const std::string on_hit : {"on_hit = \"stop\"", "on_hit = \"pass\"", "on_hit = \"bounce\""}) {
    std::string text = scene;
    for (std::size_t at; (at = text.find("ON_HIT")) != std::string::npos;) text.replace(at, 6, on_hit);
    const RunResult result = run_text(text);
    // what bounces off both at once does so whatever their order
    EXPECT_EQ(result.warnings.size(), on_hit == "on_hit = \"bounce\"" ? 0u : 1u) << on_hit;
    EXPECT_EQ(result.impacts[0].with, "floor") << on_hit;
    EXPECT_EQ(result.end_time, on_hit == "on_hit = \"stop\"" ? 2.0 : 3.0);
  }
}

TEST(Passing, AStartInContact) {
  const auto start = [](const std::string& velocity, const std::string& on_hit) {
    return run_text(
        "[time]\nend = 1\n[[body]]\nname = \"ball\"\nshape = \"sphere\"\nradius = 0.5\nposition = [0, 0, "
        "0.5]\nvelocity = " +
        velocity +
        "\n[[obstacle]]\nname = \"floor\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\non_hit = \"" +
        on_hit + "\"\n");
  };
  for (const std::string on_hit : {"stop", "bounce", "pass"})
    EXPECT_TRUE(start("[0, 0, 1]", on_hit).impacts.empty()) << on_hit;
  for (const std::string on_hit : {"stop", "bounce", "pass"})
    EXPECT_TRUE(start("[1, 0, 0]", on_hit).impacts.empty()) << on_hit;
  for (const std::string on_hit : {"stop", "bounce", "pass"}) {
    const RunResult result = start("[0, 0, -1]", on_hit);
    ASSERT_EQ(result.impacts.size(), 1u) << on_hit;
    EXPECT_EQ(result.impacts[0].time, 0.0) << on_hit;
    EXPECT_EQ(result.impacts[0].point.z(), 0.0) << on_hit;
  }
  EXPECT_EQ(start("[0, 0, -1]", "stop").status, RunStatus::stopped);
  EXPECT_EQ(test::final_of(start("[0, 0, -1]", "bounce"), "ball").position.z(), 1.5);
  EXPECT_EQ(test::final_of(start("[0, 0, -1]", "pass"), "ball").position.z(), -0.5);
}

TEST(Passing, AStartInsideIsTheScenesError) {
  const std::string scene = R"(
[time]
end = 1
[[body]]
name = "ball"
position = [0.2, 0, 0]
velocity = [3, 0, 0]
[[obstacle]]
name = "rock"
shape = "sphere"
center = [0, 0, 0]
radius = 1
on_hit = ")";
  for (const std::string on_hit : {"stop", "bounce"}) {
    try {
      run_text(scene + on_hit + "\"\n");
      ADD_FAILURE() << on_hit;
    } catch (const InputError& error) {
      EXPECT_EQ(error.message(), "body 'ball' starts inside obstacle 'rock'");
      EXPECT_GT(error.where().line, 0);
    }
  }
}

TEST(Passing, AStartInsideWhatIsPassedComesOutFirst) {
  struct Inside {
    std::string obstacle;
    double out;  // s, at 2 m/s along x from the origin
  };
  const std::vector<Inside> obstacles{{"shape = \"sphere\"\ncenter = [0.25, 0, 0]\nradius = 1\n", 0.625},
                                      {"shape = \"box\"\ncenter = [0, 0, 0]\nsize = [3, 2, 2]\n", 0.75},
                                      {"shape = \"plane\"\npoint = [0.5, 0, 0]\nnormal = [1, 0, 0]\n", 0.25}};
  for (const Way& way : ways())
    for (const Inside& inside : obstacles)
      for (const double radius : {0.0, 0.125}) {
        const std::string shape = radius > 0.0 ? "shape = \"sphere\"\nradius = 0.125\n" : "";
        const RunResult result = run_text("[time]\nend = 4\n[method]\n" + way.lines + "[[body]]\nname = \"probe\"\n" +
                                          shape + "velocity = [2, 0, 0]\n[[obstacle]]\nname = \"cloud\"\n" +
                                          "on_hit = \"pass\"\n" + inside.obstacle + R"([[obstacle]]
name = "behind"
shape = "sphere"
center = [5, 0, 0]
radius = 1
on_hit = "pass"
)");
        SCOPED_TRACE(way.name + inside.obstacle);
        ASSERT_EQ(names(result), "cloud behind behind ");
        EXPECT_NEAR(result.impacts[0].time, inside.out + radius / 2.0, 1e-12);
        // towards the side that it came from
        EXPECT_LT(result.impacts[0].normal.x(), 0.0);
        EXPECT_NEAR(result.impacts[1].time, 2.0 - radius / 2.0, 1e-12);
      }
}

TEST(Passing, AnImpactAtTheLastInstantCounts) {
  // 1 - t at the end t = 1 of steps that are exact in binary
  for (const Way& way : {ways()[0], ways()[1], test::fixed("rk4", 0.25), test::fixed("midpoint", 1.0)}) {
    const RunResult result = run_text("[time]\nend = 1\n[method]\n" + way.lines + R"(
[[body]]
name = "ball"
position = [0, 0, 1]
velocity = [0, 0, -1]
[[obstacle]]
name = "floor"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
)");
    ASSERT_EQ(result.impacts.size(), 1u) << way.name;
    EXPECT_NEAR(result.impacts[0].time, 1.0, 1e-15) << way.name;
  }
}

TEST(Passing, ABounceBeforeOrBehindTheCrossingOfAThinPlaneBesideIt) {
  // The point bounces off a wall where it is right above or below a disk, and crosses the disk's plane beside the disk:
  // after the bounce and, unless it bounced, beyond the wall; or before the bounce. It never meets the disk.
  for (const std::string start :
       {"position = [0, 0, 1]\nvelocity = [2, 0, -0.5]\n", "position = [-5, 0, 1]\nvelocity = [2, 0, -1]\n"}) {
    for (const Way& way : ways()) {
      const RunResult result =
          run_text("[time]\nend = 6\n[method]\n" + way.lines + "[[body]]\nname = \"point\"\n" + start + R"(
[[obstacle]]
name = "disk"
shape = "disk"
center = [0, 0, 0]
normal = [0, 0, 1]
radius = 1
[[obstacle]]
name = "wall"
shape = "plane"
point = [0.5, 0, 0]
normal = [-1, 0, 0]
on_hit = "bounce"
)");
      ASSERT_EQ(result.status, RunStatus::finished) << way.name << result.failure;
      EXPECT_EQ(names(result), "wall ") << way.name;
    }
  }
}

}  // namespace
}  // namespace trajet
