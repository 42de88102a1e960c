#include "trajet/ode/registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <string>
#include <utility>

#include "methods/steppers.hpp"
#include "problems/drag.hpp"
#include "problems/driven.hpp"
#include "problems/lotka_volterra.hpp"
#include "trajet/ode/differentiable_law.hpp"

namespace trajet {
namespace {

/// A named problem as what a scene compiles to. Its power series comes from the law itself.
template <class Problem>
class ProblemSystem final : public System {
 public:
  using State = typename Problem::State;

  int dimension() const override { return Problem::kDimension; }
  void rate(double t, const double* q, double* dq) override {
    Eigen::Map<State> rate(dq);
    Problem()(t, Eigen::Map<const State>(q), rate);
  }
  void jacobian(double t, const double* q, double* dg_dq, double* dg_dt) override {
    Eigen::Matrix<double, Problem::kDimension, Problem::kDimension> derivatives;
    State time_derivative;
    law_.jacobian(t, State(Eigen::Map<const State>(q)), derivatives, time_derivative);
    Eigen::Map<decltype(derivatives)>{dg_dq} = derivatives;
    Eigen::Map<State>{dg_dt} = time_derivative;
  }
  void expand(double t, const double* q, int order, double* coefficients) override {
    expansion_.expand(t, State(Eigen::Map<const State>(q)), order, coefficients);
  }
  void expand(double t, const long double* q, int order, long double* coefficients) override {
    using NumberState = typename decltype(extended_)::NumberState;
    extended_.expand(t, NumberState(Eigen::Map<const NumberState>(q)), order, coefficients);
  }
  double duration_until_branch(double duration) override { return duration; }  // the problems have no branches
  int polynomial_degree() const override { return -1; }
  Structure structure() const override { return structure_of(Problem(), Problem::kDimension); }

 private:
  DifferentiableLaw<Problem, Problem::kDimension> law_{Problem()};
  LawExpansion<Problem, Problem::kDimension> expansion_{Problem(), Problem::kDimension};
  LawExpansion<Problem, Problem::kDimension, long double> extended_{Problem(), Problem::kDimension};
};

/// Calls f with a problem that the method can solve: the drag, or, for methods that refuse it, an acceleration of time.
template <class F>
auto with_suitable_problem(const MethodInfo& method, F&& f) {
  using problems::Drag, problems::Driven;
  const bool takes_drag =
      method.find_unsuitable == nullptr || !method.find_unsuitable(structure_of(Drag(), Drag::kDimension));
  return takes_drag ? f(Drag()) : f(Driven());
}

class EveryMethod : public testing::TestWithParam<MethodInfo> {};
INSTANTIATE_TEST_SUITE_P(Registry, EveryMethod, testing::ValuesIn(methods().begin(), methods().end()),
                         [](const auto& method) {
                           std::string name(method.param.name);
                           for (char& c : name)
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           return name;
                         });

/// Largest error of the end state.
double end_error(const MethodInfo& method, double tolerance, double step) {
  return with_suitable_problem(method, [&]<class Problem>(Problem) {
    ProblemSystem<Problem> system;
    StepOptions options;
    options.rtol = options.atol = tolerance;
    if (method.needs_step()) options.step = step;
    const auto stepper = method.make(system, options);
    EXPECT_EQ(integrate(*stepper, 0.0, Problem::start(), 10.0).status, IntegrationStatus::finished);
    return (stepper->state() - Problem::exact(10.0)).cwiseAbs().maxCoeff();
  });
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
    EXPECT_LT(end_error(method, tight, 0.1), (one_step ? 5.0 : 1000.0) * tight);
    EXPECT_LT(end_error(method, 1e-3, 0.1), 1e-2);
  }
}

TEST_P(EveryMethod, WritesSegmentsThatTheStateIsOn) {
  with_suitable_problem(GetParam(), []<class Problem>(Problem) {
    ProblemSystem<Problem> system;
    StepOptions options;
    options.step = 0.1;
    const auto stepper = GetParam().make(system, options);
    Segment<> segment;
    double time = 0.0;
    integrate(*stepper, 0.0, Problem::start(), 2.0, kDefaultMaxSteps, [&](AnyStepper& s) {
      s.fill_segment(segment);
      EXPECT_EQ(segment.t0(), time);
      EXPECT_EQ(segment.t1(), s.time());
      EXPECT_LE((segment.state(s.time()) - s.state()).cwiseAbs().maxCoeff(), 2e-15);
      EXPECT_TRUE((segment.error_bound().array() >= 0.0).all());
      time = s.time();
    });
    EXPECT_EQ(time, 2.0);
  });
}

TEST_P(EveryMethod, RefusesToWorkWithoutAStepOnlyIfItNeedsOne) {
  with_suitable_problem(GetParam(), []<class Problem>(Problem) {
    ProblemSystem<Problem> system;
    if (GetParam().needs_step()) {
      EXPECT_THROW(GetParam().make(system, {}), std::invalid_argument);
    } else {
      EXPECT_NO_THROW(GetParam().make(system, {}));
    }
  });
}

TEST_P(EveryMethod, RefusesTolerancesAndOrdersThatItCannotKeep) {
  with_suitable_problem(GetParam(), []<class Problem>(Problem) {
    ProblemSystem<Problem> system;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (GetParam().control == StepControl::adaptive) {
      for (const auto& [rtol, atol] : {std::pair(0.0, 0.0), {-1.0, 2.0}, {1e-6, -1.0}, {nan, 1e-6}, {1e-6, nan}})
        EXPECT_THROW(GetParam().make(system, {.rtol = rtol, .atol = atol}), std::invalid_argument)
            << rtol << " " << atol;
      EXPECT_NO_THROW(GetParam().make(system, {.rtol = 0.0, .atol = 1e-6}));
    }
    if (GetParam().max_order > 0) {
      StepOptions options;
      options.step = 0.1;
      options.order = GetParam().max_order;
      EXPECT_NO_THROW(GetParam().make(system, options));
      ++options.order;
      EXPECT_THROW(GetParam().make(system, options), std::invalid_argument);
    }
  });
}

TEST_P(EveryMethod, RefusesALawOrSaysWhyBeforehand) {
  // predator and prey: neither of time alone nor of two halves
  ProblemSystem<problems::LotkaVolterra> system;
  StepOptions options;
  options.step = 0.1;
  const auto unsuitable = GetParam().find_unsuitable;
  if (unsuitable != nullptr && unsuitable(system.structure())) {
    EXPECT_THROW(GetParam().make(system, options), std::invalid_argument);
  } else {
    EXPECT_NO_THROW(GetParam().make(system, options));
  }
}

}  // namespace
}  // namespace trajet
