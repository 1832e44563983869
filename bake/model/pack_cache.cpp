#include "bake/model/pack_cache.h"

#include <algorithm>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "bake/bake_file.h"
#include "bake/pack/writer.h"
#include "meshprep/base/cache_folder.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"

namespace malus::bake {
namespace fs = std::filesystem;

fs::path cachedPack(const fs::path& model, const ModelPackOptions& options, const MeasureDepth& measure) {
  const fs::path folder = cacheFolder("packs");
  if (folder.empty())
    throw Error(model.string(), "there is no cache folder for its pack",
                "HOME or XDG_CACHE_HOME; or bake it with 'malus bake' and -o");
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed)
    throw Error(folder.string(), "cannot create the cache folder",
                "a writable place (XDG_CACHE_HOME); or bake the model with 'malus bake' and -o", failed.message());

  const SceneDescription description = describeModel(model, options.model);
  BakeJob job;
  job.options.allowOpenGlass = options.allowOpenGlass;
  job.measure = measure;
  const std::string provenance = makeProvenance(description, job.settings, job.options);
  job.output = folder / fmt::format("{}-{:016x}.pack", description.name,
                                    pack::hashBytes(std::as_bytes(std::span<const char>(provenance))));
  const BakedFile baked = bakeFile(description, job);
  fs::last_write_time(job.output, fs::file_time_type::clock::now(), failed);
  console::inform(
      fmt::format("{}: {} {}", model.string(), baked.isUpToDate ? "the pack is" : "baked into", job.output.string()));
  for (const std::string& choice : baked.baked.choices) console::inform(fmt::format("  {}", choice));
  trimPacks(folder, kMaxCacheBytes, job.output);
  return job.output;
}

void trimPacks(const fs::path& folder, std::uintmax_t most, const fs::path& kept) {
  struct Entry {
    fs::path path;
    fs::file_time_type used;
    std::uintmax_t bytes;
  };
  std::vector<Entry> entries;
  std::uintmax_t total = 0;
  std::error_code failed;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed)) {
    if (entry.path().extension() != ".pack" || !entry.is_regular_file(failed)) continue;
    entries.push_back({entry.path(), entry.last_write_time(failed), entry.file_size(failed)});
    if (!failed) total += entries.back().bytes;
  }
  std::ranges::sort(entries, {}, &Entry::used);
  for (const Entry& entry : entries) {
    if (total <= most) return;
    if (entry.path == kept) continue;
    if (fs::remove(entry.path, failed)) total -= entry.bytes;
  }
}

}  // namespace malus::bake
