#include "tools/python/bindings/material.h"

#include <algorithm>
#include <complex>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "bake/materials/optical_file.h"
#include "bake/materials/presets.h"
#include "meshprep/base/error.h"
#include "render/material/surface_response.h"

namespace malus::python {
namespace py = pybind11;

namespace {

using Angles = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Optical constants of one material: over the wavelength, or the same at each.
class Material {
 public:
  explicit Material(const std::string& name) : name_(name) {
    if (bake::isOpticalFile(name))
      data_ = bake::readOpticalFile(name);
    else
      preset_ = &bake::requirePreset(name);
  }
  Material(double eta, double k) : name_("constants"), eta_(eta), k_(k) {}

  std::complex<double> index(double nanometres) const {
    using Quantity = bake::OpticalData::Quantity;
    if (preset_ != nullptr) return {preset_->at(Quantity::n, nanometres), -preset_->at(Quantity::k, nanometres)};
    if (!data_) return {eta_, -k_};
    return {data_->at(Quantity::n, nanometres), -data_->at(Quantity::k, nanometres)};
  }
  const std::string& name() const { return name_; }

  // The response at each angle; part: its values, 16 or 1 numbers per angle.
  template <class Part>
  py::array_t<double> overAngles(const Angles& degrees, double nanometres, double outside, std::size_t count,
                                 Part part) const {
    const std::complex<double> n = index(nanometres);
    std::vector<py::ssize_t> shape(degrees.shape(), degrees.shape() + degrees.ndim());
    if (count == 16) shape.insert(shape.end(), {4, 4});
    py::array_t<double> result(shape);
    double* to = result.mutable_data();
    for (py::ssize_t i = 0; i < degrees.size(); ++i) {
      const double angle = degrees.data()[i];
      if (!(angle >= 0 && angle <= 90))
        throw Error("angles", "an angle of incidence is out of range", "0 to 90 degrees", fmt::format("{:g}", angle));
      part(render::surfaceResponse({outside, n.real(), -n.imag()}, angle, render::Precision::doublePrecision),
           to + static_cast<std::size_t>(i) * count);
    }
    return result;
  }

 private:
  std::string name_;
  std::optional<bake::OpticalData> data_;
  const bake::Preset* preset_ = nullptr;
  double eta_ = 1, k_ = 0;
};

py::array_t<double> mueller(const Material& m, const Angles& angles, double wavelength, double outside,
                            bool transmission) {
  return m.overAngles(angles, wavelength, outside, 16, [&](const render::SurfaceResponse& r, double* to) {
    if (transmission && !r.transmission) throw Error(m.name(), "a metal transmits nothing", "a dielectric");
    const std::array<double, 16>& matrix = transmission ? *r.transmission : r.reflection;
    std::copy(matrix.begin(), matrix.end(), to);
  });
}

py::tuple reflectance(const Material& m, const Angles& angles, double wavelength, double outside) {
  const auto part = [&](double render::SurfaceResponse::*value) {
    return m.overAngles(angles, wavelength, outside, 1,
                        [&](const render::SurfaceResponse& r, double* to) { *to = r.*value; });
  };
  return py::make_tuple(part(&render::SurfaceResponse::rs), part(&render::SurfaceResponse::rp));
}

}  // namespace

void addMaterial(py::module_& module) {
  using namespace py::literals;
  constexpr double kGreen = 532;
  py::class_<Material>(module, "Material", "Optical constants of a surface (`malus material`).")
      .def_property_readonly("name", &Material::name)
      .def("index", &Material::index, "wavelength"_a = kGreen,
           "Complex index eta - i k (time dependence e^{+i w t}) at a wavelength in nm.")
      .def("mueller", &mueller, "angles"_a, py::kw_only(), "wavelength"_a = kGreen, "outside"_a = 1.0,
           "transmission"_a = false,
           "Mueller matrices of the reflection (or transmission) at angles of incidence in degrees, 0 to 90, of any "
           "shape: shape + (4, 4), float64, in flux. x of the frames is the s direction on both sides "
           "(shaders/optics/CONVENTIONS.md). outside: index of the medium of incidence. Raises malus.Error for an "
           "angle or a wavelength out of range.")
      .def("reflectance", &reflectance, "angles"_a, py::kw_only(), "wavelength"_a = kGreen, "outside"_a = 1.0,
           "(R_s, R_p) at angles of incidence in degrees: two arrays of their shape.")
      .def("__repr__", [](const Material& m) { return "<malus.Material '" + m.name() + "'>"; });
  module.def(
      "material",
      [](const std::optional<std::string>& name, std::optional<double> eta, double k) {
        if (name && eta) throw py::value_error("material: expected a name, or eta and k");
        if (!name && !eta) throw py::value_error("material: expected a name, a file, or eta");
        return name ? Material(*name) : Material(*eta, k);
      },
      "name"_a = py::none(), py::kw_only(), "eta"_a = py::none(), "k"_a = 0.0,
      "The material of a preset (malus.presets()), of a file of refractiveindex.info (.yml, .csv), or of eta and k. "
      "Raises malus.Error for an unknown name, with the nearest one.");
  module.def(
      "presets",
      [] {
        std::vector<std::string> names;
        for (const bake::Preset& preset : bake::presets()) names.push_back(preset.name);
        return names;
      },
      "Names of the built-in materials.");
}

}  // namespace malus::python
