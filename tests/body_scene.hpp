#pragma once

// Scenes of balls in rooms, for the tests of bodies that meet.

#include <string>

#include "scene_run.hpp"
#include "trajet/math/vector.hpp"

namespace trajet::test {

struct BallOf {
  std::string name;
  double radius = 0.0;
  double mass = 1.0;
  Vector3 position = Vector3::Zero();
  Vector3 velocity = Vector3::Zero();
  std::string more{};

  std::string text() const {
    return "[[body]]\nname = \"" + name + "\"\n" +
           (radius > 0.0 ? "shape = \"sphere\"\nradius = " + number(radius) + "\n" : std::string()) +
           "mass = " + number(mass) + "\nposition = " + vector(position) + "\nvelocity = " + vector(velocity) + "\n" +
           more;
  }
};

inline std::string plane(const std::string& name, const Vector3& point, const Vector3& normal,
                         double restitution = 1.0) {
  return "[[obstacle]]\nname = \"" + name + "\"\nshape = \"plane\"\npoint = " + vector(point) +
         "\nnormal = " + vector(normal) + "\non_hit = \"bounce\"\nrestitution = " + number(restitution) + "\n";
}

inline std::string room(double size) {
  const Vector3 zero = Vector3::Zero(), far = Vector3::Constant(size);
  std::string text;
  for (int i = 0; i < 3; ++i) {
    text += plane("low" + std::to_string(i), zero, Vector3::Unit(i));
    text += plane("high" + std::to_string(i), far, -Vector3::Unit(i));
  }
  return text;
}

}  // namespace trajet::test
