#include "render/sweep_cli.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/output_files.h"
#include "meshprep/json_text.h"
#include "meshprep/output_option.h"
#include "render/image/output.h"
#include "render/job.h"
#include "render/options.h"
#include "render/output_folder.h"
#include "render/scene/methods.h"

namespace malus::render {
namespace fs = std::filesystem;

namespace {

constexpr const char* kListFile = "sweep.json";

struct SweepArguments {
  PackInput input;
  std::string folder;
  JobSettings job;
  unsigned frames = 36;
  std::optional<double> exposure;
  bool json = false;
};

// The colour behind an analyser, from the Stokes channels of a rendered image.
image::Image imageBehind(const Analyser& analyser, const RenderResult& rendered) {
  if (rendered.channels != kStokesChannels)
    throw Error("--method", "the image has no Stokes vectors", "a method with Stokes vectors");
  image::Image result;
  result.width = static_cast<int>(rendered.width);
  result.height = static_cast<int>(rendered.height);
  result.channels = {"R", "G", "B"};
  result.pixels.resize(kColourChannels * rendered.width * rendered.height);
  for (std::size_t i = 0; i < result.pixels.size(); ++i) {
    const float* stokes = rendered.pixels.data() + i / 3 * kStokesChannels + kColourChannels + i % 3;
    double intensity = 0;
    for (std::size_t k = 0; k < 4; ++k) intensity += analyser[k] * static_cast<double>(stokes[3 * k]);
    result.pixels[i] = static_cast<float>(intensity);
  }
  return result;
}

// Writes every frame; returns their entries of sweep.json. fileName: by number.
template <class FileName>
nlohmann::json writeFrames(const SweepArguments& a, const FileName& fileName, const RenderResult& rendered,
                           double exposureEv) {
  nlohmann::json frames = nlohmann::json::array();
  for (unsigned i = 0; i < a.frames; ++i) {
    const double degrees = 180.0 * i / a.frames;
    console::progress(fmt::format("writing frame {} of {}", i + 1, a.frames));
    writeImage(fs::path(a.folder) / fileName(i), imageBehind(linearPolarizer(degrees), rendered), exposureEv);
    frames.push_back({{"file", fileName(i)}, {"degrees", degrees}});
  }
  return frames;
}

std::string frameName(const SweepArguments& a, unsigned frame) {
  const std::size_t digits = std::max<std::size_t>(3, std::to_string(a.frames - 1).size());
  return fmt::format("frame-{:0{}}.png", frame, digits);
}

// Refuses to write a frame or the list over the pack.
void checkFiles(const SweepArguments& a) {
  OutputFiles files;
  addInputs(files, a.input);
  files.addOutputFolder(a.folder, "--output");
  files.addOutput(fs::path(a.folder) / kListFile, "--output");
  files.check();
  // Names differ in their numbers, so only an existing frame can be the pack. Frames of an earlier sweep may be hard
  // links of each other.
  std::error_code ignored;
  for (unsigned i = 0; i < a.frames; ++i) {
    const fs::path frame = fs::path(a.folder) / frameName(a, i);
    if (!fs::exists(frame, ignored)) continue;
    OutputFiles one;
    addInputs(one, a.input);
    one.addOutput(frame, "--output");
    one.check();
  }
}

void runSweep(const SweepArguments& a) {
  requireStokes(a.job.backend, a.job.method, "--method");
  checkFiles(a);
  const pack::Pack pack = pack::read(packFile(a.input));
  JobSettings settings = a.job;
  settings.stokes = settings.storesStokes = true;
  Job job(pack, settings);
  const fs::path folder = a.folder;
  const OutputFolder made(folder);
  const std::string method = job.method(), backend = backendInfo(job.backend()).name;
  const RenderResult rendered = job.render();
  const double exposureEv = a.exposure.value_or(pack.scene.exposureEv);

  // Remove the list of an earlier sweep first: it would name frames of both.
  const fs::path list = folder / kListFile;
  std::error_code failed;
  fs::remove(list, failed);
  if (failed) throw Error(list.string(), "cannot replace", "a writable folder", failed.message());
  const auto fileName = [&](unsigned frame) { return frameName(a, frame); };
  const nlohmann::json frames = writeFrames(a, fileName, rendered, exposureEv);
  const std::string& substitutedFor = job.substitutedFor();
  const nlohmann::json result = {
      {"scene", pack.scene.name},
      {"renderer", backend},
      {"method", method},
      {"substitutedFor", substitutedFor.empty() ? nlohmann::json() : nlohmann::json(substitutedFor)},
      {"device", rendered.device},
      {"withoutRecursion",
       rendered.withoutRecursion.empty() ? nlohmann::json() : nlohmann::json(rendered.withoutRecursion)},
      {"width", rendered.width},
      {"height", rendered.height},
      {"depth", job.parameters().depth},
      {"samples", job.parameters().samples},
      {"exposureEv", exposureEv},
      {"frames", frames}};
  const std::string text = jsonText(result) + "\n";
  writeFile(list, text);
  console::progressDone();
  if (fs::exists(folder / fileName(a.frames), failed))
    console::warn(
        fmt::format("{}: {} and later frames are left from an earlier sweep", folder.string(), fileName(a.frames)));
  if (a.json)
    console::printText(text);
  else
    console::printLine("{}: {} {}{}, {} frames of {} x {} in {}{}", pack.scene.name, backend, method,
                       substitutedFor.empty() ? "" : fmt::format(" (substituted for {})", substitutedFor), a.frames,
                       rendered.width, rendered.height, folder.string(),
                       rendered.withoutRecursion.empty() ? "" : "; without recursion: " + rendered.withoutRecursion);
}

}  // namespace

void addSweepCommand(CLI::App& app) {
  auto a = std::make_shared<SweepArguments>();
  a->job.method = completeRecursiveMethod().name;
  CLI::App* command =
      app.add_subcommand("sweep", "Render a polarizer that rotates by 180 degrees in equal steps, as numbered frames");
  addJobOptions(*command, a->input, a->job);
  command->add_option("-o,--output", a->folder, "Folder for frame-000.png, ... and sweep.json")
      ->required()
      ->check(outputName())
      ->type_name("FOLDER");
  addFrames(*command, a->frames)->capture_default_str();
  addExposure(*command, a->exposure);
  command->add_flag("--json", a->json, "Print sweep.json");
  command->callback([a] { runSweep(*a); });
}

}  // namespace malus::render
