#include "bake/bake_file.h"

#include <optional>
#include <span>
#include <utility>

#include "bake/effects/effects.h"
#include "bake/meshes/glass_bodies.h"
#include "bake/model/model_scene.h"
#include "bake/previous_pack.h"
#include "bake/scene_json.h"
#include "meshprep/base/console.h"
#include "meshprep/base/unfinished_files.h"

namespace malus::bake {

namespace {

// Measures the light beyond the depth. The depth of a model follows from it.
void measureDepth(const MeasureDepth& measure, Baked& baked) {
  console::progress("measuring the light beyond the depth");
  baked.probe = measure(baked.scene);
  if (baked.description.model) {
    applyModelProbe(*baked.probe, baked.description, baked.scene, baked.choices);
    baked.scene.effects = findEffects(baked.scene);
  }
  for (std::string& note : applyProbe(*baked.probe, baked.scene)) baked.notes.push_back(std::move(note));
}

pack::Written writePack(const BakeJob& job, const Baked& baked, const std::optional<PreviousBake>& reused) {
  console::progress("compressing");
  pack::WriteSettings settings = job.settings;
  settings.provenance = [&](std::vector<std::string> warnings) {
    warnings.insert(warnings.begin(), baked.notes.begin(), baked.notes.end());
    return withWarnings(baked.scene.provenance, std::move(warnings));
  };
  settings.inspection = glassInspection(baked.scene, baked.glassBodies);
  const pack::PreviousPack source{reused ? &reused->pack : nullptr,
                                  reused ? reused->bytes : std::span<const std::byte>()};
  return pack::write(job.output, baked.scene, settings, reused ? &source : nullptr);
}

}  // namespace

BakedFile bakeFile(const SceneDescription& description, const BakeJob& job) {
  BakedFile result;
  const std::string provenance = makeProvenance(description, job.settings, job.options);
  std::optional<PreviousBake> previous;
  if (!job.output.empty()) {
    removeAbandoned(job.output);
    if (!job.isForced) previous = readPrevious(job.output);
  }
  if (previous && isUpToDate(*previous, provenance)) {
    result.isUpToDate = true;
    result.name = previous->pack.scene.name;
    result.warnings = bakeWarnings(previous->pack.scene);
    for (const std::string& warning : result.warnings) console::warn(warning);
    return result;
  }
  if (previous && !isOfSameVersions(*previous, provenance)) previous.reset();

  result.baked = bake(description, job.settings, console::progress, job.options);
  result.name = result.baked.scene.name;
  result.isRebaked = previous.has_value();
  if (job.measure) measureDepth(job.measure, result.baked);
  if (!job.output.empty()) result.written = writePack(job, result.baked, previous);
  console::progressDone();
  result.warnings = result.baked.notes;
  result.warnings.insert(result.warnings.end(), result.written.warnings.begin(), result.written.warnings.end());
  for (const std::string& warning : result.warnings) console::warn(warning);
  return result;
}

}  // namespace malus::bake
