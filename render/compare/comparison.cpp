#include "render/compare/comparison.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "render/image/output.h"
#include "render/make_renderer.h"
#include "render/scene/compiled_effects.h"
#include "render/scene/effects_choice.h"
#include "render/scene/methods.h"

namespace malus::render {

namespace {

// Processor time of the whole process, all threads.
double cpuMs() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto ms = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_usec) * 1e-3;
  };
  return ms(usage.ru_utime) + ms(usage.ru_stime);
}

// The renderers of one scene, made when first asked for.
class Renderers {
 public:
  Renderers(const pack::Scene& scene, const ComparisonSettings& settings) : scene_(scene), settings_(settings) {}

  Renderer& operator[](Backend backend) {
    std::unique_ptr<Renderer>& renderer = renderers_[backend];
    if (!renderer) renderer = makeRenderer(backend, scene_, {settings_.device, settings_.threads});
    return *renderer;
  }

 private:
  const pack::Scene& scene_;
  const ComparisonSettings& settings_;
  std::map<Backend, std::unique_ptr<Renderer>> renderers_;
};

// Rows that share a scene and a view.
struct Group {
  const pack::Pack* pack;
  RenderParameters parameters;
  std::shared_ptr<Renderers> renderers;
  std::vector<std::size_t> rows;
};

// Intensities of the pictures that the effects' table compares, while they are needed.
class EffectsPictures {
 public:
  void add(std::size_t row, const RenderResult& picture) {
    std::vector<float>& rgb = pictures_[row];
    for (std::size_t i = 0; i < picture.pixels.size(); i += picture.channels)
      rgb.insert(rgb.end(), {picture.pixels[i], picture.pixels[i + 1], picture.pixels[i + 2]});
  }
  double difference(std::size_t a, std::size_t b) const {
    double largest = 0;
    if (!pictures_.contains(a) || !pictures_.contains(b)) return largest;
    for (std::size_t i = 0; i < pictures_.at(a).size(); ++i)
      largest = std::max(largest, static_cast<double>(std::abs(pictures_.at(a)[i] - pictures_.at(b)[i])));
    return largest;
  }
  double brightest(std::size_t row) const {
    const auto found = pictures_.find(row);
    return found == pictures_.end() ? 0 : *std::max_element(found->second.begin(), found->second.end());
  }

 private:
  std::map<std::size_t, std::vector<float>> pictures_;
};

// The methods of a comparison, each with the effects that the scene needs; the one that `--effects auto` takes in
// place of the complete recursive method; and the complete methods once more with every effect.
struct Draw {
  std::string method;
  bool everyEffect;
};
std::vector<Draw> drawsOf(const std::vector<std::string>& methods, const std::string& cheapest) {
  std::vector<Draw> draws;
  const auto named = [&](std::string_view name) {
    return std::find(methods.begin(), methods.end(), name) != methods.end();
  };
  draws.reserve(methods.size() + 3);
  for (const std::string& method : methods) draws.push_back({method, false});
  if (named(completeRecursiveMethod().name) && !named(cheapest)) draws.push_back({cheapest, false});
  for (const MethodInfo& m : render::methods())
    if (m.isComplete() && named(m.name)) draws.push_back({m.name, true});
  return draws;
}

std::string stem(const std::string& scene, const RenderParameters& parameters, const std::string& what) {
  return fmt::format("{}-{}x{}-d{}-{}", scene, parameters.width, parameters.height, parameters.depth, what);
}

std::vector<RenderParameters> parameterVariants(const pack::Scene& scene, const ComparisonSettings& settings) {
  std::vector<std::uint32_t> widths = settings.widths, heights = settings.heights, depths = settings.depths;
  const double aspect = static_cast<double>(scene.width) / scene.height;
  const auto rounded = [](double side) { return std::max(1u, static_cast<std::uint32_t>(std::lround(side))); };
  if (widths.empty() && heights.empty()) widths = {rounded(scene.width * settings.scale)};
  if (widths.empty())
    for (const std::uint32_t height : heights) widths.push_back(rounded(height * aspect));
  if (heights.empty())
    for (const std::uint32_t width : widths) heights.push_back(rounded(width / aspect));
  if (depths.empty()) depths = {scene.depth};
  std::vector<RenderParameters> variants;
  for (std::size_t i = 0; i < widths.size(); ++i)
    for (const std::uint32_t depth : depths) {
      RenderParameters parameters = defaultParameters(scene);
      parameters.width = widths[i];
      parameters.height = heights[i];
      parameters.region = {0, 0, parameters.width, parameters.height};
      parameters.depth = depth;
      if (settings.polarizerDegrees) parameters.analyser = linearPolarizer(*settings.polarizerDegrees);
      variants.push_back(parameters);
    }
  return variants;
}

// One render of a row, its times kept where `timed`.
RenderResult renderRow(ComparisonRow& row, Group& group, bool timed) {
  const double cpuBefore = cpuMs();
  RenderParameters parameters = group.parameters;
  parameters.everyEffect = row.everyEffect;
  RenderResult picture = (*group.renderers)[row.backend].render(row.method, parameters);
  const double cpu = cpuMs() - cpuBefore;
  if (timed) {
    row.samplesMs.push_back(picture.cost.traceMs);
    row.wallMs.push_back(picture.cost.wallMs);
    row.readBackMs.push_back(picture.cost.readBackMs);
    row.cpuMs.push_back(cpu);
  } else {
    row.buildMs = picture.cost.buildMs;
    row.uploadMs = picture.cost.uploadMs;
    row.compileMs = picture.cost.compileMs;
  }
  return picture;
}

void summarize(Comparison& comparison, const std::vector<Group>& groups) {
  for (const Group& group : groups)
    for (const std::size_t i : group.rows) {
      ComparisonRow& row = comparison.rows[i];
      if (!row.ok()) continue;
      // An interrupted round is dropped for every row alike.
      for (auto* list : {&row.samplesMs, &row.wallMs, &row.readBackMs, &row.cpuMs})
        list->resize(std::min<std::size_t>(list->size(), comparison.rounds));
    }
  for (const Group& group : groups)
    for (const std::size_t i : group.rows) {
      ComparisonRow& row = comparison.rows[i];
      if (!row.ok() || row.samplesMs.empty()) continue;
      row.time = spreadOf(row.samplesMs);
      for (const std::size_t j : group.rows) {
        const ComparisonRow& other = comparison.rows[j];
        if (other.backend != row.backend || !other.ok() || other.samplesMs.size() != row.samplesMs.size()) continue;
        if (other.everyEffect) continue;
        if (other.method == baselineMethod().name) row.ratioToSchlick = ratioSpread(row.samplesMs, other.samplesMs);
        if (i != j && !row.everyEffect && indistinguishable(row.samplesMs, other.samplesMs))
          row.indistinguishable.push_back(other.method);
      }
    }
  for (EffectsComparison& e : comparison.effects) {
    const auto ratio = [&](std::size_t i) {
      const std::vector<double>&a = comparison.rows[i].samplesMs, &b = comparison.rows[e.all].samplesMs;
      return a.empty() || a.size() != b.size() ? Spread{} : ratioSpread(a, b);
    };
    if (e.automatic != EffectsComparison::kNoRow) e.automaticToAll = ratio(e.automatic);
    if (e.importance != EffectsComparison::kNoRow) e.importanceToAll = ratio(e.importance);
  }
}

}  // namespace

Comparison compare(const std::vector<std::filesystem::path>& packs, const ComparisonSettings& asked,
                   const std::filesystem::path& folder, const std::function<void(std::string_view)>& progress) {
  ComparisonSettings settings = asked;
  if (packs.empty()) throw Error("malus compare", "no scene pack", "one or more");
  if (settings.rounds == 0) throw Error("--rounds", "no round", "1 or more", "0");
  if (!settings.widths.empty() && !settings.heights.empty() && settings.widths.size() != settings.heights.size())
    throw Error("--height", "are not as many as the widths", fmt::format("{}", settings.widths.size()),
                fmt::format("{}", settings.heights.size()));
  const std::string& baseline = baselineMethod().name;
  if (std::find(settings.methods.begin(), settings.methods.end(), baseline) == settings.methods.end())
    settings.methods.insert(settings.methods.begin(), baseline);
  for (const std::string& method : settings.methods) methodNamed(method);

  Comparison comparison;
  for (const std::filesystem::path& path : packs) {
    pack::Pack pack = pack::read(path);
    const std::string name = pack.scene.name;
    if (!comparison.packs.emplace(name, std::move(pack)).second)
      throw Error(path.string(), fmt::format("a second pack of scene '{}'", name), "each scene once");
  }

  // Warm-up: references, every pipeline, every picture and its error.
  std::vector<Group> groups;
  for (auto& [name, pack] : comparison.packs) {
    const auto renderers = std::make_shared<Renderers>(pack.scene, settings);
    for (const RenderParameters& parameters : parameterVariants(pack.scene, settings)) {
      if (interrupted()) break;
      progress(
          fmt::format("{} {} x {}, depth {}: reference", name, parameters.width, parameters.height, parameters.depth));
      const RenderResult reference =
          makeRenderer(Backend::reference, pack.scene, {"", settings.threads})->render("", parameters);
      comparison.devices["reference"] = reference.device;
      comparison.references.push_back(
          {name, parameters.width, parameters.height, parameters.depth, stem(name, parameters, "reference") + ".exr"});
      writeImage(folder / "pictures" / comparison.references.back().picture,
                 toImage(reference, pack, parameters, "reference", "reference"), 0);
      groups.push_back({&pack, parameters, renderers, {}});
      const EffectsChoice cheapest = chooseEffects({"auto"}, completeRecursiveMethod().name, pack.scene,
                                                   {parameters.depth, parameters.analyser, false, false});
      for (const Backend backend : settings.backends) {
        const std::string renderer = backendInfo(backend).name;
        EffectsPictures pictures;
        EffectsComparison effects;
        effects.why = cheapest.why;
        for (const auto& [method, everyEffect] : drawsOf(settings.methods, cheapest.method)) {
          if (interrupted()) break;
          progress(fmt::format("{} {} x {}, depth {}: {} {}{}", name, parameters.width, parameters.height,
                               parameters.depth, renderer, method, everyEffect ? ", all effects" : ""));
          ComparisonRow row;
          row.scene = name;
          row.backend = backend;
          row.method = method;
          row.everyEffect = everyEffect;
          row.width = parameters.width;
          row.height = parameters.height;
          row.depth = parameters.depth;
          const MethodInfo& info = methodNamed(method);
          row.payloadBytes = info.payloadBytes;
          RenderParameters drawn = parameters;
          drawn.everyEffect = everyEffect;
          if (info.isIterative)
            row.stateBytes = info.pathBytes * (1 + pathStackSize(compiledEffects(pack.scene, drawn), parameters.depth));
          try {
            const RenderResult picture = renderRow(row, groups.back(), false);
            row.rays = picture.cost.rays > 0 ? picture.cost.rays : (*renderers)[backend].countRays(method, drawn);
            row.error = imageError(picture, reference, pack.scene.exposureEv);
            if (!everyEffect) {
              row.picture = stem(name, parameters, fmt::format("{}-{}", renderer, method)) + ".exr";
              writeImage(folder / "pictures" / row.picture, toImage(picture, pack, parameters, renderer, method), 0);
            }
            const std::size_t index = comparison.rows.size();
            const bool isAll = everyEffect && !info.isIterative, isAuto = !everyEffect && method == cheapest.method,
                       isImportance = !everyEffect && info.isIterative && info.isComplete();
            if (isAll) effects.all = index;
            if (isAuto) effects.automatic = index;
            if (isImportance) effects.importance = index;
            if (isAll || isAuto || isImportance) pictures.add(index, picture);
            comparison.devices[renderer] = (*renderers)[backend].device();
          } catch (const Error& error) {
            row.status = error.what();
          }
          groups.back().rows.push_back(comparison.rows.size());
          comparison.rows.push_back(std::move(row));
        }
        if (effects.all == EffectsComparison::kNoRow) continue;
        effects.automaticDifference = pictures.difference(effects.automatic, effects.all);
        effects.importanceDifference = pictures.difference(effects.importance, effects.all);
        effects.brightest = pictures.brightest(effects.all);
        comparison.effects.push_back(std::move(effects));
      }
    }
  }

  // Rounds: every row once a round, each round beginning with another row.
  for (std::uint32_t round = 0; round < settings.rounds && !interrupted(); ++round) {
    for (std::size_t g = 0; g < groups.size() && !interrupted(); ++g) {
      Group& group = groups[g];
      progress(fmt::format("round {} of {}: {} {} x {}", round + 1, settings.rounds, group.pack->scene.name,
                           group.parameters.width, group.parameters.height));
      for (std::size_t k = 0; k < group.rows.size() && !interrupted(); ++k) {
        ComparisonRow& row = comparison.rows[group.rows[(k + round) % group.rows.size()]];
        if (!row.ok()) continue;
        try {
          renderRow(row, group, true);
        } catch (const Error& error) {
          row.status = error.what();
        }
      }
    }
    if (!interrupted()) comparison.rounds = round + 1;
  }
  comparison.interrupted = interrupted();
  summarize(comparison, groups);
  return comparison;
}

}  // namespace malus::render
