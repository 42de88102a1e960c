#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "trajet/ode/registry.hpp"

namespace trajet::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// A function of Python's as the problem dy/dt = f(t, y): it has values and no derivatives.
///
/// Exceptions do not pass through methods, of which some are written in C: what the function raises is kept, and from
/// then on the law is not a number, which no method goes on with.
class FunctionSystem : public System {
 public:
  FunctionSystem(py::function function, int dimension) : function_(std::move(function)), dimension_(dimension) {}

  int dimension() const override { return dimension_; }

  void rate(double t, const double* q, double* dq) override {
    if (!error_) keep_error([&] { call(t, q, dq); });
    if (error_) fill(dq, dimension_);
  }

  void jacobian(double, const double*, double* dg_dq, double* dg_dt) override {
    lack_derivatives();
    fill(dg_dq, dimension_ * dimension_);
    fill(dg_dt, dimension_);
  }
  void expand(double, const double*, int order, double* coefficients) override {
    lack_derivatives();
    fill(coefficients, dimension_ * (order + 1));
  }
  void expand(double, const Extended*, int order, Extended* coefficients) override {
    lack_derivatives();
    fill(coefficients, dimension_ * (order + 1));
  }

  double duration_until_branch(double duration) override { return duration; }
  int polynomial_degree() const override { return -1; }
  /// What a function depends on cannot be seen: on all.
  Structure structure() const override {
    Structure structure;
    structure.rates.resize(static_cast<std::size_t>(dimension_));
    for (Structure::Rate& rate : structure.rates) {
      rate.uses.resize(static_cast<std::size_t>(dimension_));
      std::iota(rate.uses.begin(), rate.uses.end(), 0);
    }
    return structure;
  }

  /// Whether a method has asked for derivatives.
  bool lacks_derivatives() const { return lacks_derivatives_; }
  /// Raises what the function has raised.
  void raise() {
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  }

 private:
  void call(double t, const double* q, double* dq) {
    py::array_t<double> y(dimension_, q);  // the function may keep it
    const Numbers answer = Numbers::ensure(function_(t, y));
    if (!answer) throw py::error_already_set();
    if (answer.size() != dimension_)
      throw py::value_error("`fun` gives " + std::to_string(answer.size()) + " numbers for a state of " +
                            std::to_string(dimension_));
    std::copy_n(answer.data(), dimension_, dq);
  }

  template <class Step>
  void keep_error(const Step& step) {
    try {
      step();
    } catch (...) {
      error_ = std::current_exception();
    }
  }

  void lack_derivatives() { lacks_derivatives_ = true; }

  template <class T>
  static void fill(T* values, int count) {
    std::fill_n(values, count, std::numeric_limits<T>::quiet_NaN());
  }

  py::function function_;
  int dimension_;
  std::exception_ptr error_;
  bool lacks_derivatives_ = false;
};

const MethodInfo& method_named(const std::string& name) {
  if (const MethodInfo* method = find_method(name)) return *method;
  std::string text = "unknown method '" + name + "'";
  if (const MethodInfo* near = find_nearest_method(name))
    text += "; the nearest one is '" + std::string(near->name) + "'";
  throw py::value_error(text + "; trajet.methods() lists all");
}

/// One solution on its way, step by step.
class Integrator {
 public:
  Integrator(py::function function, const std::vector<double>& start, double t0, const std::string& method, double rtol,
             const std::vector<double>& atol, std::optional<double> step, double max_step)
      : method_(method_named(method)), system_(std::move(function), static_cast<int>(start.size())) {
    StepOptions options;
    options.rtol = rtol;
    options.atol = atol.front();
    if (atol.size() > 1) options.component_atol = std::make_shared<const std::vector<double>>(atol);
    options.step = step;
    options.max_step = max_step;
    if (method_.needs_step() && !step)
      throw py::value_error("the method '" + std::string(method_.name) +
                            "' takes fixed steps: `first_step` is missing");
    if (method_.find_unsuitable != nullptr)
      if (const auto unsuitable = method_.find_unsuitable(system_.structure()))
        throw py::value_error("the method '" + std::string(method_.name) +
                              "' needs to see what `fun` depends on, which a "
                              "Python function does not show: give formulas, or another method");
    stepper_ = method_.make(system_, options);
    stepper_->start(t0, Eigen::Map<const Eigen::VectorXd>(start.data(), static_cast<Eigen::Index>(start.size())));
    raise_errors();
  }

  /// One step towards `t_end`; "" or why there is none.
  std::string advance(double t_end) {
    const StepStatus status = stepper_->advance(t_end);
    raise_errors();
    switch (status) {
      case StepStatus::ok:
        break;
      case StepStatus::step_too_small:
        return "Required step size is less than spacing between numbers.";
      case StepStatus::not_finite:
        return "`fun` is infinite or not a number, and no smaller step helps.";
    }
    stepper_->fill_segment(segment_);
    raise_errors();
    return {};
  }

  double time() const { return stepper_->time(); }
  const Eigen::VectorXd& state() const { return stepper_->state(); }
  long evaluations() const { return stepper_->statistics().law_evaluations; }
  std::string method() const { return std::string(method_.name); }

  /// The last step: where its polynomials begin, and their coefficients.  // (dimension x degree+1)
  std::pair<double, py::array_t<double>> segment() const {
    const auto& coefficients = segment_.coefficients();
    py::array_t<double> copy({coefficients.rows(), coefficients.cols()});
    for (Eigen::Index i = 0; i < coefficients.rows(); ++i)
      for (Eigen::Index k = 0; k < coefficients.cols(); ++k) copy.mutable_at(i, k) = coefficients(i, k);
    return {segment_.t0(), copy};
  }

 private:
  void raise_errors() {
    system_.raise();
    if (system_.lacks_derivatives())
      throw py::value_error("the method '" + std::string(method_.name) +
                            "' needs derivatives of `fun`, which a Python function does not have: give formulas, or a "
                            "method that works with values alone, such as dop853, dopri5, bs32 or adams");
  }

  const MethodInfo& method_;
  FunctionSystem system_;
  std::unique_ptr<AnyStepper> stepper_;
  Segment<> segment_;
};

const char* word(StepControl control) {
  switch (control) {
    case StepControl::fixed:
      return "fixed";
    case StepControl::adaptive:
      return "adaptive";
    case StepControl::subdivided:
      break;
  }
  return "subdivided";
}

py::list method_table() {
  py::list table;
  for (const MethodInfo& method : methods()) {
    py::list aliases;
    for (const std::string_view alias : method.aliases) aliases.append(std::string(alias));
    table.append(py::make_tuple(std::string(method.name), py::tuple(aliases), method.order, method.dense_order,
                                word(method.control), std::string(method.known_as), std::string(method.summary)));
  }
  return table;
}

}  // namespace

void bind_integrator(py::module_& module) {
  py::class_<Integrator>(module, "Integrator")
      .def(py::init<py::function, const std::vector<double>&, double, const std::string&, double,
                    const std::vector<double>&, std::optional<double>, double>())
      .def("advance", &Integrator::advance)
      .def_property_readonly("t", &Integrator::time)
      .def_property_readonly(
          "y", [](const Integrator& i) { return py::array_t<double>(i.state().size(), i.state().data()); })
      .def_property_readonly("nfev", &Integrator::evaluations)
      .def_property_readonly("method", &Integrator::method)
      .def("segment", &Integrator::segment);
  module.def("methods", &method_table);
}

}  // namespace trajet::python
