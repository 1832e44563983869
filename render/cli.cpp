#include "render/cli.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bake/pack/format.h"
#include "bake/pack/reader.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/image.h"
#include "render/compare/cheapest_method.h"
#include "render/compare/image_difference.h"
#include "render/image/mosaic.h"
#include "render/image/output.h"
#include "render/image/polarization.h"
#include "render/make_renderer.h"
#include "render/method_option.h"
#include "render/scene/effects_choice.h"
#include "render/scene/methods.h"
#include "render/vulkan/renderer.h"

namespace malus::render {

namespace {

// A number that is one: CLI11's ranges let NaN through.
CLI::Validator finite() {
  return {[](std::string& text) {
            double value = 0;
            return CLI::detail::lexical_cast(text, value) && std::isfinite(value) ? std::string()
                                                                                  : text + " is no number";
          },
          "NUMBER"};
}

struct RenderArguments : RenderSettings {
  std::optional<double> maxError;
  std::vector<std::string> outputs;
  std::string effects = "auto";  // or "all", or names with commas between
  std::string dolp, aolp, mosaic;
  std::string inPlaceOf;  // which method was asked for, and why another was taken; empty: none
  std::optional<double> polarizer, exposure;
  std::string analyser, wavePlate, mosaicChannel = "luminance";
  unsigned mosaicBits = 8;
  double tolerance = 0;
  bool json = false, countRays = false, checkNumerics = false, intensity = false, stokes = false;
};

// "AXIS" or "AXIS,RETARDANCE" in degrees.
std::optional<WavePlate> parseWavePlate(std::string_view text) {
  const auto number = [](std::string_view part) -> std::optional<double> {
    if (!part.empty() && part.front() == '+') part.remove_prefix(1);
    double value = 0;
    const auto [end, failed] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (failed != std::errc() || end != part.data() + part.size() || !std::isfinite(value)) return std::nullopt;
    return value;
  };
  const std::size_t comma = text.find(',');
  const std::optional<double> axis = number(text.substr(0, comma));
  const std::optional<double> retardance =
      comma == std::string_view::npos ? WavePlate{}.retardanceDegrees : number(text.substr(comma + 1));
  if (!axis || !retardance) return std::nullopt;
  return WavePlate{*axis, *retardance};
}
CLI::Validator wavePlate() {
  return {[](std::string& text) { return parseWavePlate(text) ? "" : text + " is no AXIS[,RETARDANCE] in degrees"; },
          "AXIS[,RETARDANCE]"};
}

Analyser analyserFor(const RenderArguments& a) {
  Analyser analyser = kNoFilter;
  if (a.polarizer) analyser = linearPolarizer(*a.polarizer);
  if (!a.analyser.empty()) analyser = circularAnalyser(a.analyser == "right" ? Handedness::right : Handedness::left);
  if (const auto plate = parseWavePlate(a.wavePlate)) analyser = behindWavePlate(analyser, *plate);
  return analyser;
}

// What the filter asks of light that the method does not carry.
void warnOfMissingLight(const RenderArguments& a, const Analyser& analyser) {
  if (!a.wavePlate.empty() && !a.polarizer && a.analyser.empty())
    console::warn("--wave-plate: a plate without --polarizer or --analyser behind it changes no intensity");
  if (!backendInfo(a.backend).hasMethods) return;
  const MethodInfo& method = methodNamed(a.method);
  const bool linear = (analyser[1] != 0 || analyser[2] != 0) && !method.carriesLinear(),
             circular = analyser[3] != 0 && !method.carriesCircular();
  if (!linear && !circular) return;
  console::warn(fmt::format("--method {} carries no {} light ({}): of that the filter passes half, whatever its state",
                            a.method,
                            linear && circular ? "polarized"
                            : linear           ? "linearly polarized"
                                               : "circularly polarized",
                            linear && circular ? "S1, S2, S3"
                            : linear           ? "S1, S2"
                                               : "S3"));
}

const std::map<std::string, MosaicChannel> kMosaicChannels = {{"luminance", MosaicChannel::luminance},
                                                              {"R", MosaicChannel::red},
                                                              {"G", MosaicChannel::green},
                                                              {"B", MosaicChannel::blue}};

bool endsWith(const std::string& file, std::initializer_list<const char*> extensions) {
  const auto extension = std::filesystem::path(file).extension();
  return std::any_of(extensions.begin(), extensions.end(), [&](const char* e) { return extension == e; });
}

// Combinations of options that make no picture.
void checkUsage(const RenderArguments& a) {
  const auto fail = [](const std::string& option, const std::string& problem) {
    throw CLI::ValidationError(option, problem);
  };
  std::vector<std::string> files = a.outputs;
  for (const std::string& file : {a.dolp, a.aolp, a.mosaic})
    if (!file.empty()) files.push_back(file);
  if (files.empty()) fail("--output", "no picture asked for: give -o, --output-dolp, --output-aolp or --mosaic");
  if (std::set<std::string>(files.begin(), files.end()).size() != files.size())
    fail("--output", "one file cannot hold two pictures");
  for (const std::string& file : {a.dolp, a.aolp})
    if (!file.empty() && !endsWith(file, {".exr", ".png"}))
      fail("--output-dolp, --output-aolp", file + " is no .exr or .png");
  if (!a.mosaic.empty() && !endsWith(a.mosaic, {".png", ".tif", ".tiff"}))
    fail("--mosaic", a.mosaic + " is no .png or .tif");
  if (a.polarizer && !a.analyser.empty())
    fail("--analyser", "the filter is either linear (--polarizer) or circular (--analyser)");
  if (!a.mosaic.empty() && (a.polarizer || !a.analyser.empty() || !a.wavePlate.empty()))
    fail("--mosaic", "has a polarizer in front of every pixel: no --polarizer, --analyser or --wave-plate");
  if (a.maxError && !backendInfo(a.backend).hasMethods) fail("--max-error", "the reference has no error");
  if (a.tolerance > 0 && a.maxError) fail("--tolerance", "excludes --max-error");
  if (a.intensity && a.stokes) fail("--intensity", "excludes --stokes");
  if (a.tolerance > 0 && (!backendInfo(a.backend).hasMethods || !methodNamed(a.method).isIterative))
    fail("--tolerance", fmt::format("needs a method that follows the eye's path (importance, fresnel-iterative, "
                                    "schlick-iterative), not {}",
                                    methodName(a.backend, a.method)));
  if (a.stokes && !a.maxError) requireStokes(a, "--stokes");
  if (a.intensity && (!a.dolp.empty() || !a.aolp.empty() || !a.mosaic.empty()))
    fail("--intensity", "excludes --output-dolp, --output-aolp and --mosaic");
  if (!a.maxError && (!a.dolp.empty() || !a.aolp.empty() || !a.mosaic.empty()))
    requireStokes(a, !a.mosaic.empty() ? "--mosaic" : a.dolp.empty() ? "--output-aolp" : "--output-dolp");
}

}  // namespace

void requireStokes(const RenderSettings& a, const std::string& option) {
  if (!backendInfo(a.backend).hasMethods || methodNamed(a.method).hasStokes) return;
  std::string able;
  for (const MethodInfo& m : methods())
    if (m.hasStokes) able += fmt::format("{}{}", able.empty() ? "" : ", ", m.name);
  throw CLI::ValidationError(
      option,
      fmt::format("needs Stokes vectors, which --method {} does not have: take --method {}, or --backend reference",
                  a.method, able));
}

RenderParameters parametersFor(const RenderSettings& a, const pack::Scene& scene) {
  RenderParameters parameters = defaultParameters(scene);
  const double aspect = static_cast<double>(scene.width) / scene.height;
  if (a.width > 0) parameters.width = a.width;
  if (a.height > 0) parameters.height = a.height;
  if (a.width > 0 && a.height == 0)
    parameters.height = std::max(1u, static_cast<std::uint32_t>(std::lround(a.width / aspect)));
  if (a.height > 0 && a.width == 0)
    parameters.width = std::max(1u, static_cast<std::uint32_t>(std::lround(a.height * aspect)));
  if (parameters.width > pack::kMaxResolution || parameters.height > pack::kMaxResolution)
    throw Error("--width, --height", "make a picture that is too large",
                fmt::format("at most {} a side", pack::kMaxResolution),
                fmt::format("{} x {}", parameters.width, parameters.height));
  parameters.region = {0, 0, parameters.width, parameters.height};
  if (!a.region.empty()) {
    parameters.region = {a.region[0], a.region[1], a.region[2], a.region[3]};
    const Region& r = parameters.region;
    if (r.width == 0 || r.height == 0 || r.x >= parameters.width || r.y >= parameters.height ||
        r.width > parameters.width - r.x || r.height > parameters.height - r.y)
      throw Error("--region", "does not lie in the picture",
                  fmt::format("x y width height within {} x {}", parameters.width, parameters.height),
                  fmt::format("{} {} {} {}", r.x, r.y, r.width, r.height));
  }
  parameters.samples = a.samples;
  if (a.depth) parameters.depth = *a.depth;
  return parameters;
}

RenderResult renderScene(const RenderSettings& a, const pack::Scene& scene, const RenderParameters& parameters,
                         bool countRays) {
  const std::unique_ptr<Renderer> renderer = makeRenderer(a.backend, scene, {a.device, a.threads});
  RenderResult picture = renderer->render(a.method, parameters);
  if (countRays && picture.cost.rays == 0) picture.cost.rays = renderer->countRays(a.method, parameters);
  return picture;
}

namespace {

// The colour channels alone.
RenderResult intensityOf(RenderResult picture) {
  for (std::size_t i = 0; i < std::size_t{picture.width} * picture.height; ++i)
    for (std::size_t c = 0; c < kColourChannels; ++c)
      picture.pixels[i * kColourChannels + c] = picture.pixels[i * picture.channels + c];
  picture.channels = kColourChannels;
  picture.pixels.resize(kColourChannels * picture.width * picture.height);
  return picture;
}

// What of the picture is asked for: its Stokes vectors where a file holds them.
bake::ImageRequest requestOf(const RenderArguments& a, const RenderParameters& parameters) {
  const bool stokesFile = !a.intensity && hasStokes(a.backend, a.method, parameters) &&
                          std::any_of(a.outputs.begin(), a.outputs.end(),
                                      [](const std::string& output) { return endsWith(output, {".exr"}); });
  bake::ImageRequest request{parameters.depth, parameters.analyser, false, false};
  request.linearStokes = stokesFile || !a.dolp.empty() || !a.aolp.empty() || !a.mosaic.empty();
  request.circularStokes = stokesFile;
  return request;
}

// Method, view and scene for the effects that are asked for; says what it took instead, and warns of what is missing.
pack::Scene applyEffects(RenderArguments& a, const pack::Scene& scene, RenderParameters& parameters) {
  std::vector<std::string> effects;
  for (std::size_t at = 0; at <= a.effects.size();) {
    const std::size_t comma = std::min(a.effects.find(',', at), a.effects.size());
    effects.push_back(a.effects.substr(at, comma - at));
    at = comma + 1;
  }
  parameters.everyEffect = a.effects == "all";
  // The reference carries everything, always.
  const EffectsChoice choice =
      chooseEffects(effects, backendInfo(a.backend).hasMethods ? a.method : completeRecursiveMethod().name, scene,
                    requestOf(a, parameters));
  // The reference keeps its polarized light whatever is left out.
  for (const EffectWarning& warning : choice.warnings)
    if (backendInfo(a.backend).hasMethods || !isPolarization(warning.effect)) console::warn(warning.text);
  if (backendInfo(a.backend).hasMethods && choice.method != a.method) {
    if (!choice.why.empty()) a.inPlaceOf = fmt::format("in place of {}: {}", a.method, choice.why);
    a.method = choice.method;
  }
  const auto isOff = [&](const char* name) {
    return std::find(choice.off.begin(), choice.off.end(), name) != choice.off.end();
  };
  if (isOff("shadows")) parameters.shadows = false;
  if (isOff("filter")) parameters.analyser = kNoFilter;
  return choice.off.empty() ? scene : bake::withoutEffects(scene, choice.off);
}

// The cheapest method that is good enough, and why, for a person.
std::string chooseMethod(const RenderArguments& a, const pack::Pack& pack, const RenderParameters& parameters) {
  const bool needsStokes = parameters.stokes;
  const std::unique_ptr<Renderer> renderer = makeRenderer(a.backend, pack.scene, {a.device, a.threads});
  std::vector<MethodEstimate> estimates = estimateMethods(pack, parameters, *renderer, a.threads, console::progress);
  if (needsStokes) std::erase_if(estimates, [](const MethodEstimate& e) { return !methodNamed(e.method).hasStokes; });
  const MethodEstimate& best = cheapestUnder(estimates, *a.maxError);
  console::progressDone();
  fmt::print(stderr, "malus: {}: relative RMS error {:.3g} on a small picture, {:.1f} ms; the fastest within {:g}\n",
             best.method, best.relRms, best.medianMs, *a.maxError);
  return best.method;
}

void runRender(RenderArguments a) {
  checkUsage(a);
  for (const std::string& output : a.outputs)
    if (const auto e = std::filesystem::path(output).extension(); e != ".exr" && e != ".png")
      throw Error(output, "unknown kind of picture", ".exr or .png", e.empty() ? "no extension" : e.string());
  const pack::Pack pack = pack::read(a.input);
  RenderParameters parameters = parametersFor(a, pack.scene);
  parameters.analyser = analyserFor(a);
  if (!a.mosaic.empty() && (parameters.region.width % 2 != 0 || parameters.region.height % 2 != 0))
    throw CLI::ValidationError("--mosaic",
                               fmt::format("needs an even width and height (--width, --height), not {} x {}",
                                           parameters.region.width, parameters.region.height));
  parameters.tolerance = a.tolerance;
  parameters.stokes = a.stokes || !a.dolp.empty() || !a.aolp.empty() || !a.mosaic.empty();
  if (a.maxError) a.method = chooseMethod(a, pack, parameters);
  warnOfMissingLight(a, parameters.analyser);
  const pack::Scene scene = applyEffects(a, pack.scene, parameters);
  if (!a.dolp.empty() || !a.aolp.empty() || !a.mosaic.empty())
    requireStokes(a, !a.mosaic.empty() ? "--mosaic" : a.dolp.empty() ? "--output-aolp" : "--output-dolp");
  const std::string backend = backendInfo(a.backend).name;
  console::progress(fmt::format("rendering {} with {} {}", pack.scene.name, backend,
                                backendInfo(a.backend).hasMethods ? a.method : ""));
  parameters.checkNumerics = a.checkNumerics;
  const RenderResult picture = renderScene(a, scene, parameters, a.countRays);
  if (picture.faults.count > 0) throw Error(a.input, describe(picture.faults, pack.scene));
  const std::string method = methodName(a.backend, a.method);
  const image::Image image = toImage(a.intensity ? intensityOf(picture) : picture, pack, parameters, backend, method);
  const double exposureEv = a.exposure.value_or(pack.scene.exposureEv);
  std::vector<std::string> written;
  const auto write = [&](const std::string& output, const auto& writer) {
    if (output.empty()) return;
    console::progress(fmt::format("writing {}", output));
    writer(output);
    written.push_back(output);
  };
  for (const std::string& output : a.outputs)
    write(output, [&](const std::string& file) { writeImage(file, image, exposureEv); });
  write(a.dolp, [&](const std::string& file) { writeDolp(file, image); });
  write(a.aolp, [&](const std::string& file) { writeAolp(file, image); });
  write(a.mosaic, [&](const std::string& file) {
    writeMosaic(file, mosaic(image, {a.mosaicBits, kMosaicChannels.at(a.mosaicChannel), exposureEv}));
  });
  console::progressDone();
  const Cost& cost = picture.cost;
  if (a.json) {
    const nlohmann::json result = {{"scene", pack.scene.name},
                                   {"renderer", backend},
                                   {"method", method},
                                   {"device", picture.device},
                                   {"width", picture.width},
                                   {"height", picture.height},
                                   {"depth", parameters.depth},
                                   {"samples", parameters.samples},
                                   {"rays", cost.rays == 0 ? nlohmann::json() : nlohmann::json(cost.rays)},
                                   {"buildMs", cost.buildMs},
                                   {"traceMs", cost.traceMs},
                                   {"wallMs", cost.wallMs},
                                   {"numericsChecked", a.checkNumerics},
                                   {"effects", a.effects},
                                   {"inPlaceOf", a.inPlaceOf.empty() ? nlohmann::json() : nlohmann::json(a.inPlaceOf)},
                                   {"outputs", written}};
    fmt::print("{}\n", result.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    fmt::print("{}: {} {}{}, {} x {}, depth {}, {}{:.1f} ms on {}{}\n", pack.scene.name, backend, method,
               a.inPlaceOf.empty() ? "" : fmt::format(" ({})", a.inPlaceOf), picture.width, picture.height,
               parameters.depth, cost.rays > 0 ? fmt::format("{} rays, ", cost.rays) : "", cost.traceMs, picture.device,
               a.checkNumerics ? "; every value is finite and physical" : "");
  }
}

struct CompareArguments {
  std::string a, b, difference;
  std::vector<std::string> channels = {"R", "G", "B"};
  double threshold = 1e-3, gain = 10;
  std::optional<double> failOver;
  bool json = false;
};

void runCompareImages(const CompareArguments& arguments) {
  const image::Image a = image::read(arguments.a), b = image::read(arguments.b);
  ImageDifference d;
  try {
    d = difference(a, b, arguments.channels, arguments.threshold);
  } catch (const Error& error) {
    throw Error(fmt::format("{}, {}", arguments.a, arguments.b), error.what());
  }
  if (!arguments.difference.empty()) writeImage(arguments.difference, differenceImage(a, b, arguments.gain), 0);
  if (arguments.json) {
    const auto number = [](double v) {
      return std::isfinite(v) ? nlohmann::json(v) : nlohmann::json();
    };  // JSON has no infinity
    const nlohmann::json result = {{"mean", d.mean},         {"rms", d.rms},
                                   {"max", number(d.max)},   {"p999", number(d.p999)},
                                   {"outliers", d.outliers}, {"nonFinite", d.nonFinite},
                                   {"pixels", d.pixels},     {"threshold", arguments.threshold}};
    fmt::print("{}\n", result.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    fmt::print("mean {:.6g}  rms {:.6g}  max {:.6g}  99.9 % {:.6g}  outliers over {:g}: {} of {} pixels{}\n", d.mean,
               d.rms, d.max, d.p999, arguments.threshold, d.outliers, d.pixels,
               d.nonFinite > 0 ? fmt::format(", {} with NaN or infinity", d.nonFinite) : "");
  }
  if (arguments.failOver && !(d.max <= *arguments.failOver)) throw ImagesDiffer{};
}

}  // namespace

void addRenderSettings(CLI::App& command, RenderSettings& a) {
  command.add_option("pack", a.input, "scene pack")->required();
  command
      .add_option_function<std::string>(
          "--backend", [&a](const std::string& name) { a.backend = backendNamed(name); }, "renderer")
      ->check(CLI::IsMember(backendNames()))
      ->default_str(backendInfo(a.backend).name);
  command.add_option("--method", a.method, "how light is carried along rays")
      ->transform(methodName())
      ->capture_default_str();
  command.add_option("--width", a.width, "picture width (default: the pack's; height keeps the aspect)")
      ->check(CLI::Range(1u, 16384u));
  command.add_option("--height", a.height, "picture height")->check(CLI::Range(1u, 16384u));
  command.add_option("--depth", a.depth, "most specular interactions along a path (default: the pack's)")
      ->check(CLI::Range(0u, pack::kMaxDepth));
  command.add_option("--samples", a.samples, "rays a pixel along each axis")
      ->check(CLI::Range(1u, 64u))
      ->capture_default_str();
  command.add_option("--region", a.region, "part of the picture: x y width height")->expected(4);
  command.add_option("--threads", a.threads, "CPU threads, 0 for all")
      ->check(CLI::Range(0u, 1024u))
      ->capture_default_str();
  command.add_option("--device", a.device, "Vulkan device: number or part of its name from --list-devices");
}

CLI::Option* addExposure(CLI::App& command, std::optional<double>& exposure, const std::string& description) {
  return command.add_option("--exposure", exposure, description + " in stops (default: the pack's)")
      ->check(finite())
      ->check(CLI::Range(-100.0, 100.0));
}

void addRenderCommand(CLI::App& app) {
  auto a = std::make_shared<RenderArguments>();
  CLI::App* command = app.add_subcommand("render", "Renders a scene pack");
  addRenderSettings(*command, *a);
  command->add_option("-o,--output", a->outputs, "picture to write: .exr (all channels) or .png; may be given twice")
      ->expected(1)
      ->take_all();
  command
      ->add_option("--polarizer", a->polarizer,
                   "linear polarizer in front of the camera: degrees from the picture's x axis, counter-clockwise")
      ->check(finite());
  command->add_option("--analyser", a->analyser, "circular analyser in front of the camera: passes right or left")
      ->check(CLI::IsMember({"right", "left"}));
  command
      ->add_option("--wave-plate", a->wavePlate,
                   "retarder in front of the polarizer: degrees of its fast axis and of its retardance (default 90)")
      ->check(wavePlate());
  command->add_option("--output-dolp", a->dolp,
                      "degree of linear polarization before the filter: .exr (0 to 1, per colour) or .png (viridis)");
  command->add_option("--output-aolp", a->aolp,
                      "angle of linear polarization before the filter: .exr (radians, per colour) or .png (hues)");
  CLI::Option* mosaicFile = command->add_option(
      "--mosaic", a->mosaic, "raw picture of a polarization camera, rows 90 45 / 135 0: .png or .tif");
  command->add_option("--mosaic-bits", a->mosaicBits, "of the mosaic; 12 lie unshifted in 16")
      ->check(CLI::IsMember({8u, 12u, 16u}))
      ->capture_default_str()
      ->needs(mosaicFile);
  command->add_option("--mosaic-channel", a->mosaicChannel, "light that the mosaic's sensor sees")
      ->check(CLI::IsMember({"luminance", "R", "G", "B"}))
      ->capture_default_str()
      ->needs(mosaicFile);
  addExposure(*command, a->exposure, "exposure of PNG files and mosaics");
  command->add_flag("--count-rays", a->countRays, "vulkan: trace once more, untimed, to count the rays");
  command
      ->add_option(
          "--effects", a->effects,
          "auto (what the picture calls for), all, or a list of the effects to keep, as 'malus info' names them")
      ->capture_default_str();
  command->add_flag("--stokes", a->stokes, "importance: Stokes channels too, by four analysers (four times the rays)");
  command
      ->add_option("--tolerance", a->tolerance,
                   "importance and the loops: share of a light's radiance that a path may lose, and of its own that "
                   "polarization may be, before it is left out; 0 is exact")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_flag("--intensity", a->intensity, "only the intensity: no Stokes channels in .exr files");
  command->add_flag("--check-numerics", a->checkNumerics,
                    "find the first value that no light can have (NaN, infinity, negative, more than fully polarized): "
                    "names it and writes nothing");
  command->add_flag("--json", a->json, "print the result as JSON");
  command
      ->add_option("--max-error", a->maxError,
                   "take the fastest method whose relative RMS error on this pack is at most this, instead of --method")
      ->check(CLI::Range(0.0, 1e6));
  command->callback([a] { runRender(*a); });
}

void addCompareImagesCommand(CLI::App& app) {
  auto a = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand("compare-images", "Tells how far two pictures are apart");
  command->add_option("a", a->a, "picture")->required();
  command->add_option("b", a->b, "picture")->required();
  command->add_option("--channels", a->channels, "channels to compare")->capture_default_str();
  command->add_option("--threshold", a->threshold, "difference over which a pixel is an outlier")
      ->check(finite())
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--fail-over", a->failOver, "exit with 3 where the largest difference is over this")
      ->check(finite())
      ->check(CLI::NonNegativeNumber);
  command->add_option("--difference", a->difference, "picture to write: absolute difference times --gain");
  command->add_option("--gain", a->gain, "of the difference picture")
      ->check(finite())
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_flag("--json", a->json, "print the result as JSON");
  command->callback([a] { runCompareImages(*a); });
}

void listMethods() {
  for (const MethodInfo& m : methods()) fmt::print("{:<14} {:>2} bytes a ray\n", m.name, m.payloadBytes);
}

void listDevices() {
  int number = 0;
  for (const vulkan::DeviceDescription& d : vulkan::devices())
    fmt::print("{}  {}; driver {}{}{}\n", number++, d.name, d.driver,
               d.problem.empty() ? "" : "; not usable: " + d.problem, d.isDefault ? "; used by default" : "");
}

}  // namespace malus::render
