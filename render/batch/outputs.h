// Files that a frame is written to.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace malus::render {

enum class FrameOutput : std::uint32_t { exr, png, dolp, aolp, truth, camera, raw, mask, sensorStokes };

struct FrameOutputInfo {
  FrameOutput output;
  const char* name;    // in --outputs and in jobs
  const char* suffix;  // behind the name of the frame
  bool readsStokes;    // needs a method with Stokes vectors
  bool readsSensor;    // needs a sensor
};
inline constexpr std::array<FrameOutputInfo, 9> kFrameOutputs = {{
    {FrameOutput::exr, "exr", ".exr", false, false},
    {FrameOutput::png, "png", ".png", false, false},
    {FrameOutput::dolp, "dolp", ".dolp.exr", true, false},
    {FrameOutput::aolp, "aolp", ".aolp.exr", true, false},
    {FrameOutput::truth, "truth", ".truth.exr", false, false},
    {FrameOutput::camera, "camera", ".json", false, false},
    {FrameOutput::raw, "raw", ".raw.png", true, true},
    {FrameOutput::mask, "mask", ".mask.png", true, true},
    {FrameOutput::sensorStokes, "sensor-stokes", ".sensor.exr", true, true},
}};

class FrameOutputs {
 public:
  FrameOutputs() = default;
  // Throws Error for an unknown name, and for no name. where: of the error.
  FrameOutputs(const std::vector<std::string>& names, std::string_view where);

  bool has(FrameOutput output) const { return (bits_ & bit(output)) != 0; }
  // A name of an output that needs Stokes vectors; empty if none does.
  std::string stokesOutput() const;
  // The same of a sensor.
  std::string sensorOutput() const;
  // Whether an image is rendered: not for ground truth and camera alone.
  bool needImage() const;
  // Whether any file has pixels: not for the camera alone.
  bool needPixels() const { return needImage() || has(FrameOutput::truth); }
  std::vector<std::string> names() const;

 private:
  static std::uint32_t bit(FrameOutput output) { return 1u << static_cast<std::uint32_t>(output); }
  std::uint32_t bits_ = bit(FrameOutput::exr);
};

// All names, in the order of kFrameOutputs.
std::vector<std::string> frameOutputNames();

}  // namespace malus::render
