// The list of the finished frames of a folder: manifest.jsonl, a header and a line per frame (render/batch/BATCH.md). A
// line is added when all files of its frame are complete, so that a killed batch continues behind its last frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
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
};

struct ManifestFile {
  std::string name;  // in the folder
  std::uint64_t bytes = 0;
  std::string hash;  // XXH64, 16 hexadecimal digits
};

struct ManifestEntry {
  std::uint64_t index = 0;
  std::string name;
  std::string hash;  // of what made the frame: frameHash()
  std::uint64_t seed = 0;
  std::string method;  // that rendered
  nlohmann::json settings;
  std::vector<ManifestFile> files;
};

struct Manifest {
  ManifestHeader header;
  std::map<std::uint64_t, ManifestEntry> entries;  // by index
};

// Hash of the pack, the settings and the program.
std::string frameHash(const nlohmann::json& settings, const std::string& pack, const std::string& program);

// Size and hash of a file of the folder. Throws Error if it cannot be read.
ManifestFile describeFile(const std::filesystem::path& folder, const std::string& name);

// Nothing if the folder has no manifest. A last line without its end, of a writer that was killed, is left out. Throws
// Error for any other damage.
std::optional<Manifest> readManifest(const std::filesystem::path& folder);

// Writes the frames in the order of their indices.
void writeManifest(const std::filesystem::path& folder, const Manifest& manifest);

// Adds lines to a manifest that exists.
class ManifestAppender {
 public:
  // Throws Error.
  explicit ManifestAppender(const std::filesystem::path& folder);
  ~ManifestAppender();
  ManifestAppender(const ManifestAppender&) = delete;
  ManifestAppender& operator=(const ManifestAppender&) = delete;
  // The line is written by one call, so that a killed process leaves all of it or none. Throws Error: disk full.
  void add(const ManifestEntry& entry);

 private:
  std::string path_;
  int file_ = -1;
};

}  // namespace malus::render
