// Units of whole scenes: what the parameters say goes with what they are used for, from the file and from --set.

#include <gtest/gtest.h>

#include <string>

#include "scene_run.hpp"
#include "trajet/io/scene_overrides.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {
namespace {

/// A scene with every kind of quantity; its parameters are the first lines.
std::string scene_with(const std::string& parameters, const std::string& rest) {
  return "[parameters]\n" + parameters + "\n[time]\nend = 1\n" + rest;
}

std::string fault_of(const std::string& text, const SceneOverrides& overrides = {}) {
  try {
    Scene scene = parse_scene(text, "");
    apply(overrides, scene);
    make_world(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SceneUnits, EachKeyKnowsItsDimension) {
  const struct {
    const char* lines;
    const char* place;
  } cases[] = {
      {"[[body]]\nname = \"b\"\nvelocity = [\"q\", 0, 0]", "7:14"},
      {"[[body]]\nname = \"b\"\nposition = \"q*[1, 0, 0]\"", "7:13"},
      {"[[body]]\nname = \"b\"\nacceleration = \"[0, 0, -q]\"", "7:24"},
      {"[[body]]\nname = \"b\"\nforce = \"q*v\"\nmass = 1", "7:10"},
      {"[[body]]\nname = \"b\"\nforce = [1, 0, 0]\nmass = \"q\"", "8:9"},
      {"[[body]]\nname = \"b\"\nshape = \"sphere\"\nradius = \"q\"", "8:11"},
      {"[[body]]\nname = \"b\"\nshape = \"box\"\nsize = [1, 1, \"q\"]", "8:16"},
      {"[[body]]\nname = \"b\"\nposition_rate = \"v + [q, 0, 0]\"", "7:20"},
      {"[[body]]\nname = \"b\"\nangular_velocity = [0, 0, \"q\"]", "7:28"},
      {"[[body]]\nname = \"b\"\norientation = { axis = [0, 0, 1], angle = \"q\" }", "7:44"},
      {"[[body]]\nname = \"b\"\norientation = { yaw = \"q\" }", "7:24"},
      {"[[body]]\nname = \"b\"\npoints = { tip = [\"q\", 0, 0] }", "7:20"},
      {"[[body]]\nname = \"b\"\n[[obstacle]]\nname = \"o\"\nshape = \"sphere\"\ncenter = [9, 9, 9]\nradius = \"q\"",
       "11:11"},
      {"[[body]]\nname = \"b\"\n[[event]]\nname = \"e\"\nwhen = \"b.x - q\"", "9:13"},
      {"[[body]]\nname = \"b\"\n[[event]]\nname = \"e\"\nwhen = \"b.x - 1\"\nset = { b.v = \"[q, 0, 0]\" }", "10:17"},
      {"[[state]]\nname = \"s\"\nvalue = \"3 kg\"\nrate = \"-q\"", "8:9"},
      {"[[state]]\nname = \"s\"\nvalue = 1\nrate = \"sin(q)\"", "8:9"},
  };
  for (const auto& c : cases) {
    const std::string fault = fault_of(scene_with("q = \"2 K\"", c.lines));
    EXPECT_TRUE(fault.starts_with(std::string(c.place) + ": error: ")) << c.lines << ": " << fault;
    EXPECT_NE(fault.find("K]"), std::string::npos) << fault;
    EXPECT_EQ(fault_of(scene_with("q = 0.5", c.lines)), "") << c.lines;
  }
}

TEST(SceneUnits, ParametersCarryDimensionsFromOneToTheOther) {
  const std::string body = "[[body]]\nname = \"b\"\nvelocity = [\"u\", 0, 0]";
  EXPECT_EQ(fault_of(scene_with("u = \"2*h/T\"\nh = \"3 m\"\nT = \"1 min\"", body)), "");
  EXPECT_EQ(fault_of(scene_with("u = \"2*h\"\nh = \"3 m\"", body)),
            "8:14: error: speed [m/s] expected, got length [m]");
  EXPECT_EQ(fault_of(scene_with("u = \"h + T\"\nh = \"3 m\"\nT = \"1 min\"", body)),
            "2:8: error: what '+' takes must have one dimension, got length [m] and time [s]");
}

TEST(SceneUnits, FrequenciesAreNoAngularVelocities) {
  const auto spin = [](const std::string& value) {
    return fault_of("[time]\nend = 1\n[[body]]\nname = \"b\"\nangular_velocity = [0, 0, \"" + value + "\"]");
  };
  for (const char* value : {"50 Hz", "3000 1/min", "2 1/s"})
    EXPECT_NE(
        spin(value).find(": error: angular velocity [rad/s] expected, got frequency [1/s]: write rev/s where turns"),
        std::string::npos)
        << value << spin(value);
  for (const char* value : {"50 rev/s", "3000 rpm", "2 rad/s", "2 deg/s"}) EXPECT_EQ(spin(value), "") << value;
  EXPECT_TRUE(spin("50 Hz").starts_with("5:31: "));  // at the unit
}

const std::string kShot =
    "[parameters]\nv0 = \"500 m/s\"\ntheta = \"0.05 deg\"\nk = 0.1\n[time]\nend = 1\n"
    "[[body]]\nname = \"b\"\nvelocity = \"v0*[cos(theta), 0, sin(theta)]\"\n"
    "acceleration = \"-k*v\"\n";

TEST(SceneUnits, SetKeepsTheDimensionOfAParameter) {
  EXPECT_EQ(fault_of(kShot, {.parameters = {"v0=500 kg"}}), "--set v0: error: speed [m/s] expected, got mass [kg]");
  EXPECT_EQ(fault_of(kShot, {.parameters = {"theta=3 m"}}), "--set theta: error: angle [rad] expected, got length [m]");
  EXPECT_EQ(fault_of(kShot, {.parameters = {"v0=1800 km/h", "theta=1 mil", "k=3 1/s"}}), "");
  EXPECT_EQ(fault_of(kShot, {.parameters = {"theta=0.1 1"}}), "");  // radians are plain numbers
}

TEST(SceneUnits, AVectorOfQuantitiesIsReadFromSetAndFromTheFile) {
  const std::string scene = "[parameters]\nspeed = \"2 m/s\"\n[time]\nend = 1\n[[body]]\nname = \"b\"\nvelocity = ";
  const auto velocity = [&](const std::string& in_file, const std::vector<std::string>& set) {
    Scene read = parse_scene(scene + in_file + "\n", "");
    apply({.parameters = set}, read);
    return test::final_of(run(read), "b").velocity;
  };
  EXPECT_EQ(velocity("[0, 0, 0]", {"b.velocity=[3 m/s, 0, 1 ft/s]"}), Vector3(3.0, 0.0, 0.3048));
  EXPECT_EQ(velocity("[0, 0, 0]", {" b.velocity = [ 36 km/h,max(speed, 1), -speed ] "}), Vector3(10.0, 2.0, -2.0));
  EXPECT_EQ(velocity("\"[3 m/s, 0, 1 ft/s]\"", {}), Vector3(3.0, 0.0, 0.3048));
  EXPECT_EQ(velocity("\"[3, 0, 1]*2\"", {}), Vector3(6.0, 0.0, 2.0));
  EXPECT_EQ(fault_of(scene + "[0, 0, 0]\n", {.parameters = {"b.velocity=[3 m/s, 0, 1 ft]"}}),
            "--set b.velocity: error: speed [m/s] expected, got length [m]");
  EXPECT_NE(fault_of(scene + "\"[0, 0, 1 ft]\"\n").find("7:22: error: speed [m/s] expected, got length [m]"),
            std::string::npos)
      << fault_of(scene + "\"[0, 0, 1 ft]\"\n");
  EXPECT_NE(fault_of(scene + "\"[1 m/s, 0]\"\n"), "");
}

TEST(SceneUnits, SetWithoutAUnitSaysWhichOneIsTaken) {
  const auto warnings = [](const std::string& assignment) {
    Scene scene = parse_scene(kShot, "");
    apply({.parameters = {assignment}}, scene);
    return make_world(scene).warnings;
  };
  EXPECT_EQ(warnings("theta=0.1"),
            std::vector<std::string>{"--set theta=0.1 has no unit, where the scene has one: taken as angle [rad]"});
  EXPECT_EQ(warnings("v0=2*250").size(), 1u);
  EXPECT_TRUE(warnings("theta=0.1 rad").empty());
  EXPECT_TRUE(warnings("v0=500 m/s").empty());
  EXPECT_TRUE(warnings("k=0.2").empty());  // has none in the scene either
}

TEST(SceneUnits, AScenesNumbersAreTheSameWithAndWithoutUnits) {
  const std::string bare =
      "[parameters]\nv0 = 500\ntheta = \"0.05*pi/180\"\nk = 0.1\n" + kShot.substr(kShot.find("[time]"));
  const RunResult with = test::run_text(kShot), without = test::run_text(bare);
  EXPECT_EQ(test::final_of(with, "b").position.x(), test::final_of(without, "b").position.x());
}

TEST(SceneUnits, HintsForWhatIsAlmostAQuantity) {
  const auto end = [](const std::string& text) {
    return fault_of("[time]\nend = \"" + text + "\"\n[[body]]\nname = \"b\"");
  };
  EXPECT_NE(end("3,5 s").find("2:9: error: a number has a decimal point: write 3.5"), std::string::npos)
      << end("3,5 s");
  EXPECT_NE(end("3,5").find("write 3.5"), std::string::npos) << end("3,5");
  EXPECT_NE(fault_of("[time]\nend = 1\n[[body]]\nname = \"b\"\nvelocity = [\"3,5 m/s\", 0, 0]").find("write 3.5"),
            std::string::npos);
  EXPECT_NE(end("3 S").find("; did you mean 's'?"), std::string::npos) << end("3 S");
  EXPECT_NE(end("3s").find("write \"3 s\""), std::string::npos) << end("3s");
  EXPECT_NE(end("0.05°").find("write \"0.05 °\""), std::string::npos) << end("0.05°");
  const auto of_g = [](const std::string& text) {
    return fault_of("[parameters]\ng = 9.8\n[time]\nend = 1\n[[body]]\nname = \"b\"\nacceleration = [0, 0, \"" + text +
                    "\"]");
  };
  EXPECT_NE(of_g("-2g").find("write -2*g"), std::string::npos) << of_g("-2g");
  EXPECT_NE(of_g("-2 g").find("got mass [kg]; for the value of g write -2*g"), std::string::npos) << of_g("-2 g");
  EXPECT_EQ(of_g("-2*g"), "");
  EXPECT_EQ(of_g("1 g0"), "");
}

}  // namespace
}  // namespace trajet
