// A ball with air drag bounces three times.
#include <cstdio>

#include "trajet/trajet.hpp"

int main() {
  trajet::BodyDefinition ball;
  ball.name = "ball";
  ball.shape = trajet::BallShape{0.11};
  ball.position = trajet::Vector3(0, 0, 1);
  ball.velocity = trajet::Vector3(12, 0, 6);
  ball.acceleration = "[0, 0, -9.81] - 0.01*norm(v)*v";

  trajet::Scene scene;
  scene.time.end = 3.2;
  scene.bodies = {ball};
  scene.obstacles = {{.name = "ground",
                      .shape = trajet::PlaneShape{.normal = trajet::Vector3(0, 0, 1)},
                      .on_hit = trajet::OnHit::bounce,
                      .restitution = 0.7}};

  for (const trajet::Impact& impact : trajet::compute_motion(scene).impacts())
    std::printf("%.9f s: at x = %.6f m with %.6f m/s\n", impact.time, impact.point.x(), -impact.velocity_before.z());
}
