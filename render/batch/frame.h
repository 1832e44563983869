// One frame of a batch: its settings, from its job and the options of the command.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "bake/pack/scene.h"
#include "meshprep/base/image.h"
#include "render/batch/jobs.h"
#include "render/batch/outputs.h"
#include "render/batch/overrides.h"
#include "render/filter_options.h"
#include "render/job.h"
#include "render/sensor/expose.h"

namespace malus::render {

// Settings of frames whose jobs do not have them: the options of the command.
struct FrameDefaults {
  JobSettings job;
  FilterOptions filter;
  std::optional<double> exposure;  // else the pack's
  FrameOutputs outputs;
  image::ExrCompression compression = image::ExrCompression::zip;
  std::shared_ptr<const Sensor> sensor{};  // of the outputs raw, mask and sensor-stokes
};

struct Frame {
  std::size_t index = 0;
  std::string name;
  std::uint64_t seed = 0;
  JobSettings job;  // analyser, needsLinear and storesStokes follow from the filter and the outputs
  double exposureEv = 0;
  FrameOutputs outputs;
  Region region;  // that is rendered
  pack::Camera camera;
  std::shared_ptr<const Sensor> sensor;  // null unless an output needs it
  Exposure exposure;                     // frameExposure()
  SceneSurfaces surfaces;
  nlohmann::json surfaceKeys;  // of the job, by which surfaces differs from the pack
  nlohmann::json settings;     // every setting that the files depend on
};

// Exposure of the sensor: the noise follows from the seed of the frame and the position in the whole image.
Exposure frameExposure(double exposureEv, std::uint64_t seed, const Region& region);

// scene: that of the pack. Throws Error that names the line and the key.
Frame readFrame(const FrameJob& job, const FrameDefaults& defaults, const pack::Scene& scene);

}  // namespace malus::render
