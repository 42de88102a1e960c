#include <ode/ode.h>

#include "../boxes.hpp"
#include "../work_precision.hpp"

/// The tumbling box by the Open Dynamics Engine, with its gyroscopic term.
namespace trajet::bench {
namespace {

double tumble(double step) {
  const dWorldID world = dWorldCreate();
  dWorldSetGravity(world, 0, 0, 0);
  const dBodyID body = dBodyCreate(world);
  dMass mass;
  const Vector3 size = Boxes::size(), v = Boxes::velocity(), w_start = Boxes::angular_velocity();
  dMassSetBoxTotal(&mass, Boxes::kMass, size.x(), size.y(), size.z());
  dBodySetMass(body, &mass);
  dBodySetGyroscopicMode(body, 1);
  dBodySetLinearVel(body, v.x(), v.y(), v.z());
  dBodySetAngularVel(body, w_start.x(), w_start.y(), w_start.z());
  const int steps = static_cast<int>(std::lround(Boxes::kDuration / step));
  for (int i = 0; i < steps; ++i) dWorldStep(world, step);
  const dReal* q = dBodyGetQuaternion(body);
  const dReal* w = dBodyGetAngularVel(body);
  const double error = Boxes::drift(Quaternion(q[0], q[1], q[2], q[3]), Vector3(w[0], w[1], w[2]));
  dWorldDestroy(world);
  return error;
}

}  // namespace

void add_ode() {
  dInitODE();
  for (const double step : {1e-2, 1e-3, 1e-4})
    add_case({Boxes::kName, Contender::ode, labelled("step", step)}, [step] { return tumble(step); });
}

}  // namespace trajet::bench
