// A rocket burns its fuel in 4 s and flies on to its apex, where the run stops.
#include <cstdio>

#include "trajet/trajet.hpp"

int main() {
  trajet::BodyDefinition rocket;
  rocket.name = "rocket";
  rocket.mass = "m";
  rocket.force = "[0, 0, where(t < burning, thrust, 0) - m*9.81] - 0.002*norm(v)*v";

  trajet::Scene scene;
  scene.parameters = {{"burning", 4.0}, {"thrust", 600.0}};
  scene.time.end = 100.0;
  scene.bodies = {rocket};
  scene.states = {{.name = "m", .value = 20.0, .rate = "where(t < burning, -2, 0)"}};
  scene.events = {{.name = "apex",
                   .when = "rocket.vz",
                   .direction = trajet::CrossingDirection::falling,
                   .action = trajet::EventAction::stop}};

  const trajet::Motion motion = trajet::compute_motion(scene);
  const double end = motion.end_time();
  std::printf("burnt out at %.6f m with %.6f m/s\n", motion.position("rocket", 4).z(),
              motion.velocity("rocket", 4).z());
  std::printf("apex after %.9f s at %.6f m, mass %.6f kg\n", end, motion.position("rocket", end).z(),
              motion.value("m", end));
}
