#include "render/cli.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>
#include <nlohmann/json.hpp>

#include "bake/depth_probe.h"
#include "bake/pack/reader.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/image.h"
#include "meshprep/base/output_files.h"
#include "meshprep/json_text.h"
#include "meshprep/output_option.h"
#include "render/batch/camera_keys.h"
#include "render/budget/measure.h"
#include "render/effects_option.h"
#include "render/embree/coverage.h"
#include "render/filter_options.h"
#include "render/ground_truth/truth_image.h"
#include "render/image/mosaic.h"
#include "render/image/output.h"
#include "render/image/polarization.h"
#include "render/job.h"
#include "render/options.h"
#include "render/scene/methods.h"
#include "render/sensor_options.h"
#include "render/vulkan/renderer.h"

namespace malus::render {

namespace {

const std::map<std::string, MosaicChannel> kMosaicChannels = {{"luminance", MosaicChannel::luminance},
                                                              {"r", MosaicChannel::red},
                                                              {"g", MosaicChannel::green},
                                                              {"b", MosaicChannel::blue}};

struct RenderArguments {
  PackInput input;
  JobSettings job;
  FilterOptions filter;
  SensorOptions sensor;
  std::vector<std::string> outputs;
  std::string view, dolp, aolp, mosaic, truth, mosaicChannel = "luminance";
  unsigned mosaicBits = 8;
  std::optional<double> exposure;
  image::ExrCompression compression = image::ExrCompression::zip;
  bool json = false, intensity = false, alpha = false;

  bool needsImage() const { return !outputs.empty() || !stokesOption().empty(); }
  // The first option that reads Stokes vectors; empty if none does.
  std::string stokesOption() const {
    return sensor.any()      ? "--sensor"
           : !mosaic.empty() ? "--mosaic"
           : !dolp.empty()   ? "--output-dolp"
           : !aolp.empty()   ? "--output-aolp"
                             : "";
  }
};

bool hasExtension(const std::string& file, std::initializer_list<const char*> extensions) {
  const auto extension = std::filesystem::path(file).extension();
  return std::any_of(extensions.begin(), extensions.end(), [&](const char* e) { return extension == e; });
}

[[noreturn]] void refuse(const std::string& option, const std::string& problem) {
  throw CLI::ValidationError(option, problem);
}

// Checks the output files: at least one, each once, none of them the pack, each with a known extension.
void checkOutputs(const RenderArguments& a) {
  OutputFiles files;
  addInputs(files, a.input);
  for (const std::string& file : a.outputs) files.addOutput(file, "--output");
  files.addOutput(a.dolp, "--output-dolp");
  files.addOutput(a.aolp, "--output-aolp");
  files.addOutput(a.mosaic, "--mosaic");
  files.addOutput(a.truth, "--ground-truth");
  addSensorFiles(files, a.sensor);
  files.check();
  if (!a.needsImage() && a.truth.empty())
    refuse("--output",
           "no image asked for; use -o, --output-dolp, --output-aolp, --mosaic, --sensor or --ground-truth");
  if (!a.truth.empty() && !hasExtension(a.truth, {".exr"})) refuse("--ground-truth", "expected .exr, found " + a.truth);
  checkSensorOptions(a.sensor);
  for (const std::string& file : {a.dolp, a.aolp})
    if (!file.empty() && !hasExtension(file, {".exr", ".png"}))
      refuse("--output-dolp, --output-aolp", "expected .exr or .png, found " + file);
  if (!a.mosaic.empty() && !hasExtension(a.mosaic, {".png", ".tif", ".tiff"}))
    refuse("--mosaic", "expected .png or .tif, found " + a.mosaic);
  for (const std::string& file : a.outputs)
    if (!hasExtension(file, {".exr", ".png"})) {
      const std::string extension = std::filesystem::path(file).extension().string();
      throw Error(file, "unknown image format", ".exr or .png", extension.empty() ? "no extension" : extension);
    }
}

bool writesExr(const RenderArguments& a) {
  return std::any_of(a.outputs.begin(), a.outputs.end(),
                     [](const std::string& file) { return hasExtension(file, {".exr"}); });
}

// Checks combinations of options that do not depend on the pack.
void checkCombinations(const RenderArguments& a) {
  const std::string stokesOption = a.stokesOption();
  const bool hasMethods = backendInfo(a.job.backend).hasMethods;
  for (const char* const option : {a.mosaic.empty() ? nullptr : "--mosaic", a.sensor.any() ? "--sensor" : nullptr})
    if (option && a.filter.any())
      refuse(option, "has a polarizer before every pixel; excludes --polarizer, --analyser and --wave-plate");
  const char* const budget = a.job.maxError ? "--max-error" : a.job.maxMs ? "--max-ms" : nullptr;
  if (budget && !hasMethods) refuse(budget, "excludes --backend reference, which has no methods");
  if (budget && a.job.tolerance > 0) refuse("--tolerance", fmt::format("excludes {}", budget));
  if (budget && a.job.effects != "auto" && a.job.effects != "all")
    refuse("--effects",
           fmt::format("expected auto or all with {}, which chooses effects, found '{}'", budget, a.job.effects));
  if (a.alpha && !writesExr(a)) refuse("--alpha", "needs an output with the extension .exr");
  if (a.intensity && a.job.stokes) refuse("--intensity", "excludes --stokes");
  if (a.intensity && !stokesOption.empty()) refuse("--intensity", "excludes " + stokesOption);
  if (a.job.tolerance > 0 && (!hasMethods || !methodNamed(a.job.method).isIterative)) {
    std::vector<std::string> iterative;
    for (const MethodInfo& m : methods())
      if (m.isIterative) iterative.push_back(m.name);
    refuse("--tolerance", fmt::format("needs an iterative method ({}), found {}", fmt::join(iterative, ", "),
                                      methodName(a.job.backend, a.job.method)));
  }
  if (budget) return;  // the choice is among methods that have Stokes vectors
  if (a.job.stokes) requireStokes(a.job.backend, a.job.method, "--stokes");
  if (!stokesOption.empty()) requireStokes(a.job.backend, a.job.method, stokesOption);
}

JobSettings jobSettings(const RenderArguments& a) {
  JobSettings job = a.job;
  job.analyser = makeAnalyser(a.filter);
  job.needsLinear = !a.stokesOption().empty();
  job.stokes = job.stokes || job.needsLinear;
  job.storesStokes = !a.intensity && writesExr(a);
  return job;
}

void checkMosaicSize(const Region& region) {
  if (region.width % 2 != 0 || region.height % 2 != 0)
    refuse("--mosaic", fmt::format("needs an even width and height (--width, --height), found {} x {}", region.width,
                                   region.height));
}

// Significant digits without an exponent.
std::string digits(double value, int count) {
  return value >= 0.99 * std::pow(10.0, count) ? fmt::format("{:.0f}", value) : fmt::format("{:.{}g}", value, count);
}

// The choice of --max-error or --max-ms, and what each part of it was measured to add and to save alone.
std::vector<std::string> budgetLines(const JobSettings& settings, const Budget& budget) {
  std::vector<std::string> lines;
  lines.push_back(fmt::format(
      "{}: {}; expected relative RMS error at most {:.3g}{}, over 1 % in {} % of the pixels; expected {} ms, "
      "{} ms with everything; error of the precision {:.3g}",
      settings.maxError ? fmt::format("--max-error {:g}", *settings.maxError)
                        : fmt::format("--max-ms {:g}", *settings.maxMs),
      budget.parts.empty() ? fmt::format("{}, nothing left out", budget.chosen.method)
                           : fmt::format("{}, depth {}", budget.chosen.method, budget.chosen.depth),
      budget.checked.relRms, settings.maxError ? fmt::format(" of {:g}", *settings.maxError) : "",
      digits(100 * budget.checked.wrongShare, 2), digits(budget.expectedMs, 3), digits(budget.completeMs, 3),
      budget.precision));
  for (const BudgetPart& part : budget.parts)
    lines.push_back(fmt::format("  {}: relative RMS error {:.2g} alone, {} {:.0f} % of the time", part.what, part.error,
                                part.savedShare >= 0 ? "saves" : "takes", 100 * std::abs(part.savedShare)));
  if (budget.leftOut > 0)
    lines.push_back(fmt::format("  {} choices were not measured within {:g} minutes and not considered", budget.leftOut,
                                kFirstPassMinutes));
  return lines;
}

nlohmann::json toJson(const Budget& budget) {
  nlohmann::json parts = nlohmann::json::array();
  for (const BudgetPart& part : budget.parts)
    parts.push_back({{"what", part.what}, {"relRms", part.error}, {"savedShare", part.savedShare}});
  return {{"method", budget.chosen.method},
          {"depth", budget.chosen.depth},
          {"tolerance", budget.chosen.tolerance},
          {"off", budget.chosen.off},
          {"expectedRelRms", budget.checked.relRms},
          {"expectedShareOver1Percent", budget.checked.wrongShare},
          {"expectedMs", budget.expectedMs},
          {"completeMs", budget.completeMs},
          {"precisionRelRms", budget.precision},
          {"parts", parts},
          {"leftOut", budget.leftOut}};
}

// Prints how the job differs from what was asked for.
void reportJob(const RenderArguments& a, const Job& job) {
  if (job.budget()) {
    console::progressDone();
    for (const std::string& line : budgetLines(a.job, *job.budget())) console::error(line);
  }
  warnOfFilter(a.filter, makeAnalyser(a.filter),
               backendInfo(a.job.backend).hasMethods ? job.requestedMethod() : std::string());
  for (const std::string& warning : job.warnings()) console::warn(warning);
  if (job.budget() && job.parameters().depth < renderParameters(a.job, job.scene()).depth) return;  // within its error
  const std::string lost = bake::lostLightNote(job.scene().lightBeyond, job.parameters().depth, "--depth");
  if (!lost.empty()) console::warn(lost);
}

// Removes every channel except the colour.
RenderResult withoutStokes(RenderResult result) {
  for (std::size_t i = 0; i < std::size_t{result.width} * result.height; ++i)
    for (std::size_t c = 0; c < kColourChannels; ++c)
      result.pixels[i * kColourChannels + c] = result.pixels[i * result.channels + c];
  result.channels = kColourChannels;
  result.pixels.resize(kColourChannels * result.width * result.height);
  return result;
}

// Writes every file except those of the sensor and returns their names.
// withCoverage: the image with alpha, or null.
std::vector<std::string> writeOutputs(const RenderArguments& a, const image::Image& image,
                                      const image::Image* withCoverage, double exposureEv) {
  std::vector<std::string> written;
  const auto write = [&](const std::string& output, const auto& writer) {
    if (output.empty()) return;
    console::progress(fmt::format("writing {}", output));
    writer(output);
    written.push_back(output);
  };
  for (const std::string& output : a.outputs)
    write(output, [&](const std::string& file) {
      const bool hasAlpha = withCoverage && hasExtension(file, {".exr"});
      writeImage(file, hasAlpha ? *withCoverage : image, exposureEv, a.compression);
    });
  write(a.dolp, [&](const std::string& file) { writeDolp(file, image, a.compression); });
  write(a.aolp, [&](const std::string& file) { writeAolp(file, image, a.compression); });
  write(a.mosaic, [&](const std::string& file) {
    writeMosaic(file, mosaic(image, {a.mosaicBits, kMosaicChannels.at(a.mosaicChannel), exposureEv}));
  });
  return written;
}

// Writes the ground truth of the scene that the job renders.
void renderTruth(const RenderArguments& a, const Job& job, const pack::Pack& pack, std::vector<std::string>& written) {
  if (a.truth.empty()) return;
  console::progress("ground truth");
  const std::vector<PixelTruth> pixels = GroundTruth(job.scene(), a.job.threads).render(job.parameters());
  writeTruth(a.truth, truthImage(pixels, pack, job.parameters()), a.compression);
  written.push_back(a.truth);
}

// The result of a command that only writes ground truth.
void printTruth(const RenderArguments& a, const Job& job, const std::vector<std::string>& written) {
  const Region& region = job.parameters().region;
  const std::string& scene = job.scene().name;
  if (a.json)
    console::printText(jsonText({{"scene", scene},
                                 {"width", region.width},
                                 {"height", region.height},
                                 {"depth", job.parameters().depth},
                                 {"outputs", written}}) +
                       "\n");
  else
    console::printLine("{}: ground truth, {} x {}, depth {}", scene, region.width, region.height,
                       job.parameters().depth);
}

void printResult(const RenderArguments& a, const Job& job, const std::string& scene, const RenderResult& result,
                 const std::vector<std::string>& written) {
  const std::string backend = backendInfo(job.backend()).name, &substitutedFor = job.substitutedFor();
  const Cost& cost = result.cost;
  if (!a.json) {
    console::printLine(
        "{}: {} {}{}, {} x {}, depth {}, {}{:.1f} ms on {}{}{}", scene, backend, job.method(),
        substitutedFor.empty() ? "" : fmt::format(" (substituted for {})", substitutedFor), result.width, result.height,
        job.parameters().depth, cost.rays > 0 ? fmt::format("{} rays, ", cost.rays) : "", cost.traceMs, result.device,
        result.withoutRecursion.empty() ? "" : fmt::format("; without recursion: {}", result.withoutRecursion),
        a.job.checkNumerics ? "; every value is finite and physical" : "");
    return;
  }
  const auto orNull = [](bool known, nlohmann::json value) { return known ? std::move(value) : nlohmann::json(); };
  const nlohmann::json document = {
      {"scene", scene},
      {"renderer", backend},
      {"method", job.method()},
      {"device", result.device},
      {"vulkanPath", orNull(result.vulkanPath != VulkanPath::automatic, vulkanPathName(result.vulkanPath))},
      {"embreePath", orNull(result.embreePath != EmbreePath::automatic, embreePathName(result.embreePath))},
      {"withoutRecursion", orNull(!result.withoutRecursion.empty(), result.withoutRecursion)},
      {"width", result.width},
      {"height", result.height},
      {"depth", job.parameters().depth},
      {"samples", job.parameters().samples},
      {"rays", orNull(cost.rays > 0, cost.rays)},
      {"buildMs", cost.buildMs},
      {"traceMs", cost.traceMs},
      {"wallMs", cost.wallMs},
      {"numericsChecked", a.job.checkNumerics},
      {"effects", a.job.effects},
      {"substitutedFor", orNull(!substitutedFor.empty(), substitutedFor)},
      {"budget", job.budget() ? toJson(*job.budget()) : nlohmann::json()},
      {"inPlaceOf", orNull(!substitutedFor.empty(), substitutedFor)},
      {"outputs", written}};
  console::printText(jsonText(document) + "\n");
}

void runRender(const RenderArguments& a) {
  checkOutputs(a);
  const JobSettings settings = jobSettings(a);
  checkCombinations(a);
  const std::optional<Sensor> sensor = readSensor(a.sensor);
  const std::string file = packFile(a.input);
  pack::Pack pack = pack::read(file);
  if (!a.view.empty()) {
    const RenderParameters size = renderParameters(settings, pack.scene);
    pack.scene.camera = parseCamera(a.view, pack.scene, size.width, size.height, "--view");
  }
  pack.scene.exposureEv = a.exposure.value_or(pack.scene.exposureEv);  // the white that --max-error refers to
  if (!a.mosaic.empty()) checkMosaicSize(renderParameters(settings, pack.scene).region);
  if (sensor) checkSensorRegion(*sensor, renderParameters(settings, pack.scene).region);
  Job job(pack, settings);
  std::vector<std::string> written;
  if (!a.needsImage()) {
    renderTruth(a, job, pack, written);
    console::progressDone();
    printTruth(a, job, written);
    return;
  }
  reportJob(a, job);
  if (settings.needsLinear) requireStokes(job.backend(), job.method(), a.stokesOption());

  const std::string backend = backendInfo(job.backend()).name;
  RenderResult result = job.render();
  if (result.faults.count > 0) throw Error(file, describe(result.faults, pack.scene));
  if (a.intensity) result = withoutStokes(std::move(result));
  const image::Image image = takeImage(result, pack, job.parameters(), backend, job.method());
  oneapi::tbb::task_arena(a.job.threads > 0 ? static_cast<int>(a.job.threads) : oneapi::tbb::task_arena::automatic)
      .execute([&] {
        const double exposureEv = pack.scene.exposureEv;
        std::optional<image::Image> alpha;
        if (a.alpha) alpha = withAlpha(image, embree::coverage(job.scene(), job.parameters(), a.job.threads));
        written = writeOutputs(a, image, alpha ? &*alpha : nullptr, exposureEv);
        if (!sensor) return;
        const nlohmann::json scene = {{"scene", pack.scene.name},
                                      {"pack", fmt::format("{:016x}", pack.hash)},
                                      {"renderer", backend},
                                      {"method", job.method()}};
        const std::vector<std::string> files =
            writeSensorOutputs(a.sensor, *sensor, image, job.parameters().region, exposureEv, scene, a.compression);
        written.insert(written.end(), files.begin(), files.end());
      });
  renderTruth(a, job, pack, written);
  console::progressDone();
  printResult(a, job, pack.scene.name, result, written);
}

void addOutputOptions(CLI::App& command, RenderArguments& a) {
  command.add_option("-o,--output", a.outputs, "Image to write: .exr (all channels) or .png; can be given twice")
      ->expected(1)
      ->take_all()
      ->check(outputName())
      ->type_name("FILE");
  command
      .add_option("--output-dolp", a.dolp,
                  "Degree of linear polarization before the filter: .exr (0 to 1, per colour) or .png (viridis)")
      ->check(outputName())
      ->type_name("FILE");
  command
      .add_option("--output-aolp", a.aolp,
                  "Angle of linear polarization before the filter: .exr (radians, per colour) or .png (hues)")
      ->check(outputName())
      ->type_name("FILE");
  command
      .add_option("--ground-truth", a.truth,
                  "Geometry at the centre of each pixel: depth, normals, indices, angle of incidence, ...: .exr")
      ->check(outputName())
      ->type_name("FILE");
  CLI::Option* mosaic =
      command.add_option("--mosaic", a.mosaic, "Raw image of a polarization camera, rows 90 45 / 135 0: .png or .tif")
          ->check(outputName())
          ->type_name("FILE");
  command.add_option("--mosaic-bits", a.mosaicBits, "Bits per pixel of the mosaic; 12 are stored unshifted in 16")
      ->check(CLI::IsMember({8u, 12u, 16u}))
      ->transform(wholeNumberBetween(8, 16))
      ->capture_default_str()
      ->needs(mosaic);
  command.add_option("--mosaic-channel", a.mosaicChannel, "Light that the sensor of the mosaic measures")
      ->transform(CLI::IsMember({"luminance", "r", "g", "b"}, CLI::ignore_case))
      ->capture_default_str()
      ->needs(mosaic);
  addSensorOptions(command, a.sensor);
  addExposure(command, a.exposure);
  addCompression(command, a.compression);
  command.add_flag("--alpha", a.alpha, "Add alpha to .exr files: share of a pixel's rays that meet a surface");
  command.add_flag("--intensity", a.intensity, "Leave the Stokes channels out of .exr files");
  command.add_flag("--json", a.json, "Print the result as JSON");
}

void addMethodOptions(CLI::App& command, JobSettings& job) {
  addEffects(command, job.effects);
  CLI::Option* maxError =
      command
          .add_option("--max-error", job.maxError,
                      "Choose method, effects, depth and tolerance: the fastest within this relative RMS error")
          ->transform(numberBetween(0, 1e6))
          ->excludes(command.get_option("--method"));
  command
      .add_option("--max-ms", job.maxMs,
                  "Choose them: the most accurate that is expected to trace the image in this time [ms]")
      ->transform(numberBetween(1e-3, 1e9))
      ->excludes(maxError)
      ->excludes(command.get_option("--method"));
  command.add_flag("--stokes", job.stokes, "Iterative methods: Stokes channels too, by four times the rays");
  command
      .add_option("--tolerance", job.tolerance,
                  "Iterative methods: share of a light's radiance that a path may lose; 0 is exact")
      ->transform(numberBetween(0, 1))
      ->capture_default_str();
  command.add_flag("--count-rays", job.countRays, "Count the rays even if that takes a second, untimed pass");
  command.add_flag("--check-numerics", job.checkNumerics,
                   "Report the first unphysical value (NaN, infinite, negative, over-polarized) and write nothing");
}

}  // namespace

void addRenderCommand(CLI::App& app) {
  auto a = std::make_shared<RenderArguments>();
  CLI::App* command = app.add_subcommand("render", "Render a scene pack or a model file");
  addJobOptions(*command, a->input, a->job);
  addView(*command, a->view);
  addFilterOptions(*command, a->filter);
  addMethodOptions(*command, a->job);
  addOutputOptions(*command, *a);
  command->callback([a] { runRender(*a); });
}

void listMethods() {
  for (const MethodInfo& m : methods()) console::printLine("{:<17} {:>2} bytes per ray", m.name, m.payloadBytes);
}

}  // namespace malus::render
