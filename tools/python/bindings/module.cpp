// The Python module malus._malus; malus/__init__.py is its public face.
#include <dlfcn.h>

#include <filesystem>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <CLI/CLI.hpp>

#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "meshprep/base/program_folder.h"
#include "render/scene/methods.h"
#include "tools/python/bindings/compare.h"
#include "tools/python/bindings/image.h"
#include "tools/python/bindings/material.h"
#include "tools/python/bindings/scene.h"

namespace py = pybind11;

namespace {
const int kHere = 0;  // an address in this file of the module
}

PYBIND11_MODULE(_malus, module) {
  py::register_exception<malus::Error>(module, "Error", PyExc_ValueError);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const malus::Interrupted&) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    } catch (const CLI::Error& error) {  // options that exclude each other
      PyErr_SetString(PyExc_ValueError, error.what());
    }
  });
  // The package has the folders of an installation, of which this is where the program would be.
  Dl_info here;
  if (::dladdr(&kHere, &here) != 0)
    malus::setProgramFolder(std::filesystem::absolute(here.dli_fname).parent_path() / "bin");
  malus::python::addImage(module);
  malus::python::addScene(module);
  malus::python::addMaterial(module);
  malus::python::addCompare(module);
  module.def("methods", &malus::render::methodNames, "Names of the rendering methods.");
  module.attr("__version__") = MALUS_VERSION;
}
