// A rendered image, and its ground truth, for Python: the pixels stay where the renderer wrote them, and numpy arrays
// are views of them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "render/batch/frame_renderer.h"

namespace malus::python {

class Image {
 public:
  Image(render::RenderedFrame frame, std::string backend, std::string device, double exposureEv)
      : frame_(std::move(frame)), backend_(std::move(backend)), device_(std::move(device)), exposureEv_(exposureEv) {}

  std::size_t width() const { return static_cast<std::size_t>(frame_.image.width); }
  std::size_t height() const { return static_cast<std::size_t>(frame_.image.height); }
  std::size_t channels() const { return frame_.image.channels.size(); }
  const render::RenderedFrame& frame() const { return frame_; }
  const std::string& backend() const { return backend_; }
  const std::string& device() const { return device_; }

  // Views; self keeps the pixels alive. stokes throws Error without Stokes channels.
  static pybind11::array rgb(const pybind11::object& self);
  static pybind11::array stokes(const pybind11::object& self);
  // Views by name; throws Error without ground truth.
  static pybind11::dict truth(const pybind11::object& self);
  // Per colour, H x W x 3 (render/image/polarization.h).
  pybind11::array_t<double> dolp() const;
  pybind11::array_t<double> aolp() const;
  // .exr with all channels, or .png.
  void save(const std::filesystem::path& file, std::optional<double> exposureEv) const;

 private:
  pybind11::array_t<double> perColour(double (*of)(double s0, double s1, double s2)) const;
  void requireStokes() const;

  render::RenderedFrame frame_;
  std::string backend_, device_;
  double exposureEv_;
};

void addImage(pybind11::module_& module);

}  // namespace malus::python
