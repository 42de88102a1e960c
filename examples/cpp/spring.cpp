// Two bodies with a spring between them: they swing about their centre of mass, which moves on.
#include <cstdio>

#include "trajet/trajet.hpp"

int main() {
  trajet::BodyDefinition left, right;
  left.name = "left";
  left.mass = 1.0;
  left.force = "k*(norm(right.r - r) - 1)*unit(right.r - r)";
  right.name = "right";
  right.mass = 3.0;
  right.position = trajet::Vector3(1.5, 0, 0);
  right.velocity = trajet::Vector3(0, 0.4, 0);
  right.force = "k*(norm(left.r - r) - 1)*unit(left.r - r)";

  trajet::Scene scene;
  scene.parameters = {{"k", 20.0}};
  scene.time.end = 2.0;
  scene.bodies = {left, right};

  const trajet::Motion motion = trajet::compute_motion(scene);
  for (const double t : {0.0, 0.5, 1.0, 1.5, 2.0}) {
    const trajet::Vector3 a = motion.position("left", t), b = motion.position("right", t);
    std::printf("%.1f s: length %.9f m, centre at y = %.9f m\n", t, (b - a).norm(), (a + 3 * b).y() / 4);
  }
}
