#include "render/compare/cheapest_method.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bake/pack/format.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/cache_folder.h"
#include "meshprep/base/error.h"
#include "render/compare/image_error.h"
#include "render/compare/statistics.h"
#include "render/make_renderer.h"
#include "render/scene/methods.h"

namespace malus::render {
namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::uint32_t kWidth = 256;
constexpr int kRounds = 5;

fs::path cacheFile(const std::string& key) {
  const fs::path folder = cacheFolder("errors");
  if (folder.empty()) return {};
  return folder / fmt::format("{:016x}.json", pack::hashBytes(std::as_bytes(std::span(key))));
}

// Empty if there is no cache, or if another key has the same hash.
std::vector<MethodEstimate> load(const fs::path& path, const std::string& key) {
  std::error_code ignored;
  if (path.empty() || !fs::exists(path, ignored)) return {};
  try {
    const json document = json::parse(readTextFile(path, std::size_t{1} << 20));
    std::vector<MethodEstimate> list;
    if (document.at("key") != key) return {};
    for (const json& e : document.at("estimates"))
      list.push_back({e.at("method").get<std::string>(), e.at("relRms").get<double>(), e.at("medianMs").get<double>(),
                      e.at("precisionRelRms").get<double>()});
    return list;
  } catch (const std::exception&) {
    return {};
  }
}

void save(const fs::path& path, const std::string& key, const std::vector<MethodEstimate>& list) {
  if (path.empty()) return;
  json estimates = json::array();
  for (const MethodEstimate& e : list)
    estimates.push_back(
        {{"method", e.method}, {"relRms", e.relRms}, {"medianMs", e.medianMs}, {"precisionRelRms", e.precisionRelRms}});
  try {
    fs::create_directories(path.parent_path());
    writeFile(path, json{{"key", key}, {"estimates", estimates}}.dump(1));
  } catch (const std::exception&) {  // not an error: the next run measures again
  }
}

}  // namespace

std::vector<MethodEstimate> estimateMethods(const pack::Pack& pack, const RenderParameters& full, Renderer& renderer,
                                            unsigned threads, const Progress& progress) {
  RenderParameters parameters = full;
  parameters.width = kWidth;
  parameters.height =
      std::max(1u, static_cast<std::uint32_t>(std::lround(static_cast<double>(kWidth) * full.height / full.width)));
  parameters.region = {0, 0, parameters.width, parameters.height};
  parameters.samples = 1;
  const std::string device = fmt::format("{} {}", backendInfo(renderer.backend()).name, renderer.device());
  const std::string key = fmt::format(
      "malus {} errors of methods, pack {:016x} {} paths {} {} {}x{} depth {} analyser {} {} {} {} stokes {} methods "
      "{}",
      MALUS_VERSION, pack.hash, device, vulkanPathName(parameters.vulkanPath), embreePathName(parameters.embreePath),
      parameters.width, parameters.height, parameters.depth, parameters.analyser[0], parameters.analyser[1],
      parameters.analyser[2], parameters.analyser[3], parameters.stokes, fmt::join(methodNames(), " "));
  const fs::path path = cacheFile(key);
  if (std::vector<MethodEstimate> known = load(path, key); !known.empty()) return known;

  progress("measuring the error of every method on a small image");
  const RenderResult reference = makeRenderer(Backend::reference, pack.scene, {"", threads})->render("", parameters);
  std::vector<Preparation> images;
  for (const std::string& method : methodNames()) images.push_back({method, parameters});
  renderer.prepare(images);
  const auto relRms = [&](const RenderResult& image, const RenderResult& truth) {
    return imageError(image, truth, pack.scene.exposureEv).relRms;
  };
  const RenderResult exact = renderer.render(completeRecursiveMethod().name, parameters);
  const double precision = relRms(exact, reference);
  std::vector<MethodEstimate> list;
  std::vector<std::vector<double>> samples;
  for (const std::string& method : methodNames()) try {
      list.push_back({method, relRms(renderer.render(method, parameters), exact), 0, precision});
      samples.emplace_back();
    } catch (const Error&) {  // not on this device at this depth
      if (method == methodNames().back() && list.empty()) throw;
    }
  for (int round = 0; round < kRounds; ++round)
    for (std::size_t i = 0; i < list.size(); ++i)
      samples[i].push_back(renderer.render(list[i].method, parameters).cost.traceMs);
  for (std::size_t i = 0; i < list.size(); ++i) list[i].medianMs = computeSpread(samples[i]).median;
  save(path, key, list);
  return list;
}

const MethodEstimate& cheapestUnder(const std::vector<MethodEstimate>& estimates, double maxError) {
  const MethodEstimate* best = nullptr;
  for (const MethodEstimate& e : estimates)
    if (e.relRms <= maxError && (!best || e.medianMs < best->medianMs)) best = &e;
  if (best) return *best;
  const auto least = std::min_element(estimates.begin(), estimates.end(),
                                      [](const auto& a, const auto& b) { return a.relRms < b.relRms; });
  throw Error("--max-error", fmt::format("no method is within {:g} on this pack", maxError),
              fmt::format("{:.3g} or more", least->relRms), fmt::format("'{}' as the most exact", least->method));
}

}  // namespace malus::render
