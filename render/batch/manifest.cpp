#include "render/batch/manifest.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include <fmt/format.h>

#include "bake/pack/format.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/json_text.h"

namespace malus::render {
using nlohmann::json;

namespace {

constexpr int kVersion = 1;

std::string hashText(std::span<const std::byte> bytes) { return fmt::format("{:016x}", pack::hashBytes(bytes)); }

std::string headerLine(const ManifestHeader& h) {
  const Producer& p = h.producer;
  json line = {{"malusBatch", kVersion}, {"scene", h.scene},   {"pack", h.pack},
               {"seed", h.seed},         {"frames", h.frames}, {"program", p.program},
               {"backend", p.backend},   {"device", p.device}, {"processor", p.processor}};
  if (h.tileSide > 0) line["tileSide"] = h.tileSide;
  return jsonText(line, -1) + "\n";
}

// hasTile: the entry is a tile.
std::string entryLine(const ManifestEntry& e, bool hasTile) {
  json files = json::array();
  for (const ManifestFile& file : e.files)
    files.push_back({{"file", file.name}, {"bytes", file.bytes}, {"xxh64", file.hash}});
  json line = {{"index", e.index},   {"name", e.name},         {"hash", e.hash}, {"seed", e.seed},
               {"method", e.method}, {"settings", e.settings}, {"files", files}};
  if (hasTile) line["tile"] = e.tile;
  return jsonText(line, -1) + "\n";
}

ManifestHeader parseHeader(const json& line) {
  if (line.at("malusBatch") != kVersion) throw json::type_error::create(0, "another version", &line);
  return {line.at("scene"),
          line.at("pack"),
          line.at("seed"),
          line.at("frames"),
          {line.at("program"), line.at("backend"), line.at("device"), line.at("processor")},
          line.value("tileSide", 0u)};
}

ManifestEntry parseEntry(const json& line) {
  ManifestEntry entry{line.at("index"),    line.value("tile", std::uint64_t{0}),
                      line.at("name"),     line.at("hash"),
                      line.at("seed"),     line.at("method"),
                      line.at("settings"), {}};
  for (const json& file : line.at("files")) {
    entry.files.push_back({file.at("file"), file.at("bytes"), file.at("xxh64")});
    if (entry.files.back().name.find('/') != std::string::npos)  // must stay in the folder
      throw json::type_error::create(0, "a file outside of the folder", &line);
  }
  return entry;
}

std::string errorText() { return std::strerror(errno); }

}  // namespace

std::string frameHash(const json& settings, const std::string& pack, const std::string& program) {
  const std::string text = jsonText({{"settings", settings}, {"pack", pack}, {"program", program}}, -1);
  return hashText(std::as_bytes(std::span(text)));
}

ManifestFile describeFile(const std::filesystem::path& folder, const std::string& name) {
  const std::vector<std::byte> bytes = readFile(folder / name);
  return {name, bytes.size(), hashText(bytes)};
}

std::optional<Manifest> readManifest(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kManifestFile;
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return std::nullopt;
  const std::string text = readTextFile(path);
  Manifest manifest;
  std::size_t number = 1;
  for (std::size_t at = 0; at < text.size(); ++number) {
    const std::size_t end = text.find('\n', at);
    if (end == std::string::npos) break;  // its writer was killed
    try {
      const json line = json::parse(text.substr(at, end - at));
      if (number == 1) {
        manifest.header = parseHeader(line);
      } else {
        ManifestEntry entry = parseEntry(line);
        const EntryKey key = entryKey(entry);
        manifest.entries[key] = std::move(entry);
      }
    } catch (const json::exception&) {
      throw Error(fmt::format("{}:{}", path.string(), number), "is not a line of a manifest",
                  "a folder of 'malus batch', or another one");
    }
    at = end + 1;
  }
  if (number == 1) return std::nullopt;
  return manifest;
}

void writeManifest(const std::filesystem::path& folder, const Manifest& manifest) {
  std::string text = headerLine(manifest.header);
  for (const auto& [key, entry] : manifest.entries) text += entryLine(entry, manifest.header.tileSide > 0);
  writeFile(folder / kManifestFile, text);
}

ManifestAppender::ManifestAppender(const std::filesystem::path& folder, const ManifestHeader& header)
    : path_((folder / kManifestFile).string()),
      hasTiles_(header.tileSide > 0),
      file_(::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC)) {
  if (file_ < 0) throw Error(path_, "cannot write", "a writable file", errorText());
}

ManifestAppender::~ManifestAppender() { ::close(file_); }

void ManifestAppender::add(const ManifestEntry& entry) {
  const std::string line = entryLine(entry, hasTiles_);
  const ssize_t written = ::write(file_, line.data(), line.size());
  if (written != static_cast<ssize_t>(line.size()))
    throw Error(path_, "cannot write", "enough space", written < 0 ? errorText() : "a part was written");
}

}  // namespace malus::render
