#include <gtest/gtest.h>

#include <string>

#include "trajet/io/scene_file.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/sim/run.hpp"

namespace trajet {
namespace {

/// A wrong scene and how its message must begin and what it must contain. Lines and columns are counted by hand.
struct BadScene {
  const char* text;
  const char* place;  // LINE:COLUMN
  const char* words;
};

// A text without [time] follows two lines "[time]" and "end = 1", so that its own first line is line 3.
const BadScene kBadScenes[] = {
    // syntax
    {"x = [", "3:", "end-of-file"},
    {"end = 2", "3:", "redefine"},
    {"[[body]]\nname = \"b\nc\"", "4:", "error"},
    {"title = \"\xff\"", "3:", "utf-8"},
    // what is almost TOML
    {"[[body]]\nname = \"b\"\nvelocity = v0", "5:12", "; a formula or a quantity stands in quotes: \"v0\""},
    {"[[body]]\nname = \"b\"\nacceleration = [0, 0, -g]", "5:23", "stands in quotes: \"-g\""},
    {"[[body]]\nname = \"b\"\nmass = 5 kg", "5:10", "stands in quotes: \"5 kg\""},
    {"[[body]]\nname = \"b\"\nvelocity = [1/2, sqrt(2), 0]", "5:14", "stands in quotes: \"1/2\""},
    {"[[body]]\nname = \"b\"\nvelocity = [max(1, 2), 0, 0]", "5:13", "stands in quotes: \"max(1, 2)\""},
    {"[[body]]\nname = \"b\"\nmass = 3,5", "5:9", "; a number has a decimal point: write 3.5"},
    {"[[body]]\nname = \"b\"\nvelocity = [1 2 3]", "5:15", "; commas stand between numbers: 1, 2, 3"},
    {"[[body]]\nname = \"b\"\nvelocity = (1, 2, 3)", "5:12", "; a vector stands in brackets: [1, 2, 3]"},
    {"[[body]]\nname = \"b\"\nvelocity = \"[1, 2, 3]", "5:22", "; the closing quote is missing"},
    {"[[body]]\nname = \"b\"\nmass = .5", "5:8", "; write 0.5"},
    {"[[body]]\nname = \"b\"\nmass = 5.", "5:10", "; write 5.0"},
    {"[[body]]\nname = \"b\"\nmass: 5", "5:5", "; a key and its value are joined by '='"},
    {"[[body]]\nname = \"b\"\n[body]", "5:1", "; write [[body]]"},
    {"[[body]]\nname = \"b\"\nacceleration = -9.8", "5:16", "got a number: write its direction too"},
    {"[[body]]\nname = \"b\"\nvelocity = \"3 m/s\"", "5:12", "write its direction too, [\"3 m/s\", 0, 0]"},
    // keys
    {"[[body]]\nname = \"b\"\nvelocty = [1,0,0]", "5:1", "unknown key 'velocty' in [[body]]; did you mean 'velocity'?"},
    {"[[body]]\nname = \"b\"\nradius = 1", "5:10", "a point has no radius"},
    {"[[body]]\nname = \"b\"\ncolor = \"gren\"", "5:9", "got 'gren'; did you mean 'green'?"},
    {"[[body]]\nname = \"b\"\ncolor = \"#12345g\"", "5:9", "a colour expected, \"#rrggbb\" or one of aqua, "},
    {"[[body]]\nname = \"b\"\ncolor = 255", "5:9", "a string expected"},
    {"[[obstacle]]\nname = \"o\"\nshape = \"plane\"\npoint = [0,0,0]\nnormal = [0,0,1]\ncolor = \"#fff\"", "8:9",
     "got '#fff'"},
    {"[[body]]\nname = \"b\"\nshape = \"sphere\"", "3:1", "lacks the key 'radius'"},
    {"[[body]]\nposition = [0,0,0]", "3:1", "[[body]] lacks the key 'name'"},
    {"[[body]]\nname = \"b\"\nfriction = -1", "5:12", "friction of body 'b'"},
    {"[[body]]\nname = \"b\"\nshape = \"hull\"", "3:1", "lacks the key 'points'"},
    {"[[body]]\nname = \"b\"\nshape = \"box\"\nradius = 1", "6:1", "unknown key 'radius'"},
    {"[[body]]\nname = \"b\"\nshape = \"mesh\"", "3:1", "lacks the key 'file'"},
    {"[[body]]\nname = \"b\"\norientation = {angle = 1}", "5:15", "lacks the key 'axis'"},
    {"[[body]]\nname = \"b\"\norientation = {quaternion = [1,0,0]}", "5:29", "an array of 4 expected, got 3"},
    {"[[body]]\nname = \"b\"\ninertia = [[1,0,0],[0,1,0]]", "5:11", "an array of 3 expected, got 2"},
    {"[[body]]\nname = \"b\"\nangular_velocity = \"3 m/s\"", "5:20", "a vector expected"},
    {"[[body]]\nname = \"b\"\ntorque = [0, 0, \"3 N\"]", "5:20", "torque [J] expected, got force [N]"},
    {"[[body]]\nname = \"b\"\npoints = {tip = 3}", "5:17", "a vector expected"},
    {"[[body]]\nname = \"b\"\nshape = \"spere\"", "5:9", "did you mean 'sphere'?"},
    {"[[body]]\nname = \"b\"\nforce = [0,0,1]", "5:9", "a force needs the key 'mass'"},
    {"[[body]]\nname = \"b\"\nforce = [0,0,1]\nmass = 1\nacceleration = [0,0,1]", "5:9", "not by both"},
    {"[[bodies]]\nname = \"b\"", "3:3", "unknown key 'bodies'"},
    {"[body]\nname = \"b\"", "3:1", "write [[body]]"},
    {"body = [1]\n[time]\nend = 1", "1:9", "write [[body]]"},
    {"[methd]\nname = \"rk4\"", "3:2", "did you mean 'method'?"},
    {"[method]\nsteps = []", "4:9", "non-empty array"},
    {"[method]\nsteps = [1]\nstep = 1", "4:9", "not both"},
    {"[method]\nmax_steps = 0", "4:13", "at least 1 expected, got 0"},
    {"[method]\nmax_steps = 1.5", "4:13", "got a number"},
    {"[method]\nmax_step = 0\n[[body]]\nname = \"b\"", "4:12", "max_step must be positive, got 0"},
    {"[method]\nmax_step = \"1 m\"", "4:15", "time [s] expected, got length [m]"},
    {"[method]\nname = \"rk4\"\nmax_step = \"10 ms\"\nstep = 0.02\n[[body]]\nname = \"b\"", "6:8",
     "step of 0.02 s is longer than max_step = 0.01 s"},
    {"[method]\nname = \"rk4\"\nmax_step = \"10 ms\"\nsteps = [0.01, 0.02]\n[[body]]\nname = \"b\"", "6:16",
     "step of 0.02 s is longer than max_step = 0.01 s"},
    {"[method]\norientation = \"matrx\"", "4:15", "did you mean 'matrix'?"},
    {"[method]\nlocate = \"linear\"", "4:10", "expected one of: polynomial, interpolation, subdivision"},
    {"[[obstacle]]\nname = \"o\"", "3:1", "lacks the key 'shape'"},
    {"[[obstacle]]\nname = \"o\"\nshape = \"plane\"\npoint = [0,0,0]", "3:1", "lacks the key 'normal'"},
    {"[[obstacle]]\nname = \"o\"\nshape = \"plane\"\nradius = 1", "6:1",
     "unknown key 'radius' in [[obstacle]] of shape plane"},
    {"[[obstacle]]\nname = \"o\"\nshape = \"mesh\"", "3:1", "lacks the key 'file'"},
    {"[[obstacle]]\nname = \"o\"\nshape = \"cilinder\"", "5:9", "did you mean 'cylinder'?"},
    {"[[obstacle]]\nname = \"o\"\nshape = \"cone\"\ncenter = [0,0,0]\nradius = 1", "3:1", "lacks the key 'height'"},
    {"[[obstacle]]\nname = \"o\"\nshape = \"ellipsoid\"\ncenter = [0,0,0]\nradius = 1", "7:1",
     "unknown key 'radius' in [[obstacle]] of shape ellipsoid; did you mean 'radii'?"},
    {"[[obstacle]]\nname = \"o\"\nshape = \"cone\"\ncenter = [0,0,0]\nradius = 1\nheight = 1\ninside = true", "9:1",
     "unknown key 'inside' in [[obstacle]] of shape cone"},
    {"[[obstacle]]\nname = \"o\"\nshape = \"sphere\"\ncenter = [0,0,0]\nradius = 1\ninside = 1", "8:10",
     "true or false expected"},
    {"[[obstacle]]\nname = \"o\"\nshape = \"plane\"\npoint = [0,0,0]\nnormal = [0,0,1]\norientation = {}", "8:1",
     "unknown key 'orientation'"},
    {"[[obstacle]]\nname = \"o\"\nshape = \"box\"\ncenter = [0,0,0]\nsize = [1,1,1]\ninside = true\nrounding = 0.1",
     "9:12", "the inside of a shape is not rounded"},
    {"[[obstacle]]\nname = \"o\"\nshape = \"terrain\"", "3:1", "lacks the key 'height'"},
    {"[[obstacle]]\nname = \"o\"\nshape = \"compound\"\nparts = []", "6:9", "an array of tables expected"},
    {"[[obstacle]]\nname = \"o\"\nshape = \"compound\"\nparts = [{shape = \"cub\"}]", "6:19", "expected one of"},
    {"[[obstacle]]\nname = \"o\"\nshape = \"compound\"\nparts = [{shape = \"box\", size = [1,1,1], mass = 1}]", "6:42",
     "unknown key 'mass' in a part of shape box"},
    {"[[body]]\nname = \"b\"\nshape = \"cone\"\nradius = 1", "3:1", "lacks the key 'height'"},
    {"[[body]]\nname = \"b\"\nshape = \"compound\"", "3:1", "lacks the key 'parts'"},
    {"[[body]]\nname = \"b\"\nshape = \"ellipsoid\"\nradii = [1, 2]", "6:9", "got 2 elements"},
    {"[[body]]\nname = \"b\"\n[[obstacle]]\nname = \"o\"\nshape = \"plane\"\npoint = [0,0,0]\nnormal = "
     "[0,0,1]\nfriction = -1",
     "10:12", "friction of obstacle 'o'"},
    {"[[body]]\nname = \"b\"\n[[obstacle]]\nname = \"o\"\nshape = \"plane\"\npoint = [0,0,0]\nnormal = "
     "[0,0,1]\nrolling_friction = \"1 s\"",
     "10:23", "length"},
    {"[[obstacle]]\nname = \"o\"\nshape = \"plane\"\npoint = [0,0,0]\nnormal = [0,0,1]\nimpact = \"newtn\"", "8:10",
     "did you mean 'newton'?"},
    {"[[obstacle]]\nname=\"o\"\nshape=\"sphere\"\ncenter=[0,0,0]\nradius=1\non_hit = \"stik\"", "8:10",
     "did you mean 'stick'?"},
    {"[[obstacle]]\nname=\"o\"\nshape=\"box\"\ncenter=[0,0,0]\nsize=[1,1,1]\norientation = {}", "8:15", "one of"},
    // types
    {"title = 3\n[time]\nend = 1", "1:9", "a string expected, got a number"},
    {"[[body]]\nname = 3", "4:8", "a string expected"},
    {"[[body]]\nname = \"b\"\nposition = 3", "5:12", "a vector expected"},
    {"[[body]]\nname = \"b\"\nposition = [1, 2]", "5:12", "got 2 elements"},
    {"[[body]]\nname = \"b\"\nposition = [1, 2, true]", "5:19", "got a boolean"},
    {"[[body]]\nname = \"b\"\nposition = [1, 2, [3]]", "5:19", "got an array"},
    {"[[body]]\nname = \"b\"\nposition = \"5 m\"", "5:12",
     "error: a vector expected (an array of three or a vector expression), got a scalar quantity"},
    {"[parameters]\na = 1979-05-27", "4:5", "got a date"},
    {"[[event]]\nname = \"e\"\nwhen = 1\naction = \"set\"", "3:1", "lacks the key 'set'"},
    {"[[event]]\nname = \"e\"\nwhen = 1\naction = \"stop\"\nset = {}", "7:7", "does not go with"},
    {"\xef\xbb\xbftitle = 3\n[time]\nend = 1", "1:9", "a string expected"},
    // numbers and units
    {"[parameters]\na = nan", "4:5", "a finite number expected"},
    {"[parameters]\na = -inf", "4:5", "a finite number expected"},
    {"[parameters]\na = \"1e999 m\"", "4:6", "too large"},
    {"[parameters]\na = \"1e999\"", "4:6", "range"},
    {"[parameters]\na = \"5 parrots\"", "4:8", "unknown unit 'parrots'"},
    {"[parameters]\na = \"5 degC\"", "4:8", "no multiple of an SI unit"},
    {"[parameters]\na = \"500m/s\"", "4:9", "write \"500 m/s\""},
    {"[method]\nstep = \"5 m\"", "4:11", "time [s] expected, got length [m]"},
    {"[[body]]\nname = \"b\"\nposition = [\"1 km\", 0, \"2 m/s\"]", "5:27", "length [m] expected, got speed [m/s]"},
    {"[[body]]\nname = \"b\"\nvelocity = [\"1 deg\", 0, 0]", "5:16", "speed [m/s] expected, got angle [rad]"},
    // expressions: the column is that of the character inside the string
    {"[[body]]\nname = \"b\"\nvelocity = \"[1, 0, 2 +]\"", "5:23", "error"},
    {"[[body]]\nname = \"b\"\nvelocity = [0, 0, \"coz(1)\"]", "5:20", "did you mean 'cos'?"},
    {"[[body]]\nname = \"b\"\nvelocity = '''[1,\n 0, coz(1)]'''", "6:5", "did you mean 'cos'?"},
    {"[[body]]\nname = \"b\"\nvelocity = \"\"\"\n[1,\n 0, coz(1)]\"\"\"", "7:5", "did you mean 'cos'?"},
    {"[[body]]\nname = \"b\"\nvelocity = \"[1,\\t0, coz(1)]\"", "5:21", "did you mean 'cos'?"},
    {"[[body]]\nname = \"b\"\nvelocity = \"[1,\\n0, coz(1)]\"", "5:21", "did you mean 'cos'?"},
    {"[[body]]\nname = \"b\"\nvelocity = \"[1,\\u0020\\U00000020 0, coz(1)]\"", "5:36", "did you mean 'cos'?"},
    {"[[body]]\nname = \"b\"\nvelocity = \"[\\u00b1, coz(1)]\"", "5:14", "not allowed"},
    {"[[body]]\nname = \"b\"\nvelocity = \"\"\"\r\n[1,\r\n 0, \\\n   coz(1)]\"\"\"", "8:4", "did you mean 'cos'?"},
    {"[parameters]\na = \"5 \\u0070arrots\"", "4:8", "unknown unit 'parrots'"},
    {"[\"\u00e9\"]\n[[body]]", "3:2", "unknown key"},
    {"[parameters]\n\"\u00d7\" = 1", "4:1", "is no name"},
    {"[parameters]\na = [\"\u00b1\", \"coz(1)\", 1]", "4:7", "not allowed"},
    {"[parameters]\na = [1, \"1 \u00b0\", \"coz(1)\"]", "4:18",
     "did you mean 'cos'?"},  // columns count bytes: ° has two
    // names
    {"[parameters]\npi = 3", "4:1", "reserved"},
    {"[parameters]\nt = 3", "4:1", "reserved"},
    {"[parameters]\nsin = 3", "4:1", "reserved"},
    {"[parameters]\nvx = 3\n[[body]]\nname = \"b\"", "4:1", "reserved"},
    {"[[body]]\nname = \"2b\"", "4:8", "is no name"},
    {"[[body]]\nname = \"\"", "4:8", "is no name"},
    {"[[body]]\nname = \"b\"\n[[body]]\nname = \"b\"", "6:8", "already that of the body in line 4"},
    {"[parameters]\nb = 1\n[[body]]\nname = \"b\"", "6:8", "already that of the parameter in line 4"},
    {"[[body]]\nname = \"b\"\n[[obstacle]]\nname = \"b\"\nshape = \"sphere\"\ncenter = [0,0,0]\nradius = 1", "6:8",
     "already that of the body in line 4"},
    {"[[body]]\nname = \"b\"\n[[event]]\nname = \"e\"\nwhen = 1\n[[event]]\nname = \"e\"\nwhen = 1", "9:8", "already"},
    {"[[body]]\nname = \"b\"\n[exact]\nc.r = 1", "6:3", "neither an extra state nor a part of a body"},
    {"[[body]]\nname = \"b\"\n[exact]\nb.x = 1", "6:3", "neither an extra state nor a part of a body"},
    {"[[body]]\nname = \"b\"\n[exact]\nb.q = 1", "6:3", "did you mean 'b.r'?"},
    {"[[body]]\nname = \"b\"\n[exact]\nb.orientatio = 1", "6:3", "did you mean 'b.orientation'?"},
    {"[[body]]\nname = \"b\"\n[exact]\nb.qw = 1\nb.qy = 0", "6:3", "four parts: b.qw, qx, qy, qz expected, got 2"},
    {"[[body]]\nname = \"b\"\n[exact]\nb.orientation = {axis = [0, 0, 1]}", "6:17", "lacks the key 'angle'"},
    {"[[body]]\nname = \"b\"\n[exact]\nc.orientation = {quaternion = [1, 0, 0, 0]}", "6:3",
     "neither an extra state nor a part of a body"},
    {"[[body]]\nname = \"b\"\n[[event]]\nname = \"e\"\nwhen = 1\nset = {mas = 1}", "8:8", "neither an extra state"},
    {"[[body]]\nname = \"b\"\n[[event]]\nname = \"e\"\nwhen = 1\nset = {b.v = 1}\naction = {set = {b.v = 2}}", "8:7",
     "'set' stands beside another one"},
    {"[[state]]\nname = \"m\"\nvalue = 1", "3:1", "[[state]] lacks the key 'rate'"},
    // nothing to do
    {"", "1:1", "nothing moves"},
    {"# just a comment \n", "1:1", "nothing moves"},
};

std::string message_of(const std::string& text) {
  try {
    make_world(parse_scene(text, "s.toml"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SceneErrors, PointAtTheFaultAndSayWhatWasExpected) {
  for (const BadScene& bad : kBadScenes) {
    const std::string text = bad.text;
    const bool has_time = text.find("[time]") != std::string::npos;
    const std::string message = message_of((has_time ? "" : "[time]\nend = 1\n") + text);
    EXPECT_TRUE(message.starts_with("s.toml:" + std::string(bad.place))) << message << "\n  for:\n" << bad.text;
    EXPECT_NE(message.find(": error: "), std::string::npos) << message;
    EXPECT_NE(message.find(bad.words), std::string::npos) << message << "\n  for:\n" << bad.text;
  }
}

// Wrong numbers of scenes that are well formed. A text without [time] as above.
const BadScene kBadNumbers[] = {
    {"[[body]]\nname = \"b\"\nforce = [0,0,1]\nmass = \"1 - 1\"", "6:9", "mass of body 'b' must be positive"},
    {"[[body]]\nname = \"b\"\nforce = [0,0,1]\nmass = -1", "6:8", "mass of body 'b' must be positive"},
    {"[[body]]\nname = \"b\"\nforce = [0,0,1]\nmass = \"m\"\n[[state]]\nname = \"m\"\nvalue = -1\nrate = 1", "6:9",
     "mass of body 'b' must be positive"},
    {"[[body]]\nname = \"b\"\ninertia = [1, 2, -1]", "5:12", "inertia of body 'b' belongs to no body"},
    {"[[body]]\nname = \"b\"\ninertia = [[1,1,0],[0,1,0],[0,0,1]]", "5:13", "not symmetric"},
    {"[method]\nname = \"rk4\"\nstep = 1\norder = 3\n[[body]]\nname = \"b\"", "6:9", "has an order of its own"},
    {"[[body]]\nname = \"b\"\nacceleration = \"[0,\\n0, vxx]\"", "5:25", "unknown name 'vxx'"},
    {"[time]\nend = 1\nsample = 1e-13\n[[body]]\nname = \"b\"", "3:10", "more than 1e12 samples"},
    {"[[body]]\nname = \"b\"\n[[obstacle]]\nname = \"o\"\nshape = \"plane\"\npoint = [0,0,0]\nnormal = [0,0,0]", "9:11",
     "normal of obstacle 'o' must not be zero"},
    {"[[body]]\nname = \"b\"\n[[obstacle]]\nname = \"o\"\nshape = \"sphere\"\ncenter = [0,0,0]\nradius = 1", "4:8",
     "starts inside obstacle 'o'"},
    {"[[body]]\nname = \"b\"\nshape = \"sphere\"\nradius = 0.2\n[[obstacle]]\nname = \"o\"\nshape = \"disk\"\n"
     "center = [0.1,0,0]\nnormal = [1,0,0]\nradius = 1",
     "4:8", "starts inside obstacle 'o'"},
    {"[[body]]\nname = \"b\"\n[[obstacle]]\nname = \"o\"\nshape = \"sphere\"\ncenter = [5,0,0]\nradius = 1\n"
     "on_hit = \"bounce\"\nrestitution = 1.0000001",
     "11:15", "must lie between 0 and 1, got 1.0000001"},
    {"[[body]]\nname = \"b\"\n[[obstacle]]\nname = \"o\"\nshape = \"sphere\"\ncenter = [5,0,0]\nradius = 1\n"
     "on_hit = \"bounce\"\nrestitution = \"0.9 - 0.1*w\"",
     "11:26", "unknown name 'w'"},
    {"[parameters]\nu = 0.5\n[[body]]\nname = \"b\"\n[[obstacle]]\nname = \"o\"\nshape = \"sphere\"\n"
     "center = [5,0,0]\nradius = 1\non_hit = \"bounce\"\nrestitution = \"u\"",
     "13:16", "`u` is the speed of approach: call the parameter otherwise"},
    {"[parameters]\nk = \"0.1 kg\"\n[[body]]\nname = \"b\"\n[[obstacle]]\nname = \"o\"\nshape = \"sphere\"\n"
     "center = [5,0,0]\nradius = 1\non_hit = \"bounce\"\nrestitution = \"0.9 - k*u\"",
     "13:16", "number without unit [1] expected, got momentum [kg m/s]"},
    {"[[body]]\nname = \"b\"\nshape = \"ellipsoid\"\nradii = [1, 0, 1]", "6:10", "radii of body 'b' must be positive"},
    {"[[body]]\nname = \"b\"\nshape = \"box\"\nsize = [1,1,1]\nrounding = 0.6", "4:8",
     "body 'b': the rounding leaves nothing of the shape"},
    {"[[body]]\nname = \"b\"\nrounding = 0.6", "4:8", "a point cannot be rounded"},
    {"[[body]]\nname = \"b\"\nshape = \"compound\"\nmass = 1\nforce = [0,0,0]\n"
     "parts = [{shape = \"sphere\", radius = 1, mass = 1}]",
     "6:8", "the parts of body 'b' have their masses"},
    {"[[body]]\nname = \"b\"\nshape = \"compound\"\n"
     "parts = [{shape = \"sphere\", radius = 1, mass = 1}, {shape = \"sphere\", radius = 1}]",
     "6:10", "either all parts of body 'b' have a mass or density, or none has"},
    {"[[body]]\nname = \"b\"\nshape = \"sphere\"\nradius = 0.3\n[[obstacle]]\nname = \"o\"\nshape = \"ellipsoid\"\n"
     "center = [0,0,0]\nradii = [2,1,0.5]\ninside = true",
     "4:8", "the ball is too large for the inside, whose walls are met by balls of a radius below 0.125 m only"},
    {"[[body]]\nname = \"b\"\nshape = \"sphere\"\nradius = 0.3\n[[obstacle]]\nname = \"o\"\nshape = "
     "\"terrain\"\nheight = \"x - 5\"",
     "4:8", "a terrain is met by points only"},
    {"[[body]]\nname = \"b\"\n[[obstacle]]\nname = \"o\"\nshape = \"terrain\"\nheight = \"x + zz\"", "8:15",
     "unknown name 'zz'"},
    {"[[body]]\nname = \"b\"\n[[obstacle]]\nname = \"o\"\nshape = \"terrain\"\nheight = \"x + 3\"", "4:8",
     "starts inside obstacle 'o'"},
    {"[method]\nstep = \"-1e-9 s\"\n[[body]]\nname = \"b\"", "4:9", "must be positive, got -1e-09"},
    {"[time]\nstart = -1e308\nend = 1e308\n[[body]]\nname = \"b\"", "3:7", "too far apart"},
};

TEST(SceneErrors, AnOrientationMadeInCppMustBeComplete) {
  Scene scene = parse_scene("[time]\nend = 1\n[[body]]\nname = \"b\"", "s.toml");
  for (const int count : {1, 3, 5}) {
    scene.bodies[0].orientation.quaternion.assign(static_cast<std::size_t>(count), Expression(0.5));
    EXPECT_THROW(make_world(scene), InputError) << count;
  }
  scene.bodies[0].orientation.quaternion.assign(4, Expression(0.5));
  EXPECT_NO_THROW(make_world(scene));
  scene.bodies[0].orientation.quaternion.clear();
  scene.bodies[0].orientation.axis = Expression("[0, 0, 1]");
  EXPECT_THROW(make_world(scene), InputError);
}

TEST(SceneErrors, TheShortestRunHasSamples) {
  const RunResult result = run(parse_scene("[time]\nend = 1e-322\n[[body]]\nname = \"b\"", "s.toml"));
  EXPECT_EQ(result.status, RunStatus::finished) << result.failure;
  EXPECT_EQ(result.end_time, 1e-322);
}

TEST(SceneErrors, NumbersPointAtTheFaultToo) {
  for (const BadScene& bad : kBadNumbers) {
    const std::string text = bad.text;
    const Scene scene = parse_scene((text.starts_with("[time]") ? "" : "[time]\nend = 1\n") + text, "s.toml");
    try {
      make_world(scene);
      ADD_FAILURE() << "no error for:\n" << bad.text;
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with("s.toml:" + std::string(bad.place) + ": error: ")) << message << bad.text;
      EXPECT_NE(message.find(bad.words), std::string::npos) << message << "\n  for:\n" << bad.text;
    }
  }
}

TEST(SceneErrors, MissingTimeIsNamed) {
  EXPECT_EQ(message_of(""), "s.toml:1:1: error: the scene lacks the table [time] with the key 'end'");
  EXPECT_EQ(message_of("\n[time]\nstart = 1"), "s.toml:2:1: error: [time] lacks the key 'end'");
}

TEST(SceneErrors, DeepNestingIsRefused) {
  EXPECT_NE(message_of("a = " + std::string(100000, '[')).find("error"), std::string::npos);
  EXPECT_NE(message_of("[time]\nend = \"" + std::string(100000, '(') + "\"").find("error"), std::string::npos);
}

}  // namespace
}  // namespace trajet
