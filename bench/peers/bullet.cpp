#include <btBulletDynamicsCommon.h>

#include <memory>

#include "../boxes.hpp"
#include "../work_precision.hpp"

/// The tumbling box by Bullet, in double precision, with its implicit gyroscopic term.
namespace trajet::bench {
namespace {

btVector3 bullet_vector(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

double tumble(double step) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, 0));
  btBoxShape shape(bullet_vector(0.5 * Boxes::size()));
  btRigidBody body(
      btRigidBody::btRigidBodyConstructionInfo(Boxes::kMass, nullptr, &shape, bullet_vector(Boxes::inertia())));
  body.setDamping(0, 0);
  body.setActivationState(DISABLE_DEACTIVATION);
  body.setFlags(body.getFlags() | BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY);
  body.setLinearVelocity(bullet_vector(Boxes::velocity()));
  body.setAngularVelocity(bullet_vector(Boxes::angular_velocity()));
  world.addRigidBody(&body);
  const int steps = static_cast<int>(std::lround(Boxes::kDuration / step));
  for (int i = 0; i < steps; ++i) world.stepSimulation(step, 0);
  const btQuaternion q = body.getOrientation();
  const btVector3 w = body.getAngularVelocity();
  world.removeRigidBody(&body);
  return Boxes::drift(Quaternion(q.w(), q.x(), q.y(), q.z()), Vector3(w.x(), w.y(), w.z()));
}

}  // namespace

void add_bullet() {
  for (const double step : {1e-2, 1e-3, 1e-4})
    add_case({Boxes::kName, Contender::bullet, labelled("step", step)}, [step] { return tumble(step); });
}

}  // namespace trajet::bench
