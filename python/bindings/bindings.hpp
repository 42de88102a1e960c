#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

namespace trajet::python {

namespace py = pybind11;

// What each source adds to the module `trajet._core`. The package's Python files make of it what users see.
void bind_motions(py::module_& module);
void bind_integrator(py::module_& module);
void bind_ensembles(py::module_& module);

}  // namespace trajet::python
