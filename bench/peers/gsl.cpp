#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <memory>

#include "../problem_set.hpp"
#include "../work_precision.hpp"

/// The GNU Scientific Library, as Debian builds it: the law is called through a pointer.
namespace trajet::bench {
namespace {

template <class Problem>
int law(double t, const double q[], double dq[], void*) {
  Problem{}(t, q, dq);
  return GSL_SUCCESS;
}

template <class Problem>
struct Driver {
  Driver(const gsl_odeiv2_step_type* method, double tolerance)
      : driver(gsl_odeiv2_driver_alloc_y_new(&system, method, kFirstStep, tolerance, tolerance)) {}
  ~Driver() { gsl_odeiv2_driver_free(driver); }
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;

  gsl_odeiv2_system system{law<Problem>, nullptr, static_cast<std::size_t>(Problem::kDimension), nullptr};
  gsl_odeiv2_driver* driver;
};

template <class Problem>
void add_method(const char* name, const gsl_odeiv2_step_type* method, double tolerance) {
  auto driver = std::make_shared<Driver<Problem>>(method, tolerance);
  add_case({Benchmark<Problem>::kName, Contender::gsl, labelled(name, tolerance)}, [driver] {
    gsl_odeiv2_driver_reset_hstart(driver->driver, kFirstStep);
    typename Problem::State q = Problem::start();
    double t = Problem::start_time();
    const int status = gsl_odeiv2_driver_apply(driver->driver, &t, Problem::end_time(), q.data());
    return status == GSL_SUCCESS ? error_at_end<Problem>(q) : kFailed;
  });
}

template <class Problem>
void add_problem() {
  for (const double tolerance : kTolerances) {
    add_method<Problem>("rk8pd", gsl_odeiv2_step_rk8pd, tolerance);
    add_method<Problem>("msadams", gsl_odeiv2_step_msadams, tolerance);
  }
}

}  // namespace

void add_gsl() {
  gsl_set_error_handler_off();  // a tolerance that cannot be met is no reason to end the benchmark
  for_each_problem([]<class Problem>() { add_problem<Problem>(); });
}

}  // namespace trajet::bench
