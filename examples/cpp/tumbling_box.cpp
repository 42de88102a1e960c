// A box tumbles, and a torque that dies away speeds it up about its longest axis.
#include <cstdio>

#include "trajet/trajet.hpp"

int main() {
  trajet::BodyDefinition box;
  box.name = "box";
  box.shape = trajet::CuboidShape{trajet::Vector3(0.1, 0.4, 0.9)};
  box.mass = 10.0;
  box.angular_velocity = trajet::Vector3(0.1, 5, 0.1);
  box.torque_body = "[0, 0, 0.5*exp(-t)]";

  trajet::Scene scene;
  scene.time.end = 4.0;
  scene.bodies = {box};

  const trajet::Motion motion = trajet::compute_motion(scene);
  for (int t = 0; t <= 4; ++t) {
    const trajet::Quaternion q = motion.orientation("box", t);
    const trajet::Vector3 w = motion.angular_velocity("box", t);
    std::printf("%d s: q = %+.6f %+.6f %+.6f %+.6f, w = %+.6f %+.6f %+.6f rad/s\n", t, q.w(), q.x(), q.y(), q.z(),
                w.x(), w.y(), w.z());
  }
}
