#include "render/sweep_cli.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "render/cli.h"
#include "render/image/output.h"

namespace malus::render {
namespace fs = std::filesystem;

namespace {

struct SweepArguments : RenderSettings {
  SweepArguments() { method = "stokes"; }
  std::string folder;
  unsigned frames = 36;
  std::optional<double> exposure;
  bool json = false;
};

// The folder, made where it is missing; removed again where nothing came to lie in it.
class OutputFolder {
 public:
  explicit OutputFolder(const fs::path& path) : path_(path) {
    std::error_code failed;
    made_ = fs::create_directories(path, failed);
    if (!fs::is_directory(path))
      throw Error(path.string(), "cannot write", "a folder", failed ? failed.message() : "a file");
    if (::access(path.c_str(), W_OK | X_OK) != 0) throw Error(path.string(), "cannot write", "a writable folder");
  }
  ~OutputFolder() {
    std::error_code ignored;
    if (made_) fs::remove(path_, ignored);  // an empty one only
  }
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  fs::path path_;
  bool made_ = false;
};

// The colour behind an analyser, from the Stokes channels of a rendered picture.
image::Image behind(const Analyser& analyser, const RenderResult& picture) {
  if (picture.channels != kStokesChannels) throw Error("malus sweep", "the picture has no Stokes vectors");
  image::Image result;
  result.width = static_cast<int>(picture.width);
  result.height = static_cast<int>(picture.height);
  result.channels = {"R", "G", "B"};
  result.pixels.resize(kColourChannels * picture.width * picture.height);
  for (std::size_t i = 0; i < result.pixels.size(); ++i) {
    const float* stokes = picture.pixels.data() + i / 3 * kStokesChannels + kColourChannels + i % 3;
    double intensity = 0;
    for (std::size_t k = 0; k < 4; ++k) intensity += analyser[k] * static_cast<double>(stokes[3 * k]);
    result.pixels[i] = static_cast<float>(intensity);
  }
  return result;
}

void runSweep(const SweepArguments& a) {
  requireStokes(a, "--method");
  const pack::Pack pack = pack::read(a.input);
  RenderParameters parameters = parametersFor(a, pack.scene);
  parameters.stokes = true;
  const fs::path folder = a.folder;
  const OutputFolder made(folder);
  const std::string method = methodName(a.backend, a.method), backend = backendInfo(a.backend).name;
  console::progress(fmt::format("rendering {} with {} {}", pack.scene.name, backend, method));
  const RenderResult picture = renderScene(a, pack.scene, parameters, false);
  const double exposureEv = a.exposure.value_or(pack.scene.exposureEv);

  const fs::path list = folder / "sweep.json";
  std::error_code failed;
  fs::remove(list, failed);  // of an earlier sweep: it would name frames of both
  if (failed) throw Error(list.string(), "cannot replace", "a writable folder", failed.message());
  const std::size_t digits = std::max<std::size_t>(3, std::to_string(a.frames - 1).size());
  const auto nameOf = [&](unsigned frame) { return fmt::format("frame-{:0{}}.png", frame, digits); };
  nlohmann::json frames = nlohmann::json::array();
  for (unsigned i = 0; i < a.frames; ++i) {
    const double degrees = 180.0 * i / a.frames;
    console::progress(fmt::format("writing frame {} of {}", i + 1, a.frames));
    writeImage(folder / nameOf(i), behind(linearPolarizer(degrees), picture), exposureEv);
    frames.push_back({{"file", nameOf(i)}, {"degrees", degrees}});
  }
  const nlohmann::json result = {{"scene", pack.scene.name},  {"renderer", backend},
                                 {"method", method},          {"device", picture.device},
                                 {"width", picture.width},    {"height", picture.height},
                                 {"depth", parameters.depth}, {"samples", parameters.samples},
                                 {"exposureEv", exposureEv},  {"frames", frames}};
  const std::string text = result.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  writeFile(list, text);
  console::progressDone();
  if (fs::exists(folder / nameOf(a.frames), failed))
    console::warn(
        fmt::format("{}: {} and what follows it belong to an earlier sweep", folder.string(), nameOf(a.frames)));
  if (a.json)
    fmt::print("{}", text);
  else
    fmt::print("{}: {} {}, {} frames of {} x {} in {}\n", pack.scene.name, backend, method, a.frames, picture.width,
               picture.height, folder.string());
}

}  // namespace

void addSweepCommand(CLI::App& app) {
  auto a = std::make_shared<SweepArguments>();
  CLI::App* command =
      app.add_subcommand("sweep", "Renders a polarizer that turns through 180 degrees, as numbered frames");
  addRenderSettings(*command, *a);
  command->add_option("-o,--output", a->folder, "folder for frame-000.png, ... and sweep.json")->required();
  command->add_option("--frames", a->frames, "pictures between 0 and 180 degrees")
      ->check(CLI::Range(1u, 100000u))
      ->capture_default_str();
  addExposure(*command, a->exposure, "exposure of all frames");
  command->add_flag("--json", a->json, "print sweep.json");
  command->callback([a] { runSweep(*a); });
}

}  // namespace malus::render
