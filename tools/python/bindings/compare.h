// `malus compare` for Python.
#pragma once

#include <pybind11/pybind11.h>

namespace malus::python {

void addCompare(pybind11::module_& module);

}  // namespace malus::python
