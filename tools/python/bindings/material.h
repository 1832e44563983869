// Responses of single surfaces for Python.
#pragma once

#include <pybind11/pybind11.h>

namespace malus::python {

void addMaterial(pybind11::module_& module);

}  // namespace malus::python
