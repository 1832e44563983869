#include "render/batch/batch.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <commit.h>
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "render/batch/processor.h"
#include "render/batch/tile_files.h"
#include "render/batch/tiles.h"
#include "render/batch/writer.h"

namespace malus::render {
namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

double elapsedSeconds(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Keeps other processes of this host from writing into the folder.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& folder) : file_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (file_ >= 0 && ::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      ::close(file_);
      throw Error(folder.string(), "another batch is writing into the folder", "another folder");
    }
  }
  ~FolderLock() {
    if (file_ >= 0) ::close(file_);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

std::string packText(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

// Whether the files of an entry are there, with their sizes.
bool hasFiles(const fs::path& folder, const ManifestEntry& entry) {
  for (const ManifestFile& file : entry.files) {
    std::error_code failed;
    if (fs::file_size(folder / file.name, failed) != file.bytes || failed) return false;
  }
  return true;
}

// The frames of an earlier run that need not be rendered again, under the header of this run.
Manifest reuse(const fs::path& folder, const ManifestHeader& header) {
  Manifest manifest{header, {}};
  const std::optional<Manifest> earlier = readManifest(folder);
  if (!earlier) return manifest;
  if (earlier->header.pack != header.pack)
    throw Error((folder / kManifestFile).string(), "the folder has frames of another scene",
                fmt::format("another folder, or pack {} of '{}'", earlier->header.pack, earlier->header.scene),
                header.pack);
  if (earlier->header.tileSide != header.tileSide)
    throw Error((folder / kManifestFile).string(),
                header.tileSide > 0 ? "the folder has whole frames" : "the folder has tiles of frames",
                header.tileSide > 0 ? "another folder, or no --tiles" : "another folder, or --tiles");
  if (earlier->header.producer != header.producer) {
    console::warn(fmt::format("{}: its frames are rendered again: they were made by {} with {} on '{}'",
                              folder.string(), earlier->header.producer.program, earlier->header.producer.device,
                              earlier->header.producer.processor));
    return manifest;
  }
  manifest.entries = earlier->entries;
  return manifest;
}

// A frame, or a tile of it, that is not finished.
struct Work {
  std::size_t frame, tile;
};

// Reads every job, and finds the frames or tiles of the shard that are not finished.
class WorkSearch {
 public:
  WorkSearch(const BatchSettings& settings, Manifest& manifest) : settings_(settings), manifest_(manifest) {}

  void add(const Frame& frame) {
    const std::size_t tiles = settings_.tiles ? TileGrid(frame.region, frame.outputs).count() : 1;
    std::string hash;
    for (std::size_t tile = 0; tile < tiles; ++tile) {
      if (!settings_.shard.contains(count_++)) continue;
      if (hash.empty()) hash = frameHash(frame.settings, manifest_.header.pack, manifest_.header.producer.program);
      const auto entry = manifest_.entries.find({frame.index, tile});
      if (entry != manifest_.entries.end() && entry->second.hash == hash && entry->second.name == frame.name &&
          hasFiles(settings_.folder, entry->second))
        finished_.insert(*entry);
      else
        unfinished_.push_back({frame.index, tile});
    }
  }

  // Leaves the finished entries in the manifest.
  std::vector<Work> finish() {
    manifest_.entries = std::move(finished_);
    return std::move(unfinished_);
  }
  // Frames or tiles of all shards.
  std::size_t count() const { return count_; }

 private:
  const BatchSettings& settings_;
  Manifest& manifest_;
  std::size_t count_ = 0;
  std::map<EntryKey, ManifestEntry> finished_;
  std::vector<Work> unfinished_;
};

void readJobs(const FrameDefaults& defaults, const Jobs& jobs, const pack::Scene& scene, WorkSearch& search) {
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (interrupted()) throw Interrupted();
    if (i % 1000 == 0) console::progress(fmt::format("reading job {} of {}", i + 1, jobs.size()));
    search.add(readFrame(jobs.draw(i), defaults, scene));
  }
}

std::string durationText(double seconds) {
  if (seconds < 120) return fmt::format("{:.0f} s", seconds);
  return seconds < 7200 ? fmt::format("{:.0f} min", seconds / 60) : fmt::format("{:.1f} h", seconds / 3600);
}

// unit: "frame" or "tile".
void reportProgress(const char* unit, std::size_t done, std::size_t count, double seconds) {
  const double perUnit = done > 0 ? seconds / static_cast<double>(done) : 0;
  console::progress(done == 0
                        ? fmt::format("{} 1 of {}", unit, count)
                        : fmt::format("{} {} of {}, {:.3g} {}s per minute, {} left", unit, done + 1, count,
                                      60 / perUnit, unit, durationText(perUnit * static_cast<double>(count - done))));
}

}  // namespace

std::string programVersion() { return "malus " MALUS_VERSION " (" MALUS_COMMIT ")"; }

BatchResult runBatch(const BatchSettings& settings, const Jobs& jobs, FrameRenderer& renderer) {
  const InterruptScope deferring;
  const FolderLock lock(settings.folder);
  const ManifestHeader header{
      renderer.scene().name,
      packText(renderer.packHash()),
      settings.seed,
      jobs.size(),
      {programVersion(), backendInfo(settings.defaults.job.backend).name, renderer.device(), processorFeatures()},
      settings.tiles ? kFrameTileSide : 0};
  Manifest manifest = reuse(settings.folder, header);
  WorkSearch search(settings, manifest);
  readJobs(settings.defaults, jobs, renderer.scene(), search);
  const std::vector<Work> unfinished = search.finish();
  BatchResult result;
  if (settings.tiles) result.tiles = search.count();
  result.reused = manifest.entries.size();
  writeManifest(settings.folder, manifest);

  const char* const unit = settings.tiles ? "tile" : "frame";
  ManifestAppender appender(settings.folder, header);
  TileWriter tileWriter(settings.folder);
  WriterThread writer;
  const auto start = Clock::now();
  for (const auto& [i, tile] : unfinished) {
    if (interrupted()) break;
    reportProgress(unit, result.rendered, unfinished.size(), elapsedSeconds(start));
    auto frame = std::make_shared<Frame>(readFrame(jobs.draw(i), settings.defaults, renderer.scene()));
    auto rendered = std::make_shared<RenderedFrame>();
    try {
      *rendered = settings.tiles ? renderer.render(*frame, TileGrid(frame->region, frame->outputs)[tile])
                                 : renderer.render(*frame);
    } catch (const Interrupted&) {
      break;
    }
    writer.push([&, frame, rendered, tile = tile] {
      const std::string hash = frameHash(frame->settings, header.pack, header.producer.program);
      const ManifestEntry entry = settings.tiles ? tileWriter.write(*frame, tile, *rendered, hash)
                                                 : writeFrame(settings.folder, *frame, std::move(*rendered),
                                                              settings.defaults.compression, hash);
      appender.add(entry);
      manifest.entries[entryKey(entry)] = entry;
    });
    ++result.rendered;
  }
  writer.finish();
  result.seconds = elapsedSeconds(start);
  result.builds = renderer.builds();
  result.updates = renderer.updates();
  writeManifest(settings.folder, manifest);
  console::progressDone();
  if (interrupted()) {
    console::inform(fmt::format("{} of {} {}s are finished; the same command renders the others",
                                manifest.entries.size(), manifest.entries.size() + unfinished.size() - result.rendered,
                                unit));
    throw Interrupted();
  }
  return result;
}

}  // namespace malus::render
