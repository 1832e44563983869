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
  if (earlier->header.producer != header.producer) {
    console::warn(fmt::format("{}: its frames are rendered again: they were made by {} with {} on '{}'",
                              folder.string(), earlier->header.producer.program, earlier->header.producer.device,
                              earlier->header.producer.processor));
    return manifest;
  }
  manifest.entries = earlier->entries;
  return manifest;
}

// Reads every job of the shard and finds those that are not finished.
std::vector<std::size_t> findUnfinished(const BatchSettings& settings, const Jobs& jobs, const pack::Scene& scene,
                                        Manifest& manifest) {
  std::vector<std::size_t> unfinished;
  std::map<std::uint64_t, ManifestEntry> finished;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (interrupted()) throw Interrupted();
    if (i % 1000 == 0) console::progress(fmt::format("reading job {} of {}", i + 1, jobs.size()));
    const Frame frame = readFrame(jobs.draw(i), settings.defaults, scene);
    if (!settings.shard.contains(i)) continue;
    const std::string hash = frameHash(frame.settings, manifest.header.pack, manifest.header.producer.program);
    const auto entry = manifest.entries.find(i);
    if (entry != manifest.entries.end() && entry->second.hash == hash && entry->second.name == frame.name &&
        hasFiles(settings.folder, entry->second))
      finished.emplace(i, entry->second);
    else
      unfinished.push_back(i);
  }
  manifest.entries = std::move(finished);
  return unfinished;
}

std::string durationText(double seconds) {
  if (seconds < 120) return fmt::format("{:.0f} s", seconds);
  return seconds < 7200 ? fmt::format("{:.0f} min", seconds / 60) : fmt::format("{:.1f} h", seconds / 3600);
}

void reportProgress(std::size_t done, std::size_t count, double seconds) {
  const double perFrame = done > 0 ? seconds / static_cast<double>(done) : 0;
  console::progress(done == 0 ? fmt::format("frame 1 of {}", count)
                              : fmt::format("frame {} of {}, {:.3g} frames per minute, {} left", done + 1, count,
                                            60 / perFrame, durationText(perFrame * static_cast<double>(count - done))));
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
      {programVersion(), backendInfo(settings.defaults.job.backend).name, renderer.device(), processorFeatures()}};
  Manifest manifest = reuse(settings.folder, header);
  const std::vector<std::size_t> unfinished = findUnfinished(settings, jobs, renderer.scene(), manifest);
  BatchResult result;
  result.reused = manifest.entries.size();
  writeManifest(settings.folder, manifest);

  ManifestAppender appender(settings.folder);
  WriterThread writer;
  const auto start = Clock::now();
  for (const std::size_t i : unfinished) {
    if (interrupted()) break;
    reportProgress(result.rendered, unfinished.size(), elapsedSeconds(start));
    auto frame = std::make_shared<Frame>(readFrame(jobs.draw(i), settings.defaults, renderer.scene()));
    auto rendered = std::make_shared<RenderedFrame>();
    try {
      *rendered = renderer.render(*frame);
    } catch (const Interrupted&) {
      break;
    }
    writer.push([&, frame, rendered] {
      const std::string hash = frameHash(frame->settings, header.pack, header.producer.program);
      const ManifestEntry entry =
          writeFrame(settings.folder, *frame, std::move(*rendered), settings.defaults.compression, hash);
      appender.add(entry);
      manifest.entries[entry.index] = entry;
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
    console::inform(fmt::format("{} of {} frames are finished; the same command renders the others",
                                manifest.entries.size(),
                                manifest.entries.size() + unfinished.size() - result.rendered));
    throw Interrupted();
  }
  return result;
}

}  // namespace malus::render
