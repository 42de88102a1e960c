#include "published_checks.hpp"

#include <vector>

namespace trajet {

namespace {

/// [[state]] tables of a system that runs from 0 to `end`.
struct StateText {
  const char* name;
  const char* value;
  const char* rate;
};

std::string states(const char* end, const std::vector<StateText>& all) {
  std::string text = std::string("[time]\nend = ") + end + "\n[method]\nrtol = 1e-14\natol = 1e-15\n";
  for (const StateText& state : all)
    text += std::string("[[state]]\nname = \"") + state.name + "\"\nvalue = " + state.value + "\nrate = \"" +
            state.rate + "\"\n";
  return text;
}

/// A body that falls on the ground and bounces.
std::string bouncing(const char* end, const char* g, const char* position, const char* velocity,
                     const char* restitution) {
  return std::string("[time]\nend = ") + end + "\n[[body]]\nname = \"ball\"\nposition = " + position +
         "\nvelocity = " + velocity + "\nacceleration = [0, 0, -" + g +
         "]\n[[obstacle]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"
         "on_hit = \"bounce\"\nrestitution = " +
         restitution + "\n";
}

const char* const kDrag =
    "[time]\nend = 10\nsample = 1\n[[body]]\nname = \"particle\"\nvelocity = [1, 1, 1]\n"
    "acceleration = [\"-vx^2/2\", \"-vy^2\", \"-vz^2/3\"]\n[exact]\n"
    "particle.r = [\"2*log(1 + t/2)\", \"log(1 + t)\", \"3*log(1 + t/3)\"]\n"
    "particle.v = [\"2/(2 + t)\", \"1/(1 + t)\", \"3/(3 + t)\"]\n";

/// The acceleration t along z for ten seconds, by the course's first formula with that step.
std::string growing(const char* step) {
  return std::string("[time]\nend = 10\n[method]\nname = \"difference-linear\"\nstep = ") + step +
         "\n[[body]]\nname = \"particle\"\nposition = [0, 0, 1]\nvelocity = [2, 1, 0]\nacceleration = [0, 0, \"t\"]\n";
}

/// Two bodies, reduced: r'' = -r/|r|^3 from the pericentre of an ellipse of eccentricity e.
std::string kepler(const char* x, const char* vy) {
  return std::string(
             "[time]\nend = 20\n[method]\nrtol = 1e-14\natol = 1e-15\n[[body]]\nname = \"moon\"\nposition = [") +
         x + ", 0, 0]\nvelocity = [0, \"" + vy + "\", 0]\nacceleration = \"-r/norm(r)^3\"\n";
}

/// Arenstorf's orbit in the rotating frame of earth and moon.
std::string arenstorf() {
  const std::string mu = "0.012277471", rest = "0.987722529";
  const std::string d1 = "((X + " + mu + ")^2 + Y^2)^1.5", d2 = "((X - " + rest + ")^2 + Y^2)^1.5";
  const std::string ax = "X + 2*V - " + rest + "*(X + " + mu + ")/" + d1 + " - " + mu + "*(X - " + rest + ")/" + d2;
  const std::string ay = "Y - 2*U - " + rest + "*Y/" + d1 + " - " + mu + "*Y/" + d2;
  return states("17.0652165601579625588917206249", {{"X", "0.994", "U"},
                                                    {"Y", "0", "V"},
                                                    {"U", "0", ax.c_str()},
                                                    {"V", "-2.00158510637908252240537862224", ay.c_str()}});
}

}  // namespace

std::span<const PublishedCheck> published_checks() {
  constexpr const char* kCourse = "PHS4700, its code repaired";
  constexpr const char* kDetest = "DETEST (Hull, Enright, Fellen, Sedgwick 1972)";
  constexpr const char* kBallode = "MATLAB, ballode";
  constexpr const char* kNasa = "NASA TM-2015-218675, case 2";
  static const std::string b1 = states("20", {{"Y1", "1", "2*(Y1 - Y1*Y2)"}, {"Y2", "3", "-(Y2 - Y1*Y2)"}});
  static const std::string b5 = states("20", {{"Y1", "0", "Y2*Y3"}, {"Y2", "1", "-Y1*Y3"}, {"Y3", "1", "-0.51*Y1*Y2"}});
  static const std::string d1 = kepler("0.9", "sqrt(1.1/0.9)"), d3 = kepler("0.5", "sqrt(1.5/0.5)");
  static const std::string e1 = states(
      "20",
      {{"Y1", "0.6713967071418030", "Y2"}, {"Y2", "0.09540051444747446", "-(Y2/(t + 1) + (1 - 0.25/(t + 1)^2)*Y1)"}});
  static const std::string e3 = states("20", {{"Y1", "0", "Y2"}, {"Y2", "0", "Y1^3/6 - Y1 + 2*sin(2.78535*t)"}});
  // principal moments in slug ft^2, of which only ratios matter; rates in deg/s
  static const std::string brick =
      states("30", {{"P", "\"10*pi/180\"", "(0.006211019 - 0.007194665)/0.001894220*Q*S"},
                    {"Q", "\"20*pi/180\"", "(0.007194665 - 0.001894220)/0.006211019*S*P"},
                    {"S", "\"30*pi/180\"", "(0.001894220 - 0.006211019)/0.007194665*P*Q"}});
  static const std::string ballode = bouncing("45", "9.8", "[0, 0, 0]", "[0, 0, 20]", "0.9");
  constexpr double kDegree = 0.017453292519943295;  // rad
  static const std::vector<PublishedCheck> checks = {
      {kCourse, "drag in 3-D", kDrag, "nodes euler 10", 1.39789527279837, 5e-15},
      {kCourse, "drag in 3-D", kDrag, "nodes euler 40", 0.0702641221366347, 5e-15},
      {kCourse, "drag in 3-D", kDrag, "nodes rk4 10", 0.0542477931734899, 5e-15},
      {kCourse, "drag in 3-D", kDrag, "nodes rk4 40", 7.53983131197348e-5, 5e-15},
      {"PHS4700, first formula repaired", "a = (0, 0, t)", growing("2"), "final particle.z", 171.0, 1e-12},
      {"PHS4700, first formula repaired", "a = (0, 0, t)", growing("0.5"), "final particle.z", 167.875, 1e-12},
      {kDetest, "A1", states("20", {{"Y", "1", "-Y"}}), "final Y", 2.061153353012535e-9, 1e-15},
      {kDetest, "A2", states("20", {{"Y", "1", "-Y^3/2"}}), "final Y", 2.182178902359887e-1, 1e-12},
      {kDetest, "A3", states("20", {{"Y", "1", "Y*cos(t)"}}), "final Y", 2.491650271850414, 1e-12},
      {kDetest, "B1", b1, "final Y1", 6.761876008576667e-1, 1e-11},
      {kDetest, "B1", b1, "final Y2", 1.860816099640036e-1, 1e-11},
      {kDetest, "B5", b5, "final Y1", -9.396570798729192e-1, 1e-12},
      {kDetest, "B5", b5, "final Y2", -3.421177754000779e-1, 1e-12},
      {kDetest, "B5", b5, "final Y3", 7.414126596199957e-1, 1e-12},
      {kDetest, "D1", d1, "final moon.x", 2.198835352008397e-1, 1e-11},
      {kDetest, "D1", d1, "final moon.y", 9.427076846341813e-1, 1e-11},
      {kDetest, "D3", d3, "final moon.x", -5.780432953035361e-1, 1e-11},
      {kDetest, "D3", d3, "final moon.y", 8.633840009194193e-1, 1e-11},
      {kDetest, "E1", e1, "final Y1", 1.456723600728308e-1, 1e-12},
      {kDetest, "E1", e1, "final Y2", -9.883500195574063e-2, 1e-12},
      {kDetest, "E3", e3, "final Y1", -1.004178858647128e-1, 1e-11},
      {kDetest, "E3", e3, "final Y2", 2.411400132095954e-1, 1e-11},
      // the orbit passes the moon so near that errors grow a millionfold
      {"Hairer, Norsett, Wanner 1993", "Arenstorf's orbit", arenstorf(), "final X", 0.994, 1e-9},
      // the last digit is not the solution's: integrating with 25 digits gives 12.6183907759144 deg/s for P
      {kNasa, "tumbling brick", brick, "final P", 12.6183907757 * kDegree, 1e-11},
      {kNasa, "tumbling brick", brick, "final Q", -17.3974747619 * kDegree, 1e-11},
      {kNasa, "tumbling brick", brick, "final S", 31.1195888868 * kDegree, 1e-11},
      {"A ball dropped from 1 m, g = 9.81", "e = 0.7", bouncing("3", "9.81", "[0, 0, 1]", "[0, 0, 0]", "0.7"),
       "impact 1", 0.451523640985731, 1e-15},
      {"A ball dropped from 1 m, g = 9.81", "e = 0.7", bouncing("3", "9.81", "[0, 0, 1]", "[0, 0, 0]", "0.7"), "rest",
       2.55863396558581, 1e-8},
      {"A ball dropped from 1 m, g = 9.81", "e = 0.9", bouncing("9", "9.81", "[0, 0, 1]", "[0, 0, 0]", "0.9"), "rest",
       8.57894917872889, 1e-8},
      {kBallode, "v = 20, e = 0.9", ballode, "impact 1", 4.08163265, 5e-9},
      {kBallode, "v = 20, e = 0.9", ballode, "impact 2", 7.75510204, 5e-9},
      {kBallode, "v = 20, e = 0.9", ballode, "impact 3", 11.06122449, 5e-9},
      {kBallode, "v = 20, e = 0.9", ballode, "rest", 40.81632653, 1e-7},
  };
  return checks;
}

}  // namespace trajet
