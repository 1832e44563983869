// The command lines of rendering:
//   malus render PACK -o OUT.exr [-o OUT.png] [--backend B] [--method M]
//                [--polarizer DEG | --analyser right|left] [--wave-plate AXIS[,RETARDANCE]]
//                [--output-dolp FILE] [--output-aolp FILE] [--mosaic FILE [--mosaic-bits 8|12|16]] ...
//   malus sweep PACK -o FOLDER [--frames N] ...   (render/sweep_cli.h)
//   malus compare-images A B [--threshold T] [--fail-over VALUE] [--difference OUT] [--json]
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "bake/pack/scene.h"
#include "render/backend.h"
#include "render/scene/render_parameters.h"
#include "render/scene/render_result.h"

namespace malus::render {

// What every command that renders a picture takes, and its options.
struct RenderSettings {
  std::string input;  // scene pack
  Backend backend = Backend::embree;
  std::string method = "fresnel", device;
  std::uint32_t width = 0, height = 0;  // pixels; 0: the pack's, or what keeps its aspect
  std::uint32_t samples = 1;
  std::optional<std::uint32_t> depth;  // else the pack's
  std::vector<std::uint32_t> region;   // x, y, width, height in pixels; empty: the whole picture
  unsigned threads = 0;                // 0: all
};
void addRenderSettings(CLI::App& command, RenderSettings& settings);
// --exposure, in stops; unset: the pack's.
CLI::Option* addExposure(CLI::App& command, std::optional<double>& exposure, const std::string& description);

// Throws CLI::ValidationError that names `option` and what is able, where pictures have no Stokes channels.
void requireStokes(const RenderSettings& settings, const std::string& option);
// The view without a filter. Throws Error for a size or a region that the scene does not allow.
RenderParameters parametersFor(const RenderSettings& settings, const pack::Scene& scene);
// countRays: Vulkan traces once more, untimed, to count them.
RenderResult renderScene(const RenderSettings& settings, const pack::Scene& scene, const RenderParameters& parameters,
                         bool countRays);

// Thrown by compare-images where the pictures differ by more than --fail-over: exit code 3.
struct ImagesDiffer {};

void addRenderCommand(CLI::App& app);
void addCompareImagesCommand(CLI::App& app);
void listMethods();
void listDevices();

}  // namespace malus::render
