#include "render/cli.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bake/image/image.h"
#include "bake/pack/reader.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "render/compare/image_difference.h"
#include "render/embree/renderer.h"
#include "render/image/output.h"
#include "render/reference/reference.h"
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

struct RenderArguments {
  std::string input;
  std::vector<std::string> outputs;
  std::string backend = "embree", method = "fresnel", device;
  std::optional<double> polarizer, exposure;
  std::uint32_t width = 0, height = 0, samples = 1;
  std::optional<std::uint32_t> depth;
  std::vector<std::uint32_t> region;
  unsigned threads = 0;
  bool json = false, countRays = false;
};

View viewFor(const RenderArguments& a, const pack::Scene& scene) {
  View view = viewOf(scene);
  const double aspect = static_cast<double>(scene.width) / scene.height;
  if (a.width > 0) view.width = a.width;
  if (a.height > 0) view.height = a.height;
  if (a.width > 0 && a.height == 0)
    view.height = std::max(1u, static_cast<std::uint32_t>(std::lround(a.width / aspect)));
  if (a.height > 0 && a.width == 0)
    view.width = std::max(1u, static_cast<std::uint32_t>(std::lround(a.height * aspect)));
  if (view.width > pack::kMaxResolution || view.height > pack::kMaxResolution)
    throw Error("--width, --height", "make a picture that is too large",
                fmt::format("at most {} a side", pack::kMaxResolution),
                fmt::format("{} x {}", view.width, view.height));
  view.region = {0, 0, view.width, view.height};
  if (!a.region.empty()) {
    view.region = {a.region[0], a.region[1], a.region[2], a.region[3]};
    const Region& r = view.region;
    if (r.width == 0 || r.height == 0 || r.x >= view.width || r.y >= view.height || r.width > view.width - r.x ||
        r.height > view.height - r.y)
      throw Error("--region", "does not lie in the picture",
                  fmt::format("x y width height within {} x {}", view.width, view.height),
                  fmt::format("{} {} {} {}", r.x, r.y, r.width, r.height));
  }
  view.samples = a.samples;
  if (a.depth) view.depth = *a.depth;
  if (a.polarizer) view.analyser = linearPolarizer(*a.polarizer);
  return view;
}

void runRender(const RenderArguments& a) {
  for (const std::string& output : a.outputs)
    if (const auto e = std::filesystem::path(output).extension(); e != ".exr" && e != ".png")
      throw Error(output, "unknown kind of picture", ".exr or .png", e.empty() ? "no extension" : e.string());
  const pack::Pack pack = pack::read(a.input);
  const View view = viewFor(a, pack.scene);
  console::progress(
      fmt::format("rendering {} with {} {}", pack.scene.name, a.backend, a.backend == "reference" ? "" : a.method));
  Picture picture;
  std::string method = a.method;
  if (a.backend == "reference") {
    picture = reference::render(pack.scene, view, a.threads);
    method = "reference";
  } else if (a.backend == "embree") {
    picture = embree::Renderer(pack.scene, a.threads).render(a.method, view);
  } else {
    vulkan::Renderer renderer(pack.scene, {a.device, a.threads});
    picture = renderer.render(a.method, view);
    if (a.countRays) picture.cost.rays = renderer.countRays(a.method, view);
  }
  const image::Image image = toImage(picture, pack, view, a.backend, method);
  for (const std::string& output : a.outputs) {
    console::progress(fmt::format("writing {}", output));
    writePicture(output, image, a.exposure.value_or(pack.scene.exposureEv));
  }
  console::progressDone();
  const Cost& cost = picture.cost;
  if (a.json) {
    const nlohmann::json result = {{"scene", pack.scene.name},
                                   {"renderer", a.backend},
                                   {"method", method},
                                   {"device", picture.device},
                                   {"width", picture.width},
                                   {"height", picture.height},
                                   {"depth", view.depth},
                                   {"samples", view.samples},
                                   {"rays", cost.rays == 0 ? nlohmann::json() : nlohmann::json(cost.rays)},
                                   {"buildMs", cost.buildMs},
                                   {"traceMs", cost.traceMs},
                                   {"wallMs", cost.wallMs},
                                   {"outputs", a.outputs}};
    fmt::print("{}\n", result.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    fmt::print("{}: {} {}, {} x {}, depth {}, {}{:.1f} ms on {}\n", pack.scene.name, a.backend, method, picture.width,
               picture.height, view.depth, cost.rays > 0 ? fmt::format("{} rays, ", cost.rays) : "", cost.traceMs,
               picture.device);
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
  if (!arguments.difference.empty()) writePicture(arguments.difference, differencePicture(a, b, arguments.gain), 0);
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
  if (arguments.failOver && !(d.max <= *arguments.failOver)) throw PicturesDiffer{};
}

}  // namespace

void addRenderCommand(CLI::App& app) {
  auto a = std::make_shared<RenderArguments>();
  CLI::App* command = app.add_subcommand("render", "Renders a scene pack");
  command->add_option("pack", a->input, "scene pack")->required();
  command->add_option("-o,--output", a->outputs, "picture to write: .exr (all channels) or .png; may be given twice")
      ->required()
      ->expected(1)
      ->take_all();
  command->add_option("--backend", a->backend, "renderer")
      ->check(CLI::IsMember({"vulkan", "embree", "reference"}))
      ->capture_default_str();
  command->add_option("--method", a->method, "how light is carried along rays")
      ->check(CLI::IsMember(methodNames()))
      ->capture_default_str();
  command
      ->add_option("--polarizer", a->polarizer,
                   "linear polarizer in front of the camera: degrees from the picture's x axis, counter-clockwise")
      ->check(finite());
  command->add_option("--width", a->width, "picture width (default: the pack's; height keeps the aspect)")
      ->check(CLI::Range(1u, 16384u));
  command->add_option("--height", a->height, "picture height")->check(CLI::Range(1u, 16384u));
  command->add_option("--depth", a->depth, "most specular interactions along a path (default: the pack's)")
      ->check(CLI::Range(0u, 30u));
  command->add_option("--samples", a->samples, "rays a pixel along each axis")
      ->check(CLI::Range(1u, 64u))
      ->capture_default_str();
  command->add_option("--region", a->region, "part of the picture: x y width height")->expected(4);
  command->add_option("--threads", a->threads, "CPU threads, 0 for all")
      ->check(CLI::Range(0u, 1024u))
      ->capture_default_str();
  command->add_option("--device", a->device, "Vulkan device: number or part of its name from --list-devices");
  command->add_option("--exposure", a->exposure, "display exposure of PNG files in stops (default: the pack's)")
      ->check(finite())
      ->check(CLI::Range(-100.0, 100.0));
  command->add_flag("--count-rays", a->countRays, "vulkan: trace once more, untimed, to count the rays");
  command->add_flag("--json", a->json, "print the result as JSON");
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
  const std::vector<vulkan::DeviceDescription> devices = vulkan::devices();
  if (devices.empty())
    throw Error("Vulkan", "no device", "a driver such as Mesa's lavapipe (mesa-vulkan-drivers 24.3 or later)");
  for (std::size_t i = 0; i < devices.size(); ++i)
    fmt::print("{}  {} ({}){}\n", i, devices[i].name, devices[i].driver,
               devices[i].problem.empty() ? "" : ": " + devices[i].problem);
}

}  // namespace malus::render
