#include "bindings.hpp"

PYBIND11_MODULE(_core, module) {
  module.doc() = "The part of trajet that is written in C++; see the package `trajet`.";
  trajet::python::bind_motions(module);
  trajet::python::bind_integrator(module);
  trajet::python::bind_ensembles(module);
}
