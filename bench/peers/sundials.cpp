#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <memory>

#include "../problem_set.hpp"
#include "../work_precision.hpp"

/// SUNDIALS as Debian builds it, about three times slower than one tuned for the machine: ARKODE's explicit methods of
/// orders 5 and 8, CVODE's Adams methods.
namespace trajet::bench {
namespace {

constexpr long kMaxSteps = 100'000;

template <class Problem>
int law(double t, N_Vector q, N_Vector dq, void*) {
  double* rate = NV_DATA_S(dq);
  Problem{}(t, NV_DATA_S(q), rate);
  return 0;
}

/// What every solver needs, released at the end.
template <class Problem>
struct Work {
  Work() {
    SUNContext_Create(nullptr, &context);
    q = N_VNew_Serial(Problem::kDimension, context);
    set_start();
  }
  ~Work() {
    if (fixed_point != nullptr) SUNNonlinSolFree(fixed_point);
    if (arkode != nullptr) ERKStepFree(&arkode);
    if (cvode != nullptr) CVodeFree(&cvode);
    N_VDestroy(q);
    SUNContext_Free(&context);
  }
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  void set_start() { Eigen::Map<typename Problem::State>(NV_DATA_S(q)) = Problem::start(); }

  SUNContext context = nullptr;
  N_Vector q = nullptr;
  void* arkode = nullptr;
  void* cvode = nullptr;
  SUNNonlinearSolver fixed_point = nullptr;
};

template <class Problem>
void add_arkode(const char* name, ARKODE_ERKTableID table, double tolerance) {
  auto work = std::make_shared<Work<Problem>>();
  work->arkode = ERKStepCreate(law<Problem>, Problem::start_time(), work->q, work->context);
  ERKStepSetTableNum(work->arkode, table);
  ERKStepSStolerances(work->arkode, tolerance, tolerance);
  ERKStepSetMaxNumSteps(work->arkode, kMaxSteps);
  ERKStepSetErrHandlerFn(
      work->arkode, [](int, const char*, const char*, char*, void*) {}, nullptr);
  add_case({Benchmark<Problem>::kName, Contender::sundials, labelled(name, tolerance)}, [work] {
    work->set_start();
    ERKStepReInit(work->arkode, law<Problem>, Problem::start_time(), work->q);
    ERKStepSetInitStep(work->arkode, kFirstStep);
    ERKStepSetStopTime(work->arkode, Problem::end_time());
    double t = Problem::start_time();
    const int status = ERKStepEvolve(work->arkode, Problem::end_time(), work->q, &t, ARK_NORMAL);
    return status >= 0 ? error_at_end<Problem>(NV_DATA_S(work->q)) : kFailed;
  });
}

template <class Problem>
void add_adams(double tolerance) {
  auto work = std::make_shared<Work<Problem>>();
  work->cvode = CVodeCreate(CV_ADAMS, work->context);
  CVodeInit(work->cvode, law<Problem>, Problem::start_time(), work->q);
  CVodeSStolerances(work->cvode, tolerance, tolerance);
  CVodeSetMaxNumSteps(work->cvode, kMaxSteps);
  CVodeSetErrHandlerFn(
      work->cvode, [](int, const char*, const char*, char*, void*) {}, nullptr);
  work->fixed_point = SUNNonlinSol_FixedPoint(work->q, 0, work->context);
  CVodeSetNonlinearSolver(work->cvode, work->fixed_point);
  add_case({Benchmark<Problem>::kName, Contender::sundials, labelled("adams", tolerance)}, [work] {
    work->set_start();
    CVodeReInit(work->cvode, Problem::start_time(), work->q);
    CVodeSetStopTime(work->cvode, Problem::end_time());
    double t = Problem::start_time();
    const int status = CVode(work->cvode, Problem::end_time(), work->q, &t, CV_NORMAL);
    return status >= 0 ? error_at_end<Problem>(NV_DATA_S(work->q)) : kFailed;
  });
}

template <class Problem>
void add_problem() {
  for (const double tolerance : kTolerances) {
    add_arkode<Problem>("ark-fehl8", ARKODE_FEHLBERG_13_7_8, tolerance);
    if (tolerance >= 1e-8) add_arkode<Problem>("ark-dp5", ARKODE_DORMAND_PRINCE_7_4_5, tolerance);
    add_adams<Problem>(tolerance);
  }
}

}  // namespace

void add_sundials() {
  for_each_problem([]<class Problem>() { add_problem<Problem>(); });
}

}  // namespace trajet::bench
