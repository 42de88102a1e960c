#include "trajet/ode/registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "methods/steppers.hpp"
#include "problems/drag.hpp"
#include "trajet/ode/differentiable_law.hpp"

namespace trajet {
namespace {

using problems::Drag;

/// The drag as what a scene compiles to. Its power series comes from the law itself.
class DragSystem final : public System {
 public:
  int dimension() const override { return Drag::kDimension; }
  void rate(double t, const double* q, double* dq) const override {
    Eigen::Map<Drag::State> rate(dq);
    Drag()(t, Eigen::Map<const Drag::State>(q), rate);
  }
  void jacobian(double t, const double* q, double* dg_dq, double* dg_dt) const override {
    Eigen::Matrix<double, 6, 6> derivatives;
    Drag::State time_derivative;
    law_.jacobian(t, Drag::State(Eigen::Map<const Drag::State>(q)), derivatives, time_derivative);
    Eigen::Map<Eigen::Matrix<double, 6, 6>>{dg_dq} = derivatives;
    Eigen::Map<Drag::State>{dg_dt} = time_derivative;
  }
  void expand(double t, const double* q, int order, double* coefficients) override {
    expansion_.expand(t, Drag::State(Eigen::Map<const Drag::State>(q)), order, coefficients);
  }
  double duration_until_branch(double duration) override { return expansion_.duration_until_branch(duration); }
  int polynomial_degree() const override { return -1; }

 private:
  DifferentiableLaw<Drag, Drag::kDimension> law_{Drag()};
  LawExpansion<Drag, Drag::kDimension> expansion_{Drag(), Drag::kDimension};
};

class EveryMethod : public testing::TestWithParam<MethodInfo> {};
INSTANTIATE_TEST_SUITE_P(Registry, EveryMethod, testing::ValuesIn(methods().begin(), methods().end()),
                         [](const auto& method) {
                           std::string name(method.param.name);
                           std::ranges::replace(name, '-', '_');  // as GoogleTest wants names
                           return name;
                         });

/// Largest error of the drag's end state.
double end_error(const MethodInfo& method, double tolerance, double step) {
  DragSystem system;
  StepOptions options;
  options.rtol = options.atol = tolerance;
  if (method.control == StepControl::fixed) options.step = step;
  const auto stepper = method.make(system, options);
  EXPECT_EQ(integrate(*stepper, 0.0, Drag::start(), 10.0).status, IntegrationStatus::finished);
  return (stepper->state() - Drag::exact(10.0)).cwiseAbs().maxCoeff();
}

TEST_P(EveryMethod, ConvergesAsItsEntrySays) {
  const MethodInfo& method = GetParam();
  if (method.control == StepControl::fixed) {
    const double step = method.order > 4 ? 0.25 : 0.02;  // errors far above rounding
    const double order = std::log2(end_error(method, 0.0, step) / end_error(method, 0.0, step / 2));
    EXPECT_NEAR(order, method.order, 0.2);
  } else {
    // The errors of the steps add up. A method of low order takes many, and the multistep methods, which know their
    // order only from the tolerance, keep them longer: measured 310 times the tolerance.
    const bool low_order = method.order == 2;
    const bool one_step = method.order > 2 || method.name == "taylor";
    const double tight = low_order ? 1e-8 : 1e-13;
    EXPECT_LT(end_error(method, tight, 0.0), (one_step ? 2.0 : 1000.0) * tight);
    EXPECT_LT(end_error(method, 1e-3, 0.0), 1e-2);
  }
}

TEST_P(EveryMethod, WritesSegmentsThatTheStateIsOn) {
  DragSystem system;
  StepOptions options;
  options.step = 0.1;
  const auto stepper = GetParam().make(system, options);
  Segment<> segment;
  double time = 0.0;
  integrate(*stepper, 0.0, Drag::start(), 2.0, kDefaultMaxSteps, [&](AnyStepper& s) {
    s.fill_segment(segment);
    EXPECT_EQ(segment.t0(), time);
    EXPECT_EQ(segment.t1(), s.time());
    EXPECT_LE((segment.state(s.time()) - s.state()).cwiseAbs().maxCoeff(), 2e-15);
    EXPECT_TRUE((segment.error_bound().array() >= 0.0).all());
    time = s.time();
  });
  EXPECT_EQ(time, 2.0);
}

TEST_P(EveryMethod, RefusesToWorkWithoutAStepOnlyIfItNeedsOne) {
  DragSystem system;
  if (GetParam().control == StepControl::fixed) {
    EXPECT_THROW(GetParam().make(system, {}), std::invalid_argument);
  } else {
    EXPECT_NO_THROW(GetParam().make(system, {}));
  }
}

}  // namespace
}  // namespace trajet
