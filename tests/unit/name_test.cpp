// Names in letters of any script: in texts, in formulas, in scenes from files and from C++.

#include "trajet/text/name.hpp"

#include <gtest/gtest.h>

#include <string>

#include "trajet/error.hpp"
#include "trajet/io/scene_file.hpp"
#include "trajet/scene/scene.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {
namespace {

TEST(Name, EndsBeforeWhatIsNoLetter) {
  EXPECT_EQ(name_length("v0*t"), 2u);
  EXPECT_EQ(name_length("K\u00fcgelchen.x"), std::string("K\u00fcgelchen").size());
  EXPECT_EQ(name_length("\u03b8+1"), 2u);                                          // theta
  EXPECT_EQ(name_length("\u7403 1"), 3u);                                          // ball, in Chinese
  EXPECT_EQ(name_length("e\u0301t\u00e9"), std::string("e\u0301t\u00e9").size());  // a combining accent follows
  for (const char* none : {"", "2b", "\u00d7", "\u00b2", "\u2212x", "\u00b0", "\xc3", "\xff", "\u0301"})
    EXPECT_EQ(name_length(none), 0u) << none;
}

TEST(Name, OfABodyMayHaveLettersOfAnyScript) {
  const Scene scene = parse_scene(R"([time]
end = 1
[[body]]
name = "Kügelchen"
velocity = [1, 0, 0]
[[body]]
name = "Mond"
acceleration = "Kügelchen.r - r"
[[event]]
name = "am Ziel"
when = "Kügelchen.x - 1/2"
)", "scene.toml");
  const World world = make_world(scene);
  EXPECT_EQ(world.groups.size(), 1u);
}

void expect_refused(const Scene& scene, const std::string& part) {
  try {
    make_world(scene);
    FAIL() << "no error: " << part;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

/// A scene that no file was read for is checked like any other.
TEST(Name, OfScenesFromCppAreChecked) {
  Scene scene;
  scene.time.end = 1.0;
  expect_refused(scene, "nothing moves");
  scene.bodies.push_back({.name = "2b"});
  expect_refused(scene, "is no name");
  scene.bodies[0].name = "vx";
  expect_refused(scene, "reserved");
  scene.bodies[0].name = "b";
  scene.parameters.push_back({"b", 1.0, {}});
  expect_refused(scene, "already that of the parameter");
  scene.parameters.clear();
  scene.events.push_back({.name = "", .when = 1.0});
  expect_refused(scene, "no name of an event");
  scene.events[0] = {.name = "e", .when = 1.0, .set = {{"b.q", 1.0, {}}}};
  expect_refused(scene, "neither an extra state nor a part of a body");
}

}  // namespace
}  // namespace trajet
