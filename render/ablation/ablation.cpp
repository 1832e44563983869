#include "render/ablation/ablation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "render/ablation/advice.h"
#include "render/compare/backend_order.h"
#include "render/compare/machine.h"
#include "render/compare/packs.h"
#include "render/compare/time_limit.h"
#include "render/image/output.h"
#include "render/renderer_pool.h"
#include "render/scene/methods.h"

namespace malus::render {

namespace {

// The rows of one scene on one renderer, and what renders them.
struct Group {
  const pack::Pack* pack = nullptr;
  RendererPool renderers;
  std::vector<Variant> variants{};  // of the rows
  std::vector<std::size_t> rows{};  // indices into Ablation::rows
  std::uint32_t rounds = 0;         // finished ones

  Backend backend() const { return renderers.backend(); }
  std::string title() const { return fmt::format("{}, {}", pack->scene.name, backendInfo(backend()).name); }
};

// Images of the first pass that later ones are compared with.
struct Images {
  RenderResult complete;
  std::map<std::size_t, RenderResult> byRow;  // of bounces
};

JobSettings imageSettings(const AblationSettings& settings, const pack::Scene& scene) {
  JobSettings image = settings.image;
  if (image.width != 0 || image.height != 0) return image;
  (scene.width >= scene.height ? image.width : image.height) =
      std::min(kAblationSide, std::max(scene.width, scene.height));
  return image;
}

AblationRow makeRow(const Group& group, const Variant& variant) {
  AblationRow row;
  row.scene = group.pack->scene.name;
  row.backend = group.backend();
  row.kind = variant.kind;
  row.name = variant.name;
  row.method = variant.method;
  row.width = variant.parameters.width;
  row.height = variant.parameters.height;
  row.depth = variant.parameters.depth;
  row.savedBytes = static_cast<std::int64_t>(completeRecursiveMethod().payloadBytes) -
                   static_cast<std::int64_t>(methodNamed(variant.method).payloadBytes);
  return row;
}

std::string imageName(const Group& group, const AblationRow& row) {
  std::string what = row.kind == VariantKind::complete  ? "complete"
                     : row.kind == VariantKind::depth   ? fmt::format("depth {}", row.depth)
                     : row.kind == VariantKind::samples ? row.name
                                                        : "without " + row.name;
  std::replace(what.begin(), what.end(), ' ', '-');
  return fmt::format("{}-{}x{}-{}-{}.exr", safeName(row.scene), row.width, row.height,
                     backendInfo(group.backend()).name, safeName(what));
}

// Renders a row for the first time and stores its error and its image.
void renderFirst(Ablation& ablation, Group& group, const Variant& variant, Images& images,
                 const std::filesystem::path& folder) {
  AblationRow row = makeRow(group, variant);
  const bool isComplete = variant.kind == VariantKind::complete;
  try {
    Renderer& renderer = group.renderers[variant.scene];
    renderer.prepare({{variant.method, variant.parameters, true}});
    RenderResult image = renderImage(renderer, variant.method, variant.parameters, true);
    ablation.devices[backendInfo(group.backend()).name] = image.device;
    row.rays = image.cost.rays;
    row.firstMs = image.cost.traceMs;
    row.error = imageError(image, isComplete ? image : images.complete, group.pack->scene.exposureEv);
    row.image = imageName(group, row);
    writeImage(folder / "images" / row.image,
               toImage(image, *group.pack, variant.parameters, backendInfo(group.backend()).name, variant.method), 0);
    if (isComplete)
      images.complete = std::move(image);
    else if (variant.kind == VariantKind::depth)
      images.byRow[ablation.rows.size()] = std::move(image);
  } catch (const Error& error) {
    row.status = error.what();
  }
  group.variants.push_back(variant);
  group.rows.push_back(ablation.rows.size());
  ablation.rows.push_back(std::move(row));
}

// Relative RMS of the difference of two images, relative to a third.
double relativeDifference(const RenderResult& a, const RenderResult& b, const RenderResult& reference) {
  const std::vector<float> first = colours(a), second = colours(b), whole = colours(reference);
  double squares = 0, all = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const double d = static_cast<double>(first[i]) - second[i];
    squares += d * d;
    all += static_cast<double>(whole[i]) * whole[i];
  }
  return all > 0 ? std::sqrt(squares / all) : std::sqrt(squares);
}

// Adds the step between each depth and the next larger one that was measured.
void addBounces(Ablation& ablation, const Group& group, const Images& images) {
  std::vector<std::size_t> rows;
  for (const auto& [row, image] : images.byRow) rows.push_back(row);
  std::sort(rows.begin(), rows.end(),
            [&](std::size_t a, std::size_t b) { return ablation.rows[a].depth > ablation.rows[b].depth; });
  const RenderResult* deeperImage = &images.complete;
  std::size_t deeper = group.rows.front();
  for (const std::size_t row : rows) {
    const RenderResult& image = images.byRow.at(row);
    ablation.bounces.push_back({row, deeper, relativeDifference(image, *deeperImage, images.complete), {}, false});
    deeper = row;
    deeperImage = &image;
  }
}

// Sorts the variants of a scene by what they saved on the first renderer, most first; the complete image stays first.
void sortByWorth(std::vector<Variant>& variants, const Ablation& ablation, const Group& first) {
  const AblationRow& complete = ablation.rows[first.rows.front()];
  const auto worth = [&](const Variant& variant) {
    for (const std::size_t i : first.rows) {
      const AblationRow& row = ablation.rows[i];
      if (row.ok() && row.kind == variant.kind && row.name == variant.name)
        return costPerError(1 - row.firstMs / complete.firstMs, row.error);
    }
    return 0.0;
  };
  std::stable_sort(variants.begin() + 1, variants.end(),
                   [&](const Variant& a, const Variant& b) { return worth(a) > worth(b); });
}

// The first pass of a group. isOver: whether its share of the time is used.
void firstPass(Ablation& ablation, Group& group, std::vector<Variant> variants, const std::filesystem::path& folder,
               const Progress& progress, const std::function<bool()>& isOver) {
  Images images;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    if (interrupted()) return;
    if (i > 0 && isOver()) {
      ablation.leftOut += variants.size() - i;
      break;
    }
    const Variant& variant = variants[i];
    progress(fmt::format("{}: {}", group.title(),
                         i == 0                                 ? "complete"
                         : variant.kind == VariantKind::samples ? variant.name
                                                                : "without " + variant.name));
    renderFirst(ablation, group, variant, images, folder);
    if (i == 0 && !ablation.rows.back().ok()) return;  // nothing to compare with
  }
  addBounces(ablation, group, images);
}

// One round of a group. False: interrupted, or the time is over.
bool timeRound(Ablation& ablation, Group& group, std::uint32_t round, const std::function<bool()>& isOver) {
  for (std::size_t k = 0; k < group.rows.size(); ++k) {
    if (interrupted() || isOver()) return false;
    const std::size_t i = (k + round) % group.rows.size();
    AblationRow& row = ablation.rows[group.rows[i]];
    if (!row.ok()) continue;
    const Variant& variant = group.variants[i];
    try {
      row.samplesMs.push_back(
          renderImage(group.renderers[variant.scene], variant.method, variant.parameters, false).cost.traceMs);
    } catch (const Error& error) {
      row.status = error.what();
    }
  }
  return true;
}

void summarizeRow(AblationRow& row, const AblationRow& complete) {
  row.savedRays = complete.rays > row.rays ? complete.rays - row.rays : 0;
  if (!row.ok() || row.samplesMs.empty()) return;
  row.time = computeSpread(row.samplesMs);
  if (row.samplesMs.size() != complete.samplesMs.size()) return;
  row.ratioToComplete = ratioSpread(row.samplesMs, complete.samplesMs);
  row.differs = differSignificantly(row.samplesMs, complete.samplesMs);
}

void summarize(Ablation& ablation, const std::vector<Group>& groups) {
  ablation.rounds = groups.empty() ? 0 : std::ranges::min_element(groups, {}, &Group::rounds)->rounds;
  for (const Group& group : groups)
    for (const std::size_t i : group.rows) {
      AblationRow& row = ablation.rows[i];
      // Drop the samples of an unfinished round, except the first.
      row.samplesMs.resize(std::min<std::size_t>(row.samplesMs.size(), std::max(group.rounds, 1u)));
      summarizeRow(row, ablation.rows[group.rows.front()]);
    }
  for (BounceStep& step : ablation.bounces) {
    const std::vector<double>&a = ablation.rows[step.deeper].samplesMs, &b = ablation.rows[step.shorter].samplesMs;
    if (a.empty() || a.size() != b.size()) continue;
    step.timeRatio = ratioSpread(a, b);
    step.differs = differSignificantly(a, b);
  }
}

// The rounds of the groups from a number on. isOver: whether their share of the time is used.
void timeRounds(Ablation& ablation, std::vector<Group>& groups, std::size_t first, std::uint32_t rounds,
                const std::function<bool()>& isOver, const Progress& progress, const AblationSnapshot& snapshot) {
  for (std::uint32_t round = 0; round < rounds; ++round) {
    for (std::size_t i = first; i < groups.size(); ++i) {
      progress(fmt::format("round {} of {}: {}", round + 1, rounds, groups[i].title()));
      if (!timeRound(ablation, groups[i], round, isOver)) return;
      groups[i].rounds = round + 1;
    }
    summarize(ablation, groups);
    if (snapshot) snapshot(ablation);
  }
}

}  // namespace

Ablation ablate(const std::vector<std::filesystem::path>& packs, const AblationSettings& settings,
                const std::filesystem::path& folder, const Progress& progress, const AblationSnapshot& snapshot) {
  if (settings.rounds == 0) throw Error("--rounds", "no round", "1 or more", "0");
  Ablation ablation;
  ablation.date = currentDate();
  ablation.packs = readPacks(packs);
  const TimeLimit limit(settings.minutes);
  const std::vector<Backend> backends = fastestToStartFirst(settings.backends, settings.image.device);
  const std::size_t scenes = ablation.packs.size();
  std::vector<Group> groups;
  groups.reserve(scenes * backends.size());
  try {
    for (std::size_t b = 0; b < backends.size(); ++b) {
      // Each renderer has an equal part of the time, and what the ones before it leave; half of it for the first pass.
      const auto isOver = [&](double part) {
        return limit.usedShare() > 0 &&
               limit.usedShare() >= (static_cast<double>(b) + part) / static_cast<double>(backends.size());
      };
      for (const auto& [name, pack] : ablation.packs) {
        if (interrupted()) break;
        std::vector<Variant> variants =
            ablationVariants(pack.scene, renderParameters(imageSettings(settings, pack.scene), pack.scene));
        if (!groups.empty() && limit.isOver()) {
          ablation.leftOut += variants.size();
          continue;
        }
        const std::size_t view = groups.size();
        if (b > 0) sortByWorth(variants, ablation, groups[view % scenes]);
        Group& group = groups.emplace_back(
            Group{&pack, RendererPool(pack.scene, backends[b], {settings.image.device, settings.image.threads})});
        const double part = 0.5 * static_cast<double>(view % scenes + 1) / static_cast<double>(scenes);
        firstPass(ablation, group, std::move(variants), folder, progress, [&] { return isOver(part); });
        summarize(ablation, groups);
        if (snapshot) snapshot(ablation);
      }
      timeRounds(
          ablation, groups, std::min(b * scenes, groups.size()), settings.rounds, [&] { return isOver(1); }, progress,
          snapshot);
    }
  } catch (const Interrupted&) {  // finished rows and rounds are kept
  }
  summarize(ablation, groups);
  ablation.interrupted = interrupted();
  ablation.timeIsOver =
      !ablation.interrupted && (ablation.rounds < settings.rounds || groups.size() < scenes * backends.size());
  return ablation;
}

}  // namespace malus::render
