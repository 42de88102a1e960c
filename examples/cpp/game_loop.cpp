// A loop of 60 frames a second knows of each impact before it happens, and plays its sound at the exact time.
#include <cstdio>

#include "trajet/trajet.hpp"

int main() {
  trajet::BodyDefinition ball;
  ball.name = "ball";
  ball.position = trajet::Vector3(0, 0, 2);
  ball.velocity = trajet::Vector3(3, 0, 0);
  ball.acceleration = "[0, 0, -9.81]";

  trajet::Scene scene;
  scene.time.end = 2.0;
  scene.bodies = {ball};
  scene.obstacles = {{.name = "ground",
                      .shape = trajet::PlaneShape{.normal = trajet::Vector3(0, 0, 1)},
                      .on_hit = trajet::OnHit::bounce,
                      .restitution = 0.8}};
  const trajet::Motion motion = trajet::compute_motion(scene);

  std::size_t next = 0;  // impact
  for (int frame = 0; frame < 120; ++frame) {
    const double now = frame / 60.0, then = (frame + 1) / 60.0;
    for (; next < motion.impacts().size() && motion.impacts()[next].time < then; ++next)
      std::printf("frame %d, height %.6f m: sound in %.6f ms\n", frame, motion.position("ball", now).z(),
                  1e3 * (motion.impacts()[next].time - now));
  }
}
