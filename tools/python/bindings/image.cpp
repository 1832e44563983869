#include "tools/python/bindings/image.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "meshprep/base/error.h"
#include "render/image/output.h"
#include "render/image/polarization.h"
#include "render/scene/render_result.h"
#include "tools/python/bindings/run.h"

namespace malus::python {
namespace py = pybind11;

namespace {

constexpr py::ssize_t kFloat = sizeof(float);

// A view of the floats of an image, which must not be written through.
py::array view(const float* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
               const py::object& owner) {
  py::array array(py::dtype::of<float>(), std::move(shape), std::move(strides), data, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

double angle(double, double s1, double s2) { return render::angleOfLinearPolarization(s1, s2); }

}  // namespace

void Image::requireStokes() const {
  if (channels() != render::kStokesChannels)
    throw Error("image", "has no Stokes vectors", "a method with Stokes vectors, such as stokes, or stokes=True",
                frame_.method);
}

py::array Image::rgb(const py::object& self) {
  const auto& image = self.cast<const Image&>();
  const auto pixel = static_cast<py::ssize_t>(image.channels()) * kFloat;
  const auto h = static_cast<py::ssize_t>(image.height()), w = static_cast<py::ssize_t>(image.width());
  return view(image.frame_.image.pixels.data(), {h, w, 3}, {w * pixel, pixel, kFloat}, self);
}

py::array Image::stokes(const py::object& self) {
  const auto& image = self.cast<const Image&>();
  image.requireStokes();
  const auto pixel = static_cast<py::ssize_t>(image.channels()) * kFloat;
  const auto h = static_cast<py::ssize_t>(image.height()), w = static_cast<py::ssize_t>(image.width());
  return view(image.frame_.image.pixels.data() + render::kColourChannels, {h, w, 3, 4},
              {w * pixel, pixel, kFloat, 3 * kFloat}, self);
}

// The channels are those of render/ground_truth/truth_image.h, layer by layer.
py::dict Image::truth(const py::object& self) {
  const auto& image = self.cast<const Image&>();
  const image::Image& truth = image.frame_.truth;
  if (truth.pixels.empty()) throw Error("image", "has no ground truth", "ground_truth=True");
  const auto channels = static_cast<py::ssize_t>(truth.channels.size());
  const auto h = static_cast<py::ssize_t>(truth.height), w = static_cast<py::ssize_t>(truth.width);
  py::dict layers;
  for (py::ssize_t i = 0; i < channels;) {
    const std::string& name = truth.channels[static_cast<std::size_t>(i)];
    const std::string layer = name.substr(0, name.find('.') + 1);
    py::ssize_t count = 1;
    while (i + count < channels && truth.channels[static_cast<std::size_t>(i + count)].starts_with(layer)) ++count;
    std::vector<py::ssize_t> shape = {h, w}, strides = {w * channels * kFloat, channels * kFloat};
    if (count > 1) shape.push_back(count), strides.push_back(kFloat);
    layers[py::str(layer.substr(0, layer.size() - 1))] = view(truth.pixels.data() + i, shape, strides, self);
    i += count;
  }
  return layers;
}

py::array_t<double> Image::perColour(double (*of)(double, double, double)) const {
  requireStokes();
  py::array_t<double> result({height(), width(), std::size_t{3}});
  double* to = result.mutable_data();
  for (std::size_t i = 0; i < width() * height(); ++i) {
    const float* s = frame_.image.pixels.data() + i * channels() + render::kColourChannels;
    for (std::size_t c = 0; c < 3; ++c)
      to[3 * i + c] = of(static_cast<double>(s[c]), static_cast<double>(s[3 + c]), static_cast<double>(s[6 + c]));
  }
  return result;
}

py::array_t<double> Image::dolp() const { return perColour(render::degreeOfLinearPolarization); }
py::array_t<double> Image::aolp() const { return perColour(angle); }

void Image::save(const std::filesystem::path& file, std::optional<double> exposureEv) const {
  withoutLock([&] { render::writeImage(file, frame_.image, exposureEv.value_or(exposureEv_)); });
}

void addImage(py::module_& module) {
  py::class_<Image>(module, "_Image")
      .def_property_readonly("width", &Image::width)
      .def_property_readonly("height", &Image::height)
      .def_property_readonly("method", [](const Image& image) { return image.frame().method; })
      .def_property_readonly("backend", &Image::backend)
      .def_property_readonly("device", &Image::device)
      .def_property_readonly("trace_ms", [](const Image& image) { return image.frame().traceMs; })
      .def_property_readonly(
          "camera",
          [](const Image& image) { return py::module_::import("json").attr("loads")(image.frame().camera.dump()); })
      .def_property_readonly("rgb", &Image::rgb)
      .def_property_readonly("stokes", &Image::stokes)
      .def_property_readonly("truth", &Image::truth)
      .def("dolp", &Image::dolp)
      .def("aolp", &Image::aolp)
      .def("save", &Image::save, py::arg("file"), py::arg("exposure"));
}

}  // namespace malus::python
