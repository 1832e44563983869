#include "render/compare/warm_up.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <thread>

#include <fmt/format.h>

#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "render/budget/display_error.h"
#include "render/compare/backend_order.h"
#include "render/compare/choice_rows.h"
#include "render/compare/effects_table.h"
#include "render/compare/packs.h"
#include "render/compare/paths_table.h"
#include "render/image/output.h"
#include "render/job.h"
#include "render/scene/compiled_effects.h"
#include "render/scene/methods.h"
#include "render/vulkan/device_description.h"

namespace malus::render {

namespace {

// Folder of the images, and receiver of progress messages.
struct Output {
  std::filesystem::path images;
  const Progress& progress;
};

// A view's share of the time for the first pass.
struct Share {
  const TimeLimit& limit;
  std::size_t view, views;
  std::optional<TimeLimit> compiling{};  // of one renderer
  bool isOver() const { return limit.isFirstPassOver(view, views) || (compiling && compiling->isOver()); }
};

std::string fileName(const RowGroup& group, const std::string& what) {
  const RenderParameters& p = group.parameters;
  return fmt::format("{}-{}x{}-d{}-{}.exr", safeName(group.pack->scene.name), p.width, p.height, p.depth, what);
}

// Every size with every depth.
std::vector<RenderParameters> views(const pack::Scene& scene, const ComparisonSettings& settings) {
  std::vector<JobSettings> sizes(std::max({settings.widths.size(), settings.heights.size(), std::size_t{1}}));
  for (std::size_t i = 0; i < settings.widths.size(); ++i) sizes[i].width = settings.widths[i];
  for (std::size_t i = 0; i < settings.heights.size(); ++i) sizes[i].height = settings.heights[i];
  if (settings.widths.empty() && settings.heights.empty())
    sizes[0].width = std::max(1u, static_cast<std::uint32_t>(std::lround(scene.width * settings.scale)));
  std::vector<RenderParameters> result;
  for (JobSettings& size : sizes) {
    if (settings.polarizerDegrees) size.analyser = linearPolarizer(*settings.polarizerDegrees);
    for (const std::uint32_t depth : settings.depths.empty() ? std::vector{scene.depth} : settings.depths) {
      size.depth = depth;
      result.push_back(renderParameters(size, scene));
    }
  }
  return result;
}

RenderResult renderReference(Comparison& comparison, const RowGroup& group, unsigned threads, const Output& output) {
  output.progress(groupTitle(group) + ": reference");
  const pack::Pack& pack = *group.pack;
  const RenderParameters& p = group.parameters;
  const std::unique_ptr<Renderer> renderer = makeRenderer(Backend::reference, pack.scene, {"", threads});
  RenderResult result = renderImage(*renderer, "", p, false);
  const std::string name = backendInfo(Backend::reference).name, file = fileName(group, name);
  comparison.devices[name] = result.device;
  comparison.references.push_back({pack.scene.name, p.width, p.height, p.depth, file});
  writeImage(output.images / file, toImage(result, pack, p, name, name), 0);
  return result;
}

// A row before it is rendered.
ComparisonRow makeRow(const RowGroup& group, Backend backend, const MethodVariant& variant) {
  ComparisonRow row;
  row.scene = group.pack->scene.name;
  row.backend = backend;
  row.method = variant.method;
  row.everyEffect = variant.everyEffect;
  row.vulkanPath = variant.path.vulkan;
  row.embreePath = variant.path.embree;
  row.isSecondPath = variant.isSecondPath;
  row.width = group.parameters.width;
  row.height = group.parameters.height;
  row.depth = group.parameters.depth;
  const MethodInfo& method = methodNamed(variant.method);
  row.payloadBytes = method.payloadBytes;
  if (method.isIterative) {
    const std::uint32_t effects = compiledEffects(group.pack->scene, rowParameters(row, group));
    row.stateBytes = method.pathBytes * (1 + pathStackSize(effects, row.depth));
  }
  return row;
}

// Images that the rows of one view and renderer are compared with, and the row of the exact method.
struct Exact {
  const RenderResult& reference;        // in double precision
  std::optional<RenderResult> image{};  // by the complete recursive method; none if it failed
  std::optional<ComparisonRow> row{};
  std::optional<ImageError> precision{};
};

void storeErrors(ComparisonRow& row, const RenderResult& image, const Exact& exact, double exposureEv) {
  row.errorToReference = imageError(image, exact.reference, exposureEv);
  row.precision = exact.precision;
  row.error = exact.image ? imageError(image, *exact.image, exposureEv) : row.errorToReference;
}

// Renders a row and stores its errors and, of a main row, its image.
RenderResult renderRow(ComparisonRow& row, RowGroup& group, const Exact& exact, const Output& output) {
  const pack::Pack& pack = *group.pack;
  const std::string backend = backendInfo(row.backend).name;
  output.progress(fmt::format("{}: {} {}{}{}", groupTitle(group), backend, row.method,
                              row.everyEffect ? ", all effects" : "",
                              row.isSecondPath ? fmt::format(", {}", pathName(row)) : ""));
  RenderResult result = renderFirst(row, group);
  storeErrors(row, result, exact, pack.scene.exposureEv);
  if (row.choice && exact.image)
    row.choice->displayError = displayError(result, *exact.image, pack.scene.exposureEv).relRms();
  if (!row.isMain()) return result;
  row.image = fileName(group, fmt::format("{}-{}", backend, row.method));
  writeImage(output.images / row.image, toImage(result, pack, group.parameters, backend, row.method), 0);
  return result;
}

// Compiles rows of one backend at once. A backend that cannot be used is reported by its rows.
void prepareRows(const RowGroup& group, Backend backend, std::span<const MethodVariant> variants,
                 const Output& output) {
  output.progress(
      fmt::format("{}: {}, preparing {} methods", groupTitle(group), backendInfo(backend).name, variants.size()));
  std::vector<Preparation> images;
  for (const MethodVariant& variant : variants) {
    Preparation& image = images.emplace_back(Preparation{variant.method, group.parameters, true});
    image.parameters.everyEffect = variant.everyEffect;
    image.parameters.vulkanPath = variant.path.vulkan;
  }
  try {
    (*group.renderers)[backend].prepare(images);
  } catch (const Error&) {
  }
}

// Renders the exact method before the others, whose errors relate to it. Its row is that of the list, if it is there.
void renderExact(Exact& exact, RowGroup& group, Backend backend, const PathChoice& path, const Output& output) {
  ComparisonRow row = makeRow(group, backend, {completeRecursiveMethod().name, false, path});
  try {
    RenderResult image = renderRow(row, group, exact, output);
    exact.precision = row.errorToReference;
    exact.image = std::move(image);
    storeErrors(row, *exact.image, exact, group.pack->scene.exposureEv);
    exact.row = std::move(row);
  } catch (const Interrupted&) {
    throw;
  } catch (const Error&) {  // its row reports it, if there is one
  }
}

// The path that is not taken automatically; automatic: there is none, or the user chose a path.
PathChoice secondPath(RowGroup& group, Backend backend, const PathChoice& chosen) {
  PathChoice second;
  try {
    const Renderer& renderer = (*group.renderers)[backend];
    const std::vector<VulkanPath> vulkan = renderer.vulkanPaths();
    const std::vector<EmbreePath> embree = renderer.embreePaths();
    if (vulkan.size() > 1 && chosen.vulkan == VulkanPath::automatic) second.vulkan = vulkan[1];
    if (embree.size() > 1 && chosen.embree == EmbreePath::automatic) second.embree = embree[1];
  } catch (const Error&) {  // every row reports it
  }
  return second;
}

// Renders what --max-error chooses, unless the time does not suffice or only some methods are compared.
void renderChoices(Comparison& comparison, RowGroup& group, Backend backend, const ComparisonSettings& settings,
                   const Exact& exact, const Share& share, const Output& output) {
  const std::vector<std::string> names = methodNames();
  const bool comparesAll = std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    return std::find(settings.methods.begin(), settings.methods.end(), name) != settings.methods.end();
  });
  // The search compiles about as much as the methods did.
  const bool isSlow = share.compiling && share.compiling->usedShare() > 0.2;
  if (!comparesAll || !exact.image || interrupted() || share.isOver() || isSlow) return;
  try {
    for (ComparisonRow& row : choiceRows(group, backend, settings.threads, output.progress)) {
      renderRow(row, group, exact, output);
      group.rows.push_back(comparison.rows.size());
      comparison.rows.push_back(std::move(row));
    }
  } catch (const Interrupted&) {  // the rows before it are kept
  } catch (const Error& error) {
    console::warn(fmt::format("{}: no choices of --max-error: {}", groupTitle(group), error.what()));
  }
}

// Warns of the rows that are left out because the time for compiling is over.
void warnLeftOut(const RowGroup& group, Backend backend, std::size_t rows, const Share& share) {
  if (!share.compiling || !share.compiling->isOver()) return;
  console::warn(
      fmt::format("{}: {} left out {} row{}, because a CPU compiles a row for minutes; use --minutes 0 to render all, "
                  "or --backends embree to leave out Vulkan",
                  groupTitle(group), backendInfo(backend).name, rows, rows == 1 ? "" : "s"));
}

// Renders every method on one backend.
void renderRows(Comparison& comparison, RowGroup& group, Backend backend, const ComparisonSettings& settings,
                const RenderResult& reference, Share share, const Output& output) {
  if (settings.compileMinutes > 0 && isOnCpu(backend, settings.device))
    share.compiling.emplace(settings.compileMinutes);
  const RenderParameters& p = group.parameters;
  const EffectsChoice cheapest =
      chooseEffects({"auto"}, completeRecursiveMethod().name, group.pack->scene, {p.depth, p.analyser, false, false});
  EffectsTable effects(cheapest);
  PathsTable paths;
  Exact exact{reference};
  const PathChoice path{settings.vulkanPath, settings.embreePath};
  const std::vector<MethodVariant> variants =
      methodVariants(settings.methods, cheapest, backend, path, secondPath(group, backend, path));
  // Within a time limit only as many at once as there are threads to compile them: the limit may leave out the rest.
  const bool isLimited = settings.minutes > 0 || share.compiling;
  const std::size_t atOnce = isLimited ? std::max(1u, std::thread::hardware_concurrency()) : variants.size();
  for (std::size_t i = 0; i < variants.size(); ++i) {
    if (interrupted()) break;
    if (share.isOver() && i > 0) {
      warnLeftOut(group, backend, variants.size() - i, share);
      break;
    }
    if (i % atOnce == 0)
      prepareRows(group, backend, std::span(variants).subspan(i, std::min(atOnce, variants.size() - i)), output);
    ComparisonRow row = makeRow(group, backend, variants[i]);
    const std::size_t index = comparison.rows.size();
    try {
      if (i == 0) renderExact(exact, group, backend, path, output);
      const bool isExact = exact.row && row.method == exact.row->method && row.isMain();
      const RenderResult rendered = isExact ? *exact.image : renderRow(row, group, exact, output);
      if (isExact) row = *exact.row;
      effects.add(index, row, rendered);
      paths.add(index, row, rendered);
      comparison.devices[backendInfo(backend).name] = (*group.renderers)[backend].device();
    } catch (const Interrupted&) {
      break;
    } catch (const Error& error) {
      row.status = error.what();
    }
    group.rows.push_back(index);
    comparison.rows.push_back(std::move(row));
  }
  renderChoices(comparison, group, backend, settings, exact, share, output);
  if (backend == Backend::vulkan && comparison.devices.contains(backendInfo(backend).name))
    comparison.deviceInfo = vulkan::toJson(vulkan::chosenDevice(settings.device));
  if (EffectsComparison entry; effects.finish(entry)) comparison.effects.push_back(std::move(entry));
  for (const PathComparison& entry : paths.finish()) comparison.paths.push_back(entry);
}

}  // namespace

std::vector<RowGroup> warmUp(Comparison& comparison, const ComparisonSettings& settings, const TimeLimit& limit,
                             const std::filesystem::path& folder, const Progress& progress,
                             const std::function<void(const std::vector<RowGroup>&)>& afterView) {
  const Output output{folder / "images", progress};
  const std::vector<Backend> backends = fastestToStartFirst(settings.backends, settings.device);
  std::vector<RowGroup> groups;
  std::size_t count = 0;
  try {
    for (const auto& [name, pack] : comparison.packs) count += views(pack.scene, settings).size();
    for (auto& [name, pack] : comparison.packs) {
      const auto renderers =
          std::make_shared<RendererSet>(pack.scene, RendererOptions{settings.device, settings.threads});
      for (const RenderParameters& parameters : views(pack.scene, settings)) {
        if (interrupted() || (limit.isOver() && !groups.empty())) break;
        const Share share{limit, groups.size(), count};
        groups.push_back({&pack, parameters, renderers, {}});
        const RenderResult reference = renderReference(comparison, groups.back(), settings.threads, output);
        for (const Backend backend : backends)
          renderRows(comparison, groups.back(), backend, settings, reference, share, output);
        afterView(groups);
      }
    }
  } catch (const Interrupted&) {  // finished views are kept
  }
  return groups;
}

}  // namespace malus::render
