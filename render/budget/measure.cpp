#include "render/budget/measure.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "bake/pack/format.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/cache_folder.h"
#include "meshprep/base/error.h"
#include "render/ablation/variants.h"
#include "render/budget/display_error.h"
#include "render/compare/statistics.h"
#include "render/compare/time_limit.h"
#include "render/make_renderer.h"
#include "render/scene/methods.h"

namespace malus::render {
namespace fs = std::filesystem;
using nlohmann::json;

namespace {

using Kind = MeasuredChoice::Kind;

constexpr int kRounds = 5;                                              // after a first pass, which is timed too
constexpr double kRoundMinutes = 1. / 6;                                // no further round is started after them
constexpr double kTolerances[] = {1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2};  // of iterative methods
constexpr const char* kKinds[] = {"method", "effect", "depth", "tolerance"};

// A choice and what renders it.
struct Subject {
  MeasuredChoice choice;
  std::string method;
  RenderParameters parameters;
  std::shared_ptr<const pack::Scene> scene;
  std::vector<double> samples{};
};

fs::path cacheFile(const std::string& key) {
  const fs::path folder = cacheFolder("errors");
  if (folder.empty()) return {};
  return folder / fmt::format("{:016x}.json", pack::hashBytes(std::as_bytes(std::span(key))));
}

json toJson(const MeasuredChoice& choice) {
  return {{"kind", kKinds[static_cast<std::size_t>(choice.kind)]},
          {"name", choice.name},
          {"depth", choice.depth},
          {"tolerance", choice.tolerance},
          {"error", choice.error},
          {"medianMs", choice.milliseconds}};
}

MeasuredChoice choiceFrom(const json& entry) {
  MeasuredChoice choice;
  const auto kind = std::find(std::begin(kKinds), std::end(kKinds), entry.at("kind").get<std::string>());
  if (kind == std::end(kKinds)) throw Error("", "unknown kind");
  choice.kind = static_cast<Kind>(kind - std::begin(kKinds));
  choice.name = entry.at("name").get<std::string>();
  choice.depth = entry.at("depth").get<std::uint32_t>();
  choice.tolerance = entry.at("tolerance").get<double>();
  choice.error = entry.at("error").get<double>();
  choice.milliseconds = entry.at("medianMs").get<double>();
  return choice;
}

// Nothing if there is no cache, or if another key has the same hash.
std::optional<Measurements> load(const fs::path& path, const std::string& key) {
  std::error_code ignored;
  if (path.empty() || !fs::exists(path, ignored)) return std::nullopt;
  try {
    const json document = json::parse(readTextFile(path, std::size_t{1} << 20));
    if (document.at("key") != key) return std::nullopt;
    Measurements result;
    result.precision = document.at("precision").get<double>();
    for (const json& entry : document.at("choices")) result.choices.push_back(choiceFrom(entry));
    return result;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

void save(const fs::path& path, const std::string& key, const Measurements& measurements) {
  if (path.empty()) return;
  json choices = json::array();
  for (const MeasuredChoice& choice : measurements.choices) choices.push_back(toJson(choice));
  try {
    fs::create_directories(path.parent_path());
    writeFile(path, json{{"key", key}, {"precision", measurements.precision}, {"choices", choices}}.dump(1));
  } catch (const std::exception&) {  // not an error: the next run measures again
  }
}

// Everything that is measured, the complete image first.
std::vector<Subject> subjects(const pack::Scene& scene, const RenderParameters& parameters, bool leaveOutEffects) {
  const std::string complete = completeRecursiveMethod().name;
  std::vector<Subject> list = {{{Kind::method, complete, parameters.depth}, complete, parameters, nullptr}};
  for (const MethodInfo& method : methods()) {
    if (parameters.stokes && !method.hasStokes) continue;
    if (method.name != complete)
      list.push_back({{Kind::method, method.name, parameters.depth}, method.name, parameters, nullptr});
    if (!method.isIterative) continue;
    for (const double tolerance : kTolerances) {
      Subject subject{{Kind::tolerance, method.name, parameters.depth, tolerance}, method.name, parameters, nullptr};
      subject.parameters.tolerance = tolerance;
      list.push_back(std::move(subject));
    }
  }
  if (!leaveOutEffects) return list;
  for (const Variant& variant : ablationVariants(scene, parameters)) {
    if (variant.kind == VariantKind::effect)
      list.push_back({{Kind::effect, variant.name, parameters.depth}, complete, variant.parameters, variant.scene});
    else if (variant.kind == VariantKind::depth)
      list.push_back({{Kind::depth, variant.name, variant.parameters.depth}, complete, variant.parameters, nullptr});
  }
  return list;
}

// The choices from `first` on that are compiled at once, one per processor, because they share a renderer.
std::span<Subject> preparedTogether(std::span<Subject> list, std::size_t first) {
  const std::size_t most = std::thread::hardware_concurrency();
  std::size_t count = 1;
  while (count < most && first + count < list.size() && list[first + count].scene == list[first].scene) ++count;
  return list.subspan(first, count);
}

RenderResult render(const Subject& s, RendererPool& renderers) {
  return renderers[s.scene].render(s.method, s.parameters);
}

// Renders each choice once until the time is over, and returns those that the device can render. leftOut: how many were
// not started.
std::vector<Subject> firstPass(std::span<Subject> list, const RenderResult& complete, double ev,
                               RendererPool& renderers, const TimeLimit& limit, const Progress& progress,
                               std::size_t& leftOut) {
  std::vector<Subject> rendered;
  std::size_t first = 0;
  while (first < list.size() && (first == 0 || !limit.isOver())) {
    const std::span<Subject> together = preparedTogether(list, first);
    std::vector<Preparation> preparations;
    for (const Subject& subject : together) preparations.push_back({subject.method, subject.parameters});
    progress(
        fmt::format("measuring on a small image: {} of {}, {}", first + 1, list.size(), together.front().choice.name));
    renderers[together.front().scene].prepare(preparations);
    for (Subject& subject : together) try {
        const RenderResult image = render(subject, renderers);
        subject.choice.error = displayError(image, complete, ev).relRms();
        subject.samples.push_back(image.cost.traceMs);
        rendered.push_back(std::move(subject));
      } catch (const Error&) {  // not on this device at this depth
      }
    first += together.size();
  }
  leftOut = list.size() - first;
  return rendered;
}

Measurements measure(const pack::Pack& pack, const RenderParameters& parameters, RendererPool& renderers,
                     unsigned threads, std::vector<Subject> list, const Progress& progress, double minutes) {
  progress("measuring methods and effects on a small image");
  const TimeLimit passLimit(minutes);
  const double ev = pack.scene.exposureEv;
  const RenderResult complete = render(list.front(), renderers);
  const RenderResult reference = makeRenderer(Backend::reference, pack.scene, {"", threads})->render("", parameters);
  Measurements result;
  result.precision = displayError(complete, reference, ev).relRms();
  std::vector<Subject> rendered = firstPass(list, complete, ev, renderers, passLimit, progress, result.leftOut);
  const TimeLimit limit(kRoundMinutes);
  for (int round = 0; round < kRounds && !(round > 0 && limit.isOver()); ++round) {
    progress(fmt::format("measuring times on a small image: round {} of {}", round + 1, kRounds));
    for (Subject& subject : rendered) subject.samples.push_back(render(subject, renderers).cost.traceMs);
  }
  for (Subject& subject : rendered) {
    subject.choice.milliseconds = computeSpread(subject.samples).median;
    result.choices.push_back(subject.choice);
  }
  return result;
}

// The scene of the pack may have another camera and exposure than the pack's, by --view and --exposure.
std::string viewKey(const pack::Scene& scene) {
  const pack::Camera& c = scene.camera;
  const auto vector = [](const glm::dvec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); };
  return fmt::format("camera {}, {}, {}, {}, {} {} {} {} {} {} exposure {}", vector(c.position), vector(c.right),
                     vector(c.up), vector(c.forward), c.verticalFovDegrees, c.mediumEta, c.orthographicHeight,
                     c.pixelAspect, c.middleX, c.middleY, scene.exposureEv);
}

std::string cacheKey(const pack::Pack& pack, const RenderParameters& p, const std::string& device,
                     bool leaveOutEffects) {
  return fmt::format(
      "malus {} errors of choices, pack {:016x} {} {} paths {} {} {}x{} region {} {} {} {} depth {} analyser {} {} {} "
      "{} stokes {} every effect {} effects {} light samples {} methods {}",
      MALUS_VERSION, pack.hash, viewKey(pack.scene), device, vulkanPathName(p.vulkanPath), embreePathName(p.embreePath),
      p.width, p.height, p.region.x, p.region.y, p.region.width, p.region.height, p.depth, p.analyser[0], p.analyser[1],
      p.analyser[2], p.analyser[3], p.stokes, p.everyEffect, leaveOutEffects, p.lightSamples,
      fmt::join(methodNames(), " "));
}

}  // namespace

RenderParameters smallParameters(const RenderParameters& full) {
  RenderParameters small = full;
  const double factor =
      std::min(1.0, static_cast<double>(kSmallSide) / std::max(full.region.width, full.region.height));
  const auto scaled = [&](std::uint32_t side) {
    return std::max(1u, static_cast<std::uint32_t>(std::lround(side * factor)));
  };
  small.width = scaled(full.width);
  small.height = scaled(full.height);
  small.region.x = std::min(static_cast<std::uint32_t>(full.region.x * factor), small.width - 1);
  small.region.y = std::min(static_cast<std::uint32_t>(full.region.y * factor), small.height - 1);
  small.region.width = std::min(scaled(full.region.width), small.width - small.region.x);
  small.region.height = std::min(scaled(full.region.height), small.height - small.region.y);
  small.samples = 1;
  return small;
}

Measurements measureChoices(const pack::Pack& pack, const RenderParameters& full, RendererPool& renderers,
                            unsigned threads, bool leaveOutEffects, const Progress& progress, double minutes) {
  const RenderParameters small = smallParameters(full);
  const std::string device = fmt::format("{} {}", backendInfo(renderers.backend()).name, renderers[nullptr].device());
  const std::string key = cacheKey(pack, small, device, leaveOutEffects);
  const fs::path path = cacheFile(key);
  std::optional<Measurements> result = load(path, key);
  if (!result) {
    result = measure(pack, small, renderers, threads, subjects(pack.scene, small, leaveOutEffects), progress, minutes);
    if (result->leftOut == 0) save(path, key, *result);
  }
  result->depth = full.depth;
  const auto samples = [](const RenderParameters& p) {
    return static_cast<double>(p.region.width) * p.region.height * p.samples * p.samples;
  };
  result->fullPixels = samples(full);
  result->measuredPixels = samples(small);
  return *result;
}

}  // namespace malus::render
