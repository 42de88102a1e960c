#include "trajet/ode/cvode.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

#include "trajet/ode/step_control.hpp"

namespace trajet::detail {
namespace {

/// Frees what SUNDIALS has made.
struct Release {
  void operator()(_SUNContext* context) const { SUNContext_Free(&context); }
  void operator()(_generic_N_Vector* vector) const { N_VDestroy(vector); }
  void operator()(_generic_SUNMatrix* matrix) const { SUNMatDestroy(matrix); }
  void operator()(_generic_SUNLinearSolver* solver) const { SUNLinSolFree(solver); }
  void operator()(_generic_SUNNonlinearSolver* solver) const { SUNNonlinSolFree(solver); }
  void operator()(void* memory) const { CVodeFree(&memory); }
};
template <class T>
using Owned = std::unique_ptr<T, Release>;

template <class T>
T* made(T* pointer) {
  if (pointer == nullptr) throw std::bad_alloc();
  return pointer;
}

_SUNContext* make_context() {
  SUNContext context = nullptr;
  SUNContext_Create(nullptr, &context);
  return made(context);
}

/// These settings fail only where the arguments are wrong.
void check([[maybe_unused]] int flag) { assert(flag == CV_SUCCESS); }

bool all_finite(const double* values, std::size_t count) {
  return std::all_of(values, values + count, [](double x) { return std::isfinite(x); });
}

constexpr int kRecoverable = 1;  // CVODE then tries a shorter step
// Failures in one step that CVODE bears: the shortest step is to end it, not their count.
constexpr int kMaxFailures = 100;

}  // namespace

class Cvode::Solver {
 public:
  Solver(MultistepFormula formula, int dimension, std::unique_ptr<CvodeProblem> problem, const StepOptions& options)
      : problem_(std::move(problem)),
        options_(options),
        size_(static_cast<std::size_t>(dimension)),
        context_(make_context()),
        state_(made(N_VNew_Serial(dimension, context_.get()))),
        start_state_(made(N_VNew_Serial(dimension, context_.get()))),
        scratch_(made(N_VNew_Serial(dimension, context_.get()))),
        memory_(made(CVodeCreate(formula == MultistepFormula::adams ? CV_ADAMS : CV_BDF, context_.get()))) {
    void* cvode = memory_.get();
    N_VConst(0.0, state_.get());
    check(CVodeSetErrHandlerFn(
        cvode, [](int, const char*, const char*, char*, void*) {}, nullptr));
    check(CVodeInit(cvode, evaluate_rate, 0.0, state_.get()));
    check(CVodeSetUserData(cvode, this));
    check(CVodeWFtolerances(cvode, evaluate_weights));
    check(CVodeSetMaxErrTestFails(cvode, kMaxFailures));
    check(CVodeSetMaxConvFails(cvode, kMaxFailures));
    if (formula == MultistepFormula::adams) {
      iteration_.reset(made(SUNNonlinSol_FixedPoint(state_.get(), 0, context_.get())));
      check(CVodeSetNonlinearSolver(cvode, iteration_.get()));
    } else {
      matrix_.reset(made(SUNDenseMatrix(dimension, dimension, context_.get())));
      linear_.reset(made(SUNLinSol_Dense(state_.get(), matrix_.get(), context_.get())));
      check(CVodeSetLinearSolver(cvode, linear_.get(), matrix_.get()));
      check(CVodeSetJacFn(cvode, evaluate_jacobian));
    }
  }

  void start(double t, const double* q) {
    time_ = step_start_ = t;
    std::copy_n(q, size_, data(state_));
    std::copy_n(q, size_, data(start_state_));
    direction_ = 0.0;
  }

  StepStatus advance(double t_limit) {
    assert(t_limit != time_);
    void* cvode = memory_.get();
    const double distance = t_limit - time_;
    const double direction = std::copysign(1.0, distance);
    if (direction != direction_) begin(direction, std::abs(distance));
    limit_steps();
    check(CVodeSetStopTime(cvode, t_limit));
    met_not_finite_ = false;
    double t = time_;
    const int flag = CVode(cvode, t_limit, scratch_.get(), &t, CV_ONE_STEP);
    count_rejections();
    if (flag < 0 || t == time_) {
      direction_ = 0.0;  // CVODE's own state may have gone on: the next attempt begins anew from this one
      return met_not_finite_ ? StepStatus::not_finite : StepStatus::step_too_small;
    }
    step_start_ = time_;
    std::swap(start_state_, state_);
    std::swap(state_, scratch_);
    time_ = flag == CV_TSTOP_RETURN ? t_limit : t;
    ++statistics_.steps;
    return StepStatus::ok;
  }

  double time() const { return time_; }
  double step_start() const { return step_start_; }
  const double* state() const { return data(state_); }
  const double* start_state() const { return data(start_state_); }
  const StepStatistics& statistics() const { return statistics_; }

  int order() const {
    int order = 1;
    check(CVodeGetLastOrder(memory_.get(), &order));
    return order;
  }
  void derivative(int k, double* values) const {
    check(CVodeGetDky(memory_.get(), step_start_, k, scratch_.get()));
    std::copy_n(data(scratch_), size_, values);
  }
  void error_estimate(double* values) const {
    check(CVodeGetEstLocalErrors(memory_.get(), scratch_.get()));
    std::copy_n(data(scratch_), size_, values);
  }

 private:
  static double* data(const Owned<_generic_N_Vector>& vector) { return N_VGetArrayPointer(vector.get()); }

  /// Forgets the past: order 1 from the current state on.
  void begin(double direction, double distance) {
    void* cvode = memory_.get();
    rejected_before_ = statistics_.rejected_steps;
    check(CVodeReInit(cvode, time_, state_.get()));
    // CVODE finds a first step of its own, unless the limit is too near for it.
    const bool is_near = distance < 1e3 * std::numeric_limits<double>::epsilon() * std::abs(time_);
    const double first = options_.step.value_or(0.0);  // 0: CVODE's own
    check(CVodeSetInitStep(cvode, direction * (is_near ? distance : std::min(first, distance))));
    direction_ = direction;
  }

  void limit_steps() {
    void* cvode = memory_.get();
    const double smallest = smallest_step(time_);
    // CVODE minds that its limits do not cross on the way
    check(CVodeSetMinStep(cvode, 0.0));
    if (std::isfinite(options_.max_step)) check(CVodeSetMaxStep(cvode, std::max(options_.max_step, smallest)));
    check(CVodeSetMinStep(cvode, smallest));
  }

  void count_rejections() {
    long missed = 0, unsolved = 0;
    check(CVodeGetNumErrTestFails(memory_.get(), &missed));
    check(CVodeGetNumStepSolveFails(memory_.get(), &unsolved));
    statistics_.rejected_steps = rejected_before_ + missed + unsolved;
  }

  static int evaluate_rate(double t, N_Vector q, N_Vector dq, void* data) {
    auto& self = *static_cast<Solver*>(data);
    ++self.statistics_.law_evaluations;
    double* rate = N_VGetArrayPointer(dq);
    self.problem_->rate(t, N_VGetArrayPointer(q), rate);
    return self.judge(all_finite(rate, self.size_));
  }
  /// sqrt(1/n sum (e_i w_i)^2) <= 1 with w_i = sqrt n / (atol + rtol |q_i|) bounds every |e_i| by atol + rtol |q_i|.
  static int evaluate_weights(N_Vector q, N_Vector weights, void* data) {
    const auto& self = *static_cast<Solver*>(data);
    const double root = std::sqrt(std::max(1.0, static_cast<double>(self.size_)));
    for (std::size_t i = 0; i < self.size_; ++i) {
      const double tolerance = absolute_tolerance(self.options_, static_cast<Eigen::Index>(i)) +
                               self.options_.rtol * std::abs(N_VGetArrayPointer(q)[i]);
      N_VGetArrayPointer(weights)[i] = 1.0 / std::max(tolerance / root, std::numeric_limits<double>::min());
    }
    return 0;
  }
  static int evaluate_jacobian(double t, N_Vector q, N_Vector, SUNMatrix jacobian, void* data, N_Vector, N_Vector,
                               N_Vector) {
    auto& self = *static_cast<Solver*>(data);
    ++self.statistics_.law_evaluations;
    double* values = SUNDenseMatrix_Data(jacobian);
    self.problem_->jacobian(t, N_VGetArrayPointer(q), values);
    return self.judge(all_finite(values, self.size_ * self.size_));
  }
  int judge(bool is_finite) {
    if (is_finite) return 0;
    met_not_finite_ = true;
    return kRecoverable;
  }

  std::unique_ptr<CvodeProblem> problem_;
  StepOptions options_;
  std::size_t size_;
  StepStatistics statistics_;
  long rejected_before_ = 0;  // this start
  double time_ = 0.0;
  double step_start_ = 0.0;
  double direction_ = 0.0;  // of time; 0: CVODE has to begin anew
  bool met_not_finite_ = false;
  // The order of destruction matters: the context last.
  Owned<_SUNContext> context_;
  Owned<_generic_N_Vector> state_, start_state_, scratch_;
  Owned<_generic_SUNMatrix> matrix_;
  Owned<_generic_SUNLinearSolver> linear_;
  Owned<_generic_SUNNonlinearSolver> iteration_;
  Owned<void> memory_;
};

Cvode::Cvode(MultistepFormula formula, int dimension, std::unique_ptr<CvodeProblem> problem,
             const StepOptions& options) {
  check_step_control(options);
  solver_ = std::make_unique<Solver>(formula, dimension, std::move(problem), options);
}
Cvode::Cvode(Cvode&&) noexcept = default;
Cvode& Cvode::operator=(Cvode&&) noexcept = default;
Cvode::~Cvode() = default;

void Cvode::start(double t, const double* q) { solver_->start(t, q); }
StepStatus Cvode::advance(double t_limit) { return solver_->advance(t_limit); }
double Cvode::time() const { return solver_->time(); }
const double* Cvode::state() const { return solver_->state(); }
const StepStatistics& Cvode::statistics() const { return solver_->statistics(); }
double Cvode::step_start() const { return solver_->step_start(); }
const double* Cvode::start_state() const { return solver_->start_state(); }
int Cvode::order() const { return solver_->order(); }
void Cvode::derivative(int k, double* values) const { solver_->derivative(k, values); }
void Cvode::error_estimate(double* values) const { solver_->error_estimate(values); }

}  // namespace trajet::detail
