#include "boxes.hpp"

#include <memory>

#include "trajet/io/scene_file.hpp"
#include "trajet/ode/solve.hpp"
#include "trajet/sim/run.hpp"
#include "work_precision.hpp"

/// The tumbling box by trajet. The error is that of its energy or angular momentum, see Boxes::drift.
namespace trajet::bench {
namespace {

using State = Eigen::Matrix<double, 13, 1>;

template <class Method>
void add_law(const char* method, double tolerance) {
  const StepOptions options{.rtol = tolerance, .atol = tolerance};
  using Stepper = decltype(Method::template make_stepper<13>(FreeBox{}, 13, options));
  auto stepper = std::make_shared<Stepper>(Method::template make_stepper<13>(FreeBox{}, 13, options));
  State start;
  start << 0, 0, 0, Boxes::velocity(), 1, 0, 0, 0, Boxes::angular_velocity();
  add_case({Boxes::kName, Contender::law, labelled(method, tolerance)}, [stepper, start] {
    const auto result = integrate(*stepper, 0.0, start, Boxes::kDuration);
    if (result.status != IntegrationStatus::finished) return kFailed;
    const State& q = stepper->state();
    const Quaternion q_WB(q[6], q[7], q[8], q[9]);
    return Boxes::drift(q_WB, rotate<double>(q_WB.normalized(), q.tail<3>()));
  });
}

/// The whole run of a scene that is read already, its orientation carried as a scene's is by default.
void add_scene(const char* method, double tolerance) {
  const std::string text =
      "[time]\nend = 10\n[[body]]\nname = \"box\"\nshape = \"box\"\nsize = [0.1, 0.4, 0.9]\nmass = 10\n"
      "position = [0, 0, 0]\nvelocity = [-2, 2, 8]\nangular_velocity = [0.1, 5, 0.1]\n[method]\nname = \"" +
      std::string(method) + "\"\nrtol = " + std::to_string(tolerance * 1e15) + "e-15\natol = 1e-15\n";
  const auto scene = std::make_shared<Scene>(parse_scene(text, Boxes::kName));
  add_case({Boxes::kName, Contender::scene, labelled(method, tolerance)}, [scene] {
    const RunResult result = run(*scene);
    const BodyState& box = result.final.bodies.front();
    return Boxes::drift(box.orientation, box.angular_velocity);
  });
}

}  // namespace

void add_boxes() {
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14}) {
    add_law<Taylor>("taylor", tolerance);
    add_law<Dop853>("dop853", tolerance);
    add_scene("taylor", tolerance);
    add_scene("dop853", tolerance);
  }
}

}  // namespace trajet::bench
