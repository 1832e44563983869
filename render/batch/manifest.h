// The list of the finished frames of a folder: manifest.jsonl, a header and a line per frame (render/batch/BATCH.md),
// or per tile of a frame. A line is added when all of its files are complete, so that a killed batch continues behind
// its last frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace malus::render {

inline constexpr const char* kManifestFile = "manifest.jsonl";

// Producers whose files may differ for equal settings.
struct Producer {
  std::string program;  // version and commit
  std::string backend, device;
  std::string processor;  // processorFeatures()
  friend bool operator==(const Producer&, const Producer&) = default;
};

struct ManifestHeader {
  std::string scene;  // name of the pack's scene
  std::string pack;   // hash of the pack, 16 hexadecimal digits
  std::uint64_t seed = 0;
  std::uint64_t frames = 0;  // of the whole batch, finished or not
  Producer producer;
  std::uint32_t tileSide = 0;  // in pixels; 0: the entries are frames
};

struct ManifestFile {
  std::string name;  // in the folder
  std::uint64_t bytes = 0;
  std::string hash;  // XXH64, 16 hexadecimal digits
};

// A frame, or a tile of it.
struct ManifestEntry {
  std::uint64_t index = 0;  // of the frame
  std::uint64_t tile = 0;   // within the frame; 0 of a frame without tiles
  std::string name;
  std::string hash;  // of what made the frame: frameHash()
  std::uint64_t seed = 0;
  std::string method;  // that rendered
  nlohmann::json settings;
  std::vector<ManifestFile> files;
};

// Frame and tile.
using EntryKey = std::pair<std::uint64_t, std::uint64_t>;
inline EntryKey entryKey(const ManifestEntry& entry) { return {entry.index, entry.tile}; }

struct Manifest {
  ManifestHeader header;
  std::map<EntryKey, ManifestEntry> entries;
};

// Hash of the pack, the settings and the program.
std::string frameHash(const nlohmann::json& settings, const std::string& pack, const std::string& program);

// Size and hash of a file of the folder. Throws Error if it cannot be read.
ManifestFile describeFile(const std::filesystem::path& folder, const std::string& name);

// Nothing if the folder has no manifest. A last line without its end, of a writer that was killed, is left out. Throws
// Error for any other damage.
std::optional<Manifest> readManifest(const std::filesystem::path& folder);

// Writes the frames in the order of their indices, and their tiles in that of their numbers.
void writeManifest(const std::filesystem::path& folder, const Manifest& manifest);

// Adds lines to a manifest that exists.
class ManifestAppender {
 public:
  // Throws Error.
  ManifestAppender(const std::filesystem::path& folder, const ManifestHeader& header);
  ~ManifestAppender();
  ManifestAppender(const ManifestAppender&) = delete;
  ManifestAppender& operator=(const ManifestAppender&) = delete;
  // The line is written by one call, so that a killed process leaves all of it or none. Throws Error: disk full.
  void add(const ManifestEntry& entry);

 private:
  std::string path_;
  bool hasTiles_;
  int file_ = -1;
};

}  // namespace malus::render
